// SPDX-License-Identifier: MIT
/// The line a second of a job.
#include "batch/progress_lines.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace shaftcull::test {
namespace {

using batch::progress_line;
using batch::ProgressForm;
using batch::ProgressLines;

TEST(BatchProgress, TextTellsBlocksRateAndTimeLeft) {
  EXPECT_EQ(progress_line({"compute", 12, 100, 0, 500, 2}, ProgressForm::text),
            "compute: 12 of 100 blocks, 3 kshafts/s, 15 s left");
  EXPECT_EQ(progress_line({"compute", 12, 100, 10, 500'000, 2}, ProgressForm::text),
            "compute: 12 of 100 blocks (10 from an earlier run), 500 kshafts/s, 88 s left");
  EXPECT_EQ(progress_line({"write", 10, 100, 10, 500, 2}, ProgressForm::text),
            "write: 10 of 100 blocks (10 from an earlier run)");
}

TEST(BatchProgress, JsonHasTheSameNumbers) {
  const auto line = nlohmann::json::parse(progress_line({"compute", 12, 100, 2, 500, 2.5}, ProgressForm::json));
  EXPECT_EQ(line["phase"], "compute");
  EXPECT_EQ(line["blocks_done"], 12);
  EXPECT_EQ(line["blocks"], 100);
  EXPECT_EQ(line["blocks_before"], 2);
  EXPECT_EQ(line["seconds"], 2.5);
  EXPECT_EQ(line["shafts_per_second"], 2000);
  EXPECT_EQ(line["seconds_left"], 22);
  const auto nothing = nlohmann::json::parse(progress_line({"compute", 0, 100, 0, 500, 0}, ProgressForm::json));
  EXPECT_TRUE(nothing["shafts_per_second"].is_null());
  EXPECT_TRUE(nothing["seconds_left"].is_null());
}

TEST(BatchProgress, ThereIsALineASecondAndOneAtTheEnd) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  ProgressLines lines(file, ProgressForm::text);
  const ProgressLines::Clock::time_point begin = ProgressLines::Clock::now() + std::chrono::hours(1);
  using std::chrono::milliseconds;
  lines.write({"compute", 1, 9, 0, 1, 0}, begin);
  lines.write({"compute", 2, 9, 0, 1, 0}, begin + milliseconds(999));
  lines.write({"compute", 3, 9, 0, 1, 0}, begin + milliseconds(1000));
  lines.write({"compute", 9, 9, 0, 1, 0}, begin + milliseconds(1001));
  std::rewind(file);
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  EXPECT_EQ(text, "compute: 1 of 9 blocks\ncompute: 3 of 9 blocks\ncompute: 9 of 9 blocks\n");
}

}  // namespace
}  // namespace shaftcull::test
