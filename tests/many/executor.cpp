// SPDX-License-Identifier: MIT
/// Parallel calls on a plain thread pool of the caller's: the same results, on its threads and no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "many/workload.hpp"
#include "shaftcull/shaftcull.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {
namespace {

/// Threads that take tasks from one list.
class Pool final : public Executor {
 public:
  explicit Pool(std::size_t threads) {
    for (std::size_t i = 0; i != threads; ++i) threads_.emplace_back([this] { work(); });
  }
  ~Pool() override {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    EXPECT_LE(count, threads());
    EXPECT_GE(count, 2U);
    std::unique_lock lock(mutex_);
    std::size_t left = count;
    for (std::size_t i = 0; i != count; ++i) {
      tasks_.emplace_back([this, task, i, &left] {
        task(i);
        const std::lock_guard ended(mutex_);
        ++runs_;
        if (--left == 0) changed_.notify_all();
      });
    }
    changed_.notify_all();
    changed_.wait(lock, [&] { return left == 0; });
  }
  [[nodiscard]] std::size_t threads() const noexcept override { return threads_.size(); }
  [[nodiscard]] std::size_t runs() {
    const std::lock_guard lock(mutex_);
    return runs_;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return is_over_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      const std::function<void()> task = std::move(tasks_.back());
      tasks_.pop_back();
      lock.unlock();
      task();
      lock.lock();
    }
  }
  std::vector<std::thread> threads_;
  std::vector<std::function<void()>> tasks_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t runs_ = 0;
  bool is_over_ = false;
};

class UseExecutor {
 public:
  explicit UseExecutor(Executor& executor) : before_(set_executor(&executor)) {}
  ~UseExecutor() { set_executor(before_); }
  UseExecutor(const UseExecutor&) = delete;
  UseExecutor& operator=(const UseExecutor&) = delete;

 private:
  Executor* before_;
};

/// What all kinds of parallel calls answer.
struct Answers {
  Indices order;
  Indices order_after_rebuilding;
  IndexLists of_tree;
  IndexLists of_view;
  std::vector<std::uint64_t> counts;
  std::vector<std::uint64_t> bits;
  SightCounts sights{};
  Indices of_dynamic_tree;

  Answers() {
    Random random(80);
    const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 100000);
    const std::vector<CompiledShaft> shafts = shafts_for(random, 200);
    BoxTree tree{std::span<const Box>(boxes)};
    order.assign(tree.order().begin(), tree.order().end());
    tree.update(std::span<const Box>(boxes));
    tree.rebuild();
    order_after_rebuilding.assign(tree.order().begin(), tree.order().end());
    list_many(shafts, tree, of_tree);
    const BoxStream stream(boxes);
    list_many(shafts, stream.view(), of_view);
    counts.resize(shafts.size());
    count_many(shafts, stream.view(), counts);
    bits.resize(bit_words(shafts.size()));
    any_many(shafts, tree, bits);
    const std::vector<Box> patches = scene<Box>(random, Shape::uniform, 500);
    Occluders occluders;
    occluders.add_solids(std::span<const Box>(boxes).first(300));
    sights = count_visibility(PatchSet(patches), occluders);
    DynamicBoxTree dynamic;
    std::vector<BoundId> ids(boxes.size());
    dynamic.insert(boxes, ids);
    dynamic.commit();
    dynamic.erase(std::span<const BoundId>(ids).first(20000));
    dynamic.commit();
    list(shafts[0], dynamic, of_dynamic_tree);
  }
  friend bool operator==(const Answers& a, const Answers& b) {
    return a.order == b.order && a.order_after_rebuilding == b.order_after_rebuilding &&
           a.of_tree.offsets == b.of_tree.offsets && a.of_tree.indices == b.of_tree.indices &&
           a.of_view.offsets == b.of_view.offsets && a.of_view.indices == b.of_view.indices && a.counts == b.counts &&
           a.bits == b.bits && a.sights.occluded == b.sights.occluded && a.sights.clear == b.sights.clear &&
           a.sights.total() == b.sights.total() && a.of_dynamic_tree == b.of_dynamic_tree;
  }
};

