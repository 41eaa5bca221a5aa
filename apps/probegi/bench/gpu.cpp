#include "bench/gpu.h"

#include <chrono>
#include <optional>

#include "bench/points.h"
#include "camera_rays.h"
#include "render_stats.h"
#include "vulkan_device.h"

namespace probegi::tool {

double GpuBenchRound::sum(const std::function<bool(const std::string&)>& chosen) const {
    double total = 0;
    for (const auto& [name, ms] : passes)
        if (chosen(name)) total += ms;
    return total;
}

double GpuBenchResult::median(const std::function<double(const GpuBenchRound&)>& value) const {
    std::vector<double> values;
    for (const GpuBenchRound& round : rounds) values.push_back(value(round));
    return tool::median(std::move(values));
}

#if PROBEGI_HAS_VULKAN

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWarmUpUpdates = 8;  // so that the field has light of several bounces

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// What all rounds share.
struct GpuBench {
    Context context;
    vulkan::Device device;
    const LoadedSetup& setup;
    int width, height;
    std::unique_ptr<Tracer> tracer;
    Field field;
    std::vector<FieldQuery> points;
    std::vector<glm::vec3> irradiance;

    Result<GpuBenchRound> round();
    GpuBenchResult facts() const;
};

Result<GpuBench> makeGpuBench(const LoadedSetup& setup, const BackendOptions& backend, const BenchPlan& plan) {
    const auto context = makeContext(plan.threads);
    if (!context) return context.error();
    const auto device = openDevice(*context, backend);
    if (!device) return device.error();
    vulkan::GpuSceneDesc scene;
    scene.tracer = backend.tracer;
    auto tracer = vulkan::makeTracer(*context, *device, *setup.scene, setup.pose, scene);
    if (!tracer) return tracer.error();
    FieldDesc desc;
    desc.volumes = setup.volumes;
    desc.raysPerProbe = plan.raysPerProbe;
    auto field = vulkan::makeField(*context, *device, desc, setup.settings);
    if (!field) return field.error();
    auto points = picturePoints(**tracer, primaryRays(setup.camera, plan.width, plan.height));
    if (!points) return points.error();
    const std::size_t count = points->size();
    return GpuBench{*context,
                    *device,
                    setup,
                    plan.width,
                    plan.height,
                    std::move(*tracer),
                    std::move(*field),
                    std::move(*points),
                    std::vector<glm::vec3>(count)};
}

Result<GpuBenchRound> GpuBench::round() {
    GpuBenchRound round;
    auto start = Clock::now();
    const auto updated = field.update(*tracer, setup.lighting);
    if (!updated) return updated.error();
    round.update = millisecondsSince(start);

    start = Clock::now();
    const auto asked = field.irradiance(points, irradiance);
    if (!asked) return asked.error();
    round.query = millisecondsSince(start);
    for (const vulkan::PassTime& pass : vulkan::lastPassTimes(field))
        round.passes.emplace_back(pass.name, pass.milliseconds);

    start = Clock::now();
    const auto drawn = vulkan::renderPicture(context, device, *tracer, setup.lighting, &field,
                                             {setup.camera, width, height, 1, false});
    if (!drawn) return drawn.error();
    round.picture = millisecondsSince(start);
    return round;
}

GpuBenchResult GpuBench::facts() const {
    const vulkan::DeviceInfo& info = device.info();
    GpuBenchResult result;
    result.device = info.name;
    result.driver = info.driver;
    result.api = info.api;
    result.type = info.type;
    result.probes = probeCount(setup);
    result.raysPerProbe = field.desc().raysPerProbe;
    result.width = width;
    result.height = height;
    result.triangles = triangleCount(*setup.scene, setup.pose);
    result.points = points.size();
    result.persistentBytes = field.memory().persistentBytes();
    result.scratchBytes = field.memory().scratchBytes;
    return result;
}

}  // namespace

Result<GpuBenchResult> runGpuBench(const LoadedSetup& setup, const BackendOptions& backend, const BenchPlan& plan,
                                   const BenchProgress& progress) {
    progress("warming up", 0, plan.rounds);
    auto bench = makeGpuBench(setup, backend, plan);
    if (!bench) return bench.error();
    for (int update = 1; update < kWarmUpUpdates; ++update)
        if (const auto done = bench->field.update(*bench->tracer, setup.lighting); !done) return done.error();
    if (const auto done = bench->round(); !done) return done.error();

    GpuBenchResult result = bench->facts();
    const bool rayQuery = backend.tracer != TracerKind::bvh && bench->device.rayQuery();
    result.tracer = rayQuery ? "ray query" : "BVH";
    for (int round = 1; round <= plan.rounds; ++round) {
        progress("passes", round, plan.rounds);
        auto measured = bench->round();
        if (!measured) return measured.error();
        result.rounds.push_back(std::move(*measured));
    }
    return result;
}

#else

Result<GpuBenchResult> runGpuBench(const LoadedSetup&, const BackendOptions&, const BenchPlan&, const BenchProgress&) {
    return builtWithoutVulkan();
}

#endif

}  // namespace probegi::tool
