#include "vulkan/device/exchange.h"

namespace probegi::vulkan {

namespace {

void growTo(const Device& device, Buffer& buffer, const char* name, std::size_t bytes, vk::BufferUsageFlags usage,
            MemoryUse use) {
    if (buffer.bytes() >= bytes && buffer) return;
    buffer = Buffer();
    buffer = Buffer(device.impl(), name, bytes, usage, use);
}

}  // namespace

void Exchange::begin(std::size_t bytesIn, std::size_t bytesOut) {
    using Usage = vk::BufferUsageFlagBits;
    // Each array is padded to 16 bytes; no round trip has more than four.
    const std::size_t room = bytesIn + 64;
    growTo(m_device, m_upload, "upload", room, Usage::eTransferSrc, MemoryUse::upload);
    growTo(m_device, m_in, "input", room, kAddressed, MemoryUse::device);
    growTo(m_device, m_out, "output", bytesOut, kAddressed | Usage::eTransferSrc, MemoryUse::device);
    growTo(m_device, m_readback, "readback", bytesOut, Usage::eTransferDst, MemoryUse::readback);
    m_used = 0;
}

void Exchange::run(const std::function<void(const Recorder&)>& passes, std::size_t bytesBack) {
    submitAndWait(m_device, [&](const Recorder& recorder) {
        recorder.copy(m_upload, m_in, m_used);
        recorder.transferToCompute();
        passes(recorder);
        recorder.orderAll();
        recorder.copy(m_out, m_readback, bytesBack);
        recorder.transferToHost();
    });
}

void submitAndWait(const Device& device, const std::function<void(const Recorder&)>& passes) {
    const Device::Impl& impl = device.impl();
    if (!impl.submitter)
        throw Failure(ErrorCode::unsupported,
                      "this call submits and waits, which the library does not do on an engine's device; record passes "
                      "into your own command buffers, or use Device::open");
    impl.submitter->run([&](VkCommandBuffer commands) { passes(Recorder(impl, commands)); });
}

}  // namespace probegi::vulkan
