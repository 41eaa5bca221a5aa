#include "answers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace probegi;
using vulkan::MemoryUse;

namespace {

struct Comparison {
    double traced = 0, own = 0, difference = 0;  ///< means of irradiance and of its absolute difference, W m^-2
};

Comparison compare(std::span<const glm::vec3> traced, std::span<const glm::vec3> own) {
    Comparison mean;
    for (std::size_t i = 0; i < traced.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double share = 1.0 / (3.0 * double(traced.size()));
            mean.traced += share * traced[i][channel];
            mean.own += share * own[i][channel];
            mean.difference += share * std::abs(traced[i][channel] - own[i][channel]);
        }
    }
    return mean;
}

}  // namespace

bool answersAreRight(const EngineDevice& engine, MemoryPool& pool, FrameRing& ring, GlobalIllumination& gi,
                     const FrameData& frame) {
    std::vector<FieldQuery> questions = questionsIn(frame, 0);
    const std::size_t inFirstRoom = questions.size();
    for (const FieldQuery& question : questionsIn(frame, 1)) questions.push_back(question);

    const GpuBuffer asked(engine.device(), pool, questions.size() * sizeof(FieldQuery), MemoryUse::upload);
    const GpuBuffer traced(engine.device(), pool, questions.size() * sizeof(glm::vec3), MemoryUse::readback);
    const GpuBuffer own(engine.device(), pool, questions.size() * sizeof(glm::vec3), MemoryUse::readback);
    std::copy(questions.begin(), questions.end(), asked.mapped<FieldQuery>().begin());
    const vk::raii::CommandBuffer& commands = ring.begin().commands;
    gi.recordQuestions(commands, asked.address, std::uint32_t(questions.size()), traced.address, own.address);
    order(commands, kComputeUse, kHostRead);
    ring.submit();
    ring.wait();

    const auto ofTraced = traced.mapped<const glm::vec3>(), ofOwn = own.mapped<const glm::vec3>();
    bool right = true;
    for (const bool firstRoom : {true, false}) {
        const auto part = [&](std::span<const glm::vec3> all) {
            return firstRoom ? all.first(inFirstRoom) : all.subspan(inFirstRoom);
        };
        const Comparison mean = compare(part(ofTraced), part(ofOwn));
        std::printf("%s room: %.4f W/m^2 by the library's rays, %.4f by the engine's; they differ by %.3f %%\n",
                    firstRoom ? "day-lit" : "inner", mean.traced, mean.own, 100 * mean.difference / mean.traced);
        right = right && mean.traced > 0.01 && mean.difference < 0.02 * mean.traced;
    }
    return right;
}
