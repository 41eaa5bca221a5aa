// Must compile with one warning: the Result is ignored.
#include "probegi/field.h"

using namespace probegi;

void forgetful(Field& field, const Tracer& tracer, const Lighting& lighting);

void forgetful(Field& field, const Tracer& tracer, const Lighting& lighting) {
    field.update(tracer, lighting);
}
