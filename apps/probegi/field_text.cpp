#include "field_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "console/output.h"
#include "console/terminal.h"
#include "console/vector_json.h"
#include "probegi/measure.h"
#include "render_stats.h"
#include "saved_field.h"

namespace probegi::tool {

namespace {

using Json = nlohmann::ordered_json;

const char* guardName(LeakGuard guard) {
    if (guard == LeakGuard::none) return "none";
    return guard == LeakGuard::moments ? "moments" : guard == LeakGuard::masks ? "masks" : "other";
}

Json volumesOf(const FieldSnapshot& snapshot) {
    Json volumes = Json::array();
    for (std::size_t i = 0; i < snapshot.desc.volumes.size(); ++i) {
        const VolumeDesc& v = snapshot.desc.volumes[i];
        volumes.push_back({{"origin", toJson(v.origin)},
                           {"spacing", toJson(v.spacing)},
                           {"counts", toJson(v.counts)},
                           {"turned", v.orientation != VolumeDesc{}.orientation},
                           {"tracksCamera", v.tracksCamera},
                           {"scrolled", toJson(snapshot.scrolled[i])}});
    }
    return volumes;
}

Json describe(const std::string& path, const SavedField& saved) {
    const FieldSnapshot& snapshot = saved.snapshot;
    const FieldDesc& desc = snapshot.desc;
    const FieldProvenance& from = saved.provenance;
    std::error_code none;
    Json json{{"field", path},
              {"bytes", std::filesystem::file_size(path, none)},
              {"program", from.program},
              {"scene", from.scene},
              {"recipe", from.recipe},
              {"geometry", fmt::format("{:016x}", from.fingerprint.geometry)},
              {"light", fmt::format("{:016x}", from.fingerprint.light)},
              {"probes", probeCount(desc)},
              {"volumes", volumesOf(snapshot)},
              {"raysPerProbe", desc.raysPerProbe},
              {"irradianceTexels", desc.irradianceTexels},
              {"visibilityTexels", desc.visibilityTexels},
              {"relocation", desc.relocation},
              {"probeStates", desc.probeStates},
              {"seed", desc.seed},
              {"updates", snapshot.frame},
              {"leakGuard", guardName(saved.settings.guard)},
              {"unfinished", !saved.convergence.empty()}};
    if (const auto& masks = saved.settings.masks) {
        json["masks"] = masksJson(masks->report());
        json["masks"]["clusters"] = masks->clusters();
        json["masks"]["factor"] = masks->factor();
    }
    return json;
}

std::string orUnknown(const Json& text) {
    const std::string plain = plainText(text.get<std::string>(), 4 * kShownName);
    return plain.empty() ? "unknown" : plain;
}

void printText(const Json& info, const SavedField& saved) {
    fmt::print("field       {}, {}\n", plainText(info["field"].get<std::string>()), sizeText(info["bytes"]));
    fmt::print("made by     {}\nscene       {}\nhow         {}\n", orUnknown(info["program"]), orUnknown(info["scene"]),
               orUnknown(info["recipe"]));
    for (const Json& v : info["volumes"])
        fmt::print("volume      {} x {} x {} probes from {} every {} m{}\n", v["counts"][0].get<int>(),
                   v["counts"][1].get<int>(), v["counts"][2].get<int>(), vectorText(v["origin"]),
                   vectorText(v["spacing"]), v["turned"].get<bool>() ? ", turned" : "");
    fmt::print("probes      {}, {} rays, maps of {} and {} texels\n", info["probes"].get<int>(),
               info["raysPerProbe"].get<int>(), info["irradianceTexels"].get<int>(),
               info["visibilityTexels"].get<int>());
    fmt::print("updates     {}{}\nleak guard  {}\n", info["updates"].get<int>(),
               info["unfinished"].get<bool>() ? ", of a bake that has not ended" : "",
               info["leakGuard"].get<std::string>());
    if (const auto& masks = saved.settings.masks)
        fmt::print("masks       {} clusters, factor {}\n{}", masks->clusters(), masks->factor(),
                   masksText(masks->report()));
}

bool equalMasks(const SavedField& a, const SavedField& b) {
    const auto &x = a.settings.masks, &y = b.settings.masks;
    if (!x || !y) return !x && !y;
    return x->volumes() == y->volumes() && x->clusters() == y->clusters() && x->factor() == y->factor() &&
           std::ranges::equal(x->words(), y->words());
}

}  // namespace

std::string sizeText(std::uint64_t bytes) {
    if (bytes < 10'000) return fmt::format("{} bytes", bytes);
    if (bytes < 10'000'000) return fmt::format("{:.0f} KB", double(bytes) / 1e3);
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string masksText(const MaskReport& m) {
    return fmt::format(
        "mask cells  {}, {} of them with something in the way; {} different cubes, {} ({} a byte a texel and cluster)\n"
        "mask error  {:.3g} % of the leaking field's; {:.3g} clusters seen on average; {:.3g} % of the texels blind\n",
        m.cells, m.blocked, m.cubes, sizeText(m.bytes), sizeText(m.denseBytes), 100 * m.residual, m.meanClusters,
        100 * m.blindTexels);
}

Result<void> printFieldInfo(const std::string& path, bool json, const ReadLimits& limits) {
    const auto saved = loadField(path, limits);
    if (!saved) return saved.error();
    const Json info = describe(path, *saved);
    if (json)
        fmt::print("{}", jsonText(info));
    else
        printText(info, *saved);
    return {};
}

Result<void> compareFieldFiles(const std::string& a, const std::string& b, bool json, const ReadLimits& limits) {
    const auto x = loadField(a, limits);
    if (!x) return x.error();
    const auto y = loadField(b, limits);
    if (!y) return y.error();
    const auto d = compareFields(x->snapshot, y->snapshot);
    if (!d) return fail(d.error().code, fmt::format("'{}' and '{}': {}", a, b, d.error().message));
    const bool masks = equalMasks(*x, *y);
    const bool settings = x->settings.guard == y->settings.guard &&
                          sameSettings(x->snapshot.desc, x->settings, y->snapshot.desc, y->settings);
    if (json) {
        fmt::print("{}",
                   jsonText({{"probes", d->probes},
                             {"mean", d->mean},
                             {"rms", d->rms},
                             {"ratio", {{"p5", d->ratio.low}, {"median", d->ratio.median}, {"p95", d->ratio.high}}},
                             {"worst", d->worst},
                             {"worstSlot", d->worstSlot},
                             {"equalMaps", d->equalMaps},
                             {"equalStates", d->equalStates},
                             {"equalMasks", masks},
                             {"equalSettings", settings}}));
        return {};
    }
    fmt::print("probes  {:<10} that both fields use\n", d->probes);
    if (d->mean == 0)
        fmt::print("mean    -          of the light, A over B: B or A is black\n");
    else
        fmt::print(
            "mean    {:.6f}   light of all probes, A over B; of single ones {:.3f}, {:.3f}, {:.3f} (5th, 50th, 95th "
            "percentile)\n"
            "rms     {:.6f}   root mean square difference of irradiance, over B's mean\n"
            "worst   {:.6f}   largest difference of a probe's light, over its light in B (slot {})\n",
            d->mean, d->ratio.low, d->ratio.median, d->ratio.high, d->rms, d->worst, d->worstSlot);
    fmt::print("bits    {}; masks {}; settings {}\n",
               d->equalStates ? "the same"
               : d->equalMaps ? "the same maps, other states"
                              : "others",
               !x->settings.masks && !y->settings.masks ? "in neither"
               : masks                                  ? "the same"
                                                        : "others",
               settings ? "the same" : "others");
    return {};
}

}  // namespace probegi::tool
