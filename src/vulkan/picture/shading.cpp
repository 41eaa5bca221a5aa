#include "vulkan/picture/shading.h"

#include "vulkan/device/errors.h"

namespace probegi::vulkan {

namespace {

using kernels::GpuSample;

static_assert(sizeof(ShadingSample) == sizeof(GpuSample) && offsetof(ShadingSample, kind) == offsetof(GpuSample, kind));
static_assert(offsetof(ShadingSample, viewDirection) == offsetof(GpuSample, direction));
static_assert(offsetof(ShadingSample, geometricNormal) == offsetof(GpuSample, geometricNormal));
static_assert(offsetof(ShadingSample, shadingNormal) == offsetof(GpuSample, shadingNormal));
static_assert(offsetof(ShadingSample, albedo) == offsetof(GpuSample, albedo));
static_assert(offsetof(ShadingSample, direct) == offsetof(GpuSample, direct));
static_assert(offsetof(ShadingSample, indirect) == offsetof(GpuSample, indirect));
static_assert(ShadingSample::surface == kernels::kSampleSurface && ShadingSample::sky == kernels::kSampleSky &&
              ShadingSample::backface == kernels::kSampleBackface);

}  // namespace

void recordSampleShading(const Recorder& recorder, const Device& device, const GpuScene& scene,
                         const FieldPasses* volume, const kernels::PicturePush& push, Profiler* profiler) {
    // Sets stay bound through both passes, which share one layout.
    if (volume) recorder.bindVolume(volume->set());
    recorder.bindScene(scene.impl().set());
    recorder.push(push);
    {
        const PassScope scope(recorder, device.impl(), profiler, "direct");
        recorder.dispatchOver(scene.impl().shader("picture_direct"), push.sampleCount);
    }
    recorder.computeToCompute();
    if (!volume) return;
    {
        const PassScope scope(recorder, device.impl(), profiler, "query");
        recorder.dispatchOver("picture_query", push.sampleCount);
    }
    recorder.computeToCompute();
}

Result<void> recordShading(VkCommandBuffer commands, const GpuScene& scene, const GpuLighting& lighting,
                           GpuField* field, VkDeviceAddress samples, std::uint32_t count, bool diffuseOnly,
                           Profiler* profiler) {
    const Device& device = scene.impl().device;
    FieldPasses* passes = field ? &field->impl().passes : nullptr;
    if (&lighting.impl().device.impl() != &device.impl() || (passes && &passes->device().impl() != &device.impl()))
        return fail(ErrorCode::invalidArgument, "scene, lighting and field are not of one device");
    const auto done = guarded("recording shading", [&] {
        const Recorder recorder(device.impl(), commands);
        if (passes) passes->recordSettings(recorder, field->control().settings());
        kernels::PicturePush push{};
        push.samples = packAddress(samples);
        push.lighting = packAddress(lighting.impl().address());
        push.sampleCount = count;
        push.flags = diffuseOnly ? kernels::kPictureDiffuseOnly : 0;
        recordSampleShading(recorder, device, scene, passes, push, profiler);
    });
    if (!done && passes) passes->forgetRecorded();
    return done;
}

Result<void> recordToneMap(VkCommandBuffer commands, const Device& device, VkDeviceAddress linear,
                           VkDeviceAddress display, std::uint32_t width, std::uint32_t height, const ToneMap& toneMap,
                           Profiler* profiler) {
    return guarded("recording a tone map", [&] {
        const Recorder recorder(device.impl(), commands);
        const PassScope scope(recorder, device.impl(), profiler, "tone map");
        recorder.push(kernels::ToneMapPush{.pixels = packAddress(linear),
                                           .display = packAddress(display),
                                           .width = width,
                                           .height = height,
                                           .exposure = toneMap.exposure,
                                           .filmic = toneMap.filmic ? 1 : 0,
                                           .dither = toneMap.dither ? 1 : 0});
        recorder.dispatchOver("tone_map", std::size_t(width) * height);
    });
}

}  // namespace probegi::vulkan
