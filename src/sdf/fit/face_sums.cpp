#include "sdf/fit/face_sums.h"

#include <algorithm>
#include <glm/common.hpp>

namespace probegi {

namespace {

constexpr int kSide = kernels::kSdfFaceSide;
constexpr int kPerFace = kSide * kSide;
constexpr float kAlike = 0.01f;

/// One face's texels, and which of them are known.
struct Face {
    std::array<glm::vec3, kPerFace> colours{};
    std::array<bool, kPerFace> known{};

    /// Mean of the known ones beside a texel, diagonally too; false: there are none.
    bool meanBeside(int u, int v, glm::vec3& mean) const {
        glm::vec3 sum(0.0f);
        int count = 0;
        for (int y = std::max(v - 1, 0); y <= std::min(v + 1, kSide - 1); ++y)
            for (int x = std::max(u - 1, 0); x <= std::min(u + 1, kSide - 1); ++x) {
                const auto at = std::size_t(y * kSide + x);
                if (!known[at]) continue;
                sum += colours[at];
                ++count;
            }
        if (count > 0) mean = sum / float(count);
        return count > 0;
    }

    /// Spreads what is known, one texel a round.
    void fill() {
        for (int round = 0; round < kSide; ++round) {
            Face next = *this;
            for (int i = 0; i < kPerFace; ++i)
                if (!known[std::size_t(i)])
                    next.known[std::size_t(i)] = meanBeside(i % kSide, i / kSide, next.colours[std::size_t(i)]);
            *this = next;
        }
    }
};

}  // namespace

void FaceSums::add(const kernels::SdfSolid& box, glm::vec3 point, glm::vec3 albedo) {
    const kernels::SdfFacePoint at = kernels::sdfFacePointAt(box, point);
    const auto nearest = std::size_t(at.first + (at.u < 0.5f ? 0 : 1) + (at.v < 0.5f ? 0 : kSide));
    m_sums[nearest] += albedo;
    ++m_counts[nearest];
}

std::vector<glm::vec3> FaceSums::means(glm::vec3 otherwise) const {
    std::vector<glm::vec3> out;
    bool differs = false;
    for (int f = 0; f < 6; ++f) {
        Face face;
        for (int i = 0; i < kPerFace; ++i) {
            const auto at = std::size_t(f * kPerFace + i);
            face.known[std::size_t(i)] = m_counts[at] > 0;
            if (m_counts[at] > 0) face.colours[std::size_t(i)] = m_sums[at] / float(m_counts[at]);
        }
        face.fill();
        for (std::size_t i = 0; i < kPerFace; ++i) {
            const glm::vec3 colour = glm::clamp(face.known[i] ? face.colours[i] : otherwise, 0.0f, 1.0f);
            const glm::vec3 difference = glm::abs(colour - otherwise);
            differs = differs || std::max({difference.x, difference.y, difference.z}) > kAlike;
            out.push_back(colour);
        }
    }
    return differs ? out : std::vector<glm::vec3>();
}

}  // namespace probegi
