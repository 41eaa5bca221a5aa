#include <fmt/format.h>

#include "console/parse.h"
#include "scene_setup.h"

namespace probegi::tool {

namespace {

void addBuiltinOptions(CLI::App& command, BuiltinParams& params) {
    const auto add = [&](const char* name, float& value, double lower, double upper, const char* help) {
        command.add_option(name, value, help)
            ->check(inRange(lower, upper))
            ->capture_default_str()
            ->group("Parameters of built-in scenes");
    };
    add("--wall", params.wallThickness, 0.02, 0.30,
        "wall thickness in metres, 0.02 to 0.3 (two-rooms, dark-room, door)");
    add("--albedo", params.albedo, 0.0, 0.99, "albedo of the walls, 0 to 0.99 (furnace, sphere)");
    add("--emission", params.emission, 1e-6, 1e6, "radiance of the walls in W/sr/m2 (furnace)");
    add("--power", params.power, 1e-6, 1e9, "power of the lamp in W (sphere)");
    add("--radius", params.radius, 1e-3, 1e6, "radius in metres (sphere)");
}

void addCameraOptions(CLI::App& command, SceneOptions& options) {
    constexpr const char* kGroup = "Camera";
    command.add_option("--camera", options.camera, "name or index of a camera of the scene (default: the first)")
        ->type_name("NAME|INDEX")
        ->group(kGroup);
    command.add_option("--look-from", options.lookFrom, "position of the camera, metres")
        ->type_name("X,Y,Z")
        ->check(parsedBy(parseVector))
        ->group(kGroup);
    command.add_option("--look-at", options.lookAt, "point that the camera looks at, metres")
        ->type_name("X,Y,Z")
        ->check(parsedBy(parseVector))
        ->group(kGroup);
    command.add_option("--fov", options.fovDegrees, "vertical field of view in degrees, 1 to 179")
        ->type_name("DEGREES")
        ->check(inRange(1, 179))
        ->group(kGroup);
}

void addLightOptions(CLI::App& command, SceneOptions& options) {
    constexpr const char* kGroup =
        "Light (each replaces the scene's lights of its kind; may be repeated but for --sky)";
    command
        .add_option("--sun", options.suns,
                    "directional light: the direction in which it travels, and W/m2 at normal incidence")
        ->type_name("X,Y,Z,LUX")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->check(parsedBy(parseSun))
        ->group(kGroup);
    command.add_option("--point", options.points, "point light: position in metres, intensity in W/sr")
        ->type_name("X,Y,Z,R,G,B")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->check(parsedBy(parsePoint))
        ->group(kGroup);
    command.add_option("--sky", options.sky, "radiance of the sky in W/sr/m2, or an equirectangular .exr or .hdr file")
        ->type_name("R,G,B|FILE")
        ->group(kGroup);
}

void addGridOptions(CLI::App& command, SceneOptions& options) {
    constexpr const char* kGroup = "Probes";
    auto* probes = command
                       .add_option("--probes", options.probes,
                                   "probes per axis, laid over the scene with a cell of margin (default: the scene's "
                                   "own grid, else one that fits its size)")
                       ->type_name("XxYxZ")
                       ->check(parsedBy(parseCounts))
                       ->group(kGroup);
    auto* volume =
        command
            .add_option("--volume", options.volume,
                        "the grid itself: position of the first probe (X,Y,Z), metres between probes (S or SX,SY,SZ), "
                        "probes per axis (XxYxZ)")
            ->type_name("ORIGIN:SPACING:COUNTS")
            ->check(parsedBy(parseVolume))
            ->excludes(probes)
            ->group(kGroup);
    command
        .add_option("--turn-grid", options.turnGrid,
                    "whether a grid that is laid over the scene turns with a building that stands obliquely (default "
                    "on)")
        ->type_name("on|off")
        ->transform(oneOf(kOnOff))
        ->excludes(volume)
        ->group(kGroup);
    addVolumeOptions(command, options.volumes, {probes, volume});
}

}  // namespace

void addSceneArgument(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, "a .gltf or .glb file, or builtin:NAME (see 'probegi scenes')")
        ->type_name("")
        ->required();
    command.add_option("--time-of-scene", options.timeOfScene, "seconds into the scene's animations")
        ->type_name("SECONDS")
        ->check(inRange(-1e6, 1e6))
        ->capture_default_str();
    addBuiltinOptions(command, options.builtin);
    addUnpackLimit(command, options.limits);
}

void addThreadsOption(CLI::App& command, SceneOptions& options) {
    command.add_option("--threads", options.threads, "worker threads, 0 to 1024; 0: all; never changes the result")
        ->type_name("N")
        ->check(inRange(0, 1024))
        ->capture_default_str();
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    addSceneArgument(command, options);
    addCameraOptions(command, options);
    addLightOptions(command, options);
    addGridOptions(command, options);
    options.exposure = "auto";
    command
        .add_option("--exposure", options.exposure,
                    "factor on the light before a PNG is written: a number, what the scene suggests (scene), or what "
                    "makes the picture neither dark nor bright (auto)")
        ->type_name("auto|scene|FACTOR")
        ->check(parsedBy(parseExposure))
        ->capture_default_str();
    addThreadsOption(command, options);
}

}  // namespace probegi::tool
