// SPDX-License-Identifier: MIT
/// What is made when it is first asked for, and kept for those who ask again.
#pragma once

#include <memory>
#include <utility>

#include "support/threads.hpp"

namespace shaftcull::kernel {

/// Something that is made when it is first asked for, by one thread while others wait. Copies share it.
template <class Made>
class MadeOnce {
 public:
  using Shared = std::shared_ptr<const Made>;

  MadeOnce() = default;
  MadeOnce(const MadeOnce& other) : made_(other.made()) {}
  MadeOnce(MadeOnce&&) = delete;
  MadeOnce& operator=(const MadeOnce&) = delete;
  MadeOnce& operator=(MadeOnce&&) = delete;
  ~MadeOnce() = default;

  /// What make() returns, which must be the same from one call to the next but for forget().
  template <class Make>
  [[nodiscard]] Shared of(const Make& make) const {
    const Lock lock(mutex_);
    if (made_ == nullptr) made_ = std::make_shared<const Made>(make());
    return made_;
  }
  /// It would be another one now. Nobody else may be asking.
  void forget() noexcept { made_.reset(); }

 private:
  [[nodiscard]] Shared made() const {
    const Lock lock(mutex_);
    return made_;
  }

  mutable Mutex mutex_;
  mutable Shared made_;
};

/// The same of things that depend on a key: the last one is kept.
template <class Key, class Made>
class MadeForKey {
 public:
  using Shared = std::shared_ptr<const Made>;

  /// What make() returns, which must depend on the key alone.
  template <class Make>
  [[nodiscard]] Shared of(const Key& key, const Make& make) const {
    const Lock lock(mutex_);
    if (made_ == nullptr || !(key_ == key)) {
      Shared made = std::make_shared<const Made>(make());
      made_ = std::move(made);
      key_ = key;
    }
    return made_;
  }

 private:
  mutable Mutex mutex_;
  mutable Shared made_;
  mutable Key key_{};
};

}  // namespace shaftcull::kernel
