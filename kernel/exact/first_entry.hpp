// SPDX-License-Identifier: MIT
/// Which bound the moving box of a shaft reaches first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "exact/entry_time.hpp"
#include "exact/sphere_entry_time.hpp"
#include "exact/start_overlap.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::kernel {

/// Entry times of the bounds of a view.
template <class View>
using EntryTimesOf = std::conditional_t<std::is_same_v<View, SphereView>, SphereEntryTimes, EntryTimes>;

/// The bound with the least entry time of those offered, and of several the one with the lowest index; without those
/// that the moving box overlaps at the start, if these are skipped. The shaft and what is offered outlive it.
template <class View>
class FirstEntry {
 public:
  static constexpr std::uint64_t none = ~std::uint64_t{0};  ///< above all indices and positions

  explicit FirstEntry(const ShaftData& shaft, bool skips_overlapping = false) noexcept
      : times_(shaft), start_(shaft), skips_overlapping_(skips_overlapping) {}

  /// Of the bound at position i of separate streams, which meets the shaft.
  void offer(const float* const* stream, std::size_t i, std::uint64_t index) noexcept {
    if (is_before_all_above(index) || (index_ != none && times_.is_surely_later(stream, i, time_))) return;
    if (skips_overlapping_ && start_.has(View(), stream, i)) return;
    const Time time = times_.exact(stream, i);
    const int order = index_ == none ? -1 : times_.compare(time, time_);
    if (order > 0 || (order == 0 && index_ < index)) return;
    time_ = time;
    index_ = index;
    stream_ = stream;
    position_ = i;
  }
  /// Whether no bound within a box with such a rough entry time, or a later one, and such an index, or a higher one,
  /// can be first.
  [[nodiscard]] bool is_no_first(double rough, std::uint64_t index) const noexcept {
    if (index_ == none) return false;
    return is_before_all_above(index) || times_.is_surely_later(rough, time_);
  }
  /// Whether no bound with such an index, or a higher one, can be first.
  [[nodiscard]] bool is_before_all_above(std::uint64_t index) const noexcept {
    return index_ < index && time_.is_zero();
  }

  /// Whether one is reached at the start. Then only a bound that is, too, and has a lower index can be first.
  [[nodiscard]] bool is_at_start() const noexcept { return is_there() && time_.is_zero(); }

  /// Rough entry times of boxes around bounds.
  [[nodiscard]] const EntryTimes& times_of_boxes() const noexcept { return times_.times_of_boxes(); }
  [[nodiscard]] bool is_there() const noexcept { return index_ != none; }  ///< whether anything was offered
  [[nodiscard]] std::uint64_t index() const noexcept { return index_; }    ///< `none` if nothing was
  [[nodiscard]] FirstContact contact() const noexcept {
    if (!is_there()) return {};
    return {static_cast<std::uint32_t>(index_), times_.rounded_down(time_), times_.normal(time_, stream_, position_)};
  }

 private:
  using Times = EntryTimesOf<View>;
  using Time = typename Times::Time;

  Times times_;
  StartOverlap start_;
  bool skips_overlapping_;
  Time time_ = Times::zero;
  std::uint64_t index_ = none;
  const float* const* stream_ = nullptr;  ///< where that bound is: at this position
  std::size_t position_ = 0;
};

}  // namespace shaftcull::kernel
