// SPDX-License-Identifier: MIT
/// How much of the stack calls take: at most 64 KiB, tasks that the calling thread works on included.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "calls/every_call.hpp"
#include "many/workload.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

#if defined(__s390x__)  // where each function leaves room for its callee's registers
constexpr std::size_t promised = std::size_t{72} << 10U;
#else
constexpr std::size_t promised = std::size_t{64} << 10U;
#endif

/// A thread's stack, painted so that what was never written can be told, with a page below it that must not be touched.
class PaintedStack {
 public:
  PaintedStack() : memory_(mmap(nullptr, guard + size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    mprotect(memory_, guard, PROT_NONE);
    std::memset(bottom(), paint, size);
  }
  ~PaintedStack() { munmap(memory_, guard + size); }
  PaintedStack(const PaintedStack&) = delete;
  PaintedStack& operator=(const PaintedStack&) = delete;

  /// Runs `call` on a thread that has this stack, and returns how many bytes of it, from the call on, were written.
  template <class Call>
  std::size_t bytes_written_by(const Call& call) {
    Job<Call> job{&call, nullptr};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, bottom(), size);
    pthread_t thread{};
    const int error = pthread_create(&thread, &attributes, run<Call>, &job);
    pthread_attr_destroy(&attributes);
    if (error != 0) throw std::system_error(error, std::generic_category(), "pthread_create");
    pthread_join(thread, nullptr);
    const std::byte* lowest = bottom();
    while (lowest != job.top && *lowest == std::byte{paint}) ++lowest;
    return static_cast<std::size_t>(job.top - lowest);
  }

 private:
  static constexpr std::size_t guard = 4096;
  static constexpr std::size_t size =
      8 * promised;  // much more than is promised, so that too much is told and not a crash
  static constexpr unsigned char paint = 0xa5;

  template <class Call>
  struct Job {
    const Call* call;
    const std::byte* top;
  };
  template <class Call>
  static void* run(void* argument) {
    auto& job = *static_cast<Job<Call>*>(argument);
    job.top = static_cast<const std::byte*>(__builtin_frame_address(0));
    (*job.call)();
    return nullptr;
  }
  [[nodiscard]] std::byte* bottom() const noexcept { return static_cast<std::byte*>(memory_) + guard; }

  void* memory_;
};

/// Sanitizers and builds without optimisation take more of the stack. Nothing is promised for them.
constexpr bool is_measurable() {
#if defined(__OPTIMIZE__)
  return !has_shadow_memory;
#else
  return false;
#endif
}

TEST(Stack, EveryCallTakesAtMostWhatIsPromised) {
  if (!is_measurable()) GTEST_SKIP() << "not optimised, or with a sanitizer";
  // More than a group of shafts, whole tiles and one that is not, and parts of a tree large enough to be shared.
  const EveryCall every(EveryCall::shafts(70), 6000);
  std::size_t most = 0;
  std::string which;
  for (const int threads : {1, 3}) {
    for (const PublicCall& call : every.calls()) {
      AnswerWords words;
      const std::size_t bytes =
          PaintedStack().bytes_written_by([&] { with_threads(threads, [&] { call.call(words); }); });
      EXPECT_LE(bytes, promised) << call.name << ", threads " << threads;
      if (bytes > most) which = call.name;
      most = std::max(most, bytes);
    }
  }
  RecordProperty("most_bytes", std::to_string(most));
  std::cout << "most: " << most << " bytes, " << which << '\n';
}

TEST(Stack, BuildingALargeTreeTakesAtMostWhatIsPromised) {
  if (!is_measurable()) GTEST_SKIP() << "not optimised, or with a sanitizer";
  const std::vector<Box> boxes = random_boxes(7, 1000000);
  for (const int threads : {1, 3}) {
    const std::size_t bytes = PaintedStack().bytes_written_by(
        [&] { with_threads(threads, [&] { EXPECT_EQ(BoxTree{std::span<const Box>(boxes)}.size(), boxes.size()); }); });
    EXPECT_LE(bytes, promised) << "threads " << threads;
    std::cout << threads << " threads: " << bytes << " bytes\n";
  }
}

}  // namespace
}  // namespace shaftcull
