// SPDX-License-Identifier: MIT
/// Jobs that were interrupted go on, and end with the file of one that was not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/job_fixture.hpp"
#include "batch/npy.hpp"
#include "batch/thread_ranks.hpp"
#include "message_of.hpp"

namespace shaftcull::test {
namespace {

using batch::Answer;
using batch::BoundKind;
using batch::Job;
using batch::JobReport;
using batch::ShaftKind;
using testing::HasSubstr;

/// Asks a run to end when it has been asked so often whether it is to.
batch::Surroundings interrupted_after(std::atomic<int>& asked, int times) {
  return {[](const std::function<void()>& work) { work(); }, [&asked, times] { return ++asked > times ? SIGTERM : 0; }};
}

TEST_F(BatchJob, AnInterruptedJobGoesOn) {
  for (const std::uint64_t memory : {0U, 60'000U}) {
    job.memory = memory;
    job.question.answer = Answer::classify;
    std::filesystem::remove(job.out);
    run(job);
    const std::string whole = bytes_of_file(job.out);
    std::filesystem::remove(job.out);
    int interruptions = 0;
    for (int times = 1; times < 1000; times += 7) {
      std::atomic<int> asked = 0;
      try {
        run(job, interrupted_after(asked, times));
        break;
      } catch (const batch::Stopped& stopped) {
        EXPECT_EQ(stopped.signal(), SIGTERM);
        EXPECT_THAT(stopped.what(), HasSubstr("out.h5.parts"));
        EXPECT_FALSE(std::filesystem::exists(job.out)) << "a file that is not whole has no name";
        ++interruptions;
      }
    }
    EXPECT_GT(interruptions, 1);
    EXPECT_TRUE(bytes_of_file(job.out) == whole);
  }
}

/// Stops a job when some of its blocks are there.
void stop_half_way(const Job& job) {
  std::atomic<int> asked = 0;
  EXPECT_THROW(run(job, interrupted_after(asked, 11)), batch::Stopped);
}

std::vector<std::string> blocks_in(const std::string& folder) {
  std::vector<std::string> blocks;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("block-")) blocks.push_back(entry.path().string());
  }
  std::ranges::sort(blocks);
  return blocks;
}

TEST_F(BatchJob, TornAndDamagedBlocksAreDoneAgain) {
  job.question.answer = Answer::list;
  run(job);
  const std::string whole = bytes_of_file(job.out);
  job.block = 10;
  stop_half_way(job);
  const std::vector<std::string> blocks = blocks_in(job.out + ".parts");
  ASSERT_GE(blocks.size(), 3);
  std::string damaged = bytes_of_file(blocks[0]);
  damaged.back() = static_cast<char>(damaged.back() + 1);
  write_file(blocks[0], damaged);
  std::filesystem::resize_file(blocks[1], std::filesystem::file_size(blocks[1]) - 1);
  write_file(job.out + ".parts/rank-0", "what a killed rank was writing");
  const JobReport report = run(job);
  EXPECT_EQ(report.blocks_before, blocks.size() - 2);
  EXPECT_TRUE(bytes_of_file(job.out) == whole);
}

TEST_F(BatchJob, OtherInputsThanThoseOfTheUnfinishedJobAreRefused) {
  const auto refusal = [](const Job& other) { return message_of([&] { run(other); }); };
  job.block = 10;
  stop_half_way(job);
  Job other = job;
  other.question.answer = Answer::list;
  EXPECT_THAT(refusal(other), AllOf(HasSubstr("unfinished job"), HasSubstr("answer was count, and is list now")));
  other = job;
  other.question.contact = Contact::open;
  EXPECT_THAT(refusal(other), HasSubstr("contact was closed, and is open now"));
  other = job;
  other.block = 11;
  EXPECT_THAT(refusal(other), HasSubstr("block was 10, and is 11 now"));
  other = job;
  other.memory = 60'000;
  EXPECT_THAT(refusal(other), HasSubstr("shares was 1, and is "));

  const std::vector<float> shaft_floats = random_shafts(ShaftKind::between);
  std::vector<float> changed = shaft_floats;
  changed.back() += 1;
  write_floats(job.shafts, 12, changed);
  EXPECT_THAT(refusal(job), HasSubstr("shafts was (230, 12) of float32 "));
  write_floats(job.shafts, 12, shaft_floats);
  std::vector<float> bound_floats = random_bounds(BoundKind::box);
  bound_floats.resize(bound_floats.size() - 6);
  write_floats(job.bounds, 6, bound_floats);
  EXPECT_THAT(refusal(job),
              AllOf(HasSubstr("bounds was (1500, 6) of float32 "), HasSubstr("is (1499, 6) of float32 ")));
  write_floats(job.bounds, 6, random_bounds(BoundKind::box));
  EXPECT_GT(run(job).blocks_before, 0) << "with what it was begun with it goes on";
}

TEST_F(BatchJob, AnotherRunOfTheSameJobIsKeptOut) {
  job.block = 10;
  std::string told;
  const batch::Surroundings within{[](const std::function<void()>& work) { work(); },
                                   [&] {
                                     if (told.empty()) told = message_of<std::runtime_error>([&] { run(job); });
                                     return 0;
                                   }};
  run(job, within);
  EXPECT_THAT(told, HasSubstr("another run is working on this job"));
}

}  // namespace
}  // namespace shaftcull::test
