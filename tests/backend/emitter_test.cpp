// Light of lamps that rays hardly ever meet: what one update knows of them, against the closed form of a polygon.
#include <cmath>
#include <numeric>

#include "backend/every_backend.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr glm::vec3 kGlow{50.0f, 30.0f, 10.0f};
using Polygon = std::vector<glm::vec3>;

/// Irradiance at a point from a polygon of radiance 1 that lies in front of it (Lambert 1760): half the sum over its
/// edges of the angle they subtend times the cosine between the normal and that of the edge's plane. Negative where the
/// polygon lies partly below the horizon.
double polygonIrradiance(glm::dvec3 at, glm::dvec3 normal, const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(polygon[i]) - at);
        const glm::dvec3 b = glm::normalize(glm::dvec3(polygon[(i + 1) % polygon.size()]) - at);
        if (glm::dot(normal, a) < 0.05) return -1;
        const glm::dvec3 across = glm::cross(a, b);
        sum += std::atan2(glm::length(across), glm::dot(a, b)) * glm::dot(normal, glm::normalize(across));
    }
    return std::abs(0.5 * sum);
}

/// A square of black material at a height, its front below.
void addSquare(Scene& scene, glm::vec3 centre, float side, Material material) {
    const float h = 0.5f * side;
    Primitive p;
    p.positions = {{-h, 0, -h}, {h, 0, -h}, {h, 0, h}, {-h, 0, h}};
    p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    p.indices = {0, 1, 2, 0, 2, 3};
    material.baseColor = {0, 0, 0, 1};
    p.material = int(scene.materials.size());
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back({"square", {p}});
    scene.addNode({.translation = centre, .mesh = int(scene.meshes.size()) - 1});
}

Material lampMaterial() {
    Material m;
    m.emission = kGlow;
    return m;
}

Polygon squareAt(glm::vec3 centre, float side, float from = 0.0f, float to = 1.0f) {
    const float h = 0.5f * side, left = (from - 0.5f) * side, right = (to - 0.5f) * side;
    return {centre + glm::vec3(left, 0, -h), centre + glm::vec3(right, 0, -h), centre + glm::vec3(right, 0, h),
            centre + glm::vec3(left, 0, h)};
}

/// Ratios of what the probes store to what polygons of radiance kGlow send, over all texels that see all of them.
struct Ratios {
    double rms = 0, mean = 0;
};

