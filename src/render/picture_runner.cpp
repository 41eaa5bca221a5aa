#include "render/picture_runner.h"

#include <atomic>
#include <chrono>

#include "core/parallel.h"
#include "core/progress.h"
#include "geometry/picture_desc.h"

namespace probegi {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPartWidth = 64;
constexpr int kPartSamples = 2048;  // what stays in a core's second-level cache from pass to pass

// What a thread works on at a time.
std::vector<PixelRect> partsOf(const PixelRect& rect, int planes) {
    const int height = std::max(1, kPartSamples / (kPartWidth * planes));
    std::vector<PixelRect> parts;
    for (int y = 0; y < rect.height; y += height)
        for (int x = 0; x < rect.width; x += kPartWidth)
            parts.push_back(
                {rect.x + x, rect.y + y, std::min(kPartWidth, rect.width - x), std::min(height, rect.height - y)});
    return parts;
}

/// One picture's way through the passes.
class PictureRunner {
public:
    PictureRunner(const Context& context, PictureTask& task, std::span<const FramePass> passes)
        : m_context(context),
          m_task(task),
          m_passes(passes),
          m_planes(planeCount(task.desc)),
          m_progress(context, "rendering",
                     double(task.desc.width) * task.desc.height * m_planes * double(passes.size())),
          m_passNs(passes.size()) {}

    /// Each part of the picture is a frame of its own, with all planes.
    Result<void> runPartByPart();
    /// The whole picture or band after band, plane after plane, a frame each.
    Result<void> runFrames(std::size_t framePixels);

    /// Time of each pass, mean over threads.
    PictureTimes times() const;

private:
    // Numbers of passes.
    struct Stage {
        std::size_t begin, end;
    };

    std::vector<Stage> stages() const;
    Result<void> runFrame(Frame& frame);
    template <class Work>
    Result<void> forEachPart(const PixelRect& rect, int planes, const Work& work);
    Result<void> runStage(const Stage& stage, const PixelRect& part, Frame& frame);

    const Context& m_context;
    PictureTask& m_task;
    std::span<const FramePass> m_passes;
    int m_planes;
    Progress m_progress;
    std::vector<std::atomic<std::int64_t>> m_passNs;
};

// Of passes that run one after the other for each part by itself, so that its samples stay in the cache. A pass with
// neighbours waits for all parts, and all parts wait for it.
std::vector<PictureRunner::Stage> PictureRunner::stages() const {
    std::vector<Stage> result;
    for (std::size_t pass = 0; pass < m_passes.size(); ++pass) {
        const bool apart = pass == 0 || m_passes[pass].neighbours || m_passes[pass - 1].neighbours;
        if (apart) result.push_back({pass, pass});
        result.back().end = pass + 1;
    }
    return result;
}

Result<void> PictureRunner::runPartByPart() {
    const PixelRect all{0, 0, m_task.desc.width, m_task.desc.height};
    return forEachPart(all, m_planes, [&](const PixelRect& part) {
        thread_local Frame frame;
        frame.place(part, 0, m_planes);
        return runStage({0, m_passes.size()}, part, frame);
    });
}

Result<void> PictureRunner::runFrames(std::size_t framePixels) {
    const auto [width, height] = std::pair(m_task.desc.width, m_task.desc.height);
    const int rows = frameRows(m_task.desc, framePixels);
    Frame frame;
    GlossyFrame glossy;
    ContactFrame contact;
    if (hasGlossy(m_task.desc)) frame.glossy = &glossy;
    if (m_task.desc.contact) frame.contact = &contact;
    for (int y = 0; y < height; y += rows)
        for (int plane = 0; plane < m_planes; ++plane) {
            frame.place({0, y, width, std::min(rows, height - y)}, plane, 1);
            if (frame.glossy) glossy.place(frame.rect());
            if (frame.contact) contact.place(frame.rect(), keepsContact(m_task.desc));
            if (auto done = runFrame(frame); !done) return done;
        }
    return {};
}

Result<void> PictureRunner::runFrame(Frame& frame) {
    for (const Stage& stage : stages()) {
        const auto work = [&](const PixelRect& part) { return runStage(stage, part, frame); };
        if (auto done = forEachPart(frame.rect(), 1, work); !done) return done;
    }
    return {};
}

template <class Work>
Result<void> PictureRunner::forEachPart(const PixelRect& rect, int planes, const Work& work) {
    const std::vector<PixelRect> parts = partsOf(rect, planes);
    const auto range = [&](std::size_t begin, std::size_t end) -> Result<void> {
        for (std::size_t i = begin; i < end && !m_progress.cancelled(); ++i)
            if (auto done = work(parts[i]); !done) return done;
        return {};
    };
    if (auto done = tryParallelFor(m_context, parts.size(), 1, range); !done) return done;
    if (m_progress.cancelled()) return fail(ErrorCode::cancelled, "rendering was cancelled");
    return {};
}

Result<void> PictureRunner::runStage(const Stage& stage, const PixelRect& part, Frame& frame) {
    auto start = Clock::now();
    for (std::size_t pass = stage.begin; pass < stage.end; ++pass) {
        if (auto done = m_passes[pass].run(m_task, part, frame); !done) return done;
        const auto now = Clock::now();
        m_passNs[pass] += std::chrono::duration_cast<std::chrono::nanoseconds>(now - start).count();
        start = now;
    }
    const int planes = frame.endPlane() - frame.firstPlane();
    m_progress.advance(double(part.pixels()) * planes * double(stage.end - stage.begin));
    return {};
}

PictureTimes PictureRunner::times() const {
    PictureTimes times;
    for (std::size_t pass = 0; pass < m_passes.size(); ++pass)
        if (m_passes[pass].time) times.*m_passes[pass].time += double(m_passNs[pass]) * 1e-6 / m_context.threads();
    return times;
}

}  // namespace

Result<RenderedPicture> runPicture(const Context& context, const PictureInputs& inputs,
                                   std::span<const FramePass> passes, std::size_t framePixels) {
    const auto start = Clock::now();
    PictureTask task(inputs);
    PictureRunner runner(context, task, passes);
    const bool wholeFrames = std::ranges::any_of(passes, &FramePass::neighbours);
    if (auto done = wholeFrames ? runner.runFrames(framePixels) : runner.runPartByPart(); !done) return done.error();
    task.remember();
    PictureTimes times = runner.times();
    times.total = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return RenderedPicture{std::move(task.layers), times};
}

}  // namespace probegi
