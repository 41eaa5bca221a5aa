#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <mutex>
#include <thread>

#include "probegi/context.h"

namespace probegi {

struct Context::Impl {
    explicit Impl(const ContextDesc& d, int threadCount)
        : desc(d),
          threads(threadCount),
          parallelism(tbb::global_control::max_allowed_parallelism, workers(threadCount)),
          arena(threadCount) {}

    // Never below the hardware's threads: where several controls are alive, the smallest counts.
    static std::size_t workers(int threadCount) {
        return std::max(std::size_t(threadCount), std::size_t(std::thread::hardware_concurrency()));
    }

    ContextDesc desc;
    int threads;
    tbb::global_control parallelism;  // lets an arena have more threads than the machine; TBB would refuse them aloud
    tbb::task_arena arena;
    std::mutex logMutex;
};

}  // namespace probegi
