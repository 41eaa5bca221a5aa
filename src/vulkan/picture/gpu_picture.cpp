#include <chrono>

#include "core/progress.h"
#include "geometry/picture_desc.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/field/vulkan_field.h"
#include "vulkan/picture/shading.h"

namespace probegi::vulkan {

namespace {

constexpr std::size_t kSamplesPerBand = std::size_t(1) << 20;
constexpr std::size_t kLayers = 7;

template <class Wanted, class Given>
const Wanted& onDevice(const Device& device, const Given& given, const char* what) {
    const auto* wanted = dynamic_cast<const Wanted*>(&given);
    if (!wanted || &wanted->device().impl() != &device.impl())
        throw Failure(ErrorCode::invalidArgument, std::string("the ") + what +
                                                      " is not on this Vulkan device; make it with the device, or "
                                                      "render with the CPU backend");
    return *wanted;
}

/// The passes of a picture, band by band: memory for samples stays bounded.
class PictureRenderer {
public:
    PictureRenderer(const Device& device, const GpuTracer& tracer, const GpuLighting& lighting, const Field* field,
                    const PictureDesc& desc)
        : m_device(device), m_tracer(tracer), m_field(field), m_desc(desc), m_exchange(device) {
        if (field) m_volume = &onDevice<VulkanField>(device, backendOf(*field), "field").passes();
        m_profiler.emplace(orThrow(Profiler::create(device)));
        const std::size_t perPixel = std::size_t(desc.samplesPerAxis) * desc.samplesPerAxis;
        const std::size_t perRow = std::size_t(desc.width) * perPixel;
        m_bandRows = int(std::clamp<std::size_t>(kSamplesPerBand / perRow, 1, std::size_t(desc.height)));
        m_samples = Buffer(device.impl(), "picture samples",
                           std::size_t(m_bandRows) * perRow * sizeof(kernels::GpuSample), kAddressed);
        m_push.samples = packAddress(m_samples.address());
        m_push.lighting = packAddress(lighting.impl().address());
        const PlacedCamera& camera = desc.camera;
        m_push.camera =
            kernels::makePinhole(camera.position, camera.forward, camera.up, camera.yfov, desc.width, desc.height);
        m_push.width = desc.width;
        m_push.samplesPerAxis = desc.samplesPerAxis;
        m_push.flags = desc.diffuseOnly ? kernels::kPictureDiffuseOnly : 0;
    }

    int bands() const { return (m_desc.height + m_bandRows - 1) / m_bandRows; }

    void render(int band, Picture& picture) {
        m_push.firstRow = band * m_bandRows;
        m_push.rows = std::min(m_bandRows, m_desc.height - m_push.firstRow);
        const std::size_t pixels = std::size_t(m_push.rows) * std::size_t(m_desc.width);
        m_push.sampleCount = std::uint32_t(pixels) * std::uint32_t(m_desc.samplesPerAxis * m_desc.samplesPerAxis);
        m_exchange.begin(0, kLayers * pixels * sizeof(glm::vec3));
        m_push.layers = packAddress(m_exchange.out());
        m_exchange.run([&](const Recorder& recorder) { record(recorder, pixels); },
                       kLayers * pixels * sizeof(glm::vec3));
        store(picture, pixels);
        for (const PassTime& pass : orThrow(m_profiler->read())) {
            if (pass.name == "primary") m_times.primary += pass.milliseconds;
            if (pass.name == "direct") m_times.direct += pass.milliseconds;
            if (pass.name == "query") m_times.query += pass.milliseconds;
        }
    }

