// SPDX-License-Identifier: MIT
/// Ladders that threads share.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "support/threads.hpp"
#include "visibility/ladder.hpp"

namespace shaftcull::kernel {

/// Ladders of one job. As many are made as are borrowed at the same time.
class LadderPool {
 public:
  explicit LadderPool(const SightJob& job) noexcept : job_(job) {}

  /// A ladder that is one thread's until it goes.
  class Borrowed {
   public:
    explicit Borrowed(LadderPool& pool) : pool_(pool) {
      const Lock lock(pool.mutex_);
      if (pool.free_.empty()) {
        pool.free_.reserve(++pool.made_);  // so that giving back allocates nothing
        ladder_ = std::make_unique<Ladder>(pool.job_);
      } else {
        ladder_ = std::move(pool.free_.back());
        pool.free_.pop_back();
      }
    }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed() {
      const Lock lock(pool_.mutex_);
      pool_.free_.push_back(std::move(ladder_));
    }
    Ladder* operator->() const noexcept { return ladder_.get(); }

   private:
    LadderPool& pool_;
    std::unique_ptr<Ladder> ladder_;
  };

 private:
  const SightJob& job_;
  Mutex mutex_;
  std::vector<std::unique_ptr<Ladder>> free_;
  std::size_t made_ = 0;
};

}  // namespace shaftcull::kernel
