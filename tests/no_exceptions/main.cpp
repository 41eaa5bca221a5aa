// Without arguments: makes a field, assigning Results. With one: calls value() of an error.
#include <vector>

#include "probegi/context.h"
#include "probegi/field.h"

using namespace probegi;

int main(int argc, char**) {
    if (argc > 1) {
        Context::create({.threads = 5000}).value();
        return 0;
    }
    const Context context = Context::create({.threads = 1}).value();
    FieldDesc desc;
    desc.raysPerProbe = 16;
    Result<Field> field = Field::create(context, FieldDesc{.raysPerProbe = 0});
    if (field) return 1;
    field = Field::create(context, desc);
    if (!field) return 2;
    field->update(std::vector<RayDatum>(8 * 16, RayDatum{{1, 1, 1}, 1.0f})).value();
    const FieldQuery query{.position = {0.5f, 0.5f, 0.5f}};
    glm::vec3 answer(0.0f);
    const Result<void> asked = field->irradiance({&query, 1}, {&answer, 1});
    asked.value();
    return answer.x > 3.0f && answer.x < 3.3f ? 0 : 3;
}
