#pragma once

#include <memory>
#include <mutex>

#include "core/workers.h"
#include "probegi/context.h"

namespace probegi {

struct Context::Impl {
    ContextDesc desc;
    int threads = 1;
    std::unique_ptr<Workers> workers;  ///< null: the calling thread, or the engine's jobs
    std::mutex logMutex;
};

}  // namespace probegi
