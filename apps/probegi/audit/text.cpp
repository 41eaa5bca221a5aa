#include "audit/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace probegi::tool {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
    const double value = 100 * std::abs(share);
    if (value >= 9.95) return fmt::format("{:.0f} %", value);
    return value >= 0.1 ? fmt::format("{:.1f} %", value) : fmt::format("{:.1g} %", value);
}

std::string point(glm::vec3 p) {
    // Adding 0 turns -0 into 0.
    return fmt::format("{:.2f}, {:.2f}, {:.2f}", std::round(100 * double(p.x)) / 100 + 0,
                       std::round(100 * double(p.y)) / 100 + 0, std::round(100 * double(p.z)) / 100 + 0);
}

/// From so many times nearer probes on nobody places them.
constexpr double kManyProbes = 6;

double smallest(glm::vec3 v) {
    return double(std::min({v.x, v.y, v.z}));
}

/// What hides the probes.
std::string obstacle(const LeakPlace& place) {
    const char* const what = place.cause == LeakCause::thinWall ? "a wall" : "geometry";
    if (place.wall > 0) return fmt::format("{} {} thick", what, metres(place.wall));
    if (place.wall == 0) return "a sheet without thickness";
    return "geometry";
}

std::string titleOf(const LeakPlace& place) {
    const double right = place.truth >= 0 ? place.truth : place.unleaked;
    const std::string numbers =
        fmt::format("{:.3g} W/m2 where {}{:.3g} should be", place.light, place.truth >= 0 ? "" : "about ", right);
    const std::string worst =
        std::abs(place.worst) > 1.2 * std::abs(place.leak) ? fmt::format(", {} at worst", percent(place.worst)) : "";
    if (place.leak > 0)
        return fmt::format("light leaks in: {} of that behind {}{}; {}", percent(place.leak), obstacle(place), worst,
                           numbers);
    return fmt::format("a shadow leaks out: {} of the light is lost to probes behind {}{}; {}", percent(place.leak),
                       obstacle(place), worst, numbers);
}

std::string whyOf(const LeakPlace& place) {
    const std::string apart = metres(smallest(place.spacing));
    switch (place.cause) {
        case LeakCause::guardOff:
            return "the field has no leak guard, so probes light what they do not see";
        case LeakCause::beyondVolume:
            return "the place lies outside the probe volume, whose nearest probes answer";
        case LeakCause::noProbeSees:
            return fmt::format("none of the eight probes around it, {} apart, sees it", apart);
        case LeakCause::probeInMatter:
            return fmt::format("the probe at {} stands inside geometry or behind what is modelled", point(place.probe));
        case LeakCause::sheet:
            return "what is between it and the probes is a single layer of triangles";
        case LeakCause::thinWall:
            return fmt::format("the wall is too thin for what probes {} apart remember of distances", apart);
        case LeakCause::gradient:
            return fmt::format(
                "how light changes in front of it is read from probes {} apart on both sides of "
                "what is between them",
                apart);
        case LeakCause::blurredEdge:
            return fmt::format(
                "probes {} apart look along an edge there, and what they remember of distances is blurred", apart);
        case LeakCause::sharedCluster:
            return "its mask has one bit for a cluster of probes, of which it sees most, but not all";
    }
    return {};
}

std::string remedyOf(const LeakPlace& place) {
    std::vector<std::string> ways;
    if (place.cause == LeakCause::guardOff) ways.push_back("turn the leak guard on (--method ddgi)");
    if (place.cause == LeakCause::sharedCluster)
        ways.push_back(
            "more clusters (--clusters 6 or 8), or masks that let no cluster pass as a whole (--mask-strict)");
    if (place.extend > 0) ways.push_back(fmt::format("let the probe volume reach {} farther", metres(place.extend)));
    if (place.move > 0)
        ways.push_back(
            fmt::format("move the probe, or the grid, by more than {}, out of the geometry", metres(place.move)));
    if (place.thicken > 0) ways.push_back(fmt::format("make the wall at least {} thick", metres(place.thicken)));
    const bool many = place.refine * kManyProbes < smallest(place.spacing);
    if (place.refine > 0 && !(many && !ways.empty()))
        ways.push_back(fmt::format("put probes at most {} apart here{}", metres(place.refine),
                                   many ? ", or leave it to exact visibility (masks)" : ""));
    if (ways.empty())
        return "exact visibility (masks), or a grid that lies otherwise: nearer probes or thickness alone may not do";
    std::string text;
    for (const std::string& way : ways) text += (text.empty() ? "" : "; or ") + way;
    return text;
}

