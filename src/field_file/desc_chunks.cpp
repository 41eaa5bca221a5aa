// A new member of one of these structs stops this file from compiling: give it a chunk of its own, which old readers
// may skip or must refuse, and leave the old chunks as they are.
#include "field/guard_number.h"
#include "field_file/field_chunks.h"
#include "kernels/abi/field_constants.h"

namespace probegi {

namespace {

template <class Enum>
std::uint32_t number(Enum value) {
    return std::uint32_t(value);
}

constexpr std::size_t kKeptGuards = guardNumber(LeakGuard::masks) + 1;
constexpr std::size_t kRules = 2, kBackfaceRules = 2, kOutsideLights = 2;

}  // namespace

bool takeFlag(ByteReader& bytes, const char* what) {
    return takeEnumerator(bytes, 2, what) != 0;
}

std::uint32_t takeEnumerator(ByteReader& bytes, std::size_t count, const char* what) {
    const auto value = bytes.take<std::uint32_t>();
    if (value >= count)
        io::refuse(ErrorCode::unsupported,
                   "has {} number {}, which this ProbeGI does not know; use the version that wrote it", what, value);
    return value;
}

void putVolumes(ByteWriter& bytes, const std::vector<VolumeDesc>& volumes) {
    bytes.put(std::uint32_t(volumes.size()));
    for (const VolumeDesc& volume : volumes) {
        const auto& [origin, spacing, counts, orientation, tracksCamera] = volume;
        bytes.put(origin);
        bytes.put(spacing);
        bytes.put(counts);
        bytes.put(orientation);
        bytes.put(std::uint32_t(tracksCamera));
    }
}

std::vector<VolumeDesc> takeVolumes(ByteReader& bytes) {
    const auto count = bytes.take<std::uint32_t>();
    if (count < 1 || count > std::uint32_t(kernels::kMostVolumes))
        io::refuseMalformed("is damaged: it says that it has {} volumes", count);
    std::vector<VolumeDesc> volumes(count);
    for (VolumeDesc& volume : volumes) {
        volume.origin = bytes.take<glm::vec3>();
        volume.spacing = bytes.take<glm::vec3>();
        volume.counts = bytes.take<glm::ivec3>();
        volume.orientation = bytes.take<glm::quat>();
        volume.tracksCamera = takeFlag(bytes, "a way to follow cameras");
    }
    return volumes;
}

void writeDesc(ChunkWriter& file, const FieldDesc& desc) {
    const auto& [volumes, rays, fixedRays, irradianceTexels, visibilityTexels, rules, emitterSamples, relocation,
                 states, seed] = desc;
    ByteWriter bytes;
    bytes.put(seed);
    for (const int value : {rays, fixedRays, irradianceTexels, visibilityTexels, emitterSamples}) bytes.put(value);
    bytes.put(number(rules));
    bytes.put(std::uint32_t(relocation));
    bytes.put(std::uint32_t(states));
    putVolumes(bytes, volumes);
    file.add(kDescChunk, ChunkNeed::required, bytes.bytes());
}

FieldDesc readDesc(const ChunkReader& file) {
    const std::vector<std::byte> content = file.content(kDescChunk);
    ByteReader bytes(content, "volumes");
    FieldDesc desc;
    desc.seed = bytes.take<std::uint64_t>();
    for (int* value :
         {&desc.raysPerProbe, &desc.fixedRays, &desc.irradianceTexels, &desc.visibilityTexels, &desc.emitterSamples})
        *value = bytes.take<std::int32_t>();
    desc.rules = FieldRules(takeEnumerator(bytes, kRules, "rules"));
    desc.relocation = takeFlag(bytes, "a relocation");
    desc.probeStates = takeFlag(bytes, "probe states");
    desc.volumes = takeVolumes(bytes);
    bytes.finish();
    return desc;
}

void writeSettings(ChunkWriter& file, const FieldSettings& settings) {
    const auto& [hysteresis, visibilityHysteresis, visibilityExponent, selfShadowBias, significantChange,
                 newDistribution, backfaceRule, guard, masks, blockers, camera, outside, outsideRadiance] = settings;
    (void)masks;
    (void)blockers;
    ByteWriter bytes;
    for (const float value :
         {hysteresis, visibilityHysteresis, visibilityExponent, selfShadowBias, significantChange, newDistribution})
        bytes.put(value);
    bytes.put(number(backfaceRule));
    // What primitives hide is told by a scene that is not in the file.
    bytes.put(number(guard == LeakGuard::sdfShadow ? LeakGuard::moments : guard));
    bytes.put(std::uint32_t(camera.has_value()));
    bytes.put(camera.value_or(glm::vec3(0.0f)));
    bytes.put(number(outside));
    bytes.put(outsideRadiance);
    file.add(kSettingsChunk, ChunkNeed::required, bytes.bytes());
}

FieldSettings readSettings(const ChunkReader& file) {
    const std::vector<std::byte> content = file.content(kSettingsChunk);
    ByteReader bytes(content, "settings");
    FieldSettings s;
    for (float* value : {&s.hysteresis, &s.visibilityHysteresis, &s.visibilityExponent, &s.selfShadowBias,
                         &s.significantChange, &s.newDistribution})
        *value = bytes.take<float>();
    s.backfaceRule = BackfaceRule(takeEnumerator(bytes, kBackfaceRules, "a rule for backfaces"));
    s.guard = LeakGuard(takeEnumerator(bytes, kKeptGuards, "a leak guard"));
    const bool seen = takeFlag(bytes, "a kind of camera");
    const auto camera = bytes.take<glm::vec3>();
    if (seen) s.camera = camera;
    s.outside = OutsideLight(takeEnumerator(bytes, kOutsideLights, "a rule for light outside"));
    s.outsideRadiance = bytes.take<glm::vec3>();
    bytes.finish();
    return s;
}

}  // namespace probegi
