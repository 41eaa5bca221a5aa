#include "cpu/field_view.h"

#include <algorithm>
#include <array>

#include "cpu/field_access.h"
#include "cpu/query_lanes.h"
#include "kernels/lookup/irradiance.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/volume/volume_choice.h"

namespace probegi {

namespace {

constexpr std::size_t kBatch = 256;

// E at up to kBatch queries of one volume.
void answerIn(const FieldView& view, const kernels::Volume& volume, std::span<const FieldQuery> queries,
              std::span<glm::vec3> out) {
    const FieldAccess access(view);
    std::array<CageAnswer, kBatch> answers;
    answerFromCages(view, volume, queries, answers.data());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const CageAnswer& answer = answers[i];
        if (kernels::enoughWeight(answer.weightSum, access.rules)) {
            out[i] = answer.irradiance;
            continue;
        }
        countFallback(access);
        const FieldQuery& q = queries[i];
        const kernels::Cage cage =
            kernels::cageAround(volume, q.position, q.normal, q.toViewer, access.selfShadowBias, access.rules);
        out[i] = kernels::completedByNeighbours(
            answer.root, answer.weightSum,
            kernels::neighboursIrradiance(access, volume, cage, irradiancePoint(access, q.normal)));
    }
}

std::size_t volumeAt(const FieldView& view, glm::vec3 point) {
    kernels::VolumeChoice choice = kernels::noVolume();
    for (std::size_t i = 0; i < view.volumes.size(); ++i)
        choice = kernels::chooseVolume(choice, view.volumes[i], int(i), point);
    return std::size_t(choice.volume);
}

// E at up to kBatch queries of several volumes: sorted by volume, and in their order within each.
void answerInSeveral(const FieldView& view, std::span<const FieldQuery> queries, std::span<glm::vec3> out) {
    std::array<std::size_t, kBatch> keys;
    for (std::size_t i = 0; i < queries.size(); ++i) keys[i] = volumeAt(view, queries[i].position) * kBatch + i;
    std::sort(keys.begin(), keys.begin() + std::ptrdiff_t(queries.size()));
    std::array<FieldQuery, kBatch> sorted;
    std::array<glm::vec3, kBatch> answers;
    for (std::size_t i = 0; i < queries.size(); ++i) sorted[i] = queries[keys[i] % kBatch];
    for (std::size_t begin = 0, end; begin < queries.size(); begin = end) {
        const std::size_t volume = keys[begin] / kBatch;
        end = begin;
        while (end < queries.size() && keys[end] / kBatch == volume) ++end;
        answerIn(view, view.volumes[volume], std::span(sorted).subspan(begin, end - begin),
                 std::span(answers).subspan(begin, end - begin));
    }
    for (std::size_t i = 0; i < queries.size(); ++i) out[keys[i] % kBatch] = answers[i];
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
        if (view.volumes.size() == 1)
            answerIn(view, view.volumes[0], queries.subspan(begin, count), out.subspan(begin, count));
        else
            answerInSeveral(view, queries.subspan(begin, count), out.subspan(begin, count));
    }
}

glm::vec2 probeMoments(const FieldView& view, int slot, glm::vec3 direction) {
    return momentsAt(view, slot, footprintOf(*view.visibilityTaps, view.visibilityTexels, direction));
}

}  // namespace probegi
