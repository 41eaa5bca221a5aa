// Relocation and probe states of recorded updates, where the GPU alone decides, against Field's, where the CPU does.
#include <algorithm>
#include <set>

#include "vulkan/engine.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

using vulkan::GpuField;

class VulkanPlaces : public testing::Test {
protected:
    VulkanPlaces() {
        hooks().reset();
        // Through the walls, and with some probes far from any surface.
        world.desc.volumes[0].counts = {10, 9, 10};
        world.desc.volumes[0].origin = world.pose.bounds.lower - 0.06f * world.pose.bounds.size();
        world.desc.volumes[0].spacing = 1.12f * world.pose.bounds.size() / glm::vec3(9, 8, 9);
        world.desc.raysPerProbe = 24;
        world.desc.fixedRays = 0;
        world.desc.relocation = world.desc.probeStates = true;
        for (int i = 0; i < 150; ++i) {
            const glm::vec3 share = glm::fract(glm::vec3(0.7548f, 0.5698f, 0.3247f) * float(i) + 0.5f);
            glm::vec3 normal(0);
            normal[i % 3] = i % 2 ? 1.0f : -1.0f;
            glm::vec3 at = world.pose.bounds.lower + share * world.pose.bounds.size();
            at[i % 3] = i % 2 ? world.pose.bounds.lower[i % 3] : world.pose.bounds.upper[i % 3];
            queries.push_back({at, normal, normal});
        }
        questions = engine.makeBuffer(std::span<const FieldQuery>(queries));
        answers = engine.makeBuffer(queries.size() * sizeof(glm::vec3));
        tasks = engine.makeBuffer(64 + std::size_t(probeCount(world.desc)) * sizeof(ProbeTask));
    }

    vulkan::Device adopt() { return *vulkan::Device::adopt(log, engine.adoptDesc()); }
    void recordCopy(VkCommandBuffer commands, const GpuField& field) const {
        const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT,
                                      VK_ACCESS_TRANSFER_READ_BIT};
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1,
                             &barrier, 0, nullptr, 0, nullptr);
        const VkBufferCopy whole{0, 0, tasks.bytes};
        vkCmdCopyBuffer(commands, field.taskBuffer(), tasks.buffer, 1, &whole);
        const VkMemoryBarrier after{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                    VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &after, 0,
                             nullptr, 0, nullptr);
    }
    std::vector<ProbeTask> listed() const {
        const auto count = tasks.as<std::uint32_t>()[0];
        const auto* first = reinterpret_cast<const ProbeTask*>(static_cast<const std::byte*>(tasks.mapped) + 64);
        std::vector<ProbeTask> list(first, first + count);
        std::sort(list.begin(), list.end(), [](const ProbeTask& a, const ProbeTask& b) { return a.slot < b.slot; });
        return list;
    }
    static std::vector<ProbeTask> tasksOf(const Field& field) {
        const auto span = field.control().tasks();
        std::vector<ProbeTask> list(span.begin(), span.end());
        std::sort(list.begin(), list.end(), [](const ProbeTask& a, const ProbeTask& b) { return a.slot < b.slot; });
        return list;
    }
    // The same tasks, but for a few that rays along edges decide, in the same places.
    void expectSameTasks(const std::vector<ProbeTask>& wanted) const {
        const std::vector<ProbeTask> got = listed();
        std::set<std::uint32_t> slots, others;
        for (const ProbeTask& task : got) slots.insert(task.slot);
        for (const ProbeTask& task : wanted) others.insert(task.slot);
        ASSERT_EQ(slots.size(), got.size()) << "none is listed twice";
        std::vector<std::uint32_t> apart;
        std::set_symmetric_difference(slots.begin(), slots.end(), others.begin(), others.end(),
                                      std::back_inserter(apart));
        EXPECT_LE(apart.size(), wanted.size() / 50);
        const float step = world.desc.volumes[0].spacing.x;
        int elsewhere = 0;
        for (const ProbeTask& task : got)
            for (const ProbeTask& other : wanted)
                if (other.slot == task.slot) elsewhere += glm::distance(other.origin, task.origin) > 0.02f * step;
        EXPECT_LE(elsewhere, int(wanted.size()) / 50);
    }
    void expectSameLight(const Field& field) const {
        std::vector<glm::vec3> wanted(queries.size());
        field.irradiance(queries, wanted).value();
        const auto got = answers.as<glm::vec3>();
        double sum = 0, difference = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            sum += double(wanted[i].x + wanted[i].y + wanted[i].z);
            difference += double(glm::length(got[i] - wanted[i]));
        }
        EXPECT_GT(sum, 1e-3);
        EXPECT_LT(difference, 0.02 * sum);
    }

    SmallWorld world;
    LogBook log;
    Engine engine;
    std::vector<FieldQuery> queries;
    EngineBuffer questions, answers, tasks;
};

}  // namespace

