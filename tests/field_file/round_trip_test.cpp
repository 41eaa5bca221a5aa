// What was saved is loaded.
#include <gmock/gmock.h>

#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "field_file/content_hash.h"
#include "field_file/field_bytes.h"
#include "probegi/io.h"
#include "probegi/sdf.h"
#include "raw_file.h"
#include "saved_field.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

void expectSame(const FieldDesc& a, const FieldDesc& b) {
    EXPECT_EQ(a.volumes, b.volumes);
    EXPECT_EQ(a.raysPerProbe, b.raysPerProbe);
    EXPECT_EQ(a.fixedRays, b.fixedRays);
    EXPECT_EQ(a.irradianceTexels, b.irradianceTexels);
    EXPECT_EQ(a.visibilityTexels, b.visibilityTexels);
    EXPECT_EQ(a.rules, b.rules);
    EXPECT_EQ(a.emitterSamples, b.emitterSamples);
    EXPECT_EQ(a.relocation, b.relocation);
    EXPECT_EQ(a.probeStates, b.probeStates);
    EXPECT_EQ(a.seed, b.seed);
}

void expectSame(const FieldSnapshot& a, const FieldSnapshot& b) {
    expectSame(a.desc, b.desc);
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.rayTurns, b.rayTurns);
    EXPECT_EQ(a.scrolled, b.scrolled);
    EXPECT_EQ(a.slots, b.slots);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.visibility, b.visibility);
    EXPECT_EQ(a.states, b.states);
}

void expectSame(const Masks& a, const Masks& b) {
    EXPECT_EQ(a.volumes(), b.volumes());
    EXPECT_EQ(a.clusters(), b.clusters());
    EXPECT_EQ(a.factor(), b.factor());
    EXPECT_TRUE(std::ranges::equal(a.words(), b.words()));
    const MaskReport &x = a.report(), &y = b.report();
    EXPECT_EQ(x.visibilitySeconds + x.clusterSeconds + x.maskSeconds + x.compressSeconds, 0)
        << "times are not kept: one field has one file";
    EXPECT_EQ(x.rays, y.rays);
    EXPECT_EQ(x.cells, y.cells);
    EXPECT_EQ(x.blocked, y.blocked);
    EXPECT_EQ(x.cubes, y.cubes);
    EXPECT_EQ(x.denseBytes, y.denseBytes);
    EXPECT_EQ(x.bytes, y.bytes);
    EXPECT_EQ(x.startLoss, y.startLoss);
    EXPECT_EQ(x.loss, y.loss);
    EXPECT_EQ(x.residual, y.residual);
    EXPECT_EQ(x.meanClusters, y.meanClusters);
    EXPECT_EQ(x.blindTexels, y.blindTexels);
}

TEST(FieldFile, whatWasSavedIsLoaded) {
    const SavedField saved = someField();
    const fs::path path = fs::path(testing::TempDir()) / "some.field";
    ASSERT_TRUE(saveField(path, saved));
    EXPECT_TRUE(isFieldFile(path));
    auto loaded = loadField(path);
    fs::remove(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    expectSame(loaded->snapshot, saved.snapshot);
    ASSERT_TRUE(loaded->settings.masks);
    expectSame(*loaded->settings.masks, *saved.settings.masks);
    EXPECT_EQ(loaded->provenance.program, "test 1.2");
    EXPECT_EQ(loaded->provenance.scene, "halls");
    EXPECT_EQ(loaded->provenance.recipe, "--clusters 5");
    EXPECT_EQ(loaded->provenance.fingerprint, (SceneFingerprint{7, 8}));
    EXPECT_EQ(loaded->convergence.words, saved.convergence.words);
    const std::vector<std::uint8_t> again = encodeField(*loaded);
    EXPECT_EQ(again, encodeField(saved)) << "one field has one file";
    loaded->settings.masks = saved.settings.masks;
    EXPECT_EQ(loaded->settings, saved.settings);
}

TEST(FieldFile, aScrolledVolumeComesBackWhereItStood) {
    FieldDesc desc;
    desc.volumes[0].counts = {5, 5, 5};
    desc.volumes[0].tracksCamera = true;
    desc.rules = FieldRules::paper;
    desc.probeStates = true;
    Field field = Field::create(*Context::create({.threads = 1}), desc).value();
    ASSERT_TRUE(field.scroll(0, {-3, 7, 100}));
    const SavedField saved{field.read().value(), field.control().settings(), {}, {}};
    const auto loaded = loadFieldFromMemory("scrolled", encodeField(saved));
    ASSERT_TRUE(loaded) << loaded.error().message;
    expectSame(loaded->snapshot, saved.snapshot);
    EXPECT_EQ(loaded->settings, saved.settings);
    EXPECT_TRUE(loaded->convergence.empty());
    const Field restored = restoreField(*openBackend(*Context::create({.threads = 1})).value(), *loaded).value();
    EXPECT_EQ(restored.control().place(0), field.control().place(0));
    expectSame(restored.read().value(), saved.snapshot);
}

TEST(FieldFile, primitivesAreNotKept) {
    SavedField saved = someField();
    saved.settings.guard = LeakGuard::sdfShadow;
    saved.settings.masks = nullptr;
    saved.settings.blockers = placeSdf({}, {}, poseAt({})).value();
    const auto loaded = loadFieldFromMemory("shadowed", encodeField(saved));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->settings.guard, LeakGuard::moments);
    EXPECT_FALSE(loaded->settings.blockers);
    expectSame(loaded->snapshot, saved.snapshot);
}

