// SPDX-License-Identifier: MIT
/// Which bounds the moving box of a shaft overlaps at the start.
#pragma once

#include <cstddef>

#include "compiled/shaft_data.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::kernel {

/// As first contact leaves bounds out (Query::skip_overlapping): with closed contact, those that have a point in common
/// with the box at the start; with open contact, those whose relative interior has one in common with that of the box.
/// Coordinates that are NaN put no constraint on a bound, nor do those of a sphere's centre that are infinite. Refers
/// to the shaft.
class StartOverlap {
 public:
  explicit StartOverlap(const ShaftData& shaft) noexcept : start_(shaft.a), is_open_(shaft.contact == Contact::open) {}

  /// Whether the box overlaps a bound, at position i of separate streams of such a view. The shaft keeps the bound.
  [[nodiscard]] bool has(const BoxView& /*of*/, const float* const* stream, std::size_t i) const noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      if (!meets(k, stream[k][i], stream[k + 3][i])) return false;
    }
    return true;
  }
  [[nodiscard]] bool has(const SphereView& of, const float* const* stream, std::size_t i) const noexcept;

  /// Whether the box around some bounds, at position i of six streams, touches it or overlaps it.
  [[nodiscard]] bool touches(const float* const* stream, std::size_t i) const noexcept {
    bool touches = true;
    for (unsigned k = 0; k < 3; ++k) touches &= stream[k][i] <= start_[k + 3] && stream[k + 3][i] >= start_[k];
    return touches;
  }
  /// Whether it overlaps all bounds, none of them empty, that lie in the box at position i of six streams.
  [[nodiscard]] bool has_all_within(const float* const* stream, std::size_t i) const noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      const float lo = stream[k][i];
      const float hi = stream[k + 3][i];
      const bool is_within = is_open_ ? lo > start_[k] && hi < start_[k + 3] : lo >= start_[k] && hi <= start_[k + 3];
      if (!is_within) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool meets(unsigned k, float lo, float hi) const noexcept {
    const float from = start_[k];
    const float to = start_[k + 3];
    if (!is_open_) return !(lo > to || hi < from);
    return from == to && lo == hi ? lo == from : !(lo >= to || hi <= from);
  }

  const float* start_;  // six faces
  bool is_open_;
};

}  // namespace shaftcull::kernel
