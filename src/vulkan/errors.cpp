#include "vulkan/errors.h"

#include <fmt/format.h>

namespace probegi::vulkan {

namespace {

// Refusals that are about room, besides the two plain ones.
bool meansNoMemory(vk::Result result) {
    return result == vk::Result::eErrorTooManyObjects || result == vk::Result::eErrorMemoryMapFailed ||
           result == vk::Result::eErrorOutOfPoolMemory || result == vk::Result::eErrorFragmentedPool ||
           result == vk::Result::eErrorFragmentation || result == vk::Result::eErrorInvalidOpaqueCaptureAddress;
}

}  // namespace

Error currentError(const char* doing) noexcept {
    try {
        throw;
    } catch (const Failure& failure) {
        return {failure.code, failure.what()};
    } catch (const vk::DeviceLostError&) {
        return {ErrorCode::deviceLost,
                fmt::format("the GPU was lost while {}; make a new device, or use the CPU backend", doing)};
    } catch (const vk::IncompatibleDriverError&) {
        return {
            ErrorCode::unsupported,
            "no Vulkan driver found a device; install a driver (mesa-vulkan-drivers has a software one), or use the "
            "CPU backend"};
    } catch (const vk::OutOfDeviceMemoryError&) {
        return {ErrorCode::outOfMemory,
                fmt::format("the GPU has no memory left for {}; use fewer probes or a smaller scene", doing)};
    } catch (const vk::OutOfHostMemoryError&) {
        return {ErrorCode::outOfMemory, fmt::format("no memory left for {}", doing)};
    } catch (const vk::SystemError& error) {
        if (meansNoMemory(vk::Result(error.code().value())))
            return {ErrorCode::outOfMemory,
                    fmt::format("the Vulkan driver has no room left for {}: {}", doing, error.what())};
        return {ErrorCode::unsupported, fmt::format("the Vulkan driver failed while {}: {}", doing, error.what())};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, fmt::format("no memory left for {}", doing)};
    } catch (const std::exception& error) {
        return {ErrorCode::unsupported, fmt::format("failed while {}: {}", doing, error.what())};
    } catch (...) {
        // Callbacks of an engine's may throw anything.
        return {ErrorCode::unsupported, fmt::format("failed while {}", doing)};
    }
}

}  // namespace probegi::vulkan
