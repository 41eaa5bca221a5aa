#include "measure/audit/field_record.h"

#include <algorithm>

#include "field/guard_number.h"
#include "field/layout.h"
#include "field/map_bilinear.h"
#include "field/volume_access.h"
#include "kernels/probe/probe_texel.h"
#include "kernels/volume/placed_probe.h"
#include "kernels/volume/volume_choice.h"
#include "measure/luminance.h"

namespace probegi {

namespace {

bool has(const std::vector<int>& slots, int slot) {
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

/// The pairs that are left out have no weight.
void dropPairs(kernels::CageWeights& weights, const std::array<bool, 4>& pairs) {
    weights.pairSum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (pairs[k]) weights.pair[k] = 0;
        weights.pairSum += weights.pair[k];
    }
}

}  // namespace

const kernels::Volume& FieldRecord::volumeOf(int slot) const noexcept {
    return volumes[probegi::volumeOf(volumes, slot)];
}

glm::vec3 FieldRecord::probeAt(int slot) const noexcept {
    const kernels::Volume& v = volumeOf(slot);
    return kernels::placedPosition(v, kernels::probeCell(v, slot), snapshot.state(slot).placement);
}

int FieldRecord::volumeAt(glm::vec3 point) const noexcept {
    kernels::VolumeChoice choice = kernels::noVolume();
    for (const int i : volumesByDensity(snapshot.desc))
        choice = kernels::chooseVolume(choice, volumes[std::size_t(i)], i, point);
    return choice.volume;
}

Result<FieldRecord> recordOf(const Field& field) {
    auto snapshot = field.read();
    if (!snapshot) return snapshot.error();
    FieldRecord record{std::move(*snapshot), field.control().settings(), {}};
    record.volumes = makeVolumes(record.snapshot.desc, record.snapshot.scrolled);
    return record;
}

RecordAccess::RecordAccess(const FieldRecord& record, const LeftOut& out)
    : rules(record.snapshot.desc.rules == FieldRules::paper ? kernels::kRulesPaper : kernels::kRulesMeasured),
      guard(guardNumber(record.settings.guard)),
      selfShadowBias(record.settings.selfShadowBias),
      maskTexels(record.settings.masks ? record.settings.masks->factor() : 2),
      maskPacked(record.settings.masks && record.settings.masks->packed() ? 1 : 0),
      blockers(int(blockersOf(record.settings.blockers.get()).size())),
      m_record(&record),
      m_out(&out) {}

RecordAccess::RecordAccess(const FieldRecord& record, const LeftOut& out, const std::vector<int>& marked)
    : RecordAccess(record, out) {
    m_marked = &marked;
}

float RecordAccess::backfaceShare(int slot) const {
    // Look-ups pass over a probe that was never updated, by whatever rules.
    return has(m_out->slots, slot) ? kernels::kNeverUpdated : m_record->snapshot.state(slot).backfaceShare;
}

glm::vec2 RecordAccess::moments(int slot, glm::vec3 direction) const {
    const int size = m_record->snapshot.desc.visibilityTexels;
    const std::uint32_t* map = m_record->snapshot.visibility.data() + std::size_t(slot) * std::size_t(size * size);
    return bilinearInMap(direction, size, [&](std::size_t texel) { return kernels::unpackMoments(map[texel]); });
}

glm::vec3 RecordAccess::irradiance(int slot, glm::vec3 direction) const {
    if (m_marked) return glm::vec3(has(*m_marked, slot) ? 1.0f : 0.0f);
    const int size = m_record->snapshot.desc.irradianceTexels;
    const std::uint16_t* map = m_record->snapshot.irradiance.data() + std::size_t(slot) * 3 * std::size_t(size * size);
    return bilinearInMap(direction, size, [&](std::size_t texel) {
        return glm::vec3(kernels::unpackHalf(map[3 * texel]), kernels::unpackHalf(map[3 * texel + 1]),
                         kernels::unpackHalf(map[3 * texel + 2]));
    });
}

LookUp lookUp(const FieldRecord& record, const FieldQuery& query, const LeftOut& out) {
    const RecordAccess access(record, out);
    LookUp look;
    look.volume = record.volumeAt(query.position);
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    look.cage =
        kernels::cageAround(v, query.position, query.normal, query.toViewer, access.selfShadowBias, access.rules);
    look.weights = kernels::weighCage(access, v, look.cage);
    dropPairs(look.weights, out.pairs);
    look.enough = kernels::enoughWeight(look.weights.weightSum, access.rules);
    return look;
}

double answerOf(const FieldRecord& record, const FieldQuery& query, const LookUp& look, const LeftOut& out) {
    const RecordAccess access(record, out);
    const kernels::CageWeights& w = look.weights;
    const kernels::CageLight light = kernels::gatherLight(access, w, query.normal);
    glm::vec3 e;
    if (look.enough) {
        for (int c = 0; c < 3; ++c)
            e[c] = kernels::irradianceAtSurface(w, light.root[c], light.rise[c], 1.0f / w.weightSum, access.rules);
    } else {
        const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
        e = kernels::completedByNeighbours(light.root, w.weightSum,
                                           kernels::neighboursAnswer(access, v, look.cage, query.normal).irradiance);
    }
    return channelMean(e);
}

double shareOf(const FieldRecord& record, const FieldQuery& query, const LookUp& look, const std::vector<int>& slots) {
    const kernels::CageWeights& w = look.weights;
    double share = 0;
    for (int corner = 0; corner < 8; ++corner)
        if (has(slots, w.slot[corner])) share += double(w.weight[corner]);
    if (look.enough) return share / double(w.weightSum);
    const LeftOut none;
    const RecordAccess marked(record, none, slots);
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    const double ofNeighbours =
        double(kernels::neighboursAnswer(marked, v, look.cage, query.normal).irradiance.x) / double(kernels::kPi);
    const double lacking = double(kernels::kDoubtful) - double(w.weightSum);
    return (share + lacking * ofNeighbours) / double(kernels::kDoubtful);
}

std::vector<int> neighboursOf(const FieldRecord& record, const LookUp& look) {
    const kernels::Volume& v = record.volumes[std::size_t(look.volume)];
    std::vector<int> slots;
    for (int i = 0; i < kernels::kNeighbours; ++i) {
        const glm::ivec3 cell = kernels::neighbourCell(glm::ivec3(look.cage.base), i);
        if (kernels::isInVolume(v, cell)) slots.push_back(kernels::probeSlot(v, cell));
    }
    return slots;
}

}  // namespace probegi
