#include "leak.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "probegi/builtin_scenes.h"
#include "probegi/measure.h"

namespace probegi::accuracy {

namespace {

// The rooms of builtin:dark-room: each 5 x 2.8 x 5 m, on either side of a wall centred on x = 0.
constexpr glm::vec3 kRoom(5.0f, 2.8f, 5.0f);
constexpr int kPointsPerSide = 16;  ///< on each wall
constexpr std::array<float, 4> kShifts{0.0f, 0.25f, 0.5f, 0.75f};
constexpr int kUpdates = 24;  ///< of Field::converge

/// Probes 1 m apart, one cell beyond the building on every side, shifted by a fraction of a cell along every axis.
VolumeDesc shiftedGrid(float shift) {
    return {glm::vec3(-7, -1, -4) + glm::vec3(shift - 0.5f), glm::vec3(1), {16, 7, 10}};
}

/// The two ways to fill a field.
enum class Run { converge, update };

Result<void> fill(Field& field, const Tracer& tracer, const Lighting& lighting, Run run) {
    if (run == Run::converge)
        return field.converge(tracer, lighting, 1e-6f, kUpdates).transform([](const ConvergeResult&) {});
    for (int i = 0; i < kRealtimeUpdates; ++i)
        if (const auto done = field.update(tracer, lighting); !done) return done.error();
    return {};
}

Result<double> leakOf(const Context& context, const Tracer& tracer, const Lighting& lighting, float wallThickness,
                      const FieldDesc& desc, const FieldSettings& settings, Run run) {
    auto field = Field::create(context, desc, settings);
    if (!field) return field.error();
    if (const auto done = fill(*field, tracer, lighting, run); !done) return done.error();
    const float wall = 0.5f * wallThickness;
    const glm::vec3 sealed(wall, 0, -0.5f * kRoom.z);
    const glm::vec3 lit(-wall - kRoom.x, 0, -0.5f * kRoom.z);
    return leakShare(*field, wallPoints({sealed, sealed + kRoom}, kPointsPerSide),
                     wallPoints({lit, lit + kRoom}, kPointsPerSide));
}

}  // namespace

Result<LeakResult> measureLeak(const Context& context, float wallThickness) {
    BuiltinParams params;
    params.wallThickness = wallThickness;
    const auto scene = makeBuiltinScene("dark-room", params);
    if (!scene) return scene.error();
    const ScenePose pose = poseAt(*scene);
    const auto tracer = makeEmbreeTracer(context, *scene, pose);
    if (!tracer) return tracer.error();
    const Lighting lighting{pose.lights, scene->sky};

    LeakResult result;
    result.wallThickness = wallThickness;
    for (const float shift : kShifts)
        for (const auto& [guard, relocation, run, share] :
             {std::tuple(LeakGuard::none, false, Run::converge, &result.leaky),
              std::tuple(LeakGuard::moments, false, Run::converge, &result.moments),
              std::tuple(LeakGuard::moments, true, Run::converge, &result.relocated),
              std::tuple(LeakGuard::moments, false, Run::update, &result.realtime)}) {
            FieldDesc desc;
            desc.relocation = relocation;
            desc.volumes = {shiftedGrid(shift)};
            FieldSettings settings;
            settings.guard = guard;
            const auto measured = leakOf(context, **tracer, lighting, wallThickness, desc, settings, run);
            if (!measured) return measured.error();
            share->mean += *measured / double(kShifts.size());
            share->worst = std::max(share->worst, *measured);
        }
    return result;
}

}  // namespace probegi::accuracy
