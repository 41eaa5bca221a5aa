#include "cpu/field_view.h"

#include <algorithm>
#include <array>

#include "cpu/field_access.h"
#include "cpu/query_lanes.h"
#include "kernels/lookup/volume_blend.h"
#include "kernels/probe/octahedral_texel.h"

namespace probegi {

namespace {

constexpr std::size_t kBatch = 256;

// Answers up to kBatch queries in one volume: take(number, answer).
template <class Take>
void askVolume(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
               const Take& take) {
    const FieldAccess access(view);
    std::array<CageAnswer, kBatch> cages;
    answerFromCages(view, volume, queries, cages.data());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const CageAnswer& answer = cages[i];
        if (kernels::enoughWeight(answer.weightSum, access.rules)) {
            take(i, kernels::VolumeAnswer{answer.irradiance, answer.weightSum});
            continue;
        }
        countFallback(access);
        const FieldQuery& q = queries[i];
        const kernels::Cage cage =
            kernels::cageAround(volume, q.position, q.normal, q.toViewer, access.selfShadowBias, access.rules);
        const kernels::VolumeAnswer neighbours =
            kernels::neighboursAnswer(access, volume, cage, irradiancePoint(access, q.normal));
        take(i,
             kernels::VolumeAnswer{kernels::completedByNeighbours(answer.root, answer.weightSum, neighbours.irradiance),
                                   answer.weightSum + neighbours.weight});
    }
}

// kernels::blendedIrradiance() of up to kBatch points at once: volume by volume, each asked for all points to which it
// has something to say.
class BlendedBatch {
public:
    BlendedBatch(const FieldView& view, std::span<const FieldQuery> queries)
        : m_view(view), m_access(view.volumes, view.order), m_queries(queries) {
        for (std::size_t i = 0; i < queries.size(); ++i) m_blends[i] = kernels::emptyBlend();
    }

    void run(std::span<glm::vec3> out) {
        const int count = volumeCount(m_access);
        for (int rank = 0; rank < count; ++rank) askAround(rank);
        if (anyUnknown())
            for (int rank = 0; rank < count; ++rank) askNearest(rank);
        for (std::size_t i = 0; i < m_queries.size(); ++i) out[i] = m_blends[i].irradiance;
    }

private:
    void askAround(int rank) {
        const kernels::Volume& volume = volumeOfRank(m_access, rank);
        m_asked = 0;
        for (std::size_t i = 0; i < m_queries.size(); ++i) {
            if (m_blends[i].total >= kernels::kWholeBlend) continue;
            const float cells = kernels::cellsInRank(m_access, rank, volume, m_queries[i].position);
            if (const float weight = kernels::nextWeight(m_blends[i], cells); weight > 0.0f) ask(i, weight);
        }
        askVolume(m_view, volume, std::span(m_questions).first(m_asked),
                  [&](std::size_t k, const kernels::VolumeAnswer& answer) {
                      m_blends[m_points[k]] = kernels::withVolume(m_blends[m_points[k]], answer, m_numbers[k]);
                  });
    }

    void askNearest(int rank) {
        const kernels::Volume& volume = volumeOfRank(m_access, rank);
        m_asked = 0;
        for (std::size_t i = 0; i < m_queries.size(); ++i) {
            if (m_blends[i].total > 0.0f) continue;
            const float distance = kernels::squareDistanceToVolume(volume, m_queries[i].position);
            if (kernels::isNearer(m_blends[i], distance)) ask(i, distance);
        }
        askVolume(m_view, volume, std::span(m_questions).first(m_asked),
                  [&](std::size_t k, const kernels::VolumeAnswer& answer) {
                      m_blends[m_points[k]] = kernels::withNearest(m_blends[m_points[k]], answer, m_numbers[k]);
                  });
    }

    bool anyUnknown() const {
        return std::any_of(m_blends.begin(), m_blends.begin() + std::ptrdiff_t(m_queries.size()),
                           [](const kernels::VolumeBlend& blend) { return !(blend.total > 0.0f); });
    }

    void ask(std::size_t point, float number) {
        m_points[m_asked] = point;
        m_numbers[m_asked] = number;
        m_questions[m_asked] = m_queries[point];
        ++m_asked;
    }

    const FieldView& m_view;
    VolumeAccess m_access;
    std::span<const FieldQuery> m_queries;
    std::array<kernels::VolumeBlend, kBatch> m_blends;
    // Of the volume at hand: which points, their weights or distances, and what is asked.
    std::size_t m_asked = 0;
    std::array<std::size_t, kBatch> m_points;
    std::array<float, kBatch> m_numbers;
    std::array<FieldQuery, kBatch> m_questions;
};

void answerInOne(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    askVolume(view, view.volumes[0], queries,
              [&](std::size_t i, const kernels::VolumeAnswer& answer) { out[i] = answer.irradiance; });
}

void fadeOutside(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    const VolumeAccess access(view.volumes, view.order);
    for (std::size_t i = 0; i < queries.size(); ++i)
        out[i] =
            kernels::withOutside(out[i], kernels::coverageAt(access, queries[i].position), view.order.outsideRadiance);
}

}  // namespace

TapTable makeTapTable(int size) {
    TapTable table;
    table.reserve(std::size_t(size + 1) * (size + 1));
    const auto index = [size](int x, int y) {
        const glm::ivec2 t = kernels::octWrapTexel(x, y, size);
        return std::uint16_t(t.y * size + t.x);
    };
    for (int y = -1; y < size; ++y)
        for (int x = -1; x < size; ++x)
            table.push_back({index(x, y), index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)});
    return table;
}

void queryIrradiance(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    for (std::size_t begin = 0; begin < queries.size(); begin += kBatch) {
        const std::size_t count = std::min(kBatch, queries.size() - begin);
        const auto some = queries.subspan(begin, count);
        const auto answers = out.subspan(begin, count);
        if (view.volumes.size() == 1)
            answerInOne(view, some, answers);
        else
            BlendedBatch(view, some).run(answers);
        if (view.order.outsideFades) fadeOutside(view, some, answers);
    }
}

glm::vec2 probeMoments(const FieldView& view, int slot, glm::vec3 direction) {
    return momentsAt(view, slot, footprintOf(*view.visibilityTaps, view.visibilityTexels, direction));
}

}  // namespace probegi