TEST(Executors, AnswersAreTheSameOnAnyOfThem) {
  const Answers expected;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    Pool pool(threads);
    const UseExecutor use(pool);
    EXPECT_EQ(static_cast<std::size_t>(concurrency()), threads);
    EXPECT_EQ(Answers() == expected, true) << threads;
    if (threads > 1) {
      EXPECT_GT(pool.runs(), 20U);
    } else {
      EXPECT_EQ(pool.runs(), 0U);  // one thread is the calling one
    }
  }
  EXPECT_EQ(Answers() == expected, true);
}

TEST(Executors, ManyThreadsMayCallAtOnce) {
  const Answers expected;
  Pool pool(3);
  const UseExecutor use(pool);
  std::atomic<int> equal = 0;
  std::vector<std::thread> callers;
  for (int i = 0; i != 3; ++i) callers.emplace_back([&] { equal += Answers() == expected ? 1 : 0; });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(equal, 3);
}

/// All tasks one after the other, on the calling thread.
class OneByOne final : public Executor {
 public:
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i != count; ++i) task(i);
  }
  [[nodiscard]] std::size_t threads() const noexcept override { return 5; }
};

TEST(Executors, TasksMayRunOneAfterAnother) {
  const Answers expected;
  OneByOne executor;
  const UseExecutor use(executor);
  EXPECT_EQ(Answers() == expected, true);
}

/// All tasks at the same time, each on a thread of its own: none begins before all are there.
class AtOnce final : public Executor {
 public:
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::atomic<std::size_t> missing = count;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i != count; ++i) {
      threads.emplace_back([&missing, task, i] {
        --missing;
        while (missing.load() != 0) std::this_thread::yield();
        task(i);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  [[nodiscard]] std::size_t threads() const noexcept override { return 2; }
};

// Where a sanitizer watches threads, it sees what two tasks share: those of oneTBB and of a pool may both run on one
// thread.
TEST(Executors, TasksAtOnceShareNothingThatTheyWrite) {
  AtOnce executor;
  const UseExecutor use(executor);
  // Each half has one box for each of the shafts, which only it finds.
  std::vector<Box> boxes(16384, Box{{0, 9, 0}, {1, 10, 1}});
  boxes[5] = {{50, 0, 0}, {51, 1, 1}};
  boxes[10000] = {{40, 0, 0}, {41, 1, 1}};
  const std::vector<CompiledShaft> shafts(64, compile({{0, 0, 0}, {1, 1, 1}}, {{99, 0, 0}, {100, 1, 1}}));
  const BoxStream stream{std::span<const Box>(boxes)};
  for (int call = 0; call != 5; ++call) {
    std::vector<FirstContact> contacts(shafts.size());
    first_contact_many(shafts, stream, contacts);
    for (const FirstContact& contact : contacts) EXPECT_EQ(contact.index, 10000U);
    std::vector<std::uint64_t> counts(shafts.size());
    count_many(shafts, stream, counts);
    EXPECT_EQ(counts, std::vector<std::uint64_t>(shafts.size(), 2));
    std::vector<std::uint64_t> bits(bit_words(shafts.size()));
    any_many(shafts, stream, bits);
    EXPECT_EQ(bits, std::vector<std::uint64_t>{~std::uint64_t{0}});
  }
}

TEST(Executors, ExceptionsReachTheCaller) {
  Pool pool(4);
  const UseExecutor use(pool);
  Random random(81);
  std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 200000);
  boxes[150000].lo[0] = infinity;
  try {
    const BoxTree tree{std::span<const Box>(boxes)};
    ADD_FAILURE() << "a bad box was taken";
  } catch (const BadBound& error) {
    EXPECT_EQ(error.index(), 150000U);
  }
  const PatchSet patches(scene<Box>(random, Shape::uniform, 300));
  const auto deliver = [](const SightBatch& /*batch*/) { throw std::runtime_error("enough"); };
  EXPECT_THROW(visibility(patches, Occluders(), deliver), std::runtime_error);
  EXPECT_EQ(Answers() == Answers(), true);  // nothing hangs
}

}  // namespace
}  // namespace shaftcull
