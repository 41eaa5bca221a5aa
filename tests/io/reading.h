#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "io/gltf.h"

namespace probegi::test {

inline Result<LoadedScene> read(const Bytes& bytes) {
    return io::loadGltfFromMemory("test.glb", bytes, {});
}
inline Result<LoadedScene> read(const GltfBuilder& builder) {
    return read(builder.glb());
}

/// The scene, which must load without warnings; otherwise fails the test and returns an empty one.
inline Scene readClean(const GltfBuilder& builder) {
    auto loaded = read(builder);
    EXPECT_TRUE(loaded) << loaded.error().message;
    if (!loaded) return {};
    EXPECT_THAT(loaded->warnings, testing::IsEmpty());
    return std::move(loaded->scene);
}

/// Expects an error of this kind whose message begins with the file name and contains `words`.
inline void expectRefused(const Bytes& bytes, ErrorCode code, const std::string& words) {
    const auto loaded = read(bytes);
    ASSERT_FALSE(loaded) << "was read, but should say: " << words;
    EXPECT_EQ(loaded.error().code, code) << loaded.error().message;
    EXPECT_THAT(loaded.error().message, testing::StartsWith("test.glb: "));
    EXPECT_THAT(loaded.error().message, testing::HasSubstr(words));
    EXPECT_LT(loaded.error().message.size(), 500u);
}
inline void expectRefused(const GltfBuilder& builder, ErrorCode code, const std::string& words) {
    expectRefused(builder.glb(), code, words);
}

/// The only primitive of the first mesh.
inline Primitive onlyPrimitive(const Scene& scene) {
    EXPECT_EQ(scene.meshes.size(), 1u);
    if (scene.meshes.empty() || scene.meshes[0].primitives.size() != 1) {
        ADD_FAILURE() << "not exactly one primitive";
        return {};
    }
    return scene.meshes[0].primitives[0];
}

}  // namespace probegi::test
