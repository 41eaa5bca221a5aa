#include "renderer.h"

#include <array>
#include <glm/vec4.hpp>

using namespace probegi;

namespace {

constexpr std::uint32_t kGBufferVert[] = {
#include "g_buffer.vert.inc"
};
constexpr std::uint32_t kGBufferFrag[] = {
#include "g_buffer.frag.inc"
};
constexpr std::uint32_t kShade[] = {
#include "shade.comp.inc"
};

constexpr auto kTarget = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled;
constexpr Access kColourWrite{vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                              vk::AccessFlagBits2::eColorAttachmentWrite};
constexpr Access kDepthUse{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite};
constexpr Access kShadeRead{vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderSampledRead};
constexpr Access kShadeWrite{vk::PipelineStageFlagBits2::eComputeShader, vk::AccessFlagBits2::eShaderStorageWrite};

std::array<vk::DescriptorSetLayoutBinding, 4> imageBindings() {
    const auto stage = vk::ShaderStageFlagBits::eCompute;
    const auto sampled = vk::DescriptorType::eSampledImage;
    return {{{0, sampled, 1, stage},
             {1, sampled, 1, stage},
             {2, sampled, 1, stage},
             {3, vk::DescriptorType::eStorageImage, 1, stage}}};
}

vk::raii::DescriptorPool makeDescriptorPool(const vk::raii::Device& device) {
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eSampledImage, 3},
                                            {vk::DescriptorType::eStorageImage, 1}};
    return {device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
}

vk::raii::PipelineLayout makeLayout(const vk::raii::Device& device, vk::ShaderStageFlags stages, std::uint32_t bytes,
                                    std::initializer_list<vk::DescriptorSetLayout> sets) {
    const vk::PushConstantRange range(stages, 0, bytes);
    return {device, vk::PipelineLayoutCreateInfo({}, std::uint32_t(sets.size()), sets.begin(), 1, &range)};
}

vk::RenderingAttachmentInfo cleared(const GpuImage& image, vk::ImageLayout layout, vk::ClearValue value) {
    return vk::RenderingAttachmentInfo(*image.view, layout)
        .setLoadOp(vk::AttachmentLoadOp::eClear)
        .setStoreOp(vk::AttachmentStoreOp::eStore)
        .setClearValue(value);
}

}  // namespace

Renderer::Renderer(const EngineDevice& engine, MemoryPool& pool, vk::Extent2D size)
    : m_size(size),
      m_position(engine.device(), pool, vk::Format::eR32G32B32A32Sfloat, size, kTarget),
      m_normal(engine.device(), pool, vk::Format::eR16G16B16A16Sfloat, size, kTarget),
      m_albedo(engine.device(), pool, vk::Format::eR8G8B8A8Unorm, size, kTarget),
      m_depth(engine.device(), pool, vk::Format::eD32Sfloat, size, vk::ImageUsageFlagBits::eDepthStencilAttachment),
      m_picture(engine.device(), pool, vk::Format::eR32G32B32A32Sfloat, {2 * size.width, size.height},
                vk::ImageUsageFlagBits::eStorage | vk::ImageUsageFlagBits::eTransferSrc),
      m_readBack(engine.device(), pool, 2 * sizeof(glm::vec4) * size.width * size.height, vulkan::MemoryUse::readback),
      m_descriptors(makeDescriptorPool(engine.device())),
      m_imageLayout(makeSetLayout(engine.device(), imageBindings())),
      m_imageSet(std::move(vk::raii::DescriptorSets(engine.device(), {*m_descriptors, *m_imageLayout}).front())),
      m_probes(engine.device()),
      m_rasterLayout(makeLayout(engine.device(), vk::ShaderStageFlagBits::eVertex, sizeof(vk::DeviceAddress), {})),
      m_shadeLayout(makeLayout(engine.device(), vk::ShaderStageFlagBits::eCompute, sizeof(vk::DeviceAddress),
                               {*m_imageLayout, m_probes.layout()})),
      m_raster(nullptr),
      m_shade(makeComputePipeline(engine.device(), *m_shadeLayout, kShade)) {
    makeGraphicsPipeline(engine.device());
    writeSet(engine.device());
}

