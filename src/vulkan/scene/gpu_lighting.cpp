#include "core/sentence.h"
#include "vulkan/device/errors.h"
#include "vulkan/scene/gpu_lighting_impl.h"
#include "vulkan/scene/scene_data.h"

namespace probegi::vulkan {

GpuLighting::Impl::Impl(const Device& d, const Lighting& lighting, int maxLights)
    : device(d),
      capacity(std::max(maxLights, int(lighting.lights.size()))),
      skyWidth(packSky(lighting.sky).width),
      skyHeight(packSky(lighting.sky).height),
      packed(packLights(lighting.lights)),
      pixels(lighting.sky.image.pixels) {
    packed.resize(std::size_t(capacity));
    lights = staging.add(d.impl(), "lights", packed);
    skyPixels = staging.add(d.impl(), "sky", pixels);
    described.push_back(describe(lighting));
    block = staging.add(d.impl(), "lighting", described);
    staging.fill(d.impl());
}

kernels::LightingBlock GpuLighting::Impl::describe(const Lighting& lighting) const {
    kernels::GpuSky sky = packSky(lighting.sky);
    sky.width = skyWidth;
    sky.height = skyHeight;
    return {packAddress(lights.address()), packAddress(skyPixels.address()), sky, int(lighting.lights.size())};
}

GpuLighting::GpuLighting(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
GpuLighting::GpuLighting(GpuLighting&&) noexcept = default;
GpuLighting& GpuLighting::operator=(GpuLighting&&) noexcept = default;
GpuLighting::~GpuLighting() = default;

Result<GpuLighting> GpuLighting::create(const Device& device, const Lighting& lighting, int maxLights) {
    if (maxLights < 0) return fail(ErrorCode::invalidArgument, "maxLights is negative; it must be 0 or more");
    return guarded("uploading lights",
                   [&] { return GpuLighting(std::make_unique<Impl>(device, lighting, maxLights)); });
}

Result<void> GpuLighting::recordUpload(VkCommandBuffer commands) {
    if (m_impl->staging.released()) return fail(ErrorCode::invalidArgument, kNothingToUpload);
    return guarded("recording the upload of lights", [&] {
        const Recorder recorder(m_impl->device.impl(), commands);
        m_impl->staging.record(recorder);
        recorder.transferToCompute();
    });
}

void GpuLighting::releaseStaging() noexcept {
    m_impl->staging.release();
    m_impl->pixels = {};
}

Result<void> GpuLighting::recordUpdate(VkCommandBuffer commands, const Lighting& lighting) {
    if (int(lighting.lights.size()) > m_impl->capacity)
        return fail(ErrorCode::invalidArgument, sentence(lighting.lights.size(), " lights do not fit; the capacity is ",
                                                         m_impl->capacity, " (maxLights)"));
    return guarded("updating lights", [&] {
        const Recorder recorder(m_impl->device.impl(), commands);
        const std::vector<kernels::GpuLight> lights = packLights(lighting.lights);
        recorder.orderAll();
        recorder.write(m_impl->lights, std::as_bytes(std::span(lights)));
        recorder.write(m_impl->block, bytesOf(m_impl->describe(lighting)));
        recorder.orderAll();
    });
}

std::size_t GpuLighting::bytes() const noexcept {
    return m_impl->lights.bytes() + m_impl->skyPixels.bytes() + m_impl->block.bytes();
}

}  // namespace probegi::vulkan
