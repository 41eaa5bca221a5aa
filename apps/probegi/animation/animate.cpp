#include "animation/animate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>

#include "animation/moving_scene.h"
#include "animation/picture_sink.h"
#include "console/output.h"
#include "console/terminal.h"

namespace probegi::tool {

namespace {

using Clock = std::chrono::steady_clock;

// The exposure of all pictures is that of a few small ones, spread over the whole time.
constexpr int kExposureMoments = 5;
constexpr int kExposureWidth = 160;
constexpr int kExposureUpdates = 16;  // before each, so that the light has followed
constexpr int kExposureSamples = 16;

// Moments at which it is checked that the scene is inside the grid.
constexpr int kGridMoments = 16;

// Updates before the first picture. Not converge(): the updates after it begin a new average, noisy at first, and the
// second picture would show that.
constexpr int kFillUpdates = 100;

// Guesses for the progress bar, in updates.
constexpr double kPictureCost = 6;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct FrameStats {
    double seconds = 0;
    MoveTimes move{};
    double pictureMs = 0, writeMs = 0;
};

/// What all pictures of one animation share.
struct Animation {
    const RenderOptions& options;
    const Context& context;
    const Backend& backend;
    FrameTimes times;
    MovingScene& scene;
    PictureSink& sink;
    WholeBar& bar;
    std::unique_ptr<PictureRenderer> renderer;
    ContactHistory history{};  ///< --contact: from picture to picture

