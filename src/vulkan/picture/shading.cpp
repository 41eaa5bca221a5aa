#include "vulkan/picture/shading.h"

#include "vulkan/device/errors.h"

namespace probegi::vulkan {

void recordPass(const Recorder& recorder, const SceneObjects& objects, const GpuPass& pass,
                const kernels::PicturePush& push, Profiler* profiler) {
    if (!pass.shader) return;
    const PassScope scope(recorder, objects.scene.impl().device.impl(), profiler, pass.name);
    recorder.dispatchOver(*pass.shader, pass.perPixel ? std::uint64_t(push.width) * push.rows : push.sampleCount);
    recorder.computeToCompute();
}

void preparePasses(const SceneObjects& objects, std::span<const GpuPass> passes) {
    for (const GpuPass& pass : passes)
        if (pass.shader) objects.scene.impl().device.impl().pipelines->get(*pass.shader);
}

void bindPasses(const Recorder& recorder, const SceneObjects& objects, const kernels::PicturePush& push) {
    // Sets and constants stay bound through all passes, which share one layout.
    if (objects.volume) recorder.bindVolume(objects.volume->set());
    recorder.bindScene(objects.scene.impl().set());
    recorder.push(push);
}

GpuPass gpuPass(const PassInfo& info, const SceneObjects& objects) {
    GpuPass pass{info.name, {}, info.time, info.neighbours};
    switch (info.pass) {
        case PicturePass::primary:
            pass.shader = objects.scene.impl().shader("picture_primary");
            break;
        case PicturePass::direct:
            pass.shader = objects.scene.impl().shader("picture_direct");
            break;
        case PicturePass::query:
            if (objects.volume) pass.shader = "picture_query";
            break;
        case PicturePass::accumulate:
            pass.shader = "picture_accumulate";
            pass.perPixel = true;
            break;
    }
    return pass;
}

std::vector<GpuPass> gpuPasses(const SceneObjects& objects) {
    std::vector<GpuPass> passes;
    for (const PassInfo& info : kPicturePasses) passes.push_back(gpuPass(info, objects));
    return passes;
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
        const SceneObjects objects{scene, passes};
        std::vector<GpuPass> chosen;
        for (const PassInfo& info : kPicturePasses)
            if (info.pass == PicturePass::direct || info.pass == PicturePass::query)
                chosen.push_back(gpuPass(info, objects));
        preparePasses(objects, chosen);
        if (passes) passes->recordSettings(recorder, field->control().settings());
        kernels::PicturePush push{};
        push.samples = packAddress(samples);
        push.lighting = packAddress(lighting.impl().address());
        push.sampleCount = count;
        push.flags = diffuseOnly ? kernels::kPictureDiffuseOnly : 0;
        bindPasses(recorder, objects, push);
        for (const GpuPass& pass : chosen) recordPass(recorder, objects, pass, push, profiler);
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
