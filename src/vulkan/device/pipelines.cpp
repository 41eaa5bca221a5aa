#include "vulkan/device/pipelines.h"

#include <cstring>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>
#include <vector>

#include "core/sentence.h"
#include "vulkan/device/errors.h"

namespace probegi::vulkan {

namespace {

std::string hex(std::uint32_t value, int digits) {
    std::ostringstream out;
    out << std::hex << std::setw(digits) << std::setfill('0') << value;
    return out.str();
}

// Drivers check their pipeline cache's header, but some crash on a damaged body, so a checksum precedes it.
struct CacheHeader {
    char magic[8] = {'P', 'G', 'I', 'C', 'A', 'C', 'H', '1'};
    std::uint64_t bytes = 0;
    std::uint64_t sum = 0;
};

// FNV-1a, 64 bits: detects accidents, not attacks.
std::uint64_t checksum(std::span<const std::uint8_t> data) {
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (const std::uint8_t byte : data) sum = (sum ^ byte) * 0x100000001b3u;
    return sum;
}

// One file per driver and device, identified by the UUID.
std::filesystem::path cacheFile(const vk::raii::PhysicalDevice& physical, const std::filesystem::path& folder) {
    if (folder.empty()) return {};
    std::string name = "pipelines-";
    for (const std::uint8_t byte : physical.getProperties().pipelineCacheUUID) name += hex(byte, 2);
    return folder / (name + ".bin");
}

std::vector<std::uint8_t> readCache(const std::filesystem::path& file, std::string& warning) {
    constexpr std::uintmax_t kMostBytes = 1 << 30;
    std::error_code error;
    // Opening a pipe would block forever, and a device file may be endless.
    const bool readable =
        std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMostBytes;
    std::ifstream in;
    if (readable) in.open(file, std::ios::binary);
    if (!in.is_open() && (readable || !std::filesystem::exists(file, error))) return {};
    // Unreadable files leave the text empty.
    std::ostringstream stream;
    stream << in.rdbuf();
    const std::string text = stream.str();
    CacheHeader header;
    std::vector<std::uint8_t> body;
    if (text.size() >= sizeof(header)) {
        std::memcpy(&header, text.data(), sizeof(header));
        body.assign(text.begin() + sizeof(header), text.end());
    }
    if (body.empty() || std::memcmp(header.magic, CacheHeader().magic, sizeof(header.magic)) != 0 ||
        header.bytes != body.size() || header.sum != checksum(body)) {
        warning =
            sentence("the shader cache '", file.generic_string(), "' is damaged and was ignored; it will be rewritten");
        return {};
    }
    return body;
}

// Whether a cache's header names this driver (VkPipelineCacheHeaderVersionOne). Drivers check too, but do not report
// it.
bool isOf(const vk::raii::PhysicalDevice& physical, std::span<const std::uint8_t> cache) {
    VkPipelineCacheHeaderVersionOne header;
    if (cache.size() < sizeof(header)) return false;
    std::memcpy(&header, cache.data(), sizeof(header));
    const auto properties = physical.getProperties();
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == properties.vendorID &&
           header.deviceID == properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID.data(), VK_UUID_SIZE) == 0;
}

vk::raii::DescriptorSetLayout makeVolumeLayout(const vk::raii::Device& device) {
    using Type = vk::DescriptorType;
    const auto stages = vk::ShaderStageFlagBits::eCompute;
    const vk::DescriptorSetLayoutBinding bindings[] = {
        {0, Type::eUniformBuffer, 1, stages},        {1, Type::eCombinedImageSampler, 1, stages},
        {2, Type::eCombinedImageSampler, 1, stages}, {3, Type::eStorageBuffer, 1, stages},
        {4, Type::eStorageImage, 1, stages},         {5, Type::eStorageImage, 1, stages}};
    return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::DescriptorSetLayout makeSceneLayout(const vk::raii::Device& device) {
    const vk::DescriptorSetLayoutBinding constants(0, vk::DescriptorType::eUniformBuffer, 1,
                                                   vk::ShaderStageFlagBits::eCompute);
    return {device, vk::DescriptorSetLayoutCreateInfo({}, constants)};
}

vk::raii::PipelineLayout makePipelineLayout(const vk::raii::Device& device, const PassLayout& layout) {
    const vk::DescriptorSetLayout sets[] = {*layout.volume, *layout.scene};
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, PassLayout::kPushBytes);
    return {device, vk::PipelineLayoutCreateInfo({}, sets, push)};
}

vk::raii::Sampler makeSampler(const vk::raii::Device& device) {
    const auto edge = vk::SamplerAddressMode::eClampToEdge;
    return {device, vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
                                          edge, edge, edge)};
}

}  // namespace

PassLayout::PassLayout(const vk::raii::Device& device)
    : sampler(makeSampler(device)),
      volume(makeVolumeLayout(device)),
      scene(makeSceneLayout(device)),
      pipeline(makePipelineLayout(device, *this)) {}

PipelineStore::PipelineStore(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device,
                             std::filesystem::path folder, std::string& warning)
    : m_device(device), m_layout(device), m_file(cacheFile(physical, folder)), m_cache(nullptr) {
    std::vector<std::uint8_t> data = readCache(m_file, warning);
    if (!data.empty() && !isOf(physical, data)) {
        warning = sentence("the shader cache '", m_file.generic_string(),
                           "' is of another driver and was ignored; it will be rewritten");
        data.clear();
    }
    m_savedSum = checksum(data);
    m_cache = vk::raii::PipelineCache(device, vk::PipelineCacheCreateInfo({}, data.size(), data.data()));
}

vk::Pipeline PipelineStore::get(const Shader& shader, std::span<const std::uint32_t> constants) {
    std::string key = shader.name;
    for (const std::uint32_t constant : constants) key += sentence("/", constant);
    if (const auto found = m_pipelines.find(key); found != m_pipelines.end()) return *found->second;

    const std::span<const std::uint32_t> code = shader.book(shader.name);
    if (code.empty()) throw Failure(ErrorCode::unsupported, sentence("there is no shader '", shader.name, "'"));
    const vk::raii::ShaderModule module(m_device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, 4 * i, sizeof(std::uint32_t));
    const vk::SpecializationInfo values(std::uint32_t(entries.size()), entries.data(), constants.size_bytes(),
                                        constants.data());
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main", &values);
    vk::raii::Pipeline pipeline(m_device, m_cache, vk::ComputePipelineCreateInfo({}, stage, *m_layout.pipeline));
    m_changed = true;
    return *m_pipelines.emplace(std::move(key), std::move(pipeline)).first->second;
}

void PipelineStore::save() {
    if (m_file.empty() || !m_changed) return;
    const std::vector<std::uint8_t> body = m_cache.getData();
    CacheHeader header;
    header.bytes = body.size();
    header.sum = checksum(body);
    if (header.sum == m_savedSum) return;
    std::error_code ignored;
    std::filesystem::create_directories(m_file.parent_path(), ignored);
    // A unique name, since several processes may save at once.
    std::filesystem::path temporary = m_file;
    temporary += sentence(".", hex(std::random_device()(), 8), ".tmp");
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&header), sizeof(header));
    out.write(reinterpret_cast<const char*>(body.data()), std::streamsize(body.size()));
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(temporary, m_file, error);
    if (!out || error) {
        std::filesystem::remove(temporary, ignored);
        throw Failure(ErrorCode::writeFailed, sentence("the shader cache '", m_file.generic_string(),
                                                       "' could not be written; shaders will be recompiled next time"));
    }
    m_changed = false;
    m_savedSum = header.sum;
}

}  // namespace probegi::vulkan
