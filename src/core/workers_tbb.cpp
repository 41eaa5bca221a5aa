#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "core/workers.h"

namespace probegi {

namespace {

class TbbWorkers final : public Workers {
public:
    explicit TbbWorkers(int threads)
        : m_parallelism(tbb::global_control::max_allowed_parallelism, atLeastTheHardwares(threads)), m_arena(threads) {}

    void run(std::size_t count, const std::function<void(std::size_t)>& task) override {
        m_arena.execute([&] {
            tbb::this_task_arena::isolate([&] {
                tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), [&](const auto& range) {
                    for (std::size_t i = range.begin(); i < range.end(); ++i) task(i);
                });
            });
        });
    }
    void inside(const std::function<void()>& body) override { m_arena.execute(body); }

private:
    // Never below the number of hardware threads: of several live controls, the smallest applies.
    static std::size_t atLeastTheHardwares(int threads) {
        return std::max(std::size_t(threads), std::size_t(std::thread::hardware_concurrency()));
    }

    tbb::global_control m_parallelism;  // lets an arena have more threads than the machine; TBB would refuse them aloud
    tbb::task_arena m_arena;
};

}  // namespace

std::unique_ptr<Workers> makeWorkers(int threads) {
    return std::make_unique<TbbWorkers>(threads);
}
bool workersExist() noexcept {
    return true;
}

}  // namespace probegi
