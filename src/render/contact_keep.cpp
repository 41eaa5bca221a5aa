#include "kernels/screen/contact_history.h"

#include <cmath>
#include <glm/common.hpp>

#include "render/frame_pass.h"

namespace probegi {

namespace {

// What the last picture had at a surface, from the four pixels around its place there.
kernels::ContactPast pastOf(const PictureTask& task, const ScreenSample& sample, float pixelAngle) {
    kernels::ContactPast past = kernels::noPast();
    if (!task.past) return past;
    const glm::vec3 pixel = kernels::pinholePixel(task.past->camera, sample.position);
    const auto [width, height] = std::pair(float(task.desc.width), float(task.desc.height));
    if (pixel.z <= 0.0f || !(pixel.x >= 0.0f && pixel.x < width && pixel.y >= 0.0f && pixel.y < height)) return past;
    const float left = std::floor(pixel.x - 0.5f), top = std::floor(pixel.y - 0.5f);
    for (int i = 0; i < 4; ++i) {
        const float x = left + float(i % 2), y = top + float(i / 2);
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const kernels::ContactRecord& record =
            task.past->records[std::size_t(y) * std::size_t(task.desc.width) + std::size_t(x)];
        const float tent = (1 - std::abs(pixel.x - 0.5f - x)) * (1 - std::abs(pixel.y - 0.5f - y));
        kernels::addRecord(
            past, record,
            tent * kernels::recordWeight(record, sample.position, sample.geometricNormal, sample.distance, pixelAngle));
    }
    return past;
}

}  // namespace

Result<void> keepContact(PictureTask& task, const PixelRect& part, Frame& frame) {
    const float pixelAngle = kernels::pinholeSpread(task.camera, 1);
    forEachPixel(part, [&](int x, int y) {
        const ScreenSample& sample = frame.at(x, y, frame.firstPlane());
        kernels::ContactRecord& record = task.records[std::size_t(y) * std::size_t(task.desc.width) + std::size_t(x)];
        const glm::vec4 light = frame.contact->blurred(x, y);
        glm::vec4 lower = light, upper = light;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (frame.contact->contains(x + i, y + j)) {
                    lower = glm::min(lower, frame.contact->blurred(x + i, y + j));
                    upper = glm::max(upper, frame.contact->blurred(x + i, y + j));
                }
        float count = 0.0f;
        glm::vec4& kept = frame.contact->kept(x, y);
        kept = light;
        if (sample.kind == kSampleSurface)
            kept = kernels::keptContact(pastOf(task, sample, pixelAngle), light, lower, upper, count);
        if (frame.firstPlane() == 0) record = {kept, sample.position, sample.geometricNormal, count};
        // The mean over planes, of the first one's surface.
        record.light += (kept - record.light) * (1.0f / float(frame.firstPlane() + 1));
    });
    return {};
}

}  // namespace probegi
