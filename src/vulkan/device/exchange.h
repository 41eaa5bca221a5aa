#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "vulkan/device/errors.h"
#include "vulkan/device/recorder.h"

namespace probegi::vulkan {

/// Round trips to the GPU: uploads arrays, runs passes on them, reads results back. Reuses its buffers. Throws. One
/// thread at a time.
class Exchange {
public:
    explicit Exchange(const Device& device) : m_device(device) {}

    /// Begins a round trip with at most so many bytes each way.
    void begin(std::size_t bytesIn, std::size_t bytesOut);
    /// Appends input values and returns their address.
    template <class T>
    VkDeviceAddress add(std::span<const T> values) {
        const std::size_t at = m_used;
        std::ranges::copy(std::as_bytes(values), m_upload.mapped<std::byte>().begin() + std::ptrdiff_t(at));
        m_used += (values.size_bytes() + 15) / 16 * 16;
        return m_in.address() + at;
    }
    /// Address for the results.
    VkDeviceAddress out() const noexcept { return m_out.address(); }
    const Buffer& outBuffer() const noexcept { return m_out; }
    /// Copies the input, records the passes, copies the first bytes of the results back, waits.
    void run(const std::function<void(const Recorder&)>& passes, std::size_t bytesBack);
    template <class T>
    std::span<const T> results() const noexcept {
        return m_readback.mapped<T>();
    }
    std::size_t bytes() const noexcept { return m_in.bytes() + m_out.bytes(); }  ///< of GPU memory

private:
    Device m_device;
    Buffer m_upload, m_in, m_out, m_readback;
    std::size_t m_used = 0;
};

/// Records, submits and waits. Throws Failure on an engine's device: the library does not submit there.
void submitAndWait(const Device& device, const std::function<void(const Recorder&)>& passes);

}  // namespace probegi::vulkan
