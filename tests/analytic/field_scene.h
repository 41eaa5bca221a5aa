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

    /// Plain updates, as an engine does them.
    void run(int frames);

    /// Points on surfaces, found by random rays from probes that see a front face, with the view back along the ray.
    /// Probes with a larger share of backfaces than `mostBacks` are not asked.
    std::vector<FieldQuery> surfaceQueries(int count, float mostBacks = 1.0f) const;

    Context context;
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;
    Lighting lighting;
    Field field;
};

}  // namespace probegi::test
