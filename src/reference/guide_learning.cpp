#include "reference/guide_learning.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "core/parallel.h"
#include "kernels/sampling.h"

namespace probegi {

namespace {

/// Size of the voxels in which lights are clustered: a share of the probe spacing, and at least a share of the distance
/// from which they are seen.
constexpr float kVoxelShare = 0.25f, kVoxelAngle = 0.1f;
/// Margin of boxes around the lights found, and their minimum thickness, as shares of the voxel.
constexpr float kMargin = 0.08f, kThickness = 0.01f;
/// Boxes that contribute less than this share of a region's light count as background.
constexpr float kMinContribution = 0.004f;
/// A region keeps its boxes only if they reduce the variance below this share.
constexpr float kWorthwhile = 0.75f;

struct Box {
    glm::vec3 lower{1e30f}, upper{-1e30f};
    float voxel = 0;
};

/// The boxes around all lights, and each light's box.
struct Boxes {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> ofLight;
};

Boxes gather(const GuideLessons& lessons, float spacing) {
    Boxes out;
    out.ofLight.reserve(lessons.lights.size());
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    for (const GuideLight& light : lessons.lights) {
        const float base = kVoxelShare * spacing;
        const int level =
            std::clamp(int(std::ceil(std::log2(std::max(kVoxelAngle * light.distance / base, 1.0f)))), 0, 15);
        const float voxel = std::ldexp(base, level);
        const auto part = [&](float x) {
            return std::uint64_t(std::int64_t(std::clamp(std::floor(x / voxel), -131072.0f, 131071.0f)) + 131072);
        };
        const std::uint64_t key = part(light.position.x) | part(light.position.y) << 18 | part(light.position.z) << 36 |
                                  std::uint64_t(level) << 54 | std::uint64_t(light.sky) << 58;
        const auto [entry, fresh] = known.try_emplace(key, std::uint32_t(out.boxes.size()));
        if (fresh) out.boxes.push_back({.voxel = voxel});
        Box& box = out.boxes[entry->second];
        box.lower = glm::min(box.lower, light.position);
        box.upper = glm::max(box.upper, light.position);
        out.ofLight.push_back(entry->second);
    }
    for (Box& box : out.boxes) {
        const glm::vec3 size = box.upper - box.lower;
        for (int axis = 0; axis < 3; ++axis) {
            // Small margin across a surface, where no further lights lie; larger along it, where they may.
            const float margin = box.voxel * (size[axis] < kThickness * box.voxel ? 0.5f * kThickness : kMargin);
            box.lower[axis] -= margin;
            box.upper[axis] += margin;
        }
    }
    return out;
}

void setLane(PathGuide::Block& block, int lane, const Box& box, float strength) {
    for (int axis = 0; axis < 3; ++axis) {
        block.lower[axis][lane] = box.lower[axis];
        block.upper[axis][lane] = box.upper[axis];
    }
    block.strength[lane] = strength;
}

/// A region's receivers begin..end, and their lights.
struct Class {
    std::size_t begin, end, firstLight, lastLight;
};

struct RegionBoxes {
    std::vector<PathGuide::Block> blocks;
    float background = 0;
};

/// The boxes that contribute most light to a region. A box's strength is scaled such that its predicted light at the
/// receivers matches what they received, partial occlusion included.
RegionBoxes strongest(const GuideLessons& lessons, const Boxes& boxes, const Class& in) {
    std::unordered_map<std::uint32_t, std::size_t> known;
    std::vector<std::pair<float, std::uint32_t>> sent;
    float total = 0;
    for (std::size_t i = in.firstLight; i < in.lastLight; ++i) {
        const auto [entry, fresh] = known.try_emplace(boxes.ofLight[i], sent.size());
        if (fresh) sent.emplace_back(0.0f, boxes.ofLight[i]);
        sent[entry->second].first += lessons.lights[i].radiance;
        total += lessons.lights[i].radiance;
    }
    float background = 0;
    for (std::size_t r = in.begin; r < in.end; ++r) background += lessons.background[r];
    total += background;
    std::sort(sent.begin(), sent.end(), [](const auto& a, const auto& b) {
        return a.first > b.first || (a.first == b.first && a.second < b.second);
    });

    RegionBoxes out;
    const float perRay = 1.0f / (float(in.end - in.begin) * float(GuideLessons::kRaysPerReceiver));
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (i >= std::size_t(PathGuide::kMaxBoxes) || sent[i].first < kMinContribution * total) {
            background += sent[i].first;
            continue;
        }
        const int lane = int(i) % PathGuide::kLanes;
        if (lane == 0) {
            PathGuide::Block& block = out.blocks.emplace_back();
            for (int l = 0; l < PathGuide::kLanes; ++l) setLane(block, l, boxes.boxes[sent[i].second], 0.0f);
        }
        setLane(out.blocks.back(), lane, boxes.boxes[sent[i].second], sent[i].first * perRay);
    }
    for (PathGuide::Block& block : out.blocks) {
        float seen[PathGuide::kLanes] = {};
        for (std::size_t r = in.begin; r < in.end; ++r) {
            float shares[PathGuide::kLanes];
            PathGuide::seenShares(block, lessons.receivers[r].position, lessons.receivers[r].normal, shares);
            for (int lane = 0; lane < PathGuide::kLanes; ++lane) seen[lane] += shares[lane] / float(in.end - in.begin);
        }
        for (int lane = 0; lane < PathGuide::kLanes; ++lane)
            block.strength[lane] = seen[lane] > 1e-9f ? block.strength[lane] / seen[lane] : 0.0f;
    }
    out.background = background * perRay;
    return out;
}

/// Moments of one sample of a region's incoming light, estimated from the lights found.
struct Moments {
    float mean = 0;
    float plain = 0, guided = 0;  ///< second moments, without and with the region's boxes

