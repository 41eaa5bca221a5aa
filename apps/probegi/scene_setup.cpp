#include "scene_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "console/parse.h"
#include "sdf_scene.h"

namespace probegi::tool {

namespace {

constexpr std::string_view kBuiltinPrefix = "builtin:";

bool positive(glm::vec3 v) {
    return v.x > 0 || v.y > 0 || v.z > 0;
}

bool hasEmission(const Scene& scene, const ScenePose& pose) {
    for (const Instance& instance : pose.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            if (!primitive.indices.empty() && positive(scene.materials[std::size_t(primitive.material)].emission))
                return true;
    return false;
}

// Sky pictures often have slightly negative values at saturated colours, which become 0; NaN and infinity are errors.
Result<void> cleanSky(HdrImage& image, const std::string& path) {
    constexpr float kBrightest = 1e20f;  // Sky::image
    for (glm::vec3& pixel : image.pixels) {
        if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z))
            return fail(ErrorCode::malformed,
                        fmt::format("--sky '{}' holds infinite or undefined values; repair the picture", path));
        pixel = glm::max(pixel, glm::vec3(0.0f));
        if (std::max({pixel.x, pixel.y, pixel.z}) > kBrightest)
            return fail(ErrorCode::malformed,
                        fmt::format("--sky '{}' has a pixel of {:.3g} W/sr/m2; the limit is {:g}; repair the "
                                    "picture",
                                    path, std::max({pixel.x, pixel.y, pixel.z}), kBrightest));
    }
    return {};
}

Result<Sky> parseSky(const std::string& text, const ReadLimits& limits) {
    Sky sky;
    if (const auto color = parseVector(text)) {
        if (color->x < 0 || color->y < 0 || color->z < 0)
            return fail(ErrorCode::invalidArgument, fmt::format("--sky '{}' is negative; radiance is 0 or more", text));
        sky.radiance = *color;
        return sky;
    }
    auto image = readImage(text, limits);
    if (!image)
        return fail(image.error().code,
                    fmt::format("--sky is neither R,G,B nor a readable picture: {}", image.error().message));
    if (const auto clean = cleanSky(*image, text); !clean) return clean.error();
    sky.radiance = glm::vec3(1.0f);
    sky.image = std::move(*image);
    return sky;
}

std::vector<PlacedLight> placedLights(const SceneOptions& options, const Scene& scene, const ScenePose& pose) {
    std::vector<PlacedLight> lights;
    for (const PlacedLight& light : pose.lights) {
        const bool replaced = light.type == LightType::directional ? !options.suns.empty() : !options.points.empty();
        if (!replaced && positive(light.intensity)) lights.push_back(light);
    }
    const auto add = [&](const Result<PlacedLight>& light) {
        if (light && positive(light->intensity)) lights.push_back(*light);
    };
    for (const std::string& sun : options.suns) add(parseSun(sun));
    for (const std::string& point : options.points)
        add(parsePoint(point).transform([&](PlacedLight light) {
            light.position -= scene.origin;
            return light;
        }));
    return lights;
}

Result<Lighting> makeLighting(const SceneOptions& options, const Scene& scene, const ScenePose& pose) {
    Lighting lighting{placedLights(options, scene, pose), scene.sky};
    if (!options.sky.empty()) {
        auto sky = parseSky(options.sky, options.limits);
        if (!sky) return sky.error();
        lighting.sky = std::move(*sky);
    }
    return lighting;
}

std::string cameraNames(const ScenePose& pose) {
    std::string names;
    for (std::size_t i = 0; i < pose.cameras.size(); ++i)
        names += fmt::format("{}{} '{}'", i ? ", " : "", i, pose.cameras[i].name);
    return names.empty() ? std::string("none; leave --camera out or use --look-from and --look-at") : names;
}

Result<PlacedCamera> findCamera(const std::string& wanted, const ScenePose& pose) {
    const auto named = std::find_if(pose.cameras.begin(), pose.cameras.end(),
                                    [&](const PlacedCamera& camera) { return camera.name == wanted; });
    if (named != pose.cameras.end()) return *named;
    std::size_t index = 0;
    const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    const bool whole = code == std::errc() && end == wanted.data() + wanted.size();
    if (whole && index < pose.cameras.size()) return pose.cameras[index];
    return fail(ErrorCode::invalidArgument,
                fmt::format("--camera '{}' is not in the scene; its cameras are {}", wanted, cameraNames(pose)));
}

Result<PlacedCamera> makeCamera(const SceneOptions& options, const ScenePose& pose, glm::vec3 origin) {
    PlacedCamera camera = pose.cameras.empty() ? overviewCamera(pose.bounds) : pose.cameras.front();
    if (!options.camera.empty()) {
        const auto found = findCamera(options.camera, pose);
        if (!found) return found;
        camera = *found;
    }
    if (!options.lookFrom.empty() || !options.lookAt.empty()) {
        const glm::vec3 from = options.lookFrom.empty() ? camera.position : *parseVector(options.lookFrom) - origin;
        const glm::vec3 at = options.lookAt.empty() ? from + camera.forward : *parseVector(options.lookAt) - origin;
        if (!(glm::distance(from, at) > 0))
            return fail(ErrorCode::invalidArgument, "--look-at is the camera's own position; choose another point");
        camera = lookAt(from, at, camera.yfov);
    }
    if (options.fovDegrees) camera.yfov = glm::radians(*options.fovDegrees);
    return camera;
}

using Volumes = std::vector<VolumeDesc>;

Result<Volumes> makeVolumes(const SceneOptions& options, const Scene& scene, const ScenePose& pose, glm::vec3 camera) {
    if (!options.given.empty()) return options.given;
    if (options.volumes.cascades > 0) return cascadesAround(options.volumes, camera, pose.bounds);
    if (!options.volume.empty())
        return parseVolume(options.volume).transform([&](VolumeDesc grid) {
            grid.origin -= scene.origin;
            return Volumes{grid};
        });
    PlacementDesc placement;
    placement.turned = options.turnGrid;
    if (!options.probes.empty()) {
        placement.counts = *parseCounts(options.probes);
    } else if (scene.grid) {
        Volumes volumes{*scene.grid};
        volumes.insert(volumes.end(), scene.furtherGrids.begin(), scene.furtherGrids.end());
        return volumes;
    }
    return automaticGrid(scene, pose, placement, options.threads).transform([](const VolumeDesc& grid) {
        return Volumes{grid};
    });
}

// A box around all probes, with the first volume's cells.
VolumeDesc aroundAll(const Volumes& volumes) {
    if (volumes.size() == 1 && volumes[0].orientation == VolumeDesc{}.orientation) return volumes[0];
    Bounds all{volumes[0].origin, volumes[0].origin};
    for (const VolumeDesc& v : volumes)
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 cell(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::vec3 place = v.origin + v.orientation * (cell * glm::vec3(v.counts - 1) * v.spacing);
            all = {glm::min(all.lower, place), glm::max(all.upper, place)};
        }
    VolumeDesc box = volumes[0];
    box.origin = all.lower;
    box.orientation = VolumeDesc{}.orientation;
    box.counts = glm::ivec3(glm::ceil((all.upper - all.lower) / box.spacing)) + 1;
    return box;
}

// How far a box reaches beyond the grid's outermost probes, on the axis where that is most cells.
struct Overhang {
    float cells = 0;
    float metres = 0;
};

Overhang overhang(const VolumeDesc& grid, glm::vec3 lower, glm::vec3 upper) {
    const glm::vec3 last = grid.origin + grid.spacing * glm::vec3(grid.counts - 1);
    const glm::vec3 beyond = glm::max(grid.origin - lower, upper - last);
    Overhang most;
    for (int axis = 0; axis < 3; ++axis)
        if (const float cells = beyond[axis] / grid.spacing[axis]; cells > most.cells) most = {cells, beyond[axis]};
    return most;
}

// Up to half a cell beyond the outermost probes, the field is as accurate as between probes.
constexpr float kHarmlessCells = 0.5f;

}  // namespace

