// SPDX-License-Identifier: MIT
/// Programs that are not like the tests: another locale, instruction sets chosen anew while others ask, more threads
/// than processors.
#include <gtest/gtest.h>

#include <atomic>
#include <clocale>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "calls/every_call.hpp"
#include "instruction_sets.hpp"
#include "many/workload.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

TEST(OddSurroundings, InstructionSetsMayBeChosenWhileOthersAsk) {
  const EveryCall every(EveryCall::shafts(9), random_cases(2500));
  std::vector<AnswerWords> right(every.calls().size());
  for (std::size_t i = 0; i != right.size(); ++i) every.calls()[i].call(right[i]);
  const Isa before = active_isa();
  std::atomic<bool> is_over = false;
  std::thread chooser([&] {
    while (!is_over) {
      for (const Isa isa : available_isas()) {
        select_isa(isa);
        std::this_thread::yield();
      }
    }
  });
  std::vector<std::string> wrong(2);
  std::vector<std::thread> askers;
  for (std::string& name : wrong) {
    askers.emplace_back([&] {
      for (std::size_t i = 0; i != right.size(); ++i) {
        AnswerWords words;
        every.calls()[i].call(words);
        if (words != right[i]) name = every.calls()[i].name;
      }
    });
  }
  for (std::thread& asker : askers) asker.join();
  is_over = true;
  chooser.join();
  select_isa(before);
  EXPECT_EQ(wrong, std::vector<std::string>(2)) << "asked another set's kernels in the middle of a call";
}

TEST(OddSurroundings, MoreThreadsThanProcessorsAnswerTheSame) {
  const EveryCall every(EveryCall::shafts(70), random_cases(5000));
  for (const PublicCall& call : every.calls()) {
    AnswerWords right;
    AnswerWords words;
    with_threads(1, [&] { call.call(right); });
    with_threads(4 * static_cast<int>(std::thread::hardware_concurrency()) + 3, [&] { call.call(words); });
    EXPECT_TRUE(words == right) << call.name;
  }
}

/// Numbers as in 1.234,5.
struct DecimalComma : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST(OddSurroundings, ADecimalCommaChangesNoMessage) {
  const std::vector<CompiledShaft> shafts = EveryCall::shafts(1);
  const BoxStream boxes(random_boxes(5, 500000));
  const auto ask = [&] {
    return message_of([] {
             static_cast<void>(compile({{0.5F, 0, 0}, {0.25F, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}));
           }) +
           message_of([&] { cull(shafts[0], boxes.view(), {}); });
  };
  const std::string right = ask();
  EXPECT_NE(right.find("0.5"), std::string::npos) << right;
  EXPECT_NE(right.find("500000"), std::string::npos) << right;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {  // of the C library, if it is installed
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  const std::locale global = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::string there = ask();
  std::locale::global(global);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(there, right);
}

}  // namespace
}  // namespace shaftcull
