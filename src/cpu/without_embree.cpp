#include "probegi/tracer.h"

namespace probegi {

Result<std::unique_ptr<Tracer>> makeEmbreeTracer(const Context&, const Scene&, const ScenePose&) {
    return fail(
        ErrorCode::unsupported,
        "this ProbeGI was built without Embree; build it with PROBEGI_EMBREE=ON, or bring a Tracer of your own");
}

}  // namespace probegi
