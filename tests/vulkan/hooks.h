#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <map>
#include <string>

namespace probegi::test {

/// Simulates a faulty driver: intercepts calls between the library and the loader, counts objects and memory, and fails
/// calls. One for the process, since Vulkan's functions have no user data; call reset() at the start of a test.
struct Hooks {
    /// Fails the n-th allocating call from now on (1 is the next), and with `stays` all later ones. Allocating calls
    /// are vkAllocateMemory, vkCreateBuffer and vkCreateImage, or all functions whose names begin with `only`.
    void failCall(int n, VkResult result, const std::string& only = {}, bool stays = false);
    /// Whether a call has failed since failCall().
    bool failed() const noexcept { return failures > 0; }

    void reset() { *this = Hooks(); }
    /// Live objects of all kinds and allocations.
    int liveObjects() const;
    std::string liveText() const;

    std::map<std::string, int> live;  ///< by kind: "Buffer"
    std::map<VkDeviceMemory, VkDeviceSize> allocations;
    VkDeviceSize allocatedBytes() const;

    int countdown = 0;  ///< 0: no call fails
    bool failuresStay = false;
    int failures = 0;
    VkResult failure = VK_SUCCESS;
    std::string failing;

    std::function<void(VkPhysicalDeviceProperties&)> properties;
    std::function<void(VkFormat, VkFormatProperties&)> formats;
    std::function<void(VkQueueFamilyProperties&)> families;
    std::uint32_t moreFamilies = 0;  ///< that the device pretends to have, copies of its last one
    /// See what the library asks for, and change what the driver gets.
    std::function<void(VkBufferCreateInfo&)> buffers;
    std::function<void(VkImageCreateInfo&)> images;
    std::function<void(VkPhysicalDeviceFeatures2&)> features;
    std::string hidden;  ///< functions whose names contain it are missing; empty: none
    int submits = 0;
};

Hooks& hooks();

/// For OpenDesc::getInstanceProcAddr and AdoptDesc::getInstanceProcAddr.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedLoader(VkInstance instance, const char* name);

}  // namespace probegi::test
