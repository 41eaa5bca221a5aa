#include "probegi/tracer.h"

namespace probegi {

namespace {

Error withoutEmbree() {
    return fail(
        ErrorCode::unsupported,
        "this ProbeGI was built without Embree; build it with PROBEGI_EMBREE=ON, or bring a Tracer of your own");
}

}  // namespace

Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context&, const Scene&, const ScenePose&) {
    return withoutEmbree();
}
Result<std::unique_ptr<MovableTracer>> makeMovableEmbreeTracer(const Context&, const Scene&, const ScenePose&,
                                                               const MovableDesc&) {
    return withoutEmbree();
}

}  // namespace probegi
