#include "probegi/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace probegi {
namespace {

TEST(Context, ThreadsOutOfRangeAreRefused) {
    for (const int threads : {-1, 1025}) {
        const auto context = Context::create({.threads = threads});
        ASSERT_FALSE(context);
        EXPECT_EQ(context.error().code, ErrorCode::invalidArgument);
    }
}

// In a separate process, which may not start threads. The limit does not apply to root, so it changes its user.
TEST(Context, ThreadsThatTheSystemDoesNotStartAreASentence) {
    enum { kAsExpected = 7, kNotLimited, kSerialRefused, kNoSentence };
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        constexpr uid_t kNobody = 65534;
        if (geteuid() == 0 && setuid(kNobody) != 0) _exit(kNotLimited);
        const rlimit one{1, 1};
        setrlimit(RLIMIT_NPROC, &one);
        if (!Context::create({.threads = 1})) _exit(kSerialRefused);
        const auto context = Context::create({.threads = 4});
        if (context) _exit(kNotLimited);
        const bool told = context.error().code == ErrorCode::outOfMemory &&
                          context.error().message.find("starts only 1 of 4 threads") != std::string::npos;
        _exit(told ? kAsExpected : kNoSentence);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "it was aborted";
    EXPECT_EQ(WEXITSTATUS(status), kAsExpected);
}

}  // namespace
}  // namespace probegi
