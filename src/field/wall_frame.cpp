#include "field/wall_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace probegi {

namespace {

constexpr glm::quat kWorld(1.0f, 0.0f, 0.0f, 0.0f);
/// Normals that count as one direction: a degree.
constexpr float kAlike = 0.99985f;
/// Cosine to which two directions may be off the right angle.
constexpr float kSquare = 0.02f;
/// Samples that are compared with all others.
constexpr std::size_t kMostCandidates = 512;
/// Share of all samples that a turned frame must serve more than the world's axes do.
constexpr float kLeastGain = 0.2f;
/// And the least share that stands by each of two of its axes.
constexpr float kLeastAxis = 0.05f;
constexpr int kRaysASide = 48;

bool along(glm::vec3 normal, glm::vec3 axis) {
    return std::abs(glm::dot(normal, axis)) > kAlike;
}

/// The mean of the largest bundle of like normals, of those at right angles to `across` (zero: any); zero: none.
glm::vec3 commonest(std::span<const WallSample> samples, glm::vec3 across) {
    const auto fits = [&](glm::vec3 n) { return std::abs(glm::dot(n, across)) < kSquare; };
    const std::size_t step = std::max<std::size_t>(1, samples.size() / kMostCandidates);
    glm::vec3 best(0.0f);
    std::size_t most = 0;
    for (std::size_t i = 0; i < samples.size(); i += step) {
        const glm::vec3 candidate = samples[i].normal;
        if (!fits(candidate)) continue;
        std::size_t count = 0;
        for (std::size_t j = 0; j < samples.size(); j += step) count += along(samples[j].normal, candidate);
        if (count > most) most = count, best = candidate;
    }
    glm::vec3 mean(0.0f);
    for (const WallSample& s : samples)
        if (along(s.normal, best)) mean += glm::dot(s.normal, best) > 0 ? s.normal : -s.normal;
    return glm::dot(mean, mean) > 0 ? glm::normalize(mean) : best;
}

/// Share of the samples that stand by one axis.
float shareAlong(std::span<const WallSample> samples, glm::vec3 axis) {
    const auto count = std::ranges::count_if(samples, [&](const WallSample& s) { return along(s.normal, axis); });
    return float(count) / float(std::max<std::size_t>(1, samples.size()));
}

float shareAlongAny(std::span<const WallSample> samples, const glm::mat3& axes) {
    return shareAlong(samples, axes[0]) + shareAlong(samples, axes[1]) + shareAlong(samples, axes[2]);
}

/// The same axes in the order and with the signs that turn the world's the least.
glm::mat3 leastTurned(const glm::mat3& axes) {
    constexpr std::array<std::array<int, 3>, 6> kOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    glm::mat3 best(1.0f);
    float most = -4;  // the trace of a rotation by a falls with a
    for (const auto& order : kOrders)
        for (int signs = 0; signs < 8; ++signs) {
            glm::mat3 turned;
            for (int a = 0; a < 3; ++a) turned[a] = axes[order[std::size_t(a)]] * (signs >> a & 1 ? -1.0f : 1.0f);
            const float trace = turned[0][0] + turned[1][1] + turned[2][2];
            if (glm::determinant(turned) > 0 && trace > most) most = trace, best = turned;
        }
    return best;
}

}  // namespace

glm::quat wallFrame(std::span<const WallSample> samples) {
    const glm::vec3 first = commonest(samples, glm::vec3(0.0f));
    const glm::vec3 second = commonest(samples, first);
    const glm::vec3 third = glm::cross(first, second);
    if (!(glm::dot(third, third) > 0.5f)) return kWorld;
    glm::mat3 axes(first, glm::normalize(second - first * glm::dot(first, second)), glm::vec3(0.0f));
    axes[2] = glm::cross(axes[0], axes[1]);
    if (shareAlong(samples, axes[1]) < kLeastAxis) return kWorld;
    if (shareAlongAny(samples, axes) < shareAlongAny(samples, glm::mat3(1.0f)) + kLeastGain) return kWorld;
    return glm::normalize(glm::quat_cast(leastTurned(axes)));
}

Result<Bounds> boundsInFrame(const Tracer& tracer, std::span<const WallSample> samples, const glm::quat& frame) {
    const glm::quat back = glm::conjugate(frame);
    const Bounds world = tracer.bounds();
    Bounds around{back * world.lower, back * world.lower};
    for (int corner = 1; corner < 8; ++corner) {
        const glm::vec3 p =
            back * glm::vec3((corner & 1 ? world.upper : world.lower).x, (corner & 2 ? world.upper : world.lower).y,
                             (corner & 4 ? world.upper : world.lower).z);
        around = {glm::min(around.lower, p), glm::max(around.upper, p)};
    }
    Bounds found{around.upper, around.lower};
    const auto add = [&](glm::vec3 p) {
        const glm::vec3 in = glm::clamp(back * p, around.lower, around.upper);
        found = {glm::min(found.lower, in), glm::max(found.upper, in)};
    };
    for (const WallSample& s : samples) add(s.position);

    std::vector<Ray> rays(kRaysASide * kRaysASide);
    std::vector<Hit> hits(rays.size());
    const glm::vec3 size = around.size();
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 direction(0.0f);
            direction[axis] = sign;
            for (int i = 0; i < kRaysASide * kRaysASide; ++i) {
                glm::vec3 from = sign > 0 ? around.lower : around.upper;
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                from[u] = around.lower[u] + size[u] * (float(i % kRaysASide) + 0.5f) / kRaysASide;
                from[v] = around.lower[v] + size[v] * (float(i / kRaysASide) + 0.5f) / kRaysASide;
                rays[std::size_t(i)] = {.origin = frame * from, .direction = frame * direction};
            }
            if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
            for (std::size_t i = 0; i < rays.size(); ++i)
                if (hits[i].valid()) add(rays[i].origin + hits[i].distance * rays[i].direction);
        }
    return glm::all(glm::lessThanEqual(found.lower, found.upper)) ? found : around;
}

}  // namespace probegi
