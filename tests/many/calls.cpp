// SPDX-License-Identifier: MIT
/// How calls for many behave: what they refuse, and where they run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "many/workload.hpp"
#include "message_of.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

class ManyErrors : public testing::Test {
 protected:
  std::vector<CompiledShaft> shafts_ = random_shafts(91, 3);
  const BoxColumns boxes_{random_boxes(92, 300)};
  const SphereColumns spheres_{random_spheres(93, 300)};
  std::vector<std::uint64_t> rows_ = std::vector<std::uint64_t>(15, 7);
  std::vector<std::uint64_t> inside_ = rows_;
};

TEST_F(ManyErrors, RowsOfTheWrongSizeAreRefusedWithBothSizes) {
  std::vector<std::uint64_t> wrong(14, 7);
  const auto names_sizes = testing::AllOf(HasSubstr("14"), HasSubstr("15"));
  EXPECT_THAT(message_of([&] { cull_many(shafts_, boxes_.view(), wrong); }), names_sizes);
  EXPECT_THAT(message_of([&] { cull_many(shafts_, spheres_.view(), wrong); }), names_sizes);
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_.view(), wrong, rows_); }), names_sizes);
  EXPECT_THAT(message_of([&] { classify_many(shafts_, spheres_.view(), rows_, wrong); }), names_sizes);
  EXPECT_EQ(wrong, std::vector<std::uint64_t>(14, 7));
  EXPECT_EQ(rows_, std::vector<std::uint64_t>(15, 7)) << "written before the error was found";
}

TEST_F(ManyErrors, RowsThatShareMemoryAreRefused) {
  std::vector<std::uint64_t> both(29, 7);
  const std::span<std::uint64_t> kept = std::span(both).first(15);
  const auto names_them = HasSubstr("classify_many: kept_rows and inside_rows share memory");
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_.view(), kept, kept); }), names_them);
  EXPECT_THAT(message_of([&] { classify_many(shafts_, spheres_.view(), kept, std::span(both).last(15)); }), names_them);
  EXPECT_EQ(both, std::vector<std::uint64_t>(29, 7));
}

TEST_F(ManyErrors, ASpanOfCountsOfTheWrongSizeIsRefused) {
  std::vector<std::uint64_t> counts(4, 7);
  EXPECT_THAT(message_of([&] { count_many(shafts_, boxes_.view(), counts); }),
              testing::AllOf(HasSubstr("4"), HasSubstr("3")));
  EXPECT_EQ(counts, std::vector<std::uint64_t>(4, 7));
}

TEST_F(ManyErrors, AShaftThatWasNeverFormedIsNamedBeforeAnythingIsWritten) {
  shafts_.back() = CompiledShaft();
  std::vector<std::uint64_t> counts(3, 7);
  IndexLists lists{{0, 1}, {5}};
  const auto names_it = HasSubstr("shaft 2 was never formed");
  EXPECT_THAT(message_of([&] { cull_many(shafts_, boxes_.view(), rows_); }), names_it);
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_.view(), rows_, inside_); }), names_it);
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_.view(), {}, inside_); }), names_it);
  EXPECT_THAT(message_of([&] { count_many(shafts_, spheres_.view(), counts); }), names_it);
  EXPECT_THAT(message_of([&] { list_many(shafts_, spheres_.view(), lists); }), names_it);
  EXPECT_EQ(rows_, std::vector<std::uint64_t>(15, 7));
  EXPECT_EQ(inside_, std::vector<std::uint64_t>(15, 7));
  EXPECT_EQ(counts, std::vector<std::uint64_t>(3, 7));
  EXPECT_EQ(lists.indices, std::vector<std::uint32_t>{5});
}

#if SIZE_MAX > UINT32_MAX
TEST_F(ManyErrors, ListsOfMoreBoundsThanIndicesReachAreRefused) {
  BoxView view = boxes_.view();
  view.count = (std::size_t{1} << 32U) + 1;  // never read
  IndexLists lists;
  EXPECT_THAT(message_of([&] { list_many(shafts_, view, lists); }),
              HasSubstr("4294967297 bounds, but 32-bit indices reach 4294967295; ask slices of the view"));
}
#endif

TEST(ManyCalls, NoShaftsOrNoBoundsHaveEmptyLists) {
  const BoxColumns boxes(random_boxes(94, 10));
  const std::vector<CompiledShaft> shafts = random_shafts(95, 2);
  cull_many({}, boxes.view(), {});
  classify_many(shafts, BoxView{}, {}, {});
  IndexLists lists;
  list_many(shafts, BoxView{}, lists);
  EXPECT_EQ(lists.offsets, std::vector<std::uint64_t>(3, 0));
  list_many({}, boxes.view(), lists);
  EXPECT_EQ(lists.offsets, std::vector<std::uint64_t>(1, 0));
  EXPECT_EQ(lists.size(), 0U);
}

#if defined(__STDCPP_THREADS__)

TEST(ManyCalls, CallsFromManyThreadsDoNotDisturbEachOther) {
  const BoxColumns boxes(random_boxes(100, 20000));
  const std::vector<CompiledShaft> shafts = random_shafts(101, 20);
  const ExpectedRows expected(shafts, boxes.view());
  std::vector<std::vector<std::uint64_t>> rows(4, std::vector<std::uint64_t>(expected.kept.size()));
  std::vector<std::thread> threads;
  for (std::vector<std::uint64_t>& own : rows) {
    threads.emplace_back([&] { cull_many(shafts, boxes.view(), own); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<std::uint64_t>& own : rows) EXPECT_EQ(own, expected.kept);
}

#endif

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB

// Calls for many shafts hand out their work by parallel_for().

TEST(ManyCalls, WorkRunsInsideTheCallersArena) {
  for (const int threads : {1, 3}) {
    with_threads(threads, [&] {
      EXPECT_EQ(concurrency(), threads);
      kernel::parallel_for(400, 8, [threads](std::size_t, std::size_t) {
        EXPECT_EQ(tbb::this_task_arena::max_concurrency(), threads);
        EXPECT_LT(tbb::this_task_arena::current_thread_index(), threads);
      });
    });
  }
}

TEST(ManyCalls, AnArenaOfOneThreadIsTheCallersOwn) {
  const std::thread::id caller = std::this_thread::get_id();
  tbb::task_arena(1).execute([&] {
    kernel::parallel_for(200, 8, [caller](std::size_t, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
  });
}

#else

TEST(ManyCalls, WithoutOneTbbThereIsOneThread) { EXPECT_EQ(concurrency(), 1); }

#endif

}  // namespace
}  // namespace shaftcull
