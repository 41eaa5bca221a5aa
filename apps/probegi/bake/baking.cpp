#include "bake/baking.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bake/primitives_hash.h"
#include "saved_field.h"

namespace probegi::tool {

namespace fs = std::filesystem;

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::string partFileOf(const std::string& output) {
    std::error_code none;
    const fs::file_status status = fs::status(output, none);
    return !fs::exists(status) || fs::is_regular_file(status) ? output + ".part" : std::string();
}

std::string recipeOf(const BakeOptions& options, const LoadedSetup& setup) {
    const RenderOptions& r = options.render;
    std::string recipe =
        fmt::format("{}, {} rays, seed {}", r.rules == FieldRules::paper ? "paper" : "measured", r.rays, r.seed);
    if (r.relocation) recipe += ", relocation";
    if (r.probeStates) recipe += ", probe states";
    if (setup.sdf) recipe += fmt::format(", primitives of '{}' ({:016x})", r.scene.sdf, hashOf(*setup.sdf));
    recipe += r.run.frames ? fmt::format(", {} updates", *r.run.frames)
                           : fmt::format(", converged to {:g} within {} updates",
                                         r.run.tolerance.value_or(kConvergeTolerance), kConvergeMaxUpdates);
    recipe += r.backend.kind == BackendKind::vulkan ? ", on vulkan" : ", on cpu";
    if (!r.masks.bakes()) return recipe;
    const MaskDesc masks = maskDesc(r.masks, r.seed);
    return recipe + fmt::format("; masks: {} clusters, factor {}{}", masks.clusters, masks.factor,
                                masks.strict ? ", strict" : "");
}

Result<BakeReport> Baking::run() {
    return begin()
        .and_then([&] { return bakeMasksOnce(); })
        .and_then([&] { return light(); })
        .and_then([&] { return finish(); })
        .transform([&] { return m_report; });
}

Result<void> Baking::begin() {
    const auto fingerprint = fingerprintOf(*m_setup.scene, m_setup.pose, m_setup.lighting);
    if (!fingerprint) return fingerprint.error();
    m_provenance = {"probegi " PROBEGI_VERSION, m_options.render.scene.scene, recipeOf(m_options, m_setup),
                    *fingerprint};
    auto field = makeEmptyField(m_backend, m_setup, m_options.render, m_setup.pose);
    if (!field) return field.error();
    m_field = std::move(*field);
    m_lastCheckpoint = Clock::now();
    if (!m_options.resume) {
        std::error_code none;
        if (!fs::exists(m_partFile, none)) return {};
        if (!isFieldFile(m_partFile))
            return fail(ErrorCode::invalidArgument,
                        fmt::format("'{}' is no field, and a bake would replace it; move it away, or choose another -o",
                                    m_partFile));
        printWarning(
            fmt::format("'{}' of a bake that did not end is replaced; --resume would go on from it", m_partFile));
        return {};
    }
    auto taken = takeUp();
    if (!taken) return taken.error();
    if (*taken) return {};
    return fail(
        ErrorCode::invalidArgument,
        fmt::format("'{}' is of another bake: another scene, other light or other options; give those, or leave "
                    "--resume out",
                    m_partFile));
}

// False: it is of another bake.
Result<bool> Baking::takeUp() {
    if (m_partFile.empty())
        return fail(ErrorCode::invalidArgument, "--resume goes on from a file beside -o; a device has none");
    auto saved = loadField(m_partFile, m_options.render.scene.limits);
    if (!saved) return fail(saved.error().code, fmt::format("--resume {}", saved.error().message));
    if (saved->provenance.recipe != m_provenance.recipe || saved->provenance.fingerprint != m_provenance.fingerprint ||
        !sameSettings(saved->snapshot.desc, saved->settings, m_field->desc(), m_field->control().settings()))
        return false;
    if (auto set = m_field->control().setSettings(saved->settings); !set) return set.error();
    if (auto written = m_field->write(saved->snapshot); !written) return written.error();
    m_convergence = std::move(saved->convergence);
    m_report.updatesBefore = std::max(m_field->control().frame() - placingUpdates(), 0);
    return true;
}

// That which placed the probes before the masks were baked is not one of the light's.
int Baking::placingUpdates() const {
    return m_options.render.masks.bakes() && m_options.render.relocation ? 1 : 0;
}

Result<void> Baking::bakeMasksOnce() {
    const auto start = Clock::now();
    const bool there = m_field->control().settings().masks != nullptr;
    if (m_options.render.masks.bakes() && !there) {
        if (auto baked = bakeMasksFor(*m_field, m_context, m_tracer, m_setup, m_options.render.masks); !baked)
            return baked;
        m_report.maskSeconds = secondsSince(start);
        checkpoint();
    }
    if (const auto& masks = m_field->control().settings().masks) m_report.masks = masks->report();
    return {};
}

Result<void> Baking::light() {
    const auto start = Clock::now();
    auto done = m_options.render.run.frames ? updates() : converge();
    m_report.lightSeconds = secondsSince(start);
    m_report.updates = int(m_report.run.updates.size());
    return done;
}

Result<void> Baking::updates() {
    const int frames = *m_options.render.run.frames;
    LoopProgress progress("updating probes", frames);
    for (;;) {
        const int done = m_field->control().frame() - placingUpdates();
        progress.done(done);
        if (done >= frames) return {};
        const auto times = m_field->update(m_probes, m_setup.lighting);
        if (!times) return times.error();
        m_report.run.updates.push_back(*times);
        checkpointNowAndThen();
    }
}

Result<void> Baking::converge() {
    const auto after = [&](const UpdateTimes& times) {
        m_report.run.updates.push_back(times);
        checkpointNowAndThen();
    };
    const float tolerance = m_options.render.run.tolerance.value_or(kConvergeTolerance);
    const auto done =
        m_field->converge(m_probes, m_setup.lighting, m_convergence, tolerance, kConvergeMaxUpdates, after);
    if (!done) return done.error();
    m_report.run.convergence = *done;
    warnUnlessConverged(m_report.run, m_options.render.run);
    return {};
}

void Baking::checkpointNowAndThen() {
    if (secondsSince(m_lastCheckpoint) >= m_options.checkpointSeconds) checkpoint();
}

// A bake that cannot be taken up is worth more than none.
void Baking::checkpoint() {
    if (m_partFile.empty()) return;
    const auto saved = m_field->read().and_then([&](FieldSnapshot snapshot) {
        return saveField(m_partFile, {std::move(snapshot), m_field->control().settings(), m_provenance, m_convergence});
    });
    m_lastCheckpoint = Clock::now();
    if (saved || m_warned) return;
    m_warned = true;
    printWarning(fmt::format("{}; the bake goes on, but cannot be taken up from here", saved.error().message));
}

Result<void> Baking::finish() {
    const auto start = Clock::now();
    if (auto saved = saveField(m_options.render.output, *m_field, m_provenance); !saved) return saved;
    std::error_code none;
    if (fs::is_regular_file(m_partFile, none)) fs::remove(m_partFile, none);
    m_report.fileSeconds = secondsSince(start);
    m_report.fileBytes =
        fs::is_regular_file(m_options.render.output, none) ? fs::file_size(m_options.render.output, none) : 0;
    m_report.memory = m_field->memory();
    return {};
}

}  // namespace probegi::tool
