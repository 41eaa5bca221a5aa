// An engine with its own Vulkan device integrates ProbeGI: two probe volumes are updated in the engine's command
// buffer, one submission per frame and two frames in flight, and its shading pass queries one of them. Writes
// vulkan_engine.png (without the probes, with them) and checks that both volumes agree: one traces triangles with the
// library, the other blends the results of the engine's own rays. Usage: vulkan_engine [FRAMES [HEIGHT]]
#include <array>
#include <cstdio>
#include <cstdlib>

#include "answers.h"
#include "engine_device.h"
#include "frame_ring.h"
#include "global_illumination.h"
#include "renderer.h"

using namespace probegi;

namespace {

constexpr Access kAnything{vk::PipelineStageFlagBits2::eAllCommands,
                           vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite};

struct Options {
    int frames = 48;
    std::uint32_t height = 640;  // of the G-buffer, twice that of the picture
    std::uint32_t width() const { return height * 23 / 10; }
};

// The mean of each 2 x 2 pixels.
[[maybe_unused]] HdrImage halved(const HdrImage& image) {
    HdrImage half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            half.at(x, y) = 0.25f * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) + image.at(2 * x, 2 * y + 1) +
                                     image.at(2 * x + 1, 2 * y + 1));
    return half;
}

void playFilm(const Options& options, FrameRing& ring, GlobalIllumination& gi, const Renderer& renderer,
              const GpuBuffer& frameData) {
    for (int i = 0; i < options.frames; ++i) {
        const FrameData now = frameAt(float(i) / float(options.frames), float(options.width()) / float(options.height));
        FrameRing::Frame& frame = ring.begin();
        const vk::raii::CommandBuffer& commands = frame.commands;
        order(commands, kAnything, kTransferWrite);
        commands.updateBuffer<FrameData>(*frameData.buffer, 0, now);
        order(commands, kTransferWrite, kAnything);
        gi.record(commands, now, frameData.address, frame.profiler);
        frame.profiler.recordBegin(*commands, "G-buffer");
        renderer.recordGBuffer(commands, frameData.address);
        frame.profiler.recordEnd(*commands);
        frame.profiler.recordBegin(*commands, "shading");
        renderer.recordShading(commands, frameData.address);
        frame.profiler.recordEnd(*commands);
        if (i + 1 == options.frames) renderer.recordReadBack(commands);
        ring.submit();
    }
    ring.wait();
}

bool run(const Options& options) {
    const EngineDevice engine;
    MemoryPool pool(engine.physical(), engine.device());
    bool right = false;
    {
        const Context context = Context::create().value();
        const FrameData start = frameAt(0, 1);
        GlobalIllumination gi(context, engine, pool, start);
        Renderer renderer(engine, pool, {options.width(), options.height});
        renderer.useProbes(gi.volume());
        const GpuBuffer frameData(engine.device(), pool, sizeof(FrameData));
        FrameRing ring(engine, gi.device());
        std::printf("%s, %s\n", gi.device().info().name.c_str(),
                    gi.device().rayQuery() ? "ray query" : "no ray query: the library's BVH");

        gi.recordUpload(ring.begin().commands);
        ring.submit();
        ring.wait();
        gi.releaseStaging();
        gi.printMemory();

        playFilm(options, ring, gi, renderer, frameData);
        ring.printTimes();
#ifdef PROBEGI_HAS_IO
        writeImage("vulkan_engine.png", halved(renderer.picture()), {.exposure = 1.6f, .filmic = true}).value();
#endif
        right = answersAreRight(engine, pool, ring, gi, start);
        std::printf("pool: %d allocations, %zu bytes used of %zu\n", pool.allocations(), pool.bytesUsed(),
                    pool.bytesOfBlocks());
    }
    std::printf("afterwards: %d allocations, %d validation messages\n", pool.allocations(),
                engine.validationMessages());
    return right && pool.allocations() == 0 && engine.validationMessages() == 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (argc > 1) options.frames = std::atoi(argv[1]);
    if (argc > 2) options.height = std::uint32_t(std::atoi(argv[2]));
    try {
        return run(options) ? 0 : 1;
    } catch (const BadResult& failure) {  // from .value(): ProbeGI itself throws nothing
        std::fprintf(stderr, "vulkan_engine: %s\n", failure.error().message.c_str());
    } catch (const std::exception& failure) {  // the engine's own
        std::fprintf(stderr, "vulkan_engine: %s\n", failure.what());
    }
    return 1;
}
