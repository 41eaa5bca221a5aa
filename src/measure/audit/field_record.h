#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernels/lookup/irradiance.h"
#include "probegi/field.h"
#include "probegi/masks.h"
#include "sdf/sdf_blockers.h"

namespace probegi {

/// All that a field's look-ups depend on, read once from a field of any backend.
struct FieldRecord {
    FieldSnapshot snapshot;
    FieldSettings settings;
    std::vector<kernels::Volume> volumes;  ///< as they stand, in the order of the desc

    const kernels::Volume& volumeOf(int slot) const noexcept;
    /// Where the probe of a slot stands, metres. The one place that knows.
    glm::vec3 probeAt(int slot) const noexcept;
    /// The volume that answers at a point of the world: the densest that holds it. (In the last cell of one the next
    /// takes over by and by, which is left out of account.)
    int volumeAt(glm::vec3 point) const noexcept;
};

/// Errors: those of Field::read.
Result<FieldRecord> recordOf(const Field& field);

/// What a look-up is to leave out of account.
struct LeftOut {
    std::vector<int> slots{};                           ///< probes, wherever they would come in
    std::array<bool, 4> pairs{};                        ///< of the gradient (kernels/lookup/cage_weights.h)
    std::array<float, 8> seen{1, 1, 1, 1, 1, 1, 1, 1};  ///< factor on what the guard says of the cage's probes, 0..1
};

/// How the look-up's kernels (kernels/lookup/access.h) read a record, one point at a time.
class RecordAccess {
public:
    using MapPoint = glm::vec3;  ///< a direction of the world, of any length but 0
    int rules;
    int guard;
    float selfShadowBias;
    int maskTexels, maskPacked;
    int blockers;

    RecordAccess(const FieldRecord& record, const LeftOut& out);
    /// The same field with a light of 1 (before decoding) in some probes and none in the others: what it answers is
    /// their share of the weights. `marked` must outlive the access.
    RecordAccess(const FieldRecord& record, const LeftOut& out, const std::vector<int>& marked);

    friend float storedBackfaceShare(const RecordAccess& a, int slot) { return a.backfaceShare(slot); }
    friend int storedPlacement(const RecordAccess& a, int slot) { return a.placement(slot); }
    friend float givenVisibility(const RecordAccess& a, int corner) { return a.m_out->seen[std::size_t(corner)]; }
    friend void countFallback(const RecordAccess&) {}
    friend int maskWord(const RecordAccess& a, int number) {
        return int(a.m_record->settings.masks->words()[std::size_t(number)]);
    }
    friend const kernels::SdfBlocker& blockerAt(const RecordAccess& a, int number) {
        return blockersOf(a.m_record->settings.blockers.get())[std::size_t(number)];
    }
    friend glm::vec3 visibilityPoint(const RecordAccess&, glm::vec3 direction) { return direction; }
    friend glm::vec3 axisPoint(const RecordAccess&, const kernels::Volume& v, int axis, bool up) {
        return kernels::axisDirection(v, axis, up);
    }
    friend glm::vec3 irradiancePoint(const RecordAccess&, glm::vec3 normal) { return normal; }
    friend void storedMoments(const RecordAccess& a, int slot, glm::vec3 at, float& mean, float& meanSquare) {
        const glm::vec2 moments = a.moments(slot, at);
        mean = moments.x;
        meanSquare = moments.y;
    }
    friend void momentsOnAxis(const RecordAccess& a, const kernels::Volume&, int slot, glm::vec3 at, float& mean,
                              float& meanSquare) {
        storedMoments(a, slot, at, mean, meanSquare);
    }
    friend glm::vec3 storedIrradiance(const RecordAccess& a, int slot, glm::vec3 at) { return a.irradiance(slot, at); }

private:
    float backfaceShare(int slot) const;
    int placement(int slot) const { return int(m_record->snapshot.state(slot).placement); }
    glm::vec2 moments(int slot, glm::vec3 direction) const;
    glm::vec3 irradiance(int slot, glm::vec3 direction) const;

    const FieldRecord* m_record;
    const LeftOut* m_out;
    const std::vector<int>* m_marked = nullptr;
};

/// A look-up at one point, taken apart.
struct LookUp {
    int volume = 0;
    kernels::Cage cage;
    kernels::CageWeights weights;
    bool enough = true;  ///< the cage answers alone, without its neighbours
};

LookUp lookUp(const FieldRecord& record, const FieldQuery& query, const LeftOut& out = {});

/// What the field answers by these weights: E, mean of the channels, W m^-2.
double answerOf(const FieldRecord& record, const FieldQuery& query, const LookUp& look, const LeftOut& out = {});

/// Share of the answer's weights that some probes have, 0..1: those of the cage, and of its neighbours where they make
/// up what it lacks.
double shareOf(const FieldRecord& record, const FieldQuery& query, const LookUp& look, const std::vector<int>& slots);

/// Slots of the neighbours that are asked where a cage has too little weight.
std::vector<int> neighboursOf(const FieldRecord& record, const LookUp& look);

}  // namespace probegi