TEST(FieldFile, isAsTheDocumentSays) {
    const SavedField saved = someField();
    const FileBytes file = encodeField(saved);
    const RawFile raw = takenApart(file);
    EXPECT_EQ(putTogether(raw), file);
    std::vector<std::string> names;
    for (const RawChunk& chunk : raw.chunks) names.push_back(chunk.name);
    EXPECT_THAT(names,
                testing::ElementsAre("DESC", "SETT", "MADE", "MASK", "MWRD", "PROB", "IRRA", "VISI", "STAT", "CONV"));
    for (const RawChunk& chunk : raw.chunks)
        EXPECT_EQ(chunk.flags & 1u, chunk.name == "MADE" || chunk.name == "CONV" ? 0u : 1u) << chunk.name;
    // DESC is too short to be worth packing: its bytes are the numbers.
    const RawChunk desc = RawFile(raw).chunk("DESC");
    EXPECT_EQ(desc.unpackedBytes, 8u + 8 * 4 + 4 + 2 * 56);
    if ((desc.flags & 2u) == 0) {
        EXPECT_EQ(numberAt(desc.stored, 0, 8), saved.snapshot.desc.seed);
        EXPECT_EQ(numberAt(desc.stored, 8, 4), 40u);
    }
    EXPECT_EQ(RawFile(raw).chunk("STAT").unpackedBytes, 26u * 60);
    EXPECT_EQ(RawFile(raw).chunk("IRRA").unpackedBytes, 26u * 16 * 6);
}

TEST(FieldFile, checksumsAreXxh64) {
    const auto of = [](std::string_view text) { return hashOf(std::as_bytes(std::span(text))); };
    EXPECT_EQ(of(""), 0xef46db3751d8e999u);
    EXPECT_EQ(of("a"), 0xd24ec4f1a98c6e5bu);
    EXPECT_EQ(of("abc"), 0x44bc2cf5ad770999u);
    ContentHash pieces;
    pieces.add(std::as_bytes(std::span(std::string_view("ab"))));
    pieces.add('c');
    EXPECT_EQ(pieces.value(), of("abc"));
}

TEST(FieldFile, whatIsNotWholeIsNotSaved) {
    const fs::path path = fs::path(testing::TempDir()) / "no.field";
    const auto complaint = [&](const auto& spoil) {
        SavedField bad = someField();
        spoil(bad);
        const auto done = saveField(path, bad);
        EXPECT_FALSE(fs::exists(path));
        return done ? std::string() : done.error().message;
    };
    EXPECT_THAT(complaint([](SavedField& s) { s.snapshot.slots.count = 3; }), HasSubstr("some of the field's probes"));
    EXPECT_THAT(complaint([](SavedField& s) { s.snapshot.states.pop_back(); }), HasSubstr("states"));
    EXPECT_THAT(complaint([](SavedField& s) { s.settings.hysteresis = 2; }), HasSubstr("hysteresis is 2"));
    EXPECT_THAT(complaint([](SavedField& s) { s.settings.masks = nullptr; }), HasSubstr("needs FieldSettings::masks"));
    EXPECT_THAT(complaint([](SavedField& s) { s.provenance.scene.resize(70000); }), HasSubstr("at most 65536"));
    EXPECT_EQ(saveField("no/such/folder/a.field", someField()).error().code, ErrorCode::writeFailed);
    EXPECT_FALSE(isFieldFile("no/such/file"));
    EXPECT_FALSE(isFieldFile(testing::TempDir()));
}