    /// Variance with the boxes over that without.
    float share() const {
        const float square = mean * mean;
        return plain > square ? std::max(guided - square, 0.0f) / (plain - square) : 1.0f;
    }
};

Moments moments(const GuideLessons& lessons, const PathGuide& guide, const Class& in) {
    double sum = 0, plain = 0, guided = 0;
    std::size_t light = in.firstLight;
    PathGuide::Mixture mixture;
    for (std::size_t r = in.begin; r < in.end; ++r) {
        const GuideReceiver& receiver = lessons.receivers[r];
        guide.mixtureAt(receiver.position, receiver.normal, mixture);
        sum += double(lessons.background[r]);
        plain += double(lessons.backgroundSquares[r]);
        guided += double(lessons.backgroundSquares[r]) / double(1 - mixture.share);
        for (; light < in.lastLight && lessons.lights[light].receiver == r; ++light) {
            const GuideLight& l = lessons.lights[light];
            const glm::vec3 direction = glm::normalize(l.position - receiver.position);
            const float cosine = std::max(glm::dot(direction, receiver.normal), 1e-4f);
            float density = 1 - mixture.share;
            if (mixture.share > 0)
                density +=
                    mixture.share * PathGuide::pdf(mixture, receiver.position, direction) * kernels::kPi / cosine;
            sum += double(l.radiance);
            plain += double(l.radiance) * double(l.radiance);
            guided += double(l.radiance) * double(l.radiance) / double(density);
        }
    }
    const double rays = double(in.end - in.begin) * GuideLessons::kRaysPerReceiver;
    return {float(sum / rays), float(plain / rays), float(guided / rays)};
}

std::vector<Class> classes(const GuideLessons& lessons) {
    std::vector<Class> out;
    std::size_t light = 0;
    for (std::size_t begin = 0, end; begin < lessons.receivers.size(); begin = end) {
        for (end = begin;
             end < lessons.receivers.size() && lessons.receivers[end].region == lessons.receivers[begin].region;)
            ++end;
        const std::size_t first = light;
        while (light < lessons.lights.size() && lessons.lights[light].receiver < end) ++light;
        out.push_back({begin, end, first, light});
    }
    return out;
}

/// Regions without lessons use the field's mean as incoming light, with the scatter of the regions that have some;
/// regions that no path reached use the mean of all.
void expectLevels(const GuideLessons& lessons, std::span<const Moments> found, PathGuide& guide) {
    double means = 0, roots = 0;
    for (const Moments& m : found) {
        means += double(m.mean);
        roots += std::sqrt(double(m.plain));
    }
    const float scatter = means > 0 ? float(roots / means) : 1.0f;
    double sum = 0, known = 0;
    for (const float level : lessons.levels) {
        sum += double(std::max(level, 0.0f));
        known += level >= 0 ? 1 : 0;
    }
    const float usual = known > 0 ? float(sum / known) : 0.0f;
    for (std::size_t i = 0; i < lessons.levels.size(); ++i)
        guide.setExpected(i, scatter * (lessons.levels[i] >= 0 ? lessons.levels[i] : usual));
}

}  // namespace

Result<PathGuide> learnGuide(const Context& context, const Transport& transport, const Field& field,
                             std::vector<GuideReceiver> first, std::uint64_t seed) {
    // Its regions are those of the first volume; where it ends, its outermost ones stand for what is beyond.
    const VolumeDesc grid = field.control().place(0);
    PathGuide guide(grid);
    const auto lessons = takeLessons(context, transport, field, guide, std::move(first), seed);
    if (!lessons) return lessons.error();
    const Boxes boxes = gather(*lessons, std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z}));
    const std::vector<Class> regions = classes(*lessons);
    std::vector<RegionBoxes> chosen(regions.size());
    parallelFor(context, regions.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) chosen[i] = strongest(*lessons, boxes, regions[i]);
    });
    for (std::size_t i = 0; i < regions.size(); ++i)
        guide.setRegion(lessons->receivers[regions[i].begin].region, std::move(chosen[i].blocks), chosen[i].background);
    std::vector<Moments> found(regions.size());
    parallelFor(context, regions.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) found[i] = moments(*lessons, guide, regions[i]);
    });
    expectLevels(*lessons, found, guide);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const std::size_t region = lessons->receivers[regions[i].begin].region;
        const bool worthwhile = found[i].share() < kWorthwhile;
        if (!worthwhile) guide.clearRegion(region);
        guide.setExpected(region, std::sqrt(worthwhile ? found[i].guided : found[i].plain));
    }
    return guide;
}

}  // namespace probegi
