// SPDX-License-Identifier: MIT
/// Calls in a child that fork() makes.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <vector>

#include "calls/every_call.hpp"
#include "many/workload.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
constexpr bool has_threads = true;
#else
constexpr bool has_threads = false;
#endif

/// The exit code of a child that fork() makes and that runs `call`; 9 if it does not end.
template <class Call>
int exit_code_of_child(const Call& call) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(call() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 9;
}

// oneTBB's threads do not exist in a child, and oneTBB does not know. What needs none works.
TEST(ForkedChild, AChildOfForkMayMakeCallsThatNeedNoOtherThread) {
  if (has_shadow_memory) GTEST_SKIP() << "sanitizers do not survive fork() with threads";
  const std::vector<CompiledShaft> shafts = EveryCall::shafts(9);
  const BoxStream boxes(random_boxes(5, 5000));
  const BoxTree tree(boxes.view());
  const auto answers = [&] {
    AnswerWords words(bit_words(boxes.size()));
    for (const CompiledShaft& shaft : shafts) cull(shaft, boxes.view(), words);
    for (const CompiledShaft& shaft : shafts) words.push_back(count(shaft, tree));
    BoxStream moved(boxes);
    moved.update(7, std::vector<Box>(9, boxes[0]));
    cull(compile(boxes[0], boxes[1]), moved.view(), std::span(words).first(bit_words(boxes.size())));
    return words;
  };
  std::vector<std::uint64_t> counts(shafts.size());
  count_many(shafts, boxes.view(), counts);  // starts threads, where there are any
  const AnswerWords right = answers();
  EXPECT_EQ(exit_code_of_child([&] { return answers() == right; }), 0);
  EXPECT_EQ(answers(), right);
  if (has_threads) return;
  EXPECT_EQ(exit_code_of_child([&] {
              std::vector<std::uint64_t> again(shafts.size());
              count_many(shafts, boxes.view(), again);
              return again == counts;
            }),
            0);
}

}  // namespace
}  // namespace shaftcull
