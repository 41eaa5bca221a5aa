// fuzz_seeds FOLDER: writes small valid files to FOLDER/gltf, FOLDER/image, FOLDER/sdf and FOLDER/field for the fuzzers
// to start from.
#include <filesystem>
#include <fstream>

#include "field_file/field_bytes.h"
#include "io/draco_sample.h"
#include "io/gltf_builder.h"
#include "io/image_codec.h"
#include "io/stb.h"
#include "probegi/masks.h"
#include "probegi/shapes.h"

namespace {

using probegi::test::Bytes;
namespace fs = std::filesystem;

void write(const fs::path& path, const Bytes& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

void append(void* context, void* data, int size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), bytes, bytes + size);
}

Bytes settings() {
    const std::string text =
        "# seed\nscene.lights.0.name=Sun\nscene.lights.0.type=1\nscene.lights.0.power=2.f\n"
        "scene.lights.0.direction=-0.9 -0.2 -0.2\nscene.cameras.0.yaw=11.8\nscene.cameras.0.fov=45\n"
        "scene.skyColor=1 1 1\nddgi.volume.0.probeCounts=3 4 5\nddgi.volume.0.origin=0 1 0 # comment\n";
    return {text.begin(), text.end()};
}

void writeImages(const fs::path& folder) {
    probegi::HdrImage picture(9, 7);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = glm::vec3(float(i), 0.5f, 1e-3f);
    write(folder / "float.exr", probegi::io::encodeExr(picture));
    write(folder / "picture.png", probegi::io::encodePng(picture, {}));
    Bytes hdr;
    stbi_write_hdr_to_func(append, &hdr, 9, 7, 3, &picture.pixels[0].x);
    write(folder / "picture.hdr", hdr);
    Bytes jpeg;
    const Bytes grey(3 * 16 * 16, 90);
    stbi_write_jpg_to_func(append, &jpeg, 16, 16, 3, grey.data(), 80);
    write(folder / "picture.jpg", jpeg);
}

Bytes primitives() {
    const std::string text =
        "{\"sdf\": 1, \"primitives\": [{\"name\": \"wall\", \"shape\": \"box\", \"centre\": [0, 1, 2.5], "
        "\"rotation\": [0, 0, 0, 1], \"halfSize\": [1, 2, 3], \"albedo\": [0.5, 0.5, 0.5], \"pinned\": true}, "
        "{\"shape\": \"roundedBox\", \"centre\": [0, 0, 0], \"halfSize\": [1, 1, 1], \"rounding\": 0.1}, "
        "{\"shape\": \"capsule\", \"centre\": [0, 0, 0], \"radius\": 1, \"halfLength\": 2, \"node\": \"door\"}, "
        "{\"shape\": \"cylinder\", \"centre\": [0, 0, 0], \"radius\": 1, \"halfHeight\": 2, \"emission\": [1, 2, 3]}, "
        "{\"shape\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1}, {\"shape\": \"plane\", \"centre\": [0, 0, "
        "0]}]}";
    return {text.begin(), text.end()};
}

/// Eight probes, and a wall between them.
probegi::SavedField field(bool withMasks) {
    using namespace probegi;
    const Context context = Context::create({.threads = 1}).value();
    Scene scene;
    scene.materials.resize(1);
    Primitive wall;
    addBox(wall, {0.4f, -1, -1}, {0.5f, 2, 2});
    addObject(scene, std::move(wall));
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();
    FieldDesc desc;
    desc.irradianceTexels = desc.visibilityTexels = 4;
    desc.raysPerProbe = 8;
    FieldSettings settings;
    if (withMasks) {
        settings.masks = bakeMasks(context, *tracer, desc, {.factor = 2}).value();
        settings.guard = LeakGuard::masks;
    }
    Field made = Field::create(context, desc, settings).value();
    ConvergeState state;
    const Lighting sky{{}, {glm::vec3(1), {}}};
    made.converge(*tracer, sky, state, 0.5f, 4).value();
    return {made.read().value(), settings, {"seed", "a wall", "--clusters 4", {1, 2}}, state};
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 1;
    const fs::path folder = arguments[1];
    using namespace probegi::test;
    write(folder / "gltf" / "rich.glb", richScene().glb());
    write(folder / "gltf" / "rich.gltf", richScene().text());
    write(folder / "gltf" / "draco.glb", dracoScene().glb());
    write(folder / "gltf" / "settings.ini", settings());
    write(folder / "sdf" / "all.json", primitives());
    write(folder / "field" / "moments.field", probegi::encodeField(field(false)));
    write(folder / "field" / "masks.field", probegi::encodeField(field(true)));
    writeImages(folder / "image");
    return 0;
}
