#include "vulkan/query_shader.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace probegi::test {

namespace {

void check(VkResult result) {
    if (result != VK_SUCCESS) throw std::runtime_error("Vulkan: " + std::to_string(result));
}

VkDescriptorSetLayout makeLayout(VkDevice device, std::span<const VkDescriptorSetLayoutBinding> bindings) {
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = std::uint32_t(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout;
    check(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout));
    return layout;
}

}  // namespace

QueryShader::QueryShader(const Engine& engine, const char* spirvFile, const EngineBuffer& questions,
                         const EngineBuffer& answers, vulkan::QueryConstants constants)
    : m_device(engine.device) {
    makeSets(questions, answers, constants);
    makePipeline(spirvFile);
}

QueryShader::~QueryShader() {
    vkDestroyPipeline(m_device, m_pipeline, nullptr);
    vkDestroyPipelineLayout(m_device, m_layout, nullptr);
    vkDestroyDescriptorPool(m_device, m_pool, nullptr);
    for (const VkDescriptorSetLayout layout : m_layouts) vkDestroyDescriptorSetLayout(m_device, layout, nullptr);
}

void QueryShader::makeSets(const EngineBuffer& questions, const EngineBuffer& answers,
                           vulkan::QueryConstants constants) {
    const VkDescriptorSetLayoutBinding own[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    m_layouts[0] = makeLayout(m_device, own);
    m_layouts[1] =
        makeLayout(m_device, vulkan::GpuField::queryBindings(kFirstBinding, VK_SHADER_STAGE_COMPUTE_BIT, constants));
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2}};
    const VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 2, 3, sizes};
    check(vkCreateDescriptorPool(m_device, &pool, nullptr, &m_pool));
    const VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, m_pool, 2,
                                               m_layouts};
    check(vkAllocateDescriptorSets(m_device, &allocate, m_sets));
    for (std::uint32_t i = 0; i < 2; ++i) {
        const VkDescriptorBufferInfo buffer{i == 0 ? questions.buffer : answers.buffer, 0, VK_WHOLE_SIZE};
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = m_sets[0];
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(m_device, 1, &write, 0, nullptr);
    }
}

void QueryShader::makePipeline(const char* spirvFile) {
    std::ifstream in(spirvFile, std::ios::binary);
    const std::vector<char> code((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    VkShaderModuleCreateInfo moduleInfo{};
    moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    moduleInfo.codeSize = code.size();
    moduleInfo.pCode = reinterpret_cast<const std::uint32_t*>(code.data());
    VkShaderModule module;
    check(vkCreateShaderModule(m_device, &moduleInfo, nullptr, &module));
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 4};
    const VkPipelineLayoutCreateInfo layout{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 2, m_layouts, 1, &push};
    check(vkCreatePipelineLayout(m_device, &layout, nullptr, &m_layout));
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = m_layout;
    check(vkCreateComputePipelines(m_device, VK_NULL_HANDLE, 1, &info, nullptr, &m_pipeline));
    vkDestroyShaderModule(m_device, module, nullptr);
}

void QueryShader::record(VkCommandBuffer commands, std::uint32_t count) const {
    VkMemoryBarrier2 memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    memory.srcStageMask = memory.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    memory.srcAccessMask = memory.dstAccessMask = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT;
    VkDependencyInfo order{};
    order.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    order.memoryBarrierCount = 1;
    order.pMemoryBarriers = &memory;
    vkCmdPipelineBarrier2(commands, &order);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout, 0, 2, m_sets, 0, nullptr);
    vkCmdPushConstants(commands, m_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, 4, &count);
    vkCmdDispatch(commands, (count + 31) / 32, 1, 1);
    vkCmdPipelineBarrier2(commands, &order);
}

}  // namespace probegi::test
