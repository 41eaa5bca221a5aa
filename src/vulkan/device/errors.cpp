#include "vulkan/device/errors.h"

#include "core/sentence.h"

namespace probegi::vulkan {

namespace {

// Out-of-memory results besides the two obvious ones.
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
                sentence("the GPU was lost while ", doing, "; make a new device, or use the CPU backend")};
    } catch (const vk::IncompatibleDriverError&) {
        return {
            ErrorCode::unsupported,
            "no Vulkan driver found a device; install a driver (mesa-vulkan-drivers has a software one), or use the "
            "CPU backend"};
    } catch (const vk::OutOfDeviceMemoryError&) {
        return {ErrorCode::outOfMemory,
                sentence("the GPU has no memory left for ", doing, "; use fewer probes or a smaller scene")};
    } catch (const vk::OutOfHostMemoryError&) {
        return {ErrorCode::outOfMemory, sentence("no memory left for ", doing)};
    } catch (const vk::SystemError& error) {
        if (meansNoMemory(vk::Result(error.code().value())))
            return {ErrorCode::outOfMemory,
                    sentence("the Vulkan driver has no room left for ", doing, ": ", error.what())};
        return {ErrorCode::unsupported, sentence("the Vulkan driver failed while ", doing, ": ", error.what())};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::outOfMemory, sentence("no memory left for ", doing)};
    } catch (const std::exception& error) {
        return {ErrorCode::unsupported, sentence("failed while ", doing, ": ", error.what())};
    } catch (...) {
        // An engine's callbacks may throw anything.
        return {ErrorCode::unsupported, sentence("failed while ", doing)};
    }
}

}  // namespace probegi::vulkan
