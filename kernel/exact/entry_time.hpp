/// When the moving box of a shaft reaches a box: exact times, as the constraints that they come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "compiled/moving_faces.hpp"

namespace shaftcull::kernel {

/// The entry times of boxes into one shaft. Construction costs about as much as one time.
///
/// Face f of the moving box is at p + t · q. A face that moves outwards allows the box to touch another only from the
/// time on at which it has reached that one, (x − p) / q for the other's opposite face at x. The entry time of a box
/// that meets the shaft is the largest of these times, or 0 if all are negative.
class EntryTimes {
 public:
  explicit EntryTimes(const ShaftData& shaft) noexcept;

  /// The time (x − p) / q of a face, or 0.
  struct Time {
    double value;   ///< within 2⁻⁵⁰ of it, relatively
    unsigned face;  ///< `zero` for 0
    float x;
  };
  static constexpr unsigned zero = 6;

  /// Of a bound, the corners of which are in separate streams, at position i: not more than its entry time is off by
  /// rounding. The bound need not meet the shaft.
  [[nodiscard]] double rough(const float* const* stream, std::size_t i) const noexcept {
    double time = 0;
    for (unsigned n = 0; n < faces_; ++n) {
      const Face& face = face_[n];
      // An infinite coordinate gives −∞ and NaN nothing at all: neither is a constraint.
      const double reached = (static_cast<double>(stream[face.near][i]) - face.p) * face.inverse;
      if (reached > time) time = reached;
    }
    return time;
  }
  /// The same, and which constraint it comes from.
  [[nodiscard]] Time exact(const float* const* stream, std::size_t i) const noexcept;

  /// Whether a rough time is later than an exact one, whatever rounding did.
  [[nodiscard]] static bool is_surely_later(double rough, const Time& than) noexcept {
    return rough * (1 - entry_margin) > than.value;
  }
  /// −1, 0 or 1: whether one time is earlier than, equal to or later than another.
  [[nodiscard]] int compare(const Time& one, const Time& other) const noexcept;

  /// The largest float that is not larger.
  [[nodiscard]] float rounded_down(const Time& time) const noexcept;

 private:
  /// Twice what values of two times may be off by together is far below this.
  static constexpr double entry_margin = 0x1p-47;

  /// A face that moves outwards.
  struct Face {
    unsigned face;
    unsigned near;  ///< stream of the bound's opposite face
    double p;
    double inverse;  ///< 1 / q
  };
  MovingFaces moving_;
  Face face_[6];
  unsigned faces_ = 0;
};

/// The bound with the least entry time of those offered, and of several the one with the lowest index.
class FirstEntry {
 public:
  static constexpr std::uint64_t none = ~std::uint64_t{0};

  explicit FirstEntry(const ShaftData& shaft) noexcept : times_(shaft) {}

  /// Of the bound at position i of separate streams, which meets the shaft.
  void offer(const float* const* stream, std::size_t i, std::uint64_t index) noexcept {
    if (is_no_first(times_.rough(stream, i), index)) return;
    const EntryTimes::Time time = times_.exact(stream, i);
    const int order = index_ == none ? -1 : times_.compare(time, time_);
    if (order > 0 || (order == 0 && index_ < index)) return;
    time_ = time;
    index_ = index;
  }
  /// Whether no bound with such a rough entry time, or a later one, and such an index, or a higher one, can be first.
  [[nodiscard]] bool is_no_first(double rough, std::uint64_t index) const noexcept {
    if (index_ == none) return false;
    return EntryTimes::is_surely_later(rough, time_) || is_before_all_above(index);
  }
  /// Whether no bound with such an index, or a higher one, can be first.
  [[nodiscard]] bool is_before_all_above(std::uint64_t index) const noexcept {
    return index_ < index && time_.face == EntryTimes::zero;
  }

  [[nodiscard]] const EntryTimes& times() const noexcept { return times_; }
  [[nodiscard]] std::uint64_t index() const noexcept { return index_; }  ///< `none` if nothing was offered
  /// Rounded down; +∞ if nothing was offered.
  [[nodiscard]] float time() const noexcept {
    return index_ == none ? std::numeric_limits<float>::infinity() : times_.rounded_down(time_);
  }

 private:
  EntryTimes times_;
  EntryTimes::Time time_{0, EntryTimes::zero, 0};
  std::uint64_t index_ = none;
};

}  // namespace shaftcull::kernel