Result<LoadedScene> readScene(const SceneOptions& options) {
    if (options.scene.rfind(kBuiltinPrefix, 0) != 0) return loadScene(options.scene, options.limits);
    auto scene = makeBuiltinScene(std::string_view(options.scene).substr(kBuiltinPrefix.size()), options.builtin);
    if (!scene) return scene.error();
    return LoadedScene{std::move(*scene), {}, {}};
}

std::vector<std::string> gridWarnings(const LoadedSetup& setup, const Bounds& scene) {
    const VolumeDesc box = aroundAll(setup.volumes);
    const Overhang surfaces = overhang(box, scene.lower, scene.upper);
    if (surfaces.cells <= kHarmlessCells) return {};  // then a camera sees no surface outside
    std::vector<std::string> sentences{
        fmt::format("the scene reaches {:.4g} m beyond its probe grid: surfaces there get the light of {}; cover all "
                    "of it with {}",
                    surfaces.metres, setup.settings.outside == OutsideLight::fades ? "--outside" : "the nearest probes",
                    setup.settings.camera ? "a larger --cascade-spacing, or more --cascades" : "--probes")};
    const Overhang camera = overhang(box, setup.camera.position, setup.camera.position);
    if (camera.cells > kHarmlessCells)
        sentences.push_back(
            fmt::format("the camera stands {:.4g} m outside the probe grid, where no light is known", camera.metres));
    return sentences;
}

