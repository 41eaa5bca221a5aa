// Glossy light against the path tracer, where it matters most: between two mirrors that face each other.
#include <gtest/gtest.h>

#include "probegi/probegi.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

TEST(GlossyReference, mirrorsFacingEachOtherComeNearerWithEachStep) {
    const Context context = Context::create({.threads = 2}).value();
    const Scene scene = makeBuiltinScene("mirrors").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();
    FieldSetup fieldDesc;
    fieldDesc.volumes = {placeVolume(*tracer, {.counts = {13, 9, 11}}).value()};
    fieldDesc.raysPerProbe = 64;
    Field field = Field::create(context, fieldDesc, fieldDesc).value();
    for (int i = 0; i < 30; ++i) field.update(*tracer, lighting).value();

    PictureDesc desc{.camera = pose.cameras.at(0), .width = 48, .height = 27, .samplesPerAxis = 2};
    const PathTracer pathTracer = PathTracer::create(context, scene, pose, *tracer, lighting).value();
    const Picture truth = pathTracer.render({.picture = desc, .samplesPerPixel = 160}).value().picture;
    const auto errorWith = [&](Glossy glossy) {
        desc.glossy = glossy;
        const Picture own = renderPicture(context, *tracer, lighting, &field, desc).value().picture;
        return compareImages(own.color, truth.color).value().difference;
    };
    const ImageDifference off = errorWith(Glossy::off), first = errorWith(Glossy::first),
                          second = errorWith(Glossy::field);
    RecordProperty("rmse",
                   std::to_string(off.rmse) + " " + std::to_string(first.rmse) + " " + std::to_string(second.rmse));
    RecordProperty("flip",
                   std::to_string(off.flip) + " " + std::to_string(first.flip) + " " + std::to_string(second.flip));
    // Measured: 0.100, 0.091, 0.079 and 0.226, 0.167, 0.152.
    EXPECT_LT(first.rmse, 0.95 * off.rmse);
    EXPECT_LT(second.rmse, 0.93 * first.rmse);
    EXPECT_LT(first.flip, 0.8 * off.flip);
    EXPECT_LT(second.flip, 0.97 * first.flip);
}

}  // namespace
}  // namespace probegi::test
