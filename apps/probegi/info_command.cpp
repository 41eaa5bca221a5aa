#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "console/output.h"
#include "console/vector_json.h"
#include "field_text.h"
#include "scene_setup.h"

namespace probegi::tool {

namespace {

using Json = nlohmann::ordered_json;

const char* typeName(LightType type) {
    if (type == LightType::directional) return "directional";
    return type == LightType::point ? "point" : "spot";
}

Json lightsOf(const ScenePose& pose, glm::vec3 origin) {
    Json lights = Json::array();
    for (const PlacedLight& light : pose.lights) {
        Json entry{{"type", typeName(light.type)}, {"intensity", toJson(light.intensity)}};
        if (light.type != LightType::directional) entry["position"] = toJson(light.position + origin);
        if (light.type != LightType::point) entry["direction"] = toJson(light.direction);
        lights.push_back(std::move(entry));
    }
    return lights;
}

Json camerasOf(const ScenePose& pose, glm::vec3 origin) {
    Json cameras = Json::array();
    for (const PlacedCamera& camera : pose.cameras)
        cameras.push_back({{"name", camera.name},
                           {"position", toJson(camera.position + origin)},
                           {"forward", toJson(camera.forward)},
                           {"yfov", camera.yfov}});
    return cameras;
}

Json skyOf(const Sky& sky) {
    if (sky.textured()) return fmt::format("picture of {}x{} pixels", sky.image.width, sky.image.height);
    return toJson(sky.radiance);
}

Json gridOf(const Scene& scene, const ScenePose& pose) {
    const Result<VolumeDesc> grid = scene.grid ? Result<VolumeDesc>(*scene.grid) : automaticGrid(scene, pose);
    if (!grid) return nullptr;
    return {{"source", scene.grid ? "scene" : "automatic"},
            {"origin", toJson(grid->origin + scene.origin)},
            {"spacing", toJson(grid->spacing)},
            {"turnedDegrees", glm::degrees(glm::angle(grid->orientation))},
            {"counts", {grid->counts.x, grid->counts.y, grid->counts.z}},
            {"probes", probeCount(*grid)},
            {"furtherGrids", scene.furtherGrids.size()}};
}

Json animationSpan(const Scene& scene) {
    if (scene.animations.empty()) return nullptr;
    float first = 1e30f, last = -1e30f;
    for (const AnimationChannel& channel : scene.animations) {
        if (channel.times.empty()) continue;
        first = std::min(first, channel.times.front());
        last = std::max(last, channel.times.back());
    }
    return Json{first, last};
}

Json describe(const SceneOptions& options, const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    const ScenePose pose = poseAt(scene, options.timeOfScene);
    Lighting lighting{pose.lights, scene.sky};
    return {
        {"scene", options.scene},
        {"triangles", triangleCount(scene, pose)},
        {"meshes", scene.meshes.size()},
        {"instances", pose.instances.size()},
        {"materials", scene.materials.size()},
        {"textures", scene.images.size()},
        {"lights", lightsOf(pose, scene.origin)},
        {"sky", skyOf(scene.sky)},
        {"lit", hasLight(scene, pose, lighting)},
        {"cameras", camerasOf(pose, scene.origin)},
        {"bounds",
         {{"lower", toJson(pose.bounds.lower + scene.origin)}, {"upper", toJson(pose.bounds.upper + scene.origin)}}},
        {"animation", animationSpan(scene)},
        {"grid", gridOf(scene, pose)},
        {"warnings", loaded.warnings}};
}

void printLights(const Json& info) {
    fmt::print("lights      {}{}\n", info["lights"].size(), info["lit"] ? "" : " and no other light");
    for (const Json& light : info["lights"]) {
        fmt::print("  {:<12}intensity {}", light["type"].get<std::string>(), vectorText(light["intensity"]));
        if (light.contains("position")) fmt::print(" at {}", vectorText(light["position"]));
        if (light.contains("direction")) fmt::print(" towards {}", vectorText(light["direction"]));
        fmt::print("\n");
    }
    const Json& sky = info["sky"];
    fmt::print("sky         {}\n", sky.is_string() ? sky.get<std::string>() : vectorText(sky));
}

void printCameras(const Json& info) {
    fmt::print("cameras     {}\n", info["cameras"].size());
    int index = 0;
    for (const Json& camera : info["cameras"])
        fmt::print("  {:<3}{:<20} at {} towards {}\n", index++,
                   "'" + plainText(camera["name"].get<std::string>(), kShownName) + "'", vectorText(camera["position"]),
                   vectorText(camera["forward"]));
}

void printGrid(const Json& grid) {
    if (grid.is_null()) return;
    const Json& n = grid["counts"];
    const double turned = grid["turnedDegrees"];
    fmt::print("probe grid  {} x {} x {} = {} probes from {} every {} m{} ({})\n", n[0].get<int>(), n[1].get<int>(),
               n[2].get<int>(), grid["probes"].get<int>(), vectorText(grid["origin"]), vectorText(grid["spacing"]),
               turned > 0 ? fmt::format(", turned by {:.1f} degrees", turned) : "",
               grid["source"] == "scene" ? "from the scene" : "placed automatically, by bounds and walls");
    if (const std::size_t further = grid["furtherGrids"].get<std::size_t>(); further > 0)
        fmt::print("            and {} more from the scene\n", further);
}

void printText(const Json& info) {
    fmt::print("scene       {}\n", plainText(info["scene"].get<std::string>()));
    for (const char* key : {"triangles", "meshes", "instances", "materials", "textures"})
        fmt::print("{:<12}{}\n", key, info[key].get<std::size_t>());
    fmt::print("bounds      {} .. {} m\n", vectorText(info["bounds"]["lower"]), vectorText(info["bounds"]["upper"]));
    printLights(info);
    printCameras(info);
    const Json& span = info["animation"];
    if (!span.is_null()) fmt::print("animation   {} .. {} s\n", span[0].get<float>(), span[1].get<float>());
    printGrid(info["grid"]);
}

}  // namespace

void addInfoCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand(
        "info", "print what a scene contains: triangles, lights, cameras, probe grid; or what a field's file does");
    struct Options {
        SceneOptions scene;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    addSceneArgument(*command, options->scene);
    command->add_flag("--json", options->json, "print JSON");
    command->footer(
        "Example: probegi info sponza.glb\nExample: probegi info sponza.field\nLengths are metres, angles radians.");
    command->callback([options, &exitCode] {
        if (isFieldFile(options->scene.scene)) {
            const auto printed = printFieldInfo(options->scene.scene, options->json, options->scene.limits);
            if (!printed) exitCode = printError(printed.error());
            return;
        }
        const auto loaded = readScene(options->scene);
        if (!loaded) {
            exitCode = printError(loaded.error());
            return;
        }
        for (const std::string& warning : loaded->warnings) printWarning(warning);
        const Json info = describe(options->scene, *loaded);
        if (options->json)
            fmt::print("{}", jsonText(info));
        else
            printText(info);
    });
}

}  // namespace probegi::tool
