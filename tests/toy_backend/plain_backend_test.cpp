// A toy backend, added as CONTRIBUTING.md says, against the library's: plain loops are an oracle for all that the CPU's
// field does faster.
#include <gtest/gtest.h>

#include "probegi/probegi.h"
#include "toy_backend/plain_field.h"

namespace probegi::test {
namespace {

class PlainRenderer final : public PictureRenderer {
public:
    explicit PlainRenderer(const Context& context) : m_context(context) {}
    Result<RenderedPicture> render(const Tracer& tracer, const Lighting& lighting, const Field* field,
                                   const PictureDesc& desc) override {
        return renderPicture(m_context, tracer, lighting, field, desc);
    }

private:
    Context m_context;
};

class PlainBackend final : public Backend {
public:
    explicit PlainBackend(const Context& context) : m_context(context) {}

    BackendKind kind() const noexcept override { return BackendKind::cpu; }
    Result<std::unique_ptr<Tracer>> openScene(const Scene& scene, const ScenePose& pose) const override {
        return makeEmbreeTracer(m_context, scene, pose);
    }
    Result<std::unique_ptr<MovableTracer>> openMovableScene(const Scene& scene, const ScenePose& pose,
                                                            const MovableDesc& movable) const override {
        return makeMovableEmbreeTracer(m_context, scene, pose, movable);
    }
    Result<std::unique_ptr<MovableTracer>> openSdf(const SdfScene& sdf, const Scene& scene,
                                                   const ScenePose& pose) const override {
        return makeSdfTracer(m_context, sdf, scene, pose);
    }
    Result<Field> makeField(const FieldDesc& desc, const FieldSettings& settings) const override {
        if (auto ok = validateFieldDesc(desc); !ok) return ok.error();
        if (auto ok = validateFieldSettings(settings); !ok) return ok.error();
        if (desc.rules != FieldRules::paper) return fail(ErrorCode::unsupported, "only the paper's rules");
        return makeFieldOn(m_context, desc, settings, std::make_unique<PlainField>(m_context, desc));
    }
    Result<std::unique_ptr<PictureRenderer>> makeRenderer() const override {
        return std::make_unique<PlainRenderer>(m_context);
    }

private:
    Context m_context;
};

/// The Cornell box with a small field of each backend.
class ToyBackend : public testing::Test {
protected:
    ToyBackend() {
        desc.volumes = {placeVolume(pose.bounds, {.counts = {5, 5, 5}}).value()};
        desc.rules = FieldRules::paper;
        desc.raysPerProbe = 64;
        field.emplace(plain.makeField(desc, {}).value());
        reference.emplace(library->makeField(desc, {}).value());
    }
    void update(int times) {
        for (int i = 0; i < times; ++i) {
            ASSERT_TRUE(field->update(*tracer, lighting));
            ASSERT_TRUE(reference->update(*tracer, lighting));
        }
    }
    /// Points in the box, with normals all around.
    std::vector<FieldQuery> queries() const {
        std::vector<FieldQuery> all;
        for (int i = 0; i < 60; ++i) {
            const glm::vec3 share = glm::fract(glm::vec3(0.7548f, 0.5698f, 0.3247f) * float(i) + 0.5f);
            const glm::vec3 normal = glm::normalize(glm::fract(share * 7.3f) - 0.5f);
            all.push_back({pose.bounds.lower + share * pose.bounds.size(), normal, normal});
        }
        return all;
    }

    const Context context = Context::create({.threads = 2}).value();
    const Scene scene = makeBuiltinScene("cornell").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const PlainBackend plain{context};
    const std::unique_ptr<Backend> library = openBackend(context).value();
    const std::unique_ptr<Tracer> tracer = plain.openScene(scene, pose).value();
    FieldDesc desc;
    std::optional<Field> field, reference;
};

TEST_F(ToyBackend, holdsWhatTheLibrarysHolds) {
    for (int round = 0; round < 3; ++round) {
        update(2);
        const FieldSnapshot own = field->read().value(), wanted = reference->read().value();
        EXPECT_EQ(own.frame, wanted.frame);
        for (int probe = 0; probe < probeCount(desc); ++probe) {
            EXPECT_NEAR(own.state(probe).backfaceShare, wanted.state(probe).backfaceShare, 1e-5f) << probe;
            for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0, 0.8f)}) {
                const glm::vec3 e = own.probeIrradiance(probe, n), same = wanted.probeIrradiance(probe, n);
                EXPECT_LE(glm::length(e - same), 5e-3f * glm::length(same) + 1e-5f) << probe;  // a step of the storage
                const glm::vec2 m = own.probeDistanceMoments(probe, n), mSame = wanted.probeDistanceMoments(probe, n);
                EXPECT_NEAR(m.x, mSame.x, 1e-3f) << probe;
                EXPECT_NEAR(m.y, mSame.y, 2e-3f) << probe;
            }
        }
    }
}

TEST_F(ToyBackend, scrollsAsTheLibraryDoes) {
    update(2);
    for (Field* each : {&*field, &*reference}) ASSERT_TRUE(each->scroll(0, {1, -2, 0}));
    for (const FieldQuery& query : queries())
        EXPECT_LE(glm::length(field->irradiance(query) - reference->irradiance(query)),
                  5e-3f * glm::length(reference->irradiance(query)) + 1e-5f);
    update(2);
    const FieldSnapshot own = field->read().value(), wanted = reference->read().value();
    for (int probe = 0; probe < probeCount(desc); ++probe) {
        EXPECT_NEAR(own.state(probe).backfaceShare, wanted.state(probe).backfaceShare, 1e-5f) << probe;
        const glm::vec3 e = own.probeIrradiance(probe, {0, 1, 0}), same = wanted.probeIrradiance(probe, {0, 1, 0});
        EXPECT_LE(glm::length(e - same), 5e-3f * glm::length(same) + 1e-5f) << probe;
    }
}

TEST_F(ToyBackend, answersAsTheLibraryDoes) {
    update(4);
    for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
        FieldSettings settings;
        settings.guard = guard;
        for (Field* each : {&*field, &*reference}) ASSERT_TRUE(each->control().setSettings(settings));
        // From the same probes, so that only the look-ups differ.
        ASSERT_TRUE(field->write(reference->read().value()));
        for (const FieldQuery& query : queries()) {
            const glm::vec3 e = field->irradiance(query), same = reference->irradiance(query);
            EXPECT_LE(glm::length(e - same), 1e-3f * glm::length(same) + 1e-5f);
        }
    }
}

TEST_F(ToyBackend, drawsAndConverges) {
    const auto done = field->converge(*tracer, lighting, 0.2f, 12);
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_TRUE(reference->converge(*tracer, lighting, 0.2f, 12));
    const PictureDesc view{overviewCamera(pose.bounds), 16, 12, 1, false};
    const auto own = plain.makeRenderer().value()->render(*tracer, lighting, &*field, view).value();
    const auto same = library->makeRenderer().value()->render(*tracer, lighting, &*reference, view).value();
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < own.picture.indirect.pixels.size(); ++i) {
        sum += same.picture.indirect.pixels[i].y;
        difference += std::abs(own.picture.indirect.pixels[i].y - same.picture.indirect.pixels[i].y);
    }
    EXPECT_GT(sum, 0.1);
    EXPECT_LT(difference, 5e-3 * sum);
}

TEST_F(ToyBackend, saysWhatItDoesNotDo) {
    FieldDesc measured = desc;
    measured.rules = FieldRules::measured;
    EXPECT_EQ(plain.makeField(measured, {}).error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace probegi::test
