#pragma once

#include "probegi/vulkan.h"

namespace probegi::test {

/// The device that this process's tests share, opened by the first call under the validation layer with
/// synchronisation validation. Any message of the layer, those of closing the device included, fails the process.
/// Which device it is says the system, or VK_DRIVER_FILES. Throws where there is none: the tests need one.
vulkan::Device& testDevice();

/// What testDevice() was opened with.
const Context& testContext();

}  // namespace probegi::test
