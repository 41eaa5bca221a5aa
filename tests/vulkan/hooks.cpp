#include "vulkan/hooks.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace probegi::test {

namespace {

// Whether this call must fail.
bool refused(std::string_view function) {
    Hooks& h = hooks();
    const bool counts = h.failing.empty() ? function == "vkAllocateMemory" || function == "vkCreateBuffer" ||
                                                function == "vkCreateImage"
                                          : function.starts_with(h.failing);
    if (!counts || h.countdown == 0) return false;
    if (h.countdown > 1) {
        --h.countdown;
        return false;
    }
    if (!h.failuresStay) h.countdown = 0;
    ++h.failures;
    return true;
}

template <class Function>
Function deviceFunction(VkDevice device, const char* name) {
    return reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
}

template <class Info>
Info seen(Info info) {
    if constexpr (std::is_same_v<Info, VkBufferCreateInfo>)
        if (hooks().buffers) hooks().buffers(info);
    if constexpr (std::is_same_v<Info, VkImageCreateInfo>)
        if (hooks().images) hooks().images(info);
    return info;
}

#define HOOK_OBJECT(Kind, Info)                                                                                      \
    VKAPI_ATTR VkResult VKAPI_CALL create##Kind(VkDevice device, const Info* info, const VkAllocationCallbacks* own, \
                                                Vk##Kind* made) {                                                    \
        if (refused("vkCreate" #Kind)) return hooks().failure;                                                       \
        const Info asked = seen(*info);                                                                              \
        const VkResult result =                                                                                      \
            deviceFunction<PFN_vkCreate##Kind>(device, "vkCreate" #Kind)(device, &asked, own, made);                 \
        if (result == VK_SUCCESS) ++hooks().live[#Kind];                                                             \
        return result;                                                                                               \
    }                                                                                                                \
    VKAPI_ATTR void VKAPI_CALL destroy##Kind(VkDevice device, Vk##Kind object, const VkAllocationCallbacks* own) {   \
        if (object) --hooks().live[#Kind];                                                                           \
        deviceFunction<PFN_vkDestroy##Kind>(device, "vkDestroy" #Kind)(device, object, own);                         \
    }

HOOK_OBJECT(Buffer, VkBufferCreateInfo)
HOOK_OBJECT(Image, VkImageCreateInfo)
HOOK_OBJECT(ImageView, VkImageViewCreateInfo)
HOOK_OBJECT(Sampler, VkSamplerCreateInfo)
HOOK_OBJECT(ShaderModule, VkShaderModuleCreateInfo)
HOOK_OBJECT(PipelineLayout, VkPipelineLayoutCreateInfo)
HOOK_OBJECT(PipelineCache, VkPipelineCacheCreateInfo)
HOOK_OBJECT(DescriptorSetLayout, VkDescriptorSetLayoutCreateInfo)
HOOK_OBJECT(DescriptorPool, VkDescriptorPoolCreateInfo)
HOOK_OBJECT(QueryPool, VkQueryPoolCreateInfo)
HOOK_OBJECT(CommandPool, VkCommandPoolCreateInfo)
HOOK_OBJECT(Fence, VkFenceCreateInfo)
HOOK_OBJECT(AccelerationStructureKHR, VkAccelerationStructureCreateInfoKHR)

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* own, VkPipeline* made) {
    if (refused("vkCreateComputePipelines")) return hooks().failure;
    const VkResult result = vkCreateComputePipelines(device, cache, count, infos, own, made);
    if (result == VK_SUCCESS) hooks().live["Pipeline"] += int(count);
    return result;
}
VKAPI_ATTR void VKAPI_CALL destroyPipeline(VkDevice device, VkPipeline pipeline, const VkAllocationCallbacks* own) {
    if (pipeline) --hooks().live["Pipeline"];
    vkDestroyPipeline(device, pipeline, own);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* own, VkDeviceMemory* memory) {
    if (refused("vkAllocateMemory")) return hooks().failure;
    const VkResult result = vkAllocateMemory(device, info, own, memory);
    if (result == VK_SUCCESS) hooks().allocations[*memory] = info->allocationSize;
    return result;
}
VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* own) {
    hooks().allocations.erase(memory);
    vkFreeMemory(device, memory, own);
}
VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                                         VkMemoryMapFlags flags, void** data) {
    return refused("vkMapMemory") ? hooks().failure : vkMapMemory(device, memory, offset, size, flags, data);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                           VkFence fence) {
    ++hooks().submits;
    return refused("vkQueueSubmit") ? hooks().failure : vkQueueSubmit(queue, count, infos, fence);
}
// Always waits, so that unfinished work of a "lost" device does not run on during the test.
VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                             std::uint64_t timeout) {
    const VkResult result = vkWaitForFences(device, count, fences, all, timeout);
    return refused("vkWaitForFences") ? hooks().failure : result;
}

