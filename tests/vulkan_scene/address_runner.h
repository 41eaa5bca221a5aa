#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "probegi/result.h"

namespace probegi::test {

/// Dispatches compute shaders that access data by buffer device address, on the first Vulkan device.
class AddressRunner {
public:
    /// Errors: unsupported (no usable Vulkan device).
    static Result<AddressRunner> create();
    AddressRunner(AddressRunner&&) noexcept;
    AddressRunner& operator=(AddressRunner&&) noexcept;
    ~AddressRunner();

    /// Copies values to a new buffer and returns its address. Empty arrays also get a buffer.
    template <class T>
    std::uint64_t upload(std::span<const T> values) {
        return uploadBytes(std::as_bytes(values));
    }
    template <class T>
    std::uint64_t upload(const std::vector<T>& values) {
        return upload(std::span<const T>(values));
    }
    /// The current contents of an uploaded buffer.
    template <class T>
    void download(std::uint64_t address, std::span<T> out) const {
        downloadBytes(address, std::as_writable_bytes(out));
    }

    void run(std::span<const std::uint32_t> spirv, std::span<const std::byte> pushConstants, int groups) const;

    struct Impl;

private:
    explicit AddressRunner(std::unique_ptr<Impl> impl);
    std::uint64_t uploadBytes(std::span<const std::byte> bytes);
    void downloadBytes(std::uint64_t address, std::span<std::byte> out) const;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi::test
