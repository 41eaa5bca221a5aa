#include "sdf/fit/fit_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace probegi {

namespace {

constexpr std::size_t kSamples = 8192;    ///< normals that vote
constexpr std::size_t kCandidates = 512;  ///< of them that stand for a direction
constexpr float kAlike = 0.996f;          ///< cosine of 5 degrees
constexpr float kUpright = 0.05f;         ///< largest cosine between two axes of a frame as they are found
constexpr float kSnap = 0.99998f;         ///< a frame so near to the world's axes, by the cosine, is the world's
constexpr double kLeastShare = 0.008;     ///< of all hits that a further frame must have

/// Every k-th normal.
std::vector<glm::vec3> someNormals(std::span<const FitSurface> surfaces) {
    std::vector<glm::vec3> normals;
    const std::size_t step = std::max<std::size_t>(surfaces.size() / kSamples, 1);
    for (std::size_t i = 0; i < surfaces.size(); i += step)
        if (glm::dot(surfaces[i].normal, surfaces[i].normal) > 0.5f) normals.push_back(surfaces[i].normal);
    return normals;
}

struct Direction {
    glm::vec3 mean{0.0f};
    std::size_t votes = 0;
};

/// The direction, forwards or backwards, along which most normals lie; among those perpendicular to `to`, if not 0.
Direction mostCommon(std::span<const glm::vec3> normals, glm::vec3 to) {
    Direction best;
    glm::vec3 candidate(0.0f);
    const std::size_t step = std::max<std::size_t>(normals.size() / kCandidates, 1);
    for (std::size_t c = 0; c < normals.size(); c += step) {
        if (std::abs(glm::dot(normals[c], to)) > kUpright) continue;
        std::size_t votes = 0;
        for (const glm::vec3& n : normals) votes += std::abs(glm::dot(n, normals[c])) > kAlike;
        if (votes > best.votes) {
            best.votes = votes;
            candidate = normals[c];
        }
    }
    if (best.votes == 0) return best;
    for (const glm::vec3& n : normals) {
        const float cosine = glm::dot(n, candidate);
        if (std::abs(cosine) > kAlike) best.mean += cosine > 0 ? n : -n;
    }
    best.mean = glm::normalize(best.mean);
    return best;
}

/// The frame of two directions, its axes in the order and with the signs of those of `like` that they are nearest to.
glm::mat3 frameOf(glm::vec3 first, glm::vec3 second, const glm::mat3& like) {
    second = glm::normalize(second - first * glm::dot(first, second));
    const glm::vec3 axes[3] = {first, second, glm::cross(first, second)};
    int order[3] = {0, 1, 2}, best[3] = {0, 1, 2};
    float most = -1;
    do {
        float sum = 0;
        for (int i = 0; i < 3; ++i) sum += std::abs(glm::dot(axes[order[i]], like[i]));
        if (sum > most + 1e-6f) {
            most = sum;
            std::copy(order, order + 3, best);
        }
    } while (std::next_permutation(order, order + 3));
    glm::mat3 frame;
    for (int i = 0; i < 2; ++i) frame[i] = axes[best[i]] * (glm::dot(axes[best[i]], like[i]) < 0 ? -1.0f : 1.0f);
    frame[2] = glm::cross(frame[0], frame[1]);
    return frame;
}

glm::mat3 mainFrame(std::span<const glm::vec3> normals) {
    const glm::mat3 world(1.0f);
    const Direction first = mostCommon(normals, glm::vec3(0.0f));
    if (first.votes == 0) return world;
    Direction second = mostCommon(normals, first.mean);
    if (second.votes == 0) {
        const glm::vec3 other = std::abs(first.mean.x) < 0.7f ? world[0] : world[2];
        second.mean = glm::normalize(other - first.mean * glm::dot(first.mean, other));
    }
    const glm::mat3 frame = frameOf(first.mean, second.mean, world);
    const bool snaps = frame[0].x > kSnap && frame[1].y > kSnap && frame[2].z > kSnap;
    return snaps ? world : frame;
}

}  // namespace

bool facesAlong(const glm::mat3& frame, glm::vec3 normal) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(glm::dot(frame[axis], normal)) > kAlike) return true;
    return false;
}

std::vector<glm::mat3> findFrames(std::span<const FitSurface> surfaces, int most) {
    std::vector<glm::vec3> normals = someNormals(surfaces);
    const double all = double(normals.size());
    std::vector<glm::mat3> frames{mainFrame(normals)};
    const glm::mat3 upright = frames[0];
    while (int(frames.size()) < most) {
        std::erase_if(normals, [&](const glm::vec3& n) { return facesAlong(frames.back(), n); });
        const Direction slope = mostCommon(normals, glm::vec3(0.0f));
        if (double(slope.votes) < kLeastShare * all || slope.votes == 0) break;
        // Beside the slope, an axis of the upright frame: a roof's ridge runs along a wall.
        int along = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(glm::dot(upright[axis], slope.mean)) < std::abs(glm::dot(upright[along], slope.mean)))
                along = axis;
        frames.push_back(frameOf(slope.mean, upright[along], upright));
    }
    return frames;
}

}  // namespace probegi