VKAPI_ATTR void VKAPI_CALL physicalProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* out) {
    vkGetPhysicalDeviceProperties(device, out);
    if (hooks().properties) hooks().properties(*out);
}
VKAPI_ATTR void VKAPI_CALL physicalFormats(VkPhysicalDevice device, VkFormat format, VkFormatProperties* out) {
    vkGetPhysicalDeviceFormatProperties(device, format, out);
    if (hooks().formats) hooks().formats(format, *out);
}
VKAPI_ATTR void VKAPI_CALL physicalFamilies(VkPhysicalDevice device, std::uint32_t* count,
                                            VkQueueFamilyProperties* out) {
    std::uint32_t real = out ? *count - hooks().moreFamilies : 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &real, out);
    *count = real + hooks().moreFamilies;
    if (out) std::fill(out + real, out + *count, out[real - 1]);
    if (out && hooks().families)
        for (std::uint32_t i = 0; i < *count; ++i) hooks().families(out[i]);
}
VKAPI_ATTR void VKAPI_CALL physicalFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* out) {
    vkGetPhysicalDeviceFeatures2(device, out);
    if (hooks().features) hooks().features(*out);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedDeviceFunctions(VkDevice device, const char* name);

struct Entry {
    const char* name;
    PFN_vkVoidFunction function;
};
#define HOOK(name, function)                                    \
    Entry {                                                     \
#name, reinterpret_cast < PFN_vkVoidFunction>(function) \
    }
#define HOOKS_OF_OBJECT(Kind) HOOK(vkCreate##Kind, create##Kind), HOOK(vkDestroy##Kind, destroy##Kind)

PFN_vkVoidFunction hookOf(const char* name) {
    static const Entry entries[] = {
        HOOKS_OF_OBJECT(Buffer),
        HOOKS_OF_OBJECT(Image),
        HOOKS_OF_OBJECT(ImageView),
        HOOKS_OF_OBJECT(Sampler),
        HOOKS_OF_OBJECT(ShaderModule),
        HOOKS_OF_OBJECT(PipelineLayout),
        HOOKS_OF_OBJECT(PipelineCache),
        HOOKS_OF_OBJECT(DescriptorSetLayout),
        HOOKS_OF_OBJECT(DescriptorPool),
        HOOKS_OF_OBJECT(QueryPool),
        HOOKS_OF_OBJECT(CommandPool),
        HOOKS_OF_OBJECT(Fence),
        HOOKS_OF_OBJECT(AccelerationStructureKHR),
        HOOK(vkCreateComputePipelines, createComputePipelines),
        HOOK(vkDestroyPipeline, destroyPipeline),
        HOOK(vkAllocateMemory, allocateMemory),
        HOOK(vkFreeMemory, freeMemory),
        HOOK(vkMapMemory, mapMemory),
        HOOK(vkQueueSubmit, queueSubmit),
        HOOK(vkWaitForFences, waitForFences),
        HOOK(vkGetPhysicalDeviceProperties, physicalProperties),
        HOOK(vkGetPhysicalDeviceFormatProperties, physicalFormats),
        HOOK(vkGetPhysicalDeviceQueueFamilyProperties, physicalFamilies),
        HOOK(vkGetPhysicalDeviceFeatures2, physicalFeatures),
        HOOK(vkGetDeviceProcAddr, hookedDeviceFunctions),
    };
    for (const Entry& entry : entries)
        if (std::strcmp(entry.name, name) == 0) return entry.function;
    return nullptr;
}

bool isHidden(const char* name) {
    return !hooks().hidden.empty() && std::strstr(name, hooks().hidden.c_str());
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedDeviceFunctions(VkDevice device, const char* name) {
    const PFN_vkVoidFunction real = vkGetDeviceProcAddr(device, name);
    if (!real || isHidden(name)) return nullptr;
    const PFN_vkVoidFunction hook = hookOf(name);
    return hook ? hook : real;
}

}  // namespace

Hooks& hooks() {
    static Hooks all;
    return all;
}

void Hooks::failCall(int n, VkResult result, const std::string& only, bool stays) {
    countdown = n;
    failure = result;
    failing = only;
    failuresStay = stays;
    failures = 0;
}

int Hooks::liveObjects() const {
    int sum = int(allocations.size());
    for (const auto& [kind, count] : live) sum += count;
    return sum;
}

std::string Hooks::liveText() const {
    std::string text = std::to_string(allocations.size()) + " allocations";
    for (const auto& [kind, count] : live)
        if (count != 0) text += ", " + std::to_string(count) + " " + kind;
    return text;
}

VkDeviceSize Hooks::allocatedBytes() const {
    VkDeviceSize sum = 0;
    for (const auto& [memory, bytes] : allocations) sum += bytes;
    return sum;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedLoader(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
    if (!real || isHidden(name)) return nullptr;
    const PFN_vkVoidFunction hook = hookOf(name);
    return hook ? hook : real;
}

}  // namespace probegi::test
