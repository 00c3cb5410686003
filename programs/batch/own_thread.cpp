// SPDX-License-Identifier: MIT
#include "batch/own_thread.hpp"

#include <utility>

namespace shaftcull::batch {

OwnThread::~OwnThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

std::future<void> OwnThread::start(std::function<void()> work) {
  std::packaged_task<void()> task(std::move(work));
  std::future<void> done = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    given_.push(std::move(task));
  }
  changed_.notify_one();
  return done;
}

void OwnThread::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || !given_.empty(); });
    if (given_.empty()) return;
    std::packaged_task<void()> task = std::move(given_.front());
    given_.pop();
    lock.unlock();
    task();
    task = {};  // what it holds is given up before the next one
    lock.lock();
  }
}

}  // namespace shaftcull::batch