    int updatesPerFrame() const { return options.updatesPerFrame.value_or(kDefaultUpdatesPerFrame); }
};

// `history`: null for a picture by itself.
Result<Picture> draw(Animation& animation, const RenderOptions& options, ContactHistory* history) {
    const Field* field = animation.scene.field();
    const Tracer& tracer = animation.scene.tracer();
    const LoadedSetup& setup = animation.scene.setup();
    if (options.method == Method::reference) {
        auto drawn = renderReference(animation.context, tracer, setup, options, field);
        if (!drawn) return drawn.error();
        return std::move(drawn->picture);
    }
    PictureDesc desc = pictureDesc(options, setup);
    desc.contactHistory = history;
    auto drawn = animation.renderer->render(tracer, setup.lighting, field, desc);
    if (!drawn) return drawn.error();
    return std::move(drawn->picture);
}

RenderOptions smallPictures(RenderOptions options) {
    const PictureDesc desc = pictureDesc(options, {});
    const int width = std::min(desc.width, kExposureWidth);
    options.size = fmt::format("{}x{}", width, std::max(1, desc.height * width / desc.width));
    options.antialias = 1;
    if (options.method != Method::reference) return options;
    options.samplesPerPixel = std::min(options.samplesPerPixel.value_or(kExposureSamples), kExposureSamples);
    options.seconds.reset();
    return options;
}

// An exposure for the light of some moments together. The field is then as it was, to the bit.
Result<float> sharedExposure(Animation& animation) {
    const RenderOptions small = smallPictures(animation.options);
    Field* field = animation.scene.field();
    std::optional<FieldSnapshot> before;
    if (field) {
        auto read = field->read();
        if (!read) return read.error();
        before = std::move(*read);
    }
    std::set<int> moments;
    for (int i = 0; i < kExposureMoments; ++i)
        moments.insert((animation.times.count() - 1) * i / (kExposureMoments - 1));
    HdrImage all;
    double done = 0;
    for (const int moment : moments) {
        animation.bar.done(done++ / double(moments.size()));
        if (moment > 0)
            if (const auto moved = animation.scene.moveTo(animation.times.at(moment), kExposureUpdates); !moved)
                return moved.error();
        const auto picture = draw(animation, small, nullptr);
        if (!picture) return picture.error();
        all.width = picture->color.width;
        all.height += picture->color.height;
        all.pixels.insert(all.pixels.end(), picture->color.pixels.begin(), picture->color.pixels.end());
    }
    if (const auto back = animation.scene.moveTo(animation.times.at(0), 0); !back) return back.error();
    if (const auto settled = animation.scene.settleMasks(); !settled) return settled.error();
    animation.scene.watchFromHere();
    if (before)
        if (auto written = field->write(*before); !written) return written.error();
    return autoExposure(all);
}

Result<FrameStats> drawFrame(Animation& animation, int frame, const ToneMap& toneMap) {
    FrameStats stats{animation.times.at(frame)};
    if (frame > 0) {
        const auto moved = animation.scene.moveTo(stats.seconds, animation.updatesPerFrame());
        if (!moved) return moved.error();
        stats.move = *moved;
    }
    RenderOptions options = animation.options;
    options.seed += std::uint64_t(frame);  // of the reference's noise
    const auto start = Clock::now();
    const auto picture = draw(animation, options, &animation.history);
    if (!picture) return picture.error();
    stats.pictureMs = millisecondsSince(start);
    const auto drawn = Clock::now();
    if (auto added = animation.sink.add(*picture, toneMap); !added) return added.error();
    stats.writeMs = millisecondsSince(drawn);
    return stats;
}

// JSON with the keys of statsJson() that make sense here, and a list of the pictures.
std::string animationJson(const Animation& animation, const FieldRun& fill, double fillMs, const ToneMap& toneMap,
                          const std::vector<FrameStats>& frames) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameStats& f = frames[i];
        list.push_back({{"file", animation.sink.fileOf(int(i))},
                        {"seconds", f.seconds},
                        {"poseMs", f.move.pose},
                        {"editsMs", f.move.edits},
                        {"edits", f.move.editsFound},
                        {"masksMs", f.move.masks},
                        {"maskCells", f.move.maskCells},
                        {"masksSettled", f.move.masksSettled},
                        {"updatedProbes", mean(f.move.updated)},
                        {"updateMs", f.move.update},
                        {"pictureMs", f.pictureMs},
                        {"writeMs", f.writeMs}});
    }
    const Field* field = animation.scene.field();
    const nlohmann::ordered_json json{{"probes", field ? probeCount(field->desc()) : 0},
                                      {"raysPerProbe", field ? field->desc().raysPerProbe : 0},
                                      {"fillUpdates", fill.updates.size()},
                                      {"fillMs", fillMs},
                                      {"fillUpdatedProbes", mean(fill.updated)},
                                      {"updatesPerFrame", field ? animation.updatesPerFrame() : 0},
                                      {"exposure", toneMap.exposure},
                                      {"frames", list},
                                      {"peakMemoryBytes", peakMemoryBytes()}};
    return jsonText(json);
}

void planBar(const Animation& animation) {
    const bool chooses = animation.sink.isShown() && animation.scene.setup().automaticExposure;
    std::vector<double> guesses{double(*animation.options.run.frames),
                                chooses ? kExposureMoments * (kExposureUpdates + 1.0) : 0.0};
    guesses.insert(guesses.end(), std::size_t(animation.times.count()), animation.updatesPerFrame() + kPictureCost);
    animation.bar.plan(std::move(guesses));
}

void warnWhereNothingMoves(const Scene& scene, const FrameTimes& times) {
    if (scene.animations.empty())
        return printWarning("nothing in the scene is animated: all pictures show the same moment");
    float first = scene.animations.front().times.front(), last = scene.animations.front().times.back();
    for (const AnimationChannel& channel : scene.animations) {
        first = std::min(first, channel.times.front());
        last = std::max(last, channel.times.back());
    }
    if (times.count() > 1 && (times.from >= double(last) || times.to <= double(first)))
        printWarning(
            fmt::format("the scene's animations are from second {:.4g} to {:.4g}: nothing moves in the "
                        "pictures",
                        first, last));
}

void warnWhereNoPrimitiveMoves(const LoadedSetup& setup) {
    if (!setup.sdf || setup.sdf->primitives.empty() || movingBounds(*setup.scene, setup.pose).empty()) return;
    for (const SdfPrimitive& primitive : setup.sdf->primitives)
        if (!primitive.node.empty()) return;
    printWarning("no primitive of --sdf has a \"node\": for the probes, all that moves stays where it was fitted");
}

