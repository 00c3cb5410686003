// SPDX-License-Identifier: MIT
/// When the moving box of a shaft reaches a box: exact times, as the constraints that they come from.
#pragma once

#include <cstddef>

#include "compiled/moving_faces.hpp"
#include "shaftcull/bounds.hpp"

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
    unsigned face;  ///< `no_face` for 0
    float x;

    [[nodiscard]] bool is_zero() const noexcept { return face == no_face; }
  };
  static constexpr unsigned no_face = 6;
  static constexpr Time zero{0, no_face, 0};

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

  /// Whether a rough time is later than an exact one, whatever rounding did. Of the exact one, the value or any that is
  /// not lower.
  [[nodiscard]] static bool is_surely_later(double rough, double than) noexcept {
    return rough * (1 - entry_margin) > than;
  }
  [[nodiscard]] static bool is_surely_later(double rough, const Time& than) noexcept {
    return is_surely_later(rough, than.value);
  }
  /// The same of such a bound as above.
  [[nodiscard]] bool is_surely_later(const float* const* stream, std::size_t i, const Time& than) const noexcept {
    return is_surely_later(rough(stream, i), than);
  }
  /// −1, 0 or 1: whether one time is earlier than, equal to or later than another.
  [[nodiscard]] int compare(const Time& one, const Time& other) const noexcept;

  /// The largest float that is not larger.
  [[nodiscard]] float rounded_down(const Time& time) const noexcept;

  /// The normal of contact with a bound at position i, which is reached at `time`: along the lowest axis of those whose
  /// constraints hold from then on. Zero if there is none, as the box does not move into the bound.
  [[nodiscard]] Vec3 normal(const Time& time, const float* const* stream, std::size_t i) const noexcept;

  /// For the boxes around some bounds.
  [[nodiscard]] const EntryTimes& times_of_boxes() const noexcept { return *this; }

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

}  // namespace shaftcull::kernel
