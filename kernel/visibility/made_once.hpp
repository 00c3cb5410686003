// SPDX-License-Identifier: MIT
/// Values that are made at first use, and kept for later calls.
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

/// A value that depends on a key. The value for the last key is kept.
template <class Key, class Made>
class MadeForKey {
 public:
  using Shared = std::shared_ptr<const Made>;

  /// The value for a key: the kept one, or else the result of make(), which must depend on the key alone. Other threads
  /// wait meanwhile. If make() throws, the kept value stays.
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
