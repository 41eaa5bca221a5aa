#include <bit>

#include "vulkan_tracer/ball_tracers.h"

namespace probegi::vulkan {

// Made by the build of tracer_ball.glsl.
std::span<const std::uint32_t> ballShaders(std::string_view name);

}  // namespace probegi::vulkan

namespace probegi::test {

namespace {

class BallSceneTracer final : public vulkan::SceneTracer {
public:
    explicit BallSceneTracer(const vulkan::TracedScene& scene) : m_ball(ballIn(scene.geometry.bounds())) {}

    kernels::TracerBlock block() const noexcept override {
        const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
        return {{}, {bits(m_ball.centre.x), bits(m_ball.centre.y), bits(m_ball.centre.z), bits(m_ball.radius)}};
    }
    void recordBuild(const vulkan::Recorder&) override {}
    void recordPlacements(const vulkan::Recorder&, const std::vector<Placement>&) override {}
    void releaseStaging() noexcept override {}
    std::size_t bytes() const noexcept override { return 0; }

private:
    kernels::Ball m_ball;
};

bool always(const vulkan::Device&) {
    return true;
}
std::unique_ptr<vulkan::SceneTracer> make(const vulkan::TracedScene& scene) {
    return std::make_unique<BallSceneTracer>(scene);
}

}  // namespace

const vulkan::SceneTracerType& ballSceneTracer() {
    static constexpr vulkan::SceneTracerType kBall{.name = "ball",
                                                   .kind = vulkan::TracerKind::automatic,  // users cannot ask for it
                                                   .needs = "",
                                                   .possible = always,
                                                   .preferred = always,
                                                   .make = make,
                                                   .hitsTriangles = false,
                                                   .shaders = vulkan::ballShaders};
    return kBall;
}

}  // namespace probegi::test
