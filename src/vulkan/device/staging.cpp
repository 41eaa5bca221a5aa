#include "vulkan/device/staging.h"

#include <algorithm>

namespace probegi::vulkan {

void Staging::fill(const Device::Impl& device) {
    m_upload = Buffer(device, "staging", m_bytes, vk::BufferUsageFlagBits::eTransferSrc, MemoryUse::upload);
    const std::span<std::byte> target = m_upload.mapped<std::byte>();
    for (const Copy& copy : m_copies)
        std::copy(copy.bytes.begin(), copy.bytes.end(), target.begin() + std::ptrdiff_t(copy.offset));
}

void Staging::record(const Recorder& recorder) const {
    for (const Copy& copy : m_copies)
        if (!copy.bytes.empty())
            recorder.commands().copyBuffer(m_upload.handle(), copy.to,
                                           vk::BufferCopy(copy.offset, 0, copy.bytes.size()), recorder.dispatcher());
}

}  // namespace probegi::vulkan