void Renderer::makeGraphicsPipeline(const vk::raii::Device& device) {
    const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, sizeof(kGBufferVert), kGBufferVert));
    const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, sizeof(kGBufferFrag), kGBufferFrag));
    const vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"},
                                                        {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main"}};
    const vk::PipelineVertexInputStateCreateInfo noVertices;
    const vk::PipelineInputAssemblyStateCreateInfo triangles({}, vk::PrimitiveTopology::eTriangleList);
    const vk::Viewport viewport(0, 0, float(m_size.width), float(m_size.height), 0, 1);
    const vk::Rect2D scissor({}, m_size);
    const vk::PipelineViewportStateCreateInfo viewports({}, viewport, scissor);
    const auto raster = vk::PipelineRasterizationStateCreateInfo()
                            .setCullMode(vk::CullModeFlagBits::eBack)
                            .setFrontFace(vk::FrontFace::eCounterClockwise)
                            .setLineWidth(1);
    const vk::PipelineMultisampleStateCreateInfo oneSample;
    const vk::PipelineDepthStencilStateCreateInfo depth({}, true, true, vk::CompareOp::eLess);
    using Component = vk::ColorComponentFlagBits;
    const auto opaque = vk::PipelineColorBlendAttachmentState().setColorWriteMask(Component::eR | Component::eG |
                                                                                  Component::eB | Component::eA);
    const std::array<vk::PipelineColorBlendAttachmentState, 3> targets{opaque, opaque, opaque};
    const auto blend = vk::PipelineColorBlendStateCreateInfo().setAttachments(targets);
    const vk::Format formats[] = {m_position.format, m_normal.format, m_albedo.format};
    const vk::PipelineRenderingCreateInfo rendering(0, formats, m_depth.format);
    m_raster =
        vk::raii::Pipeline(device, nullptr,
                           vk::GraphicsPipelineCreateInfo({}, stages, &noVertices, &triangles, nullptr, &viewports,
                                                          &raster, &oneSample, &depth, &blend, nullptr, *m_rasterLayout)
                               .setPNext(&rendering));
}

void Renderer::writeSet(const vk::raii::Device& device) {
    const GpuImage* images[] = {&m_position, &m_normal, &m_albedo, &m_picture};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const bool written = images[i] == &m_picture;
        const vk::DescriptorImageInfo info(
            {}, *images[i]->view, written ? vk::ImageLayout::eGeneral : vk::ImageLayout::eShaderReadOnlyOptimal);
        const auto type = written ? vk::DescriptorType::eStorageImage : vk::DescriptorType::eSampledImage;
        device.updateDescriptorSets(vk::WriteDescriptorSet(*m_imageSet, i, 0, type, info), {});
    }
}

void Renderer::recordGBuffer(const vk::raii::CommandBuffer& commands, vk::DeviceAddress frame) const {
    using Layout = vk::ImageLayout;
    std::vector<vk::ImageMemoryBarrier2> begin, end;
    for (const GpuImage* image : {&m_position, &m_normal, &m_albedo}) {
        begin.push_back(
            transition(*image, kShadeRead, Layout::eUndefined, kColourWrite, Layout::eColorAttachmentOptimal));
        end.push_back(transition(*image, kColourWrite, Layout::eColorAttachmentOptimal, kShadeRead,
                                 Layout::eShaderReadOnlyOptimal));
    }
    begin.push_back(
        transition(m_depth, kDepthUse, Layout::eUndefined, kDepthUse, Layout::eDepthStencilAttachmentOptimal));
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(begin));
    const vk::ClearValue black(vk::ClearColorValue(std::array<float, 4>{}));
    const vk::RenderingAttachmentInfo colours[] = {cleared(m_position, Layout::eColorAttachmentOptimal, black),
                                                   cleared(m_normal, Layout::eColorAttachmentOptimal, black),
                                                   cleared(m_albedo, Layout::eColorAttachmentOptimal, black)};
    const auto depth = cleared(m_depth, Layout::eDepthStencilAttachmentOptimal, vk::ClearDepthStencilValue(1));
    commands.beginRendering({{}, vk::Rect2D({}, m_size), 1, 0, colours, &depth});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *m_raster);
    commands.pushConstants<vk::DeviceAddress>(*m_rasterLayout, vk::ShaderStageFlagBits::eVertex, 0, frame);
    commands.draw(36, kBoxes - kFrontWalls, 0, kFrontWalls);
    commands.endRendering();
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(end));
}

void Renderer::recordShading(const vk::raii::CommandBuffer& commands, vk::DeviceAddress frame) const {
    // The last update ended with a full barrier, so reading the probes needs none.
    const auto begin =
        transition(m_picture, kTransferRead, vk::ImageLayout::eUndefined, kShadeWrite, vk::ImageLayout::eGeneral);
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(begin));
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *m_shade);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_shadeLayout, 0, {*m_imageSet, *m_probes}, {});
    commands.pushConstants<vk::DeviceAddress>(*m_shadeLayout, vk::ShaderStageFlagBits::eCompute, 0, frame);
    commands.dispatch((2 * m_size.width + 7) / 8, (m_size.height + 7) / 8, 1);
}

void Renderer::recordReadBack(const vk::raii::CommandBuffer& commands) const {
    order(commands, kShadeWrite, kTransferRead);
    const vk::BufferImageCopy all(0, 0, 0, {m_picture.aspect, 0, 0, 1}, {}, {2 * m_size.width, m_size.height, 1});
    commands.copyImageToBuffer(*m_picture.image, vk::ImageLayout::eGeneral, *m_readBack.buffer, all);
    order(commands, kTransferWrite, kHostRead);
}

HdrImage Renderer::picture() const {
    HdrImage image(int(2 * m_size.width), int(m_size.height));
    const auto pixels = m_readBack.mapped<glm::vec4>();
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = glm::vec3(pixels[i]);
    return image;
}
