#include "gltf_builder.h"

#include "io/image_codec.h"

namespace tinygltf {
std::string base64_encode(unsigned char const*, unsigned int length);
}

namespace probegi::test {

using nlohmann::json;

GltfBuilder::GltfBuilder() {
    json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", nlohmann::json::array()}}}}};
}

std::size_t GltfBuilder::componentsOf(const std::string& type) {
    return type == "SCALAR" ? 1 : std::size_t(type.back() - '0');
}

int GltfBuilder::append(const char* array, nlohmann::json value) {
    json[array].push_back(std::move(value));
    return int(json[array].size()) - 1;
}

int GltfBuilder::addView(std::span<const std::uint8_t> bytes, int stride) {
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride) view["byteStride"] = stride;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    binary.resize((binary.size() + 3) / 4 * 4);
    return append("bufferViews", view);
}

int GltfBuilder::addAccessor(int view, int componentType, std::size_t count, const char* type, bool normalized) {
    nlohmann::json accessor = {
        {"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return append("accessors", accessor);
}

int GltfBuilder::show(nlohmann::json primitive) {
    const int mesh = append("meshes", {{"primitives", nlohmann::json::array({std::move(primitive)})}});
    json["scenes"][0]["nodes"].push_back(append("nodes", {{"mesh", mesh}}));
    return mesh;
}

nlohmann::json GltfBuilder::triangle() {
    return {{"POSITION", addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}};
}

Bytes GltfBuilder::glb() const {
    nlohmann::json root = json;
    if (!binary.empty()) root["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes out;
    const auto word = [&](std::size_t value) {
        for (int i = 0; i < 4; ++i) out.push_back(std::uint8_t(value >> 8 * i));
    };
    word(0x46546c67);
    word(2);
    word(20 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    word(text.size());
    word(0x4e4f534a);
    out.insert(out.end(), text.begin(), text.end());
    if (binary.empty()) return out;
    word(binary.size());
    word(0x004e4942);
    out.insert(out.end(), binary.begin(), binary.end());
    return out;
}

Bytes GltfBuilder::text() const {
    nlohmann::json root = json;
    if (!binary.empty()) {
        root["buffers"] = {{{"byteLength", binary.size()}, {"uri", dataUri("application/octet-stream", binary)}}};
    }
    const std::string out = root.dump();
    return {out.begin(), out.end()};
}

std::string dataUri(const char* mime, std::span<const std::uint8_t> bytes) {
    return std::string("data:") + mime + ";base64," + tinygltf::base64_encode(bytes.data(), unsigned(bytes.size()));
}

Bytes smallPng(int width, int height) {
    HdrImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image.at(x, y) = {float(x) / float(width), float(y) / float(height), 0.5f};
    }
    return io::encodePng(image, {});
}

namespace {

nlohmann::json material(int texture) {
    const nlohmann::json transform = {{"offset", {0.25, 0.5}}, {"rotation", 0.5}, {"scale", {2, 3}}, {"texCoord", 1}};
    const nlohmann::json info = {{"index", texture}, {"extensions", {{"KHR_texture_transform", transform}}}};
    return {{"name", "all"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
              {"metallicFactor", 0.5},
              {"roughnessFactor", 0.6},
              {"baseColorTexture", info},
              {"metallicRoughnessTexture", {{"index", texture}}}}},
            {"normalTexture", {{"index", texture}, {"scale", 0.7}, {"texCoord", 1}}},
            {"emissiveTexture", {{"index", texture}}},
            {"emissiveFactor", {1, 0.5, 0.25}},
            {"alphaMode", "MASK"},
            {"alphaCutoff", 0.3},
            {"doubleSided", true},
            {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}};
}

void addLights(GltfBuilder& b) {
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 20}, {"color", {1, 0.5, 0.25}}},
        {{"type", "spot"}, {"range", 5}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
    };
}

void animate(GltfBuilder& b, int node) {
    const int times = b.addFloats({0, 1}, "SCALAR");
    const int turn = b.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 32767, 0, 0}, kShort, "VEC4", true);
    const int moves = b.addFloats({0, 0, 0, 1, 2, 3}, "VEC3");
    const int spline = b.addFloats(std::vector<float>(18, 1.0f), "VEC3");
    b.append("animations", {{"samplers",
                             {{{"input", times}, {"output", turn}},
                              {{"input", times}, {"output", moves}, {"interpolation", "STEP"}},
                              {{"input", times}, {"output", spline}, {"interpolation", "CUBICSPLINE"}}}},
                            {"channels",
                             {{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}},
                              {{"sampler", 1}, {"target", {{"node", node}, {"path", "translation"}}}},
                              {{"sampler", 2}, {"target", {{"node", node}, {"path", "scale"}}}}}}});
}

}  // namespace

GltfBuilder richScene() {
    GltfBuilder b;
    const Bytes png = smallPng(5, 3);
    b.append("images", {{"bufferView", b.addView(png)}, {"mimeType", "image/png"}});
    b.append("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    b.append("materials", material(b.append("textures", {{"source", 0}, {"sampler", 0}})));
    nlohmann::json attributes = {{"POSITION", b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3")},
                                 {"NORMAL", b.addFloats({0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1}, "VEC3")},
                                 {"TANGENT", b.addFloats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, "VEC4")},
                                 {"TEXCOORD_0", b.addFloats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2")}};
    attributes["TEXCOORD_1"] =
        b.add(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535, 65535, 65535}, kUnsignedShort, "VEC2", true);
    const int indices = b.add(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 3}, kUnsignedShort, "SCALAR");
    b.show({{"attributes", attributes}, {"indices", indices}, {"material", 0}});
    addLights(b);
    b.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}, {"name", "eye"}});
    const int lamp =
        b.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}, {"scale", {1, 2, 3}}});
    b.append("nodes", {{"camera", 0}, {"children", {lamp}}, {"translation", {0, 1, 2}}, {"rotation", {0, 1, 0, 0}}});
    b.json["scenes"][0]["nodes"].push_back(2);
    animate(b, 2);
    b.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_emissive_strength"};
    return b;
}

}  // namespace probegi::test
