#include "flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace probegi::accuracy {

namespace {

/// The value; throws the error's message, which measureFlight() catches.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Collects the changes from frame to frame.
class Changes {
public:
    void add(std::vector<double> light) {
        for (std::size_t i = 0; i < m_last.size(); ++i) m_all.push_back(std::abs(light[i] - m_last[i]));
        for (const double e : light) m_sum += e;
        m_count += double(light.size());
        m_last = std::move(light);
    }
    Change over() {
        if (m_all.empty() || !(m_sum > 0)) return {};
        std::sort(m_all.begin(), m_all.end());
        const double mean = m_sum / m_count;
        return {m_all.back() / mean, m_all[std::size_t(0.999 * double(m_all.size() - 1))] / mean};
    }

private:
    std::vector<double> m_last, m_all;
    double m_sum = 0, m_count = 0;
};

/// The middle of the scene's longest horizontal side, the flight's half before it, at a man's height.
glm::vec3 startOf(const Bounds& bounds, const FlightDesc& desc, glm::vec3& way) {
    way = bounds.size().x >= bounds.size().z ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    glm::vec3 middle = bounds.centre();
    middle.y = bounds.lower.y + std::min(1.7f, 0.5f * bounds.size().y);
    return middle - way * (0.5f * float(desc.frames) * desc.metresPerFrame);
}

int leapsTo(Field& field, glm::vec3 camera) {
    std::vector<VolumeDesc> before;
    for (int i = 0; i < int(field.desc().volumes.size()); ++i) before.push_back(field.control().place(i));
    must(field.followCamera(camera));
    int leaps = 0;
    for (int i = 0; i < int(before.size()); ++i) leaps += field.control().place(i) == before[std::size_t(i)] ? 0 : 1;
    return leaps;
}

std::vector<double> withoutCamera(Field& field, const std::vector<FieldQuery>& points) {
    const FieldSettings settings = field.control().settings();
    FieldSettings unaware = settings;
    unaware.camera.reset();
    must(field.control().setSettings(unaware));
    std::vector<double> light = must(lightAt(field, points));
    must(field.control().setSettings(settings));
    return light;
}

}  // namespace

Result<FlightResult> measureFlight(const Context& context, const std::string& name, const Scene& scene,
                                   const FlightDesc& desc) try {
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = must(makeEmbreeTracer(context, scene, pose));
    glm::vec3 way;
    const glm::vec3 start = startOf(pose.bounds, desc, way);
    CascadeDesc cascades = desc.cascades;
    cascades.centre = start;
    FieldDesc fieldDesc;
    fieldDesc.volumes = must(makeCascades(cascades));
    fieldDesc.raysPerProbe = desc.rays;
    Field field = must(Field::create(context, fieldDesc));
    must(field.followCamera(start));
    const std::vector<FieldQuery> points = must(visiblePoints(*tracer, pose.bounds, desc.points));

    FlightResult result{name, probeCount(fieldDesc), cascades.levels};
    Changes still, aware, unaware;
    for (int update = 0; update < desc.settle; ++update) {
        must(field.update(*tracer, lighting));
        if (2 * update >= desc.settle) still.add(must(lightAt(field, points)));
    }
    for (int frame = 0; frame < desc.frames; ++frame) {
        result.leaps += leapsTo(field, start + way * (float(frame) * desc.metresPerFrame));
        must(field.update(*tracer, lighting));
        aware.add(must(lightAt(field, points)));
        unaware.add(withoutCamera(field, points));
    }
    result.still = still.over();
    result.aware = aware.over();
    result.unaware = unaware.over();
    return result;
} catch (const std::runtime_error& error) {
    return fail(ErrorCode::outOfMemory, error.what());
}

std::string flightTable(const std::vector<FlightResult>& rows) {
    std::string table =
        "\n### A flight with cascades\n\n"
        "A camera flies through the middle of the scene, 5 cm a frame, cascades around it (the finest every 50 cm, "
        "each "
        "next twice as coarse), one `followCamera` and one `update` a frame. How light at surface points that stand "
        "still changes from frame to frame, as a share of the mean light of all points: largest, and 99.9th percentile "
        "of all points and frames. Aware: volumes blend around the camera. Unaware: the same probes, asked without "
        "`FieldSettings::camera`. Still: before the flight, when nothing but the probes' own noise changes.\n\n"
        "| scene | cascades | probes | leaps | aware | unaware | ratio | still |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|\n";
    const auto text = [](const Change& change) {
        return fmt::format("{:.1f} %, {:.2f} %", 100 * change.largest, 100 * change.high);
    };
    std::string missing;
    for (const FlightResult& row : rows) {
        if (!row.missing.empty()) {
            missing += fmt::format("\nNot measured: {} ({}).\n", row.scene, row.missing);
            continue;
        }
        table +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {:.2f}, {:.2f} | {} |\n", row.scene, row.levels, row.probes,
                        row.leaps, text(row.aware), text(row.unaware), row.aware.largest / row.unaware.largest,
                        row.aware.high / row.unaware.high, text(row.still));
    }
    return table + missing;
}

}  // namespace probegi::accuracy
