// Glossy light against the path tracer, where it matters most: between two mirrors that face each other.
#include <gtest/gtest.h>

#include <cmath>

#include "probegi/probegi.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

// Mean over pixels and channels of |own - wanted|, over the mean of what is wanted.
double error(const HdrImage& own, const HdrImage& wanted) {
    double sum = 0, mean = 0;
    for (std::size_t i = 0; i < own.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            // Lamps count as white.
            const auto shown = [](float value) { return std::min(double(value), 1.0); };
            sum += std::abs(shown(own.pixels[i][c]) - shown(wanted.pixels[i][c]));
            mean += shown(wanted.pixels[i][c]);
        }
    return sum / mean;
}

TEST(GlossyReference, mirrorsFacingEachOtherComeNearerWithEachStep) {
    const Context context = Context::create({.threads = 2}).value();
    const Scene scene = makeBuiltinScene("mirrors").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();
    FieldSetup fieldDesc;
    fieldDesc.volumes = {placeVolume(*tracer, {.counts = {8, 6, 8}}).value()};
    fieldDesc.raysPerProbe = 64;
    Field field = Field::create(context, fieldDesc, fieldDesc).value();
    for (int i = 0; i < 30; ++i) field.update(*tracer, lighting).value();

    PictureDesc desc{.camera = pose.cameras.at(0), .width = 48, .height = 27, .samplesPerAxis = 2};
    const PathTracer pathTracer = PathTracer::create(context, scene, pose, *tracer, lighting).value();
    const Picture truth = pathTracer.render({.picture = desc, .samplesPerPixel = 96}).value().picture;
    const auto errorWith = [&](Glossy glossy) {
        desc.glossy = glossy;
        return error(renderPicture(context, *tracer, lighting, &field, desc).value().picture.color, truth.color);
    };
    const double off = errorWith(Glossy::off), first = errorWith(Glossy::first), second = errorWith(Glossy::field);
    RecordProperty("errors", std::to_string(off) + " " + std::to_string(first) + " " + std::to_string(second));
    EXPECT_LT(first, 0.9 * off);
    EXPECT_LT(second, 0.9 * first);
}

}  // namespace
}  // namespace probegi::test
