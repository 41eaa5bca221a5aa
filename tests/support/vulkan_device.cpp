#include "support/vulkan_device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <optional>
#include <stdexcept>

namespace probegi::test {

namespace {

std::atomic<int> validationMessages{0};

// Validation messages reach the log while the device lives and while it is closed, when forgotten objects are found.
void onLog(LogLevel, std::string_view line) {
    std::fprintf(stderr, "%.*s\n", int(line.size()), line.data());
    if (line.starts_with("Vulkan validation: ")) ++validationMessages;
}

std::optional<vulkan::Device> device;

class ValidationIsSilent : public testing::Environment {
    void TearDown() override {
        const int counted = device ? device->validationMessages() : 0;
        device.reset();
        EXPECT_EQ(counted, 0);
        EXPECT_EQ(validationMessages, 0) << "messages of the validation layer: see above";
    }
};

const auto* const environment = testing::AddGlobalTestEnvironment(new ValidationIsSilent);

}  // namespace

const Context& testContext() {
    static const Context context = [] {
        ContextDesc desc;
        desc.log = onLog;
        return Context::create(desc).value();
    }();
    return context;
}

vulkan::Device& testDevice() {
    if (!device) {
        vulkan::OpenDesc desc;
        desc.validation = true;
        auto opened = vulkan::Device::open(testContext(), desc);
        if (!opened) throw std::runtime_error("no Vulkan device for the tests: " + opened.error().message);
        device = std::move(*opened);
    }
    return *device;
}

}  // namespace probegi::test
