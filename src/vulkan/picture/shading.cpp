#include "vulkan/picture/shading.h"

#include "vulkan/device/errors.h"

namespace probegi::vulkan {

void recordPass(const Recorder& recorder, const SceneObjects& objects, const GpuPass& pass,
                const kernels::PicturePush& push, Profiler* profiler) {
    if (!pass.shader) return;
    const PassScope scope(recorder, objects.scene.impl().device.impl(), profiler, pass.name);
    std::uint64_t threads = push.sampleCount;
    if (pass.perPixel) threads = std::uint64_t(push.width) * push.rows;
    if (pass.perBlock || pass.onHits) threads = glossyBlocks(push.width, push.rows);
    if (pass.onHits) {
        kernels::PicturePush hits = push;
        hits.samples = push.glossy;
        hits.sampleCount = std::uint32_t(threads);
        recorder.push(hits);
    }
    recorder.dispatchOver(*pass.shader, threads);
    if (pass.onHits) recorder.push(push);
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
    const GpuScene::Impl& scene = objects.scene.impl();
    switch (info.pass) {
        case PicturePass::primary:
            pass.shader = scene.shader("picture_primary");
            break;
        case PicturePass::direct:
            pass.shader = scene.shader("picture_direct");
            break;
        case PicturePass::query:
            if (objects.volume) pass.shader = "picture_query";
            break;
        case PicturePass::glossyTrace:
            pass.shader = scene.shader("picture_glossy_trace");
            pass.perBlock = true;
            break;
        case PicturePass::glossyDirect:
            pass.shader = scene.shader("picture_direct");
            pass.onHits = true;
            break;
        case PicturePass::glossyQuery:
            if (objects.volume) pass.shader = "picture_query";
            pass.onHits = true;
            break;
        case PicturePass::glossyField:
            if (objects.volume) pass.shader = "picture_glossy_field";
            break;
        case PicturePass::glossyLight:
            pass.shader = "picture_glossy_light";
            pass.perBlock = true;
            break;
        case PicturePass::glossyBlur:
            pass.shader = "picture_glossy_blur";
            pass.perBlock = true;
            break;
        case PicturePass::glossySpread:
            pass.shader = "picture_glossy_spread";
            pass.perBlock = true;
            break;
        case PicturePass::glossyShade:
            pass.shader = "picture_glossy_shade";
            break;
        case PicturePass::contactSearch:
            pass.shader = "picture_contact_search";
            break;
        case PicturePass::contactBlur:
            pass.shader = "picture_contact_blur";
            break;
        case PicturePass::contactHistory:
            pass.shader = "picture_contact_history";
            break;
        case PicturePass::contactShade:
            pass.shader = "picture_contact_shade";
            break;
        case PicturePass::accumulate:
            pass.shader = "picture_accumulate";
            pass.perPixel = true;
            break;
    }
    return pass;
}

std::vector<GpuPass> gpuPasses(const SceneObjects& objects, const PictureDesc& desc) {
    std::vector<GpuPass> passes;
    for (const PassInfo& info : kPicturePasses)
        if (hasPass(info, desc)) passes.push_back(gpuPass(info, objects));
    return passes;
}

// As picture_glossy.glsl has it.
static_assert(sizeof(ScreenSample) == 100 && sizeof(kernels::GlossySample) == 36);

std::uint32_t glossyBlocks(int width, int rows) {
    return std::uint32_t(kernels::glossyBlocks(width)) * std::uint32_t(kernels::glossyBlocks(rows));
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
