// SPDX-License-Identifier: MIT
/// A thread that does one thing after the other.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>

namespace shaftcull::batch {

/// The thread lives as long as the object, so that what threads keep from one call to the next is kept.
class OwnThread {
 public:
  OwnThread() : thread_([this] { run(); }) {}
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;
  /// Does what it was given first.
  ~OwnThread();

  /// Does some work on the thread after all that it was given before. What the work throws, the future does.
  [[nodiscard]] std::future<void> start(std::function<void()> work);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::packaged_task<void()>> given_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace shaftcull::batch
