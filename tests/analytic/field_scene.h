#pragma once

#include <memory>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "support/field_setup.h"

namespace probegi::test {

/// A built-in scene with a field in it, for tests against closed forms.
struct FieldScene {
    FieldScene(std::string_view name, const BuiltinParams& params, const PlacementDesc& placement,
               FieldSetup desc = {});
    FieldScene(Scene ownScene, const VolumeDesc& grid, FieldSetup desc = {});

    /// Plain updates, as in an engine.
    void run(int frames);

    /// Points on front faces hit by random rays from probes, viewed back along the ray. Probes with a larger share of
    /// backfaces than `mostBacks` are skipped.
    std::vector<FieldQuery> surfaceQueries(int count, float mostBacks = 1.0f) const;

    Context context;
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;
    Lighting lighting;
    Field field;
};

}  // namespace probegi::test