// The grid was laid over the scene as it is at first.
void warnWhereItLeavesTheGrid(const LoadedSetup& setup, const FrameTimes& times) {
    if (!gridWarnings(setup, setup.pose.bounds).empty()) return;  // told already
    for (int i = 1; i <= kGridMoments && !setup.scene->animations.empty(); ++i) {
        const double seconds = times.at((times.count() - 1) * i / kGridMoments);
        const ScenePose pose = poseAt(*setup.scene, float(seconds));
        const auto sentences = gridWarnings(setup, pose.bounds);
        if (sentences.empty()) continue;
        return printWarning(fmt::format("at second {:.4g} {}", seconds, sentences.front()));
    }
}

Result<void> run(Animation& animation) {
    const RenderOptions& options = animation.options;
    planBar(animation);
    animation.bar.begin("filling probes");
    const auto start = Clock::now();
    const auto fill = animation.scene.fill();
    if (!fill) return fill.error();
    const double fillMs = millisecondsSince(start);
    animation.bar.begin("choosing exposure");
    const LoadedSetup& setup = animation.scene.setup();
    ToneMap toneMap{setup.exposure, options.filmic};
    const bool chooses = setup.automaticExposure && animation.sink.isShown();
    if (chooses) {
        const auto exposure = sharedExposure(animation);
        if (!exposure) return exposure.error();
        toneMap.exposure = *exposure;
    }
    std::vector<FrameStats> frames;
    const int count = animation.times.count();
    for (int frame = 0; frame < count; ++frame) {
        animation.bar.begin(fmt::format("picture {} of {}", frame + 1, count));
        const auto drawn = drawFrame(animation, frame, toneMap);
        if (!drawn) return drawn.error();
        frames.push_back(*drawn);
    }
    if (auto finished = animation.sink.finish(); !finished) return finished;
    animation.bar.clear();
    if (!options.stats.empty())
        if (auto written = writeText(options.stats, animationJson(animation, *fill, fillMs, toneMap, frames)); !written)
            return written;
    std::error_code none;
    if (chooses && !std::filesystem::equivalent(options.stats, "/dev/stdout", none))
        fmt::print(
            "exposure {:.4g}, chosen automatically for all pictures; for the same in others: --exposure {:.4g}\n",
            toneMap.exposure, toneMap.exposure);
    return {};
}

}  // namespace

Result<void> renderAnimation(const RenderOptions& given) {
    RenderOptions options = given;
    const auto times = parseFrameTimes(options.animate);
    if (!times) return times.error();
    options.scene.timeOfScene = float(times->from);
    options.run.frames = options.run.frames.value_or(kFillUpdates);
    auto sink = PictureSink::create(options, *times);
    if (!sink) return sink.error();
    WholeBar bar;
    const auto context = makeContext(options.scene.threads, bar);
    if (!context) return context.error();
    options.run.progress = [&bar](double share) { bar.done(share); };
    const auto backend = openBackend(*context, options.backend);
    if (!backend) return backend.error();
    auto setup = loadSetup(options.scene);
    if (!setup) return setup.error();
    if (auto apart = sink->keepApartFrom(setup->files); !apart) return apart;
    warnWhereNothingMoves(*setup->scene, *times);
    if (hasProbes(options)) warnWhereItLeavesTheGrid(*setup, *times);
    if (hasProbes(options)) warnWhereNoPrimitiveMoves(*setup);
    auto scene = MovingScene::open(*context, **backend, *setup, options);
    if (!scene) return scene.error();
    auto renderer = (*backend)->makeRenderer();
    if (!renderer) return renderer.error();
    Animation animation{options, *context, **backend, *times, *scene, *sink, bar, std::move(*renderer)};
    return run(animation);
}

}  // namespace probegi::tool
