// Code as in an engine, compiled with every compiler, standard and mode.
#include "probegi/probegi.h"
#ifdef PROBEGI_HAS_VULKAN
#include "probegi/vulkan.h"
#endif

using namespace probegi;

Result<float> askTwice(const Context& context, const FieldDesc& desc, std::span<const RayDatum> rays) {
    auto made = Field::create(context, desc);
    if (!made) return made.error();
    made = Field::create(context, desc);  // a Result of a move-only type can be assigned
    if (auto done = made->update(rays); !done) return done.error();
    made->update(rays).value();
    const FieldQuery query{.position = {1, 2, 3}};
    glm::vec3 answer(0.0f);
    made->irradiance({&query, 1}, {&answer, 1}).value();  // of a Result<void>
    return made->irradiance(query).y + answer.x;
}

Result<int> chained(const Context& context, const FieldDesc& desc) {
    return Field::create(context, desc)
        .transform([](const Field& field) { return field.control().frame(); })
        .and_then([](int frame) { return frame == 0 ? Result<int>(1) : fail(ErrorCode::malformed, "a sentence"); });
}
