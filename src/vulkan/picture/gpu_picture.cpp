#include "vulkan/picture/gpu_picture.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "core/progress.h"
#include "geometry/picture_desc.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/field/vulkan_field.h"
#include "vulkan/picture/gpu_contact.h"

namespace probegi::vulkan {

namespace {

// Without neighbours: a band of rows, with all planes.
constexpr std::size_t kSamplesPerBand = std::size_t(1) << 20;
constexpr std::size_t kLayers = 7;  // of every picture; then `glossy`, and `contact` and `openness`

template <class Wanted, class Given>
const Wanted& onDevice(const Device& device, const Given& given, const char* what) {
    const auto* wanted = dynamic_cast<const Wanted*>(&given);
    if (!wanted || &wanted->device().impl() != &device.impl())
        throw Failure(ErrorCode::invalidArgument, std::string("the ") + what +
                                                      " is not on this Vulkan device; make it with the device, or "
                                                      "render with the CPU backend");
    return *wanted;
}

/// The passes of a picture, frame by frame: memory for samples stays bounded.
class PictureRunner {
public:
    PictureRunner(const GpuPicture& picture, std::span<const GpuPass> passes, std::size_t framePixels)
        : m_picture(picture), m_passes(passes), m_exchange(picture.device) {
        const PictureDesc& desc = picture.desc;
        const bool wholeFrames = std::ranges::any_of(passes, &GpuPass::neighbours);
        m_push.planes = wholeFrames ? 1 : planeCount(desc);
        m_bandRows = frameRows(desc, wholeFrames ? framePixels : kSamplesPerBand / std::size_t(m_push.planes));
        m_profiler.emplace(orThrow(Profiler::create(picture.device)));
        m_samples = Buffer(
            picture.device.impl(), "picture samples",
            std::size_t(m_bandRows) * std::size_t(desc.width) * std::size_t(m_push.planes) * sizeof(ScreenSample),
            kAddressed);
        m_push.samples = packAddress(m_samples.address());
        m_push.lighting = packAddress(picture.lighting.impl().address());
        const PlacedCamera& camera = desc.camera;
        m_push.camera =
            kernels::makePinhole(camera.position, camera.forward, camera.up, camera.yfov, desc.width, desc.height);
        m_push.width = desc.width;
        m_push.samplesPerAxis = desc.samplesPerAxis;
        m_push.flags = desc.diffuseOnly ? kernels::kPictureDiffuseOnly : 0;
        if (hasGlossy(desc)) placeGlossy();
        if (desc.contact) {
            m_contact.emplace(picture, m_bandRows, m_push.camera);
            m_push.flags |= kernels::kPictureContact;
        }
    }

    int bands() const { return (m_picture.desc.height + m_bandRows - 1) / m_bandRows; }
    /// Of a band: its planes, or groups of them.
    int frames() const { return planeCount(m_picture.desc) / m_push.planes; }

    void render(int band, int frame, Picture& layers) {
        m_push.firstRow = band * m_bandRows;
        m_push.rows = std::min(m_bandRows, m_picture.desc.height - m_push.firstRow);
        m_push.firstPlane = frame * m_push.planes;
        const std::size_t pixels = std::size_t(m_push.rows) * std::size_t(m_push.width);
        m_push.sampleCount = std::uint32_t(pixels) * std::uint32_t(m_push.planes);
        const std::size_t bytes = layerCount() * pixels * sizeof(glm::vec3);
        if (frame == 0) {
            m_exchange.begin(m_contact ? sizeof(kernels::ContactBlock) : 0, bytes);
            if (m_contact) m_push.contact = packAddress(m_exchange.add(std::span(&m_contact->block(), 1)));
        }
        m_push.layers = packAddress(m_exchange.out());
        const bool last = frame + 1 == frames();
        m_exchange.run([&](const Recorder& recorder) { record(recorder); }, last ? bytes : 0);
        if (last) store(layers, pixels);
        addTimes();
    }

    /// After all bands.
    void finish() {
        if (m_contact) m_contact->remember();
    }