TEST(SceneFingerprint, tellsScenesAndLightsApart) {
    const Halls halls(0.17f);
    const Lighting lighting{{}, {glm::vec3(1), {}}};
    const SceneFingerprint here = fingerprintOf(halls.scene, halls.pose, lighting).value();
    EXPECT_NE(here.geometry, 0u);
    EXPECT_NE(here.light, 0u);
    EXPECT_EQ(fingerprintOf(halls.scene, halls.pose, lighting).value(), here);
    const auto changed = [&](const auto& change) {
        Halls other(0.17f);
        Lighting light = lighting;
        change(other.scene, other.pose, light);
        const SceneFingerprint there = fingerprintOf(other.scene, other.pose, light).value();
        return std::pair(there.geometry != here.geometry, there.light != here.light);
    };
    using Changed = std::pair<bool, bool>;
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) { s.name = "other"; }), Changed(false, false));
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) { s.meshes[0].primitives[0].positions[1].x += 1e-5f; }),
              Changed(true, false));
    EXPECT_EQ(changed([](Scene&, ScenePose& p, Lighting&) { p.instances[1].toWorld[3].y += 0.1f; }),
              Changed(true, false));
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) { s.materials[0].alphaMode = AlphaMode::mask; }),
              Changed(true, false));
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) { s.materials[0].emission.y = 1; }), Changed(false, true));
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) { s.materials[0].baseColor.x = 0.5f; }),
              Changed(false, true));
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) {
                  s.meshes[0].primitives[0].normals.assign(24, {0, 1, 0});
              }),
              Changed(false, true));
    // Probes see matt surfaces, and textures only where there are any.
    EXPECT_EQ(changed([](Scene& s, ScenePose&, Lighting&) {
                  s.materials[0].metallic = s.materials[0].roughness = 0.5f;
                  s.materials[0].normalScale = 2;
                  s.materials[0].emissiveTexture.image = 0;
                  s.meshes[0].primitives[0].uv0.assign(24, {0, 1});
                  s.meshes[0].primitives[0].tangents.assign(24, {1, 0, 0, 1});
              }),
              Changed(false, false));
    EXPECT_EQ(changed([](Scene&, ScenePose&, Lighting& l) { l.sky.radiance.z = 2; }), Changed(false, true));
    EXPECT_EQ(changed([](Scene&, ScenePose&, Lighting& l) { l.lights.emplace_back(); }), Changed(false, true));
}

TEST(SceneFingerprint, tellsTexturedSurfacesApart) {
    const auto of = [](const auto& change) {
        Halls halls(0.17f);
        halls.scene.images.push_back({1, 1, {128, 128, 255, 255}});
        Primitive& surface = halls.scene.meshes[0].primitives[0];
        surface.uv0.assign(surface.positions.size(), glm::vec2(0.5f));
        surface.uv1 = surface.uv0;
        surface.tangents.assign(surface.positions.size(), {1, 0, 0, 1});
        change(halls.scene.materials[0], surface);
        return fingerprintOf(halls.scene, halls.pose, {}).value();
    };
    using Use = TextureRef Material::*;
    for (const Use use : {&Material::baseColorTexture, &Material::normalTexture, &Material::emissiveTexture}) {
        const auto light = [&](const auto& change) {
            return of([&](Material& m, Primitive& p) {
                       m.emission = glm::vec3(1);
                       (m.*use).image = 0;
                       change(m, p);
                   })
                .light;
        };
        const std::uint64_t here = light([](Material&, Primitive&) {});
        EXPECT_NE(light([&](Material& m, Primitive&) { (m.*use).image = -1; }), here);
        EXPECT_NE(light([&](Material& m, Primitive&) { (m.*use).uvTransform[2].x = 0.5f; }), here);
        EXPECT_NE(light([](Material&, Primitive& p) { p.uv0[1].x = 0; }), here);
        EXPECT_EQ(light([](Material&, Primitive& p) { p.uv1[1].x = 0; }), here) << "nothing reads it";
        EXPECT_NE(light([&](Material& m, Primitive& p) { (m.*use).texCoord = 1, p.uv1[1].x = 0; }),
                  light([&](Material& m, Primitive&) { (m.*use).texCoord = 1; }));
        const bool normals = use == &Material::normalTexture;
        EXPECT_EQ(light([](Material& m, Primitive&) { m.normalScale = 0.5f; }) != here, normals);
        EXPECT_EQ(light([](Material&, Primitive& p) { p.tangents[1].w = -1; }) != here, normals);
    }
}

}  // namespace
}  // namespace probegi::test