TEST_F(VulkanPlaces, theGpuPlacesAndListsWhatTheCpuDoes) {
    const vulkan::Device device = adopt();
    auto scene = vulkan::GpuScene::create(log, device, world.scene, world.pose).value();
    auto lighting = vulkan::GpuLighting::create(device, world.lighting).value();
    auto field = GpuField::create(device, world.desc, world.desc).value();
    Field onCpu = Field::create(log, world.desc, world.desc).value();
    const auto tracer = makeEmbreeTracer(log, world.scene, world.pose).value();
    engine.run([&](VkCommandBuffer commands) {
        scene.recordUpload(commands).value();
        lighting.recordUpload(commands).value();
        field.recordClear(commands).value();
        for (int i = 0; i < 3; ++i) field.recordUpdate(commands, scene, lighting).value();
        field.recordQuery(commands, questions.address, answers.address, std::uint32_t(queries.size())).value();
        recordCopy(commands, field);
    });
    for (int i = 0; i < 3; ++i) onCpu.update(*tracer, world.lighting).value();
    const std::vector<ProbeTask> wanted = tasksOf(onCpu);
    EXPECT_LT(wanted.size(), std::size_t(probeCount(world.desc)) - 20);
    EXPECT_GT(wanted.size(), 100u);
    expectSameTasks(wanted);
    expectSameLight(onCpu);

    // Something moves through the middle, and the window scrolls.
    const glm::vec3 centre = world.pose.bounds.centre();
    const Bounds box{centre - 0.05f * world.pose.bounds.size(), centre};
    for (FieldControl* control : {&field.control(), &onCpu.control()}) control->setMoving({&box, 1}).value();
    engine.run([&](VkCommandBuffer commands) {
        field.recordScroll(commands, 0, {1, 0, 0}).value();
        for (int i = 0; i < 2; ++i) field.recordUpdate(commands, scene, lighting).value();
        field.recordQuery(commands, questions.address, answers.address, std::uint32_t(queries.size())).value();
        recordCopy(commands, field);
    });
    onCpu.scroll(0, {1, 0, 0}).value();
    for (int i = 0; i < 2; ++i) onCpu.update(*tracer, world.lighting).value();
    EXPECT_GT(tasksOf(onCpu).size(), wanted.size()) << "it woke some";
    expectSameTasks(tasksOf(onCpu));
    expectSameLight(onCpu);
}

