// SPDX-License-Identifier: MIT
/// References to callbacks: they call what they refer to, own nothing, and tell whether they are empty.
#include "shaftcull/function_ref.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace shaftcull {
namespace {

using Twice = FunctionRef<int(int)>;

int twice(int x) { return 2 * x; }

int result_of(Twice function, int x) { return function(x); }

TEST(FunctionRef, ALambdaIsCalledWhereItLies) {
  int calls = 0;
  const auto lambda = [&calls](int x) {
    ++calls;
    return 2 * x;
  };
  EXPECT_EQ(result_of(lambda, 21), 42);
  EXPECT_EQ(result_of([&calls](int x) { return x + calls; }, 5), 6);
  EXPECT_EQ(calls, 1);
}

TEST(FunctionRef, AMutableCallableKeepsItsState) {
  auto counter = [count = 0](int step) mutable { return count += step; };
  const Twice reference = counter;
  EXPECT_EQ(reference(2), 2);
  EXPECT_EQ(reference(3), 5);
  EXPECT_EQ(counter(1), 6) << "the reference called a copy";
}

TEST(FunctionRef, FunctionsAndPointersToThemAreCalled) {
  EXPECT_EQ(result_of(twice, 4), 8);
  EXPECT_EQ(result_of(&twice, 4), 8);
  const std::function<int(int)> function = twice;
  EXPECT_EQ(result_of(function, 4), 8);
  EXPECT_EQ(result_of(std::ref(twice), 4), 8);
}

TEST(FunctionRef, ArgumentsArePassedOnAndNotCopied) {
  const auto text_of = [](std::unique_ptr<std::string> text) { return *text; };
  const FunctionRef<std::string(std::unique_ptr<std::string>)> take = text_of;
  EXPECT_EQ(take(std::make_unique<std::string>("moved")), "moved");
}

TEST(FunctionRef, AResultMayBeIgnored) {
  int seen = 0;
  const auto look = [&seen](int x) { return seen = x; };
  const FunctionRef<void(int)> call = look;
  call(7);
  EXPECT_EQ(seen, 7);
}

TEST(FunctionRef, CopiesReferToTheSame) {
  int calls = 0;
  const auto lambda = [&calls](int x) { return x + ++calls; };
  Twice first = lambda;
  const Twice second = first;
  EXPECT_EQ(second(0), 1);
  first = Twice(twice);
  EXPECT_EQ(second(0), 2);
  EXPECT_EQ(first(2), 4);
}

TEST(FunctionRef, IsEmptyIfMadeOfNothing) {
  EXPECT_FALSE(Twice(std::function<int(int)>()));
  int (*const null)(int) = nullptr;
  EXPECT_FALSE(Twice(null));
  EXPECT_TRUE(Twice(twice));
  EXPECT_TRUE(Twice([](int x) { return x; }));
}

static_assert(!std::is_constructible_v<Twice, int>, "an int cannot be called");
static_assert(!std::is_constructible_v<Twice, void (*)(int)>, "a result is asked for");
static_assert(!std::is_default_constructible_v<Twice>);
static_assert(std::is_trivially_copyable_v<Twice>);
static_assert(sizeof(Twice) == 2 * sizeof(void*));

}  // namespace
}  // namespace shaftcull
