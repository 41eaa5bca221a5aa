#pragma once

#include <tbb/task_arena.h>
#include <mutex>

#include "probegi/context.h"

namespace probegi {

struct Context::Impl {
    explicit Impl(const ContextDesc& d, int threadCount) : desc(d), threads(threadCount), arena(threadCount) {}

    ContextDesc desc;
    int threads;
    tbb::task_arena arena;
    std::mutex logMutex;
};

}  // namespace probegi