TEST_F(VulkanPlaces, raysOfTheEnginePlaceProbes) {
    const vulkan::Device device = adopt();
    auto field = GpuField::create(device, world.desc, world.desc).value();
    Field onCpu = Field::create(log, world.desc, world.desc).value();
    const auto tracer = makeEmbreeTracer(log, world.scene, world.pose).value();
    const std::size_t perProbe = std::size_t(world.desc.raysPerProbe);
    const auto dataOf = [&](const std::vector<ProbeTask>& list, const FieldControl& control) {
        std::vector<Ray> rays;
        for (const ProbeTask& task : list)
            for (const glm::vec3& direction : control.rayDirections()) rays.push_back({task.origin, 0, direction});
        std::vector<Hit> hits(rays.size());
        std::vector<Surface> seen(rays.size());
        tracer->closestHits(rays, hits).value();
        tracer->surfaces(rays, hits, seen).value();
        std::vector<RayDatum> data(std::size_t(probeCount(world.desc)) * perProbe);
        for (std::size_t r = 0; r < rays.size(); ++r)
            data[r] = {hits[r].valid() && !seen[r].backface ? seen[r].albedo : glm::vec3(0),
                       hits[r].valid() && seen[r].back ? -hits[r].distance : hits[r].distance};
        return data;
    };
    const EngineBuffer rayBuffer = engine.makeBuffer(std::size_t(probeCount(world.desc)) * perProbe * sizeof(RayDatum));
    engine.run([&](VkCommandBuffer commands) { field.recordClear(commands).value(); });
    for (int i = 0; i < 8; ++i) {
        engine.run([&](VkCommandBuffer commands) {
            EXPECT_EQ(field.recordUpdate(commands, rayBuffer.range()).error().code, ErrorCode::invalidArgument)
                << "the tasks are not listed";
            field.recordTasks(commands).value();
            recordCopy(commands, field);
        });
        const auto* head = tasks.as<std::uint32_t>().data();
        EXPECT_EQ(head[1] * head[2], (head[0] + 63) / 64) << "groups of a thread a task";
        EXPECT_EQ(head[4] * head[5], (head[0] * perProbe + 63) / 64) << "groups of a thread a ray";
        // The list's order is the GPU's own.
        const auto* first = reinterpret_cast<const ProbeTask*>(static_cast<const std::byte*>(tasks.mapped) + 64);
        const std::vector<RayDatum> data = dataOf({first, first + head[0]}, field.control());
        std::copy(data.begin(), data.end(), rayBuffer.as<RayDatum>().begin());
        engine.run([&](VkCommandBuffer commands) {
            field.recordUpdate(commands, rayBuffer.range()).value();
            field.recordQuery(commands, questions.address, answers.address, std::uint32_t(queries.size())).value();
        });
        const auto list = onCpu.control().tasks();
        std::vector<RayDatum> same = dataOf({list.begin(), list.end()}, onCpu.control());
        same.resize(list.size() * perProbe);
        onCpu.update(same).value();
    }
    engine.run([&](VkCommandBuffer commands) {
        field.recordTasks(commands).value();
        recordCopy(commands, field);
    });
    expectSameTasks(tasksOf(onCpu));
    expectSameLight(onCpu);
}

TEST_F(VulkanPlaces, whatCannotBeIsSaid) {
    const vulkan::Device device = adopt();
    FieldSetup plain = world.desc;
    plain.relocation = plain.probeStates = false;
    auto without = GpuField::create(device, plain, plain).value();
    auto field = GpuField::create(device, world.desc, world.desc).value();
    const std::vector<Bounds> many(300, Bounds{{0, 0, 0}, {1, 1, 1}});
    field.control().setMedia(many).value();
    engine.run([&](VkCommandBuffer commands) {
        without.recordClear(commands).value();
        field.recordClear(commands).value();
        // What is listed counts, whatever is set before the update.
        field.control().setMedia({}).value();
        field.recordTasks(commands).value();
        field.control().setTasks(std::vector<std::uint32_t>{0}).value();
        EXPECT_EQ(field.recordUpdate(commands, {tasks.address, 24 * sizeof(RayDatum)}).error().code,
                  ErrorCode::invalidArgument)
            << "rays of one task only";
        field.control().setMedia(many).value();
        EXPECT_EQ(without.recordTasks(commands).error().code, ErrorCode::invalidArgument);
        EXPECT_EQ(field.recordTasks(commands).error().code, ErrorCode::invalidArgument);
    });
}

}  // namespace probegi::test