    const PictureTimes& times() const noexcept { return m_times; }

private:
    void record(const Recorder& recorder, std::size_t pixels) {
        const Device::Impl& device = m_device.impl();
        m_profiler->recordReset(recorder.commands());
        if (m_volume) m_volume->recordSettings(recorder, m_field->control().settings());
        recorder.bindScene(m_tracer.scene().impl().set());
        recorder.push(m_push);
        {
            const PassScope scope(recorder, device, &*m_profiler, "primary");
            recorder.dispatchOver(m_tracer.scene().impl().shader("picture_primary"), m_push.sampleCount);
        }
        recorder.computeToCompute();
        recordSampleShading(recorder, m_device, m_tracer.scene(), m_volume, m_push, &*m_profiler);
        const PassScope scope(recorder, device, &*m_profiler, "resolve");
        recorder.dispatchOver("picture_resolve", pixels);
    }

    void store(Picture& picture, std::size_t pixels) const {
        HdrImage* layers[kLayers] = {&picture.color,  &picture.direct, &picture.indirect, &picture.irradiance,
                                     &picture.albedo, &picture.normal, &picture.depth};
        const auto results = m_exchange.results<glm::vec3>();
        const std::ptrdiff_t first = std::ptrdiff_t(m_push.firstRow) * m_desc.width;
        for (std::size_t layer = 0; layer < kLayers; ++layer)
            std::copy_n(results.begin() + std::ptrdiff_t(layer * pixels), pixels,
                        layers[layer]->pixels.begin() + first);
    }

    Device m_device;
    const GpuTracer& m_tracer;
    const Field* m_field;
    FieldPasses* m_volume = nullptr;  // of the field
    PictureDesc m_desc;
    Exchange m_exchange;
    std::optional<Profiler> m_profiler;
    int m_bandRows = 1;
    Buffer m_samples;
    kernels::PicturePush m_push{};
    PictureTimes m_times;
};

/// Lights of one picture.
GpuLighting uploadedLighting(const Device& device, const Lighting& lighting) {
    GpuLighting result = orThrow(GpuLighting::create(device, lighting));
    submitAndWait(device, [&](const Recorder& recorder) { orThrow(result.recordUpload(recorder.commands())); });
    result.releaseStaging();
    return result;
}

}  // namespace

Result<RenderedPicture> renderPicture(const Context& context, const Device& device, const Tracer& tracer,
                                      const Lighting& lighting, const Field* field, const PictureDesc& desc) {
    if (auto ok = validatePictureDesc(desc); !ok) return ok.error();
    auto result = guarded("rendering", [&] {
        const auto start = std::chrono::steady_clock::now();
        const GpuTracer& gpuTracer = onDevice<GpuTracer>(device, tracer, "tracer");
        const GpuLighting lights = uploadedLighting(device, lighting);
        RenderedPicture rendered{emptyPicture(desc.width, desc.height), {}};
        PictureRenderer renderer(device, gpuTracer, lights, field, desc);
        Progress progress(context, "rendering", renderer.bands());
        for (int band = 0; band < renderer.bands(); ++band) {
            renderer.render(band, rendered.picture);
            if (!progress.advance()) throw Failure(ErrorCode::cancelled, "rendering was cancelled");
        }
        rendered.times = renderer.times();
        rendered.times.total =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        return rendered;
    });
    const auto* onGpu = field ? dynamic_cast<const VulkanField*>(&backendOf(*field)) : nullptr;
    if (!result && onGpu) onGpu->passes().forgetRecorded();
    return result;
}

Result<std::vector<std::uint8_t>> toneMapImage(const Device& device, const HdrImage& image, const ToneMap& toneMap) {
    return guarded("mapping tones", [&] {
        const std::span<const glm::vec3> pixels(image.pixels);
        Exchange exchange(device);
        exchange.begin(pixels.size_bytes(), pixels.size() * 4);
        const VkDeviceAddress linear = exchange.add(pixels);
        exchange.run(
            [&](const Recorder& recorder) {
                orThrow(recordToneMap(recorder.commands(), device, linear, exchange.out(), std::uint32_t(image.width),
                                      std::uint32_t(image.height), toneMap));
            },
            pixels.size() * 4);
        const auto bytes = exchange.results<std::uint8_t>();
        return std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + std::ptrdiff_t(4 * pixels.size()));
    });
}

}  // namespace probegi::vulkan
