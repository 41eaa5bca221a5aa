// Parts that were left out report it, and the rest works.
#include <probegi/probegi.h>

#include <cstdio>

using namespace probegi;

namespace {

int wrong = 0;

template <class T>
void expectUnsupported(const Result<T>& result, const char* what) {
    if (!result && result.error().code == ErrorCode::unsupported && result.error().message.size() > 40) return;
    std::printf("%s: %s\n", what, result ? "there was an answer" : result.error().message.c_str());
    ++wrong;
}

void expect(bool right, const char* what) {
    if (right) return;
    std::printf("%s\n", what);
    ++wrong;
}

void inOrder(std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
}

}  // namespace

int main() {
    const Context context = Context::create().value();
    const Scene scene = makeBuiltinScene("cornell").value();
#ifndef PROBEGI_HAS_EMBREE
    expectUnsupported(makeEmbreeTracer(context, scene, poseAt(scene)), "makeEmbreeTracer");
#endif
#ifndef PROBEGI_HAS_IO
    expectUnsupported(loadScene("scene.glb"), "loadScene");
    expectUnsupported(readImage("picture.png"), "readImage");
    expectUnsupported(writeImage("picture.png", HdrImage(1, 1)), "writeImage");
#endif
#ifndef PROBEGI_HAS_TBB
    expect(context.threads() == 1, "without threads of its own the library has another number of them than one");
    expectUnsupported(Context::create({.threads = 2}), "Context::create with two threads");
#endif
    const auto engines = Context::create({.threads = 2, .parallelFor = inOrder});
    expect(engines && engines->threads() == 2, "an engine's jobs were refused");
    expect(bool(validate(scene)), "the built-in scene is not valid");
    return wrong;
}
