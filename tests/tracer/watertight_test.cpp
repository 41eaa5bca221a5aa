// No ray slips between the triangles of a closed mesh: lost rays leak light.
#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

constexpr std::size_t kBatch = 4096;

struct Room {
    TestScene s;
    std::vector<glm::vec3> corners;  ///< all vertices, in world space
    glm::mat4 toWorld;

    explicit Room(bool instanced) {
        std::mt19937 random(21);
        toWorld = glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(13, -7, 5)), 0.7f,
                              glm::normalize(glm::vec3(1, 2, 3)));
        toWorld = glm::scale(toWorld, glm::vec3(3, 2, 5));
        const int mesh = s.addMesh(innerBox(8, random));
        s.place(mesh, toWorld);
        if (instanced) s.place(mesh, glm::translate(glm::mat4(1.0f), glm::vec3(100, 0, 0)));
        for (const glm::vec3& p : s.scene.meshes[0].primitives[0].positions) corners.push_back(inWorld(p));
    }
    glm::vec3 inWorld(glm::vec3 p) const { return glm::vec3(toWorld * glm::vec4(p, 1.0f)); }
};

/// Traces batches filled by `aim`; counts the rays that miss, as closest hits or as occlusion.
template <class Aim>
std::size_t escapes(const Tracer& tracer, std::size_t batches, const Aim& aim) {
    std::vector<Ray> rays(kBatch);
    std::vector<Hit> hits(kBatch);
    std::vector<std::uint8_t> blocked(kBatch);
    std::size_t lost = 0;
    for (std::size_t batch = 0; batch < batches; ++batch) {
        aim(rays);
        tracer.closestHits(rays, hits).value();
        tracer.occluded(rays, blocked).value();
        for (std::size_t i = 0; i < kBatch; ++i) lost += !hits[i].valid() || blocked[i] == 0 ? 1 : 0;
    }
    return lost;
}

}  // namespace

class TracerWatertight : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerWatertight);

TEST_P(TracerWatertight, AMillionRandomRays) {
    for (const bool instanced : {false, true}) {
        const Room room(instanced);
        const auto tracer = trace(GetParam(), room.s);
        std::mt19937 random(22);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
        const std::size_t lost = escapes(*tracer, 128, [&](std::vector<Ray>& rays) {
            for (Ray& ray : rays) {
                const glm::vec3 direction(uniform(random), uniform(random), uniform(random));
                ray = rayAlong(room.inWorld(randomPoint(random, 0.95f)), direction);
            }
        });
        EXPECT_EQ(lost, 0u) << (instanced ? "instanced" : "merged");
    }
}

namespace {

/// Escapes of rays aimed at points on edges; `along` gives the position between the two vertices, 0..1.
template <class Along>
std::size_t escapesAtEdges(const TracerMaker& maker, bool instanced, std::size_t batches, Along along) {
    const Room room(instanced);
    const auto tracer = trace(maker, room.s);
    const std::vector<std::uint32_t>& indices = room.s.scene.meshes[0].primitives[0].indices;
    std::mt19937 random(23);
    std::uniform_int_distribution<std::size_t> pick(0, indices.size() / 3 - 1);
    return escapes(*tracer, batches, [&](std::vector<Ray>& rays) {
        for (Ray& ray : rays) {
            const std::size_t triangle = 3 * pick(random);
            const glm::vec3 a = room.corners[indices[triangle]], b = room.corners[indices[triangle + 1]];
            const glm::vec3 origin = room.inWorld(randomPoint(random, 0.95f));
            ray = rayAlong(origin, a + (b - a) * along(random) - origin);
        }
    });
}

}  // namespace

TEST_P(TracerWatertight, RaysAtEdges) {
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (const bool instanced : {false, true})
        EXPECT_LE(double(escapesAtEdges(GetParam(), instanced, 64, uniform)), GetParam().edgeLoss * 64 * kBatch)
            << (instanced ? "instanced" : "merged");
}

TEST_P(TracerWatertight, RaysAtVerticesHardlyEverEscape) {
    // Embree's edge tests agree between neighbours but not around a vertex: of rays aimed exactly at one, 0.14 % were
    // lost (16 % without the robust flag, and 1.8 % at edges). Random rays do not hit vertices exactly.
    for (const bool instanced : {false, true}) {
        const std::size_t lost = escapesAtEdges(GetParam(), instanced, 32, [](std::mt19937&) { return 0.0f; });
        EXPECT_LE(double(lost), GetParam().vertexLoss * 32 * kBatch) << (instanced ? "instanced" : "merged");
    }
}

TEST_P(TracerWatertight, CoherentRowsOfRays) {
    const Room room(false);
    const auto tracer = trace(GetParam(), room.s);
    std::mt19937 random(24);
    const std::size_t lost = escapes(*tracer, 64, [&](std::vector<Ray>& rays) {
        const glm::vec3 origin = room.inWorld(randomPoint(random, 0.95f));
        const glm::vec3 forward = randomDirection(random), side = 0.0005f * randomDirection(random);
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = rayAlong(origin, forward + float(i) * side);
    });
    EXPECT_EQ(lost, 0u);
}

}  // namespace probegi::test
