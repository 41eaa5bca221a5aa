#include "probegi/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace probegi {
namespace {

struct Base {
    virtual ~Base() = default;
};
struct Derived : Base {};

Result<int> half(int number) {
    if (number % 2) return fail(ErrorCode::malformed, "the number is odd");
    return number / 2;
}

Result<void> even(int number) {
    if (const auto halved = half(number); !halved) return halved.error();
    return {};
}

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> two = half(4), none = half(3);
    ASSERT_TRUE(two);
    EXPECT_EQ(*two, 2);
    EXPECT_EQ(two.value(), 2);
    EXPECT_EQ(two.value_or(7), 2);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::malformed);
    EXPECT_EQ(none.error().message, "the number is odd");
    EXPECT_EQ(none.value_or(7), 7);
}

TEST(Result, ValueThrowsTheError) {
    try {
        half(3).value();
        FAIL() << "nothing was thrown";
    } catch (const std::exception& thrown) {
        EXPECT_STREQ(thrown.what(), "the number is odd");
        const auto* bad = dynamic_cast<const BadResult*>(&thrown);
        ASSERT_TRUE(bad);
        EXPECT_EQ(bad->error().code, ErrorCode::malformed);
    }
}

TEST(Result, OfVoidHasAValueToo) {
    even(4).value();
    EXPECT_TRUE(even(4));
    EXPECT_THROW(even(3).value(), BadResult);
}

TEST(Result, OfWhatOnlyMovesIsMovedAndAssigned) {
    Result<std::unique_ptr<Base>> made = fail(ErrorCode::outOfMemory, "no memory");
    EXPECT_FALSE(made);
    made = std::make_unique<Derived>();
    ASSERT_TRUE(made);
    Base* const base = made->get();
    const std::unique_ptr<Base> taken = std::move(made).value();
    EXPECT_EQ(taken.get(), base);
    made = Error{ErrorCode::cancelled, "cancelled"};
    EXPECT_EQ(made.error().code, ErrorCode::cancelled);
}

TEST(Result, StepsFollowUntilOneFails) {
    EXPECT_EQ(half(12).and_then(half).value(), 3);
    EXPECT_EQ(half(6).and_then(half).error().message, "the number is odd");
    EXPECT_EQ(half(12).transform([](int n) { return n + 0.5; }).value(), 6.5);
    int calls = 0;
    EXPECT_TRUE(half(12).transform([&](int) { ++calls; }));
    EXPECT_FALSE(half(3).transform([&](int) { ++calls; }));
    EXPECT_TRUE(even(2).and_then([&] { return even(4); }).transform([&] { ++calls; }));
    EXPECT_FALSE(even(2).and_then([&] { return even(5); }).transform([&] { ++calls; }));
    EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace probegi