    const PictureTimes& times() const noexcept { return m_times; }

private:
    void placeGlossy() {
        const std::size_t blocks = glossyBlocks(m_push.width, m_bandRows);
        const std::size_t bytes = blocks * (sizeof(ScreenSample) + sizeof(kernels::GlossySample)) +
                                  std::size_t(m_bandRows) * std::size_t(m_push.width) * sizeof(glm::vec3);
        m_glossy = Buffer(m_picture.device.impl(), "glossy samples", bytes, kAddressed);
        m_push.glossy = packAddress(m_glossy.address());
        m_push.flags |= kernels::kPictureGlossy;
        if (m_picture.desc.glossy == Glossy::field) m_push.flags |= kernels::kPictureSecondGlossy;
    }
    std::size_t layerCount() const { return kLayers + (m_glossy ? 1 : 0) + (m_contact ? 2 : 0); }

    void record(const Recorder& recorder) {
        m_profiler->recordReset(recorder.commands());
        if (m_picture.volume) m_picture.volume->recordSettings(recorder, m_picture.field->control().settings());
        const SceneObjects objects{m_picture.scene, m_picture.volume};
        bindPasses(recorder, objects, m_push);
        for (const GpuPass& pass : m_passes) recordPass(recorder, objects, pass, m_push, &*m_profiler);
    }

    void addTimes() {
        for (const PassTime& measured : orThrow(m_profiler->read()))
            for (const GpuPass& pass : m_passes)
                if (pass.time && measured.name == pass.name) {
                    m_times.*pass.time += measured.milliseconds;
                    break;
                }
    }

    void store(Picture& picture, std::size_t pixels) const {
        std::vector<HdrImage*> layers{&picture.color,  &picture.direct, &picture.indirect, &picture.irradiance,
                                      &picture.albedo, &picture.normal, &picture.depth};
        if (m_glossy) layers.push_back(&picture.glossy);
        if (m_contact) layers.insert(layers.end(), {&picture.contact, &picture.openness});
        const auto results = m_exchange.results<glm::vec3>();
        const std::ptrdiff_t first = std::ptrdiff_t(m_push.firstRow) * m_push.width;
        for (std::size_t layer = 0; layer < layerCount(); ++layer)
            std::copy_n(results.begin() + std::ptrdiff_t(layer * pixels), pixels,
                        layers[layer]->pixels.begin() + first);
    }

    GpuPicture m_picture;
    std::span<const GpuPass> m_passes;
    Exchange m_exchange;
    std::optional<Profiler> m_profiler;
    int m_bandRows = 1;
    Buffer m_samples, m_glossy;
    std::optional<GpuContact> m_contact;
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

RenderedPicture runPicture(const Context& context, const GpuPicture& picture, std::span<const GpuPass> passes,
                           std::size_t framePixels) {
    RenderedPicture rendered{emptyPicture(picture.desc.width, picture.desc.height), {}};
    if (hasGlossy(picture.desc)) rendered.picture.glossy = HdrImage(picture.desc.width, picture.desc.height);
    if (picture.desc.contact)
        rendered.picture.contact = rendered.picture.openness = HdrImage(picture.desc.width, picture.desc.height);
    PictureRunner runner(picture, passes, framePixels);
    Progress progress(context, "rendering", double(runner.bands()) * runner.frames());
    for (int band = 0; band < runner.bands(); ++band)
        for (int frame = 0; frame < runner.frames(); ++frame) {
            runner.render(band, frame, rendered.picture);
            if (!progress.advance()) throw Failure(ErrorCode::cancelled, "rendering was cancelled");
        }
    runner.finish();
    rendered.times = runner.times();
    return rendered;
}

Result<RenderedPicture> renderPicture(const Context& context, const Device& device, const Tracer& tracer,
                                      const Lighting& lighting, const Field* field, const PictureDesc& desc) {
    if (auto ok = validatePictureDesc(desc); !ok) return ok.error();
    auto result = guarded("rendering", [&] {
        const auto start = std::chrono::steady_clock::now();
        const GpuTracer& gpuTracer = onDevice<GpuTracer>(device, tracer, "tracer");
        const GpuLighting lights = uploadedLighting(device, lighting);
        FieldPasses* volume = field ? &onDevice<VulkanField>(device, backendOf(*field), "field").passes() : nullptr;
        RenderedPicture rendered =
            runPicture(context, {device, gpuTracer.scene(), lights, field, volume, desc, tracer.bounds()},
                       gpuPasses({gpuTracer.scene(), volume}, desc));
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
