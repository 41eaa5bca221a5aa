#pragma once

#include <vector>

#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// The error for an upload recorded too late.
inline constexpr const char* kNothingToUpload =
    "the upload was recorded after releaseStaging(), when nothing is left to copy; record it once, before";

/// Uploads to several buffers: collects the bytes, copies them into one upload buffer, records the copies, releases it.
class Staging {
public:
    /// A new device buffer for the bytes. `bytes` must live until fill(). Throws.
    template <class T>
    Buffer add(const Device::Impl& device, const char* name, const std::vector<T>& values,
               vk::BufferUsageFlags usage = kAddressed) {
        Buffer buffer(device, name, values.size() * sizeof(T), usage);
        m_copies.push_back({buffer.handle(), std::as_bytes(std::span(values)), m_bytes});
        m_bytes += (values.size() * sizeof(T) + 15) / 16 * 16;
        return buffer;
    }
    /// Allocates the upload buffer and copies everything into it. Throws.
    void fill(const Device::Impl& device);
    void record(const Recorder& recorder) const;
    void release() noexcept { *this = Staging(); }
    /// Whether nothing is left to record, or nothing was ever added.
    bool released() const noexcept { return m_copies.empty(); }

private:
    struct Copy {
        vk::Buffer to;
        std::span<const std::byte> bytes;
        std::size_t offset;
    };
    std::vector<Copy> m_copies;
    std::size_t m_bytes = 0;
    Buffer m_upload;
};

}  // namespace probegi::vulkan