class BackendEmitters : public EveryBackend {
protected:
    static FieldSetup lampDesc(int looks = 4) {
        FieldSetup desc;
        desc.volumes = {{{-1.1f, -0.5f, -0.93f}, {1.0f, 1.0f, 0.9f}, {3, 2, 3}}};
        desc.raysPerProbe = 64;
        desc.emitterSamples = looks;
        return desc;
    }
    Field updated(const Scene& scene, const FieldDesc& desc, float seconds = 0) const {
        const ScenePose pose = poseAt(scene, seconds);
        Field field = makeField(desc);
        EXPECT_TRUE(field.update(*makeTracer(scene, pose), {pose.lights, scene.sky}));
        return field;
    }
    static Ratios compare(const Field& field, const Polygon& polygon) {
        const int size = field.desc().irradianceTexels;
        double squares = 0, sum = 0, wanted = 0;
        int count = 0;
        for (int probe = 0; probe < probeCount(field.desc()); ++probe)
            for (int texel = 0; texel < size * size; ++texel) {
                const glm::vec3 n = texelDirection(texel, size);
                const double truth = polygonIrradiance(probePosition(field.desc().volumes[0], probe), n, polygon);
                if (truth < 0) continue;
                const glm::vec3 e = probeIrradiance(field, probe, n);
                const double ratio = double(e.y) / (truth * double(kGlow.y));
                squares += (ratio - 1) * (ratio - 1);
                sum += double(e.y);
                wanted += truth * double(kGlow.y);
                ++count;
            }
        EXPECT_GT(count, 100);
        return {std::sqrt(squares / count), sum / wanted};
    }
    static float brightest(const Field& field) {
        float largest = 0;
        for (int probe = 0; probe < probeCount(field.desc()); ++probe)
            for (int texel = 0; texel < 64; ++texel)
                largest = std::max(largest, probeIrradiance(field, probe, texelDirection(texel, 8)).x);
        return largest;
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendEmitters);

// One update knows a small lamp, which only one ray in hundreds would meet.
TEST_P(BackendEmitters, oneUpdateHasTheClosedFormOfASmallLamp) {
    Scene scene;
    addSquare(scene, {0, 2, 0}, 0.2f, lampMaterial());
    const Ratios looks = compare(updated(scene, lampDesc()), squareAt({0, 2, 0}, 0.2f));
    EXPECT_LT(looks.rms, 0.05);
    EXPECT_NEAR(looks.mean, 1.0, 0.02);
    const Ratios rays = compare(updated(scene, lampDesc(0)), squareAt({0, 2, 0}, 0.2f));
    EXPECT_GT(rays.rms, 0.9);
    RecordProperty("rms", std::to_string(looks.rms));
}

// The same of a primitive, one way up and turned over.
TEST_P(BackendEmitters, oneUpdateHasTheClosedFormOfAGlowingBox) {
    SdfPrimitive lamp;
    lamp.centre = {0, 2.0004f, 0};
    lamp.halfSize = {0.1f, 0.0004f, 0.1f};  // its sides send 0.4 %
    lamp.emission = kGlow;
    for (const glm::quat turn : {glm::quat(1, 0, 0, 0), glm::quat(0, 1, 0, 0)}) {
        lamp.rotation = turn;
        const auto scene = made(GetParam().open(context));
        const auto tracer = made(scene->openSdf({{lamp}}, {}, {}));
        Field field = makeField(lampDesc(8));  // half of them at its upper side
        ASSERT_TRUE(field.update(*tracer, {}));
        const Ratios looks = compare(field, squareAt({0, 2, 0}, 0.2f));
        EXPECT_LT(looks.rms, 0.05);
        EXPECT_NEAR(looks.mean, 1.0, 0.02);
    }
}

// A primitive on a node takes its light along.
TEST_P(BackendEmitters, aGlowingBoxIsWhereThePosePutsIt) {
    Scene scene;
    addSquare(scene, {0, 2, 0}, 0.2f, {});
    scene.nodes[0].name = "lamp";
    scene.animations.push_back(
        {0, AnimationPath::translation, Interpolation::linear, {0.0f, 1.0f}, {{0, 2, 0, 0}, {0.7f, 2.5f, 0, 0}}});
    SdfPrimitive lamp;
    lamp.centre = {0, 0.001f, 0};
    lamp.halfSize = {0.1f, 0.001f, 0.1f};
    lamp.emission = kGlow;
    lamp.node = "lamp";
    const auto tracer = made(made(GetParam().open(context))->openSdf({{lamp}}, scene, poseAt(scene)));
    ASSERT_TRUE(tracer->setPose(poseAt(scene, 1.0f)));
    Field field = makeField(lampDesc());
    ASSERT_TRUE(field.update(*tracer, {}));
    EXPECT_LT(compare(field, squareAt({0.7f, 2.5f, 0}, 0.2f)).rms, 0.05);
}

// Rays and looks meet a large lamp about equally often; the average of many updates is its light.
TEST_P(BackendEmitters, raysAndLooksTogetherAreUnbiased) {
    Scene scene;
    addSquare(scene, {0, 1.3f, 0}, 1.0f, lampMaterial());
    const ScenePose pose = poseAt(scene);
    for (const int looks : {0, 1, 4, 16}) {
        Field field = makeField(lampDesc(looks));
        ASSERT_TRUE(field.converge(*makeTracer(scene, pose), {pose.lights, scene.sky}, 1e-9f, 100));
        EXPECT_NEAR(compare(field, squareAt({0, 1.3f, 0}, 1.0f)).mean, 1.0, 0.01) << looks;
    }
}

TEST_P(BackendEmitters, whatIsBlockedBringsExactlyNothing) {
    Scene scene;
    addSquare(scene, {0, 2, 0}, 0.2f, lampMaterial());
    EXPECT_GT(brightest(updated(scene, lampDesc())), 0.0f);
    addSquare(scene, {0, 1.5f, 0}, 20.0f, {});
    EXPECT_EQ(brightest(updated(scene, lampDesc())), 0.0f);
}

TEST_P(BackendEmitters, singleSidedLampsShineToTheirFront) {
    Scene scene;
    addSquare(scene, {0, -2, 0}, 0.2f, lampMaterial());  // its front turned away
    EXPECT_EQ(brightest(updated(scene, lampDesc())), 0.0f);
    scene.materials[0].doubleSided = true;
    const Ratios both = compare(updated(scene, lampDesc()), squareAt({0, -2, 0}, 0.2f));
    EXPECT_LT(both.rms, 0.05);
}

// A texture and a mask that leave half of the lamp dark: the light is that of the other half.
TEST_P(BackendEmitters, texturesAndMasksAreLookedUp) {
    for (const bool mask : {false, true}) {
        Scene scene;
        Material lamp = lampMaterial();
        TextureRef& texture = mask ? lamp.baseColorTexture : lamp.emissiveTexture;
        texture.image = 0;
        texture.nearest = true;
        const std::uint8_t other = mask ? 255 : 0;
        scene.images.push_back({2, 1, {255, 255, 255, 255, other, other, other, std::uint8_t(255 - other)}, "half"});
        if (mask) lamp.alphaMode = AlphaMode::mask;
        addSquare(scene, {0, 2, 0}, 0.5f, lamp);
        const ScenePose pose = poseAt(scene);
        Field field = makeField(lampDesc());
        ASSERT_TRUE(field.converge(*makeTracer(scene, pose), {pose.lights, scene.sky}, 1e-9f, 200));
        const Ratios half = compare(field, squareAt({0, 2, 0}, 0.5f, 0.0f, 0.5f));
        EXPECT_NEAR(half.mean, 1.0, 0.01) << (mask ? "mask" : "texture");
        EXPECT_LT(half.rms, 0.05);
    }
}

TEST_P(BackendEmitters, aLampIsWhereThePosePutsIt) {
    Scene scene;
    addSquare(scene, {0, 2, 0}, 0.2f, lampMaterial());
    scene.animations.push_back(
        {0, AnimationPath::translation, Interpolation::linear, {0.0f, 1.0f}, {{0, 2, 0, 0}, {0.7f, 2.5f, 0, 0}}});
    const Field before = updated(scene, lampDesc()), after = updated(scene, lampDesc(), 1.0f);
    EXPECT_LT(compare(before, squareAt({0, 2, 0}, 0.2f)).rms, 0.05);
    EXPECT_LT(compare(after, squareAt({0.7f, 2.5f, 0}, 0.2f)).rms, 0.05);
    EXPECT_GT(compare(after, squareAt({0, 2, 0}, 0.2f)).rms, 0.2);
}

// Everything glows, so that rays know all there is to know: looks must not add noise. Storage alone makes 0.1 %.
TEST_P(BackendEmitters, furnaceStaysStill) {
    const Scene scene = *makeBuiltinScene("furnace", {.albedo = 0.5f, .emission = 1});
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeTracer(scene, pose);
    FieldSetup desc =
        FieldDesc{.volumes = {{{-0.83f, 0.6f, -0.9f}, {0.8f, 0.9f, 0.9f}, {3, 3, 3}}}, .raysPerProbe = 32};
    desc.volumes[0].origin += pose.bounds.centre() - glm::vec3(0, 1.5f, 0);
    desc.hysteresis = 0;
    Field field = makeField(desc);
    std::vector<double> sum(27), squares(27);
    constexpr int kFirst = 20, kFrames = 30;
    for (int frame = 0; frame < kFirst + kFrames; ++frame) {
        ASSERT_TRUE(field.update(*tracer, {pose.lights, scene.sky}));
        for (int probe = 0; frame >= kFirst && probe < 27; ++probe) {
            const double e = double(probeIrradiance(field, probe, {0, 1, 0}).y) / 6.2831853;
            sum[std::size_t(probe)] += e / kFrames;
            squares[std::size_t(probe)] += e * e / kFrames;
        }
    }
    for (std::size_t probe = 0; probe < 27; ++probe) {
        EXPECT_NEAR(sum[probe], 1.0, 0.003);
        EXPECT_LT(std::sqrt(std::max(0.0, squares[probe] - sum[probe] * sum[probe])), 0.004);
    }
}

// With the lamp of the Cornell box: what other backends look at is what the CPU looks at, also where the CPU traces.
TEST_P(BackendEmitters, probesHoldWhatTheCpusHold) {
    const Scene scene = *makeBuiltinScene("cornell");
    const ScenePose pose = poseAt(scene);
    const auto own = makeTracer(scene, pose), embree = made(makeEmbreeTracer(context, scene, pose));
    const FieldSetup desc =
        FieldDesc{.volumes = {offTheWalls(*placeVolume(pose.bounds, {.counts = {5, 5, 5}}))}, .raysPerProbe = 48};
    Field onOwn = makeField(desc), onEmbree = makeField(desc), reference = *Field::create(context, desc, desc);
    for (int frame = 0; frame < 2; ++frame) {
        ASSERT_TRUE(onOwn.update(*own, {pose.lights, scene.sky}));
        ASSERT_TRUE(onEmbree.update(*embree, {pose.lights, scene.sky}));
        ASSERT_TRUE(reference.update(*embree, {pose.lights, scene.sky}));
    }
    double sum = 0, ownDifference = 0, embreeDifference = 0;
    for (int probe = 0; probe < probeCount(desc); ++probe)
        for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1)}) {
            const glm::vec3 wanted = probeIrradiance(reference, probe, n);
            sum += double(wanted.y);
            ownDifference += std::abs(double(probeIrradiance(onOwn, probe, n).y) - double(wanted.y));
            embreeDifference += std::abs(double(probeIrradiance(onEmbree, probe, n).y) - double(wanted.y));
        }
    ASSERT_GT(sum, 1.0);
    EXPECT_LT(ownDifference, 2e-3 * sum);
    EXPECT_LT(embreeDifference, 1e-3 * sum);
    RecordProperty("difference", std::to_string(ownDifference / sum));
}

// By the paper's rules, and of ray data that somebody else made, nothing is looked for.
TEST_P(BackendEmitters, thePaperLooksForNothing) {
    Scene scene;
    addSquare(scene, {0, 2, 0}, 0.2f, lampMaterial());
    FieldSetup without = lampDesc(0), with = lampDesc(4);
    without.rules = with.rules = FieldRules::paper;
    const AtlasDifference difference = compareAtlases(updated(scene, with), updated(scene, without));
    EXPECT_EQ(difference.worstIrradiance, 0.0);
}

TEST_P(BackendEmitters, descsOutOfRangeAreRefused) {
    for (const int looks : {-1, 17}) {
        const auto refused = GetParam().makeField(context, lampDesc(looks));
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find("emitterSamples"), std::string::npos);
    }
}

}  // namespace
}  // namespace probegi::test
