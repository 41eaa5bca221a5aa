#include "global_illumination.h"

#include <cstdio>

using namespace probegi;
using namespace probegi::vulkan;

// [adopt]
Device GlobalIllumination::adopt(const Context& context, const EngineDevice& engine, MemoryPool& pool) {
    AdoptDesc desc;
    desc.instance = *engine.instance();
    desc.physicalDevice = *engine.physical();
    desc.device = *engine.device();
    desc.queueFamily = engine.family();
    desc.createInfo = &engine.createInfo();  // which features and extensions are enabled
    desc.instanceExtensions = engine.instanceExtensions();
    desc.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.allocator = pool.callbacks();
    return Device::adopt(context, desc).value();
}
// [/adopt]

GlobalIllumination::GlobalIllumination(const Context& context, const EngineDevice& engine, MemoryPool& pool,
                                       const FrameData& start)
    : m_start(start),
      m_scene(sceneOf(start)),
      m_device(adopt(context, engine, pool)),
      m_gpuScene(GpuScene::create(context, m_device, m_scene, poseAt(m_scene), {.movableNodes = {&kCrate, 1}}).value()),
      m_lighting(GpuLighting::create(m_device, lightingOf(start)).value()),
      m_traced(GpuField::create(m_device, fieldDesc(), fieldSettings()).value()),
      m_own(GpuField::create(m_device, fieldDesc(), fieldSettings()).value()),
      m_ownRays(engine, pool, m_own) {}

void GlobalIllumination::recordUpload(const vk::raii::CommandBuffer& commands) {
    m_gpuScene.recordUpload(*commands).value();
    m_lighting.recordUpload(*commands).value();
    m_traced.recordClear(*commands).value();
    m_own.recordClear(*commands).value();
}

void GlobalIllumination::releaseStaging() {
    m_gpuScene.releaseStaging();
    m_lighting.releaseStaging();
}

void GlobalIllumination::record(const vk::raii::CommandBuffer& commands, const FrameData& now, vk::DeviceAddress frame,
                                Profiler& profiler) {
    // [frame]
    m_lighting.recordUpdate(*commands, lightingOf(now)).value();
    m_gpuScene.recordPose(*commands, poseOf(m_scene, m_start, now)).value();
    m_traced.recordUpdate(*commands, m_gpuScene, m_lighting, &profiler).value();
    // [/frame]

    // [own]
    profiler.recordBegin(*commands, "own rays");
    m_ownRays.record(commands, m_own, frame);
    profiler.recordEnd(*commands);
    m_own.recordUpdate(*commands, m_ownRays.data(), {}, &profiler, vulkan::RayFormat::packed).value();
    // [/own]
}

void GlobalIllumination::recordQuestions(const vk::raii::CommandBuffer& commands, vk::DeviceAddress questions,
                                         std::uint32_t count, vk::DeviceAddress traced, vk::DeviceAddress own) {
    m_traced.recordQuery(*commands, questions, traced, count).value();
    m_own.recordQuery(*commands, questions, own, count).value();
}

void GlobalIllumination::printMemory() const {
    const FieldMemory memory = m_traced.memory();
    std::printf("%d probes: %zu bytes, and %zu of scratch; scene %zu, lighting %zu bytes\n",
                probeCount(m_traced.desc()), memory.persistentBytes(), memory.scratchBytes, m_gpuScene.bytes(),
                m_lighting.bytes());
}
