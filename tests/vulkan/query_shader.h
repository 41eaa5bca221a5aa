#pragma once

#include "vulkan/engine.h"

namespace probegi::test {

/// An engine's compute shader that includes probegi/query.glsl (shaders/query_include.comp) or query.hlsl. Set 0:
/// queries and results; set 1: the volume's bindings.
class QueryShader {
public:
    static constexpr std::uint32_t kFirstBinding = 3;  // PROBEGI_BINDING of the shader

    QueryShader(const Engine& engine, const char* spirvFile, const EngineBuffer& questions, const EngineBuffer& answers,
                vulkan::QueryConstants constants = vulkan::QueryConstants::uniformBuffer);
    ~QueryShader();
    QueryShader(const QueryShader&) = delete;
    QueryShader& operator=(const QueryShader&) = delete;

    VkDescriptorSet volumeSet() const noexcept { return m_sets[1]; }
    /// Records the dispatch, with barriers to compute shaders before and after it.
    void record(VkCommandBuffer commands, std::uint32_t count) const;

private:
    void makeSets(const EngineBuffer& questions, const EngineBuffer& answers, vulkan::QueryConstants constants);
    void makePipeline(const char* spirvFile);

    VkDevice m_device;
    VkDescriptorSetLayout m_layouts[2] = {};
    VkDescriptorPool m_pool = VK_NULL_HANDLE;
    VkDescriptorSet m_sets[2] = {};
    VkPipelineLayout m_layout = VK_NULL_HANDLE;
    VkPipeline m_pipeline = VK_NULL_HANDLE;
};

}  // namespace probegi::test
