// SPDX-License-Identifier: MIT
/// When the moving box of a shaft reaches a sphere: exact times, as the polynomials that they are roots of.
///
/// With the gaps between the sphere's centre and the faces of box(t), α + t β each (exact/gap.hpp), the sphere is
/// reached at the least t with
///   f(t) = Σ max(α + t β, 0)² − r² ≤ 0.
/// f is convex and has a continuous derivative, and the sphere meets the shaft. So at any t ≥ 0
///   the sphere is reached after t  ⟺  f(t) > 0 and f′(t) < 0.
/// Just before it is reached the same gaps are positive. Of these alone, Σ (α + t β)² − r² is a quadratic polynomial,
/// and the time is the smaller one of its roots.
#pragma once

#include <cstddef>

#include "compiled/moving_faces.hpp"
#include "exact/entry_time.hpp"

namespace shaftcull::kernel {

/// The entry times of spheres into one shaft, which outlives this. Construction costs about as much as one time.
class SphereEntryTimes {
 public:
  explicit SphereEntryTimes(const ShaftData& shaft) noexcept;

  struct Time {
    double low;   ///< not above it
    double high;  ///< not below it
    float sphere[4];
    unsigned gaps;  ///< that are positive just before it, that of face f as bit f: none for 0, and only for that

    [[nodiscard]] bool is_zero() const noexcept { return gaps == 0; }
  };
  static constexpr Time zero{0, 0, {}, 0};

  /// Of a sphere that meets the shaft, at position i of four separate streams: centre and radius. An infinite radius or
  /// one that is NaN reaches everything, and coordinates of the centre that are infinite or NaN put no constraint on
  /// it.
  [[nodiscard]] Time exact(const float* const* stream, std::size_t i) const noexcept;

  /// Whether such a sphere is reached later than another one, as far as doubles can tell: false may mean either.
  [[nodiscard]] bool is_surely_later(const float* const* stream, std::size_t i, const Time& than) const noexcept;
  /// Whether a box, and so what is in it, is reached later, if its rough time is that of times_of_boxes().
  [[nodiscard]] static bool is_surely_later(double rough, const Time& than) noexcept {
    return EntryTimes::is_surely_later(rough, than.high);
  }
  /// −1, 0 or 1: whether one time is earlier than, equal to or later than another.
  [[nodiscard]] int compare(const Time& one, const Time& other) const noexcept;

  /// The largest finite float that is not larger.
  [[nodiscard]] float rounded_down(const Time& time) const noexcept;

  /// The normal of contact with a sphere at position i, which is reached at `time`: from its centre to the nearest
  /// point of the moving box, each component rounded to nearest. Zero if the box does not move into the sphere.
  [[nodiscard]] Vec3 normal(const Time& time, const float* const* stream, std::size_t i) const noexcept;

  /// For the boxes around some spheres.
  [[nodiscard]] const EntryTimes& times_of_boxes() const noexcept { return boxes_; }

 private:
  struct Starts;
  enum class Place : unsigned char { before, not_before, unknown };

  [[nodiscard]] Place place(const Starts& starts, double t) const noexcept;
  [[nodiscard]] double approximate(const Starts& starts) const noexcept;

  EntryTimes boxes_;
  MovingFaces faces_;
  double slope_[6];          // β of the gap of each face, rounded once
  double minus_inverse_[6];  // −1 / β; of a gap that does not change, 0
};

}  // namespace shaftcull::kernel
