#include "field/layout.h"
#include "field_file/field_chunks.h"

namespace probegi {

namespace {

constexpr std::size_t kStateWords = 15;

/// Word by word, each of all probes: like stands beside like, and packs better.
void writeStates(ChunkWriter& file, const std::vector<ProbeState>& states) {
    std::vector<std::uint32_t> words(kStateWords * states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto& [backfaceShare, backs, fronts, steps, nextSteps, trust, filter, placement] = states[i];
        std::size_t at = i;
        const auto put = [&](std::uint32_t word) {
            words[at] = word;
            at += states.size();
        };
        for (const float share : {backfaceShare, backs, fronts}) put(std::bit_cast<std::uint32_t>(share));
        for (const std::uint32_t word : {steps, nextSteps, trust}) put(word);
        for (const std::uint32_t word : filter) put(word);
        put(placement);
    }
    file.addArray(kStatesChunk, ChunkNeed::required, std::span<const std::uint32_t>(words));
}

std::vector<ProbeState> readStates(const ChunkReader& file, std::size_t probes, io::Budget& budget) {
    const auto words = file.array<std::uint32_t>(kStatesChunk, std::uint64_t(kStateWords) * probes);
    budget.charge(std::uint64_t(probes) * sizeof(ProbeState));
    std::vector<ProbeState> states(probes);
    for (std::size_t i = 0; i < probes; ++i) {
        ProbeState& s = states[i];
        std::size_t at = i;
        const auto take = [&] {
            const std::uint32_t word = words[at];
            at += probes;
            return word;
        };
        for (float* share : {&s.backfaceShare, &s.backs, &s.fronts}) *share = std::bit_cast<float>(take());
        for (std::uint32_t* word : {&s.steps, &s.nextSteps, &s.trust}) *word = take();
        for (std::uint32_t& word : s.filter) word = take();
        s.placement = take();
    }
    return states;
}

}  // namespace

void writeSnapshot(ChunkWriter& file, const FieldSnapshot& snapshot) {
    ByteWriter bytes;
    bytes.put(std::int32_t(snapshot.frame));
    bytes.put(std::int32_t(snapshot.rayTurns));
    for (const glm::ivec3& cells : snapshot.scrolled) bytes.put(cells);
    file.add(kProbesChunk, ChunkNeed::required, bytes.bytes());
    file.addArray(kIrradianceChunk, ChunkNeed::required, std::span<const std::uint16_t>(snapshot.irradiance));
    file.addArray(kVisibilityChunk, ChunkNeed::required, std::span<const std::uint32_t>(snapshot.visibility));
    writeStates(file, snapshot.states);
}

FieldSnapshot readSnapshot(const ChunkReader& file, const FieldDesc& desc, io::Budget& budget) {
    const FieldLayout layout(desc);
    FieldSnapshot snapshot;
    snapshot.desc = desc;
    snapshot.slots = {0, probeCount(desc)};
    const std::vector<std::byte> content = file.content(kProbesChunk);
    ByteReader bytes(content, "probes");
    snapshot.frame = bytes.take<std::int32_t>();
    snapshot.rayTurns = bytes.take<std::int32_t>();
    for (std::size_t i = 0; i < desc.volumes.size(); ++i) snapshot.scrolled.push_back(bytes.take<glm::ivec3>());
    bytes.finish();
    // At most 2^24 probes of 3 x 1024 and 4096 texels: far from 2^64.
    snapshot.irradiance =
        file.array<std::uint16_t>(kIrradianceChunk, 3 * std::uint64_t(layout.probes) * layout.irradianceTexels);
    snapshot.visibility =
        file.array<std::uint32_t>(kVisibilityChunk, std::uint64_t(layout.probes) * layout.visibilityTexels);
    snapshot.states = readStates(file, layout.probes, budget);
    return snapshot;
}

}  // namespace probegi
