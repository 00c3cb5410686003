// SPDX-License-Identifier: MIT
/// Objects with several owners, each of which can find out whether it is the only one.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace shaftcull::kernel {

/// An object that Shared may own derives from it.
class Ownable {
 public:
  Ownable() noexcept = default;
  Ownable(const Ownable& /*other*/) noexcept {}  // copies have owners of their own
  Ownable& operator=(const Ownable&) = delete;

  void add_owner() noexcept { owners_.fetch_add(1, std::memory_order_relaxed); }
  /// Whether none is left. What other owners have read was read before.
  [[nodiscard]] bool remove_owner() noexcept { return owners_.fetch_sub(1, std::memory_order_acq_rel) == 1; }
  /// Whether there is one owner, who may then write. Unlike std::shared_ptr::use_count(), it waits for what others have
  /// read.
  [[nodiscard]] bool has_one_owner() const noexcept { return owners_.load(std::memory_order_acquire) == 1; }

 protected:
  ~Ownable() = default;

 private:
  std::atomic<std::uint32_t> owners_ = 0;
};

/// One of the owners of an object, or null.
template <class Object>
class Shared {
 public:
  Shared() noexcept = default;
  explicit Shared(Object* object) noexcept : object_(object) {
    if (object_ != nullptr) object_->add_owner();
  }
  Shared(const Shared& other) noexcept : Shared(other.object_) {}
  Shared(Shared&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Shared& operator=(Shared other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Shared() {
    if (object_ != nullptr && object_->remove_owner()) delete object_;
  }

  /// Takes over what one owner of an object, or of none, had.
  [[nodiscard]] static Shared taken_over(Object* object) noexcept {
    Shared shared;
    shared.object_ = object;
    return shared;
  }
  /// Hands it over.
  [[nodiscard]] Object* hand_over() noexcept { return std::exchange(object_, nullptr); }

  [[nodiscard]] Object* get() const noexcept { return object_; }
  [[nodiscard]] Object& operator*() const noexcept { return *object_; }
  [[nodiscard]] Object* operator->() const noexcept { return object_; }
  [[nodiscard]] explicit operator bool() const noexcept { return object_ != nullptr; }
  [[nodiscard]] bool is_only() const noexcept { return object_->has_one_owner(); }

 private:
  Object* object_ = nullptr;
};

}  // namespace shaftcull::kernel
