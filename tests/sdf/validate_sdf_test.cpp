#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "probegi/sdf.h"

namespace probegi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

SdfPrimitive named(SdfShape shape, glm::vec3 halfSize) {
    SdfPrimitive primitive;
    primitive.name = "wall";
    primitive.shape = shape;
    primitive.halfSize = halfSize;
    return primitive;
}

std::string faultOf(const SdfPrimitive& primitive) {
    const auto checked = validate(SdfScene{{SdfPrimitive{}, primitive}});
    if (checked) return {};
    EXPECT_EQ(checked.error().code, ErrorCode::malformed);
    return checked.error().message;
}

TEST(ValidateSdf, acceptsEveryShapeWithWhatItUses) {
    EXPECT_TRUE(validate(SdfScene{}));
    EXPECT_EQ(faultOf(named(SdfShape::box, {1, 2, 3})), "");
    EXPECT_EQ(faultOf(named(SdfShape::roundedBox, {1, 2, 3})), "");
    // What a shape does not use may be anything.
    EXPECT_EQ(faultOf(named(SdfShape::sphere, {1, -2, kNan})), "");
    EXPECT_EQ(faultOf(named(SdfShape::capsule, {1, 0, kInfinity})), "");
    EXPECT_EQ(faultOf(named(SdfShape::cylinder, {1, 2, -1})), "");
    EXPECT_EQ(faultOf(named(SdfShape::plane, {kNan, kNan, kNan})), "");
}

TEST(ValidateSdf, looksAtTheColoursOfFaces) {
    SdfPrimitive box = named(SdfShape::box, {1, 2, 3});
    box.faces.assign(216, glm::vec3(0.5f));
    EXPECT_EQ(faultOf(box), "");
    box.faces[100].y = 1.5f;
    EXPECT_THAT(faultOf(box), testing::HasSubstr("texel of its faces"));
    box.faces[100].y = kNan;
    EXPECT_THAT(faultOf(box), testing::HasSubstr("texel of its faces"));
    box.faces.resize(36);
    EXPECT_THAT(faultOf(box), testing::HasSubstr("36 texels"));
    SdfPrimitive ball = named(SdfShape::sphere, {1, 1, 1});
    ball.faces.assign(216, glm::vec3(0.5f));
    EXPECT_THAT(faultOf(ball), testing::HasSubstr("only boxes"));
}

TEST(ValidateSdf, namesThePrimitiveAndTheFault) {
    const auto expectFault = [](const std::function<void(SdfPrimitive&)>& spoil, const char* fault) {
        SdfPrimitive primitive = named(SdfShape::roundedBox, {1, 2, 3});
        spoil(primitive);
        EXPECT_THAT(faultOf(primitive), testing::StartsWith(std::string("primitive 1 'wall': its ") + fault));
    };
    expectFault([](SdfPrimitive& p) { p.shape = SdfShape(6); }, "shape 6 is none");
    expectFault([](SdfPrimitive& p) { p.centre.y = kNan; }, "centre (0, nan, 0) must be within");
    expectFault([](SdfPrimitive& p) { p.centre.x = 2e9f; }, "centre");
    expectFault([](SdfPrimitive& p) { p.rotation = {0, 0, 0, 0}; }, "rotation (0, 0, 0, 0) must be a unit quaternion");
    expectFault([](SdfPrimitive& p) { p.rotation.w = kInfinity; }, "rotation");
    expectFault([](SdfPrimitive& p) { p.halfSize.x = 0; }, "half size along x 0 must be > 0 and");
    expectFault([](SdfPrimitive& p) { p.halfSize.z = -1; }, "half size along z -1 must be > 0");
    expectFault([](SdfPrimitive& p) { p.halfSize.y = kNan; }, "half size along y nan");
    expectFault([](SdfPrimitive& p) { p.rounding = 1.5f; }, "rounding 1.5 must be 0 to its smallest half size, 1");
    expectFault([](SdfPrimitive& p) { p.rounding = kNan; }, "rounding nan");
    expectFault([](SdfPrimitive& p) { p.albedo.z = 1.5f; }, "albedo (0.5, 0.5, 1.5) must be 0..1");
    expectFault([](SdfPrimitive& p) { p.emission.x = -1; }, "emission (-1, 0, 0) must be 0 to 1e+20");
    expectFault([](SdfPrimitive& p) { p = named(SdfShape::sphere, {-1, 1, 1}); }, "radius -1 must be > 0 and");
    expectFault([](SdfPrimitive& p) { p = named(SdfShape::capsule, {1, -1, 1}); }, "half length -1 must be > 0 or 0");
    expectFault([](SdfPrimitive& p) { p = named(SdfShape::cylinder, {1, 0, 1}); }, "half height 0 must be > 0 and");
}

TEST(ValidateSdf, refusesTooMany) {
    SdfScene sdf;
    sdf.primitives.resize(std::size_t(kMaxSdfPrimitives));
    EXPECT_TRUE(validate(sdf));
    sdf.primitives.emplace_back();
    const auto checked = validate(sdf);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().message, "4097 primitives are more than 4096; use fewer");
}

}  // namespace
}  // namespace probegi