// Traced on the CPU whatever the backend, so that the grid is the same on all backends.
Result<VolumeDesc> automaticGrid(const Scene& scene, const ScenePose& pose, const PlacementDesc& placement,
                                 int threads) {
    auto byBounds = placeVolume(pose.bounds, placement);
    if (!byBounds) return byBounds;
    const auto context = Context::create({.threads = threads, .log = {}, .progress = {}});
    if (!context) return context.error();
    const auto tracer = makeEmbreeTracer(*context, scene, pose);
    if (tracer) return placeVolume(**tracer, placement);
    if (tracer.error().code == ErrorCode::unsupported) return byBounds;
    return tracer.error();
}

int probeCount(const LoadedSetup& setup) {
    int sum = 0;
    for (const VolumeDesc& volume : setup.volumes) sum += probegi::probeCount(volume);
    return sum;
}

float shownExposure(const LoadedSetup& setup, const HdrImage& color) {
    return setup.automaticExposure ? autoExposure(color) : setup.exposure;
}

bool hasLight(const Scene& scene, const ScenePose& pose, const Lighting& lighting) {
    return !lighting.lights.empty() || !lighting.sky.black() || hasEmission(scene, pose);
}

Result<LoadedSetup> loadSetup(const SceneOptions& options) {
    auto loaded = readScene(options);
    if (!loaded) return loaded.error();
    LoadedSetup setup;
    setup.warnings = std::move(loaded->warnings);
    setup.files = std::move(loaded->files);
    for (const std::string& warning : setup.warnings) printWarning(warning);
    setup.scene = std::make_unique<Scene>(std::move(loaded->scene));
    setup.pose = poseAt(*setup.scene, options.timeOfScene);
    if (auto read = readSdf(setup, options); !read) return read.error();
    const Exposure exposure = *parseExposure(options.exposure);
    setup.exposure = exposure.factor.value_or(setup.scene->exposure);
    setup.automaticExposure = exposure.automatic;

    auto lighting = makeLighting(options, *setup.scene, setup.pose);
    if (!lighting) return lighting.error();
    setup.lighting = std::move(*lighting);
    if (!options.sky.empty() && setup.lighting.sky.textured()) setup.files.push_back(options.sky);
    if (!hasLight(*setup.scene, setup.pose, setup.lighting))
        return fail(ErrorCode::invalidArgument,
                    fmt::format("'{}' has no light, so its picture would be black; add one with --sun X,Y,Z,LUX, "
                                "--point X,Y,Z,R,G,B or --sky R,G,B",
                                options.scene));
    if (triangleCount(*setup.scene, setup.pose) == 0)
        return fail(
            ErrorCode::invalidArgument,
            fmt::format("'{}' has no triangles, so there is nothing to light; choose another scene", options.scene));

    const auto camera = makeCamera(options, setup.pose, setup.scene->origin);
    if (!camera) return camera.error();
    setup.camera = *camera;
    auto volumes = makeVolumes(options, *setup.scene, setup.pose, setup.camera.position);
    if (!volumes) return volumes.error();
    setup.volumes = std::move(*volumes);
    setup.grid = setup.volumes.front();
    setup.settings = fieldSettings(options.volumes, setup.volumes, setup.camera.position);
    for (std::string& warning : gridWarnings(setup, setup.pose.bounds)) {
        printWarning(warning);
        setup.warnings.push_back(std::move(warning));
    }
    return setup;
}

Result<void> moveSetup(LoadedSetup& setup, const SceneOptions& options, float seconds) {
    ScenePose pose = poseAt(*setup.scene, seconds);
    auto camera = makeCamera(options, pose, setup.scene->origin);
    if (!camera) return camera.error();
    setup.lighting.lights = placedLights(options, *setup.scene, pose);
    setup.camera = std::move(*camera);
    setup.pose = std::move(pose);
    return {};
}

}  // namespace probegi::tool