Json vector(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

/// Null where the number does not apply.
Json number(double value, bool applies) {
    return applies ? Json(value) : Json();
}

Json placeJson(const LeakPlace& p, glm::vec3 origin) {
    const PlaceText text = describe(p, origin);
    return {{"cause", nameOf(p.cause)},
            {"position", vector(p.position + origin)},
            {"normal", vector(p.normal)},
            {"lower", vector(p.lower + origin)},
            {"upper", vector(p.upper + origin)},
            {"area", p.area},
            {"points", p.points},
            {"leak", p.leak},
            {"worst", p.worst},
            {"light", p.light},
            {"unleaked", p.unleaked},
            {"truth", number(p.truth, p.truth >= 0)},
            {"truthError", number(p.truthError, p.truth >= 0)},
            {"harm", p.harm},
            {"volume", p.volume},
            {"spacing", vector(p.spacing)},
            {"probe", vector(p.probe + origin)},
            {"probeShare", p.probeShare},
            {"wall", number(p.wall, p.wall >= 0)},
            {"remedy",
             {{"thicken", number(p.thicken, p.thicken > 0)},
              {"refine", number(p.refine, p.refine > 0)},
              {"move", number(p.move, p.move > 0)},
              {"extend", number(p.extend, p.extend > 0)}}},
            {"text", {{"title", text.title}, {"where", text.where}, {"why", text.why}, {"remedy", text.remedy}}}};
}

}  // namespace

std::string metres(double length) {
    if (length >= 1) return fmt::format("{:.3g} m", length);
    if (length >= 0.01) return fmt::format("{:.2g} cm", 100 * length);
    return fmt::format("{:.2g} mm", 1000 * length);
}

const char* nameOf(LeakCause cause) {
    switch (cause) {
        case LeakCause::guardOff:
            return "guardOff";
        case LeakCause::beyondVolume:
            return "beyondVolume";
        case LeakCause::noProbeSees:
            return "noProbeSees";
        case LeakCause::probeInMatter:
            return "probeInMatter";
        case LeakCause::sheet:
            return "sheet";
        case LeakCause::thinWall:
            return "thinWall";
        case LeakCause::gradient:
            return "gradient";
        case LeakCause::blurredEdge:
            return "blurredEdge";
        case LeakCause::sharedCluster:
            return "sharedCluster";
    }
    return "";
}

PlaceText describe(const LeakPlace& place, glm::vec3 origin) {
    const glm::vec3 size = place.upper - place.lower;
    return {titleOf(place),
            fmt::format("at {} (worst), {:.2g} x {:.2g} x {:.2g} m, {:.2g} m2 of surface",
                        point(place.position + origin), size.x, size.y, size.z, place.area),
            whyOf(place), remedyOf(place)};
}

std::string auditSummary(const LeakAudit& audit, const AuditDesc& desc) {
    const std::string tested = fmt::format(
        "{} points on {:.4g} m2 of surface, {} pairs of a point and a probe, of which geometry hides {} ({} of the "
        "weights)",
        audit.points, audit.area, audit.pairs, audit.hiddenPairs, percent(audit.hidden));
    if (audit.points == 0) return "no surface lies in the open, so there is nothing to audit";
    if (audit.places.empty()) return fmt::format("no leaks found above {}: {}", percent(desc.least), tested);
    return fmt::format("{} {} on {:.2g} m2, up to {}: {}", audit.places.size(),
                       audit.places.size() == 1 ? "place leaks" : "places leak", audit.leakingArea,
                       percent(audit.worst), tested);
}

nlohmann::ordered_json auditJson(const LeakAudit& audit, const AuditDesc& desc, glm::vec3 origin) {
    Json places = Json::array();
    for (const LeakPlace& place : audit.places) places.push_back(placeJson(place, origin));
    return {{"points", audit.points},     {"area", audit.area},
            {"pairs", audit.pairs},       {"hiddenPairs", audit.hiddenPairs},
            {"hidden", audit.hidden},     {"meanLight", audit.meanLight},
            {"least", desc.least},        {"leastStops", desc.leastStops},
            {"worst", audit.worst},       {"leakingArea", audit.leakingArea},
            {"harmless", audit.harmless}, {"places", std::move(places)}};
}

}  // namespace probegi::tool
