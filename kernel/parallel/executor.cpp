// SPDX-License-Identifier: MIT
#include "parallel/executor.hpp"

#include <algorithm>
#include <atomic>
#include <exception>

#include "support/float_environment.hpp"
#include "support/threads.hpp"

namespace shaftcull::kernel {
namespace {

std::atomic<Executor*> current_executor{nullptr};

/// Whether this thread runs a task of an executor.
bool& is_in_task() noexcept {
  SHAFTCULL_OF_THIS_THREAD bool in_task = false;
  return in_task;
}

/// The first exception of some tasks, which reaches the caller when all have ended.
class FirstException {
 public:
  template <class Work>
  void keep(const Work& work) noexcept {
#if defined(__cpp_exceptions)
    try {
      work();
    } catch (...) {
      const Lock lock(mutex_);
      if (!first_) first_ = std::current_exception();
      is_there_.store(true, std::memory_order_relaxed);
    }
#else
    work();
#endif
  }
  /// Whether what is left need not be done.
  [[nodiscard]] bool is_there() const noexcept { return is_there_.load(std::memory_order_relaxed); }
  void rethrow() const {
#if defined(__cpp_exceptions)
    if (first_) std::rethrow_exception(first_);
#endif
  }

 private:
  std::exception_ptr first_;
  std::atomic<bool> is_there_ = false;
  Mutex mutex_;
};

}  // namespace

Executor* executor_in_use() noexcept { return current_executor.load(std::memory_order_acquire); }

void run_on(Executor& executor, std::size_t rows, std::size_t columns,
            FunctionRef<void(std::size_t, std::size_t)> body) {
  const std::size_t items = rows * columns;
  const std::size_t tasks = is_in_task() ? 1 : std::min(items, std::max<std::size_t>(executor.threads(), 1));
  if (tasks <= 1) {
    return in_float_environment([&] {
      for (std::size_t i = 0; i != items; ++i) body(i / columns, i % columns);
    });
  }
  std::atomic<std::size_t> next = 0;
  FirstException exception;
  executor.run(tasks, [&](std::size_t /*task*/) {
    bool& in_task = is_in_task();
    in_task = true;
    exception.keep([&] {
      in_float_environment([&] {
        for (std::size_t i = next.fetch_add(1); i < items && !exception.is_there(); i = next.fetch_add(1)) {
          body(i / columns, i % columns);
        }
      });
    });
    in_task = false;
  });
  exception.rethrow();
}

void run_in_order_on(Executor& executor, std::size_t count, std::size_t slots,
                     FunctionRef<void(std::size_t, std::size_t)> work,
                     FunctionRef<void(std::size_t, std::size_t)> deliver) {
  for (std::size_t first = 0; first < count; first += slots) {
    const std::size_t size = std::min(slots, count - first);
    run_on(executor, size, 1, [&](std::size_t slot, std::size_t) { work(first + slot, slot); });
    for (std::size_t slot = 0; slot != size; ++slot) deliver(first + slot, slot);
  }
}

}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

Executor::~Executor() = default;

Executor* set_executor(Executor* executor) noexcept {
  return kernel::current_executor.exchange(executor, std::memory_order_acq_rel);
}

}  // namespace shaftcull
