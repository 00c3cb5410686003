// SPDX-License-Identifier: MIT
/// Which boxes a shaft between two boxes meets, in a loop over records: as one writes it for a few boxes, rounding
/// included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"

namespace shaftcull::bench {

/// The box that moves from a to b, at a time from 0 to 1. A box is met if at one time all of six inequalities hold:
/// each says that the time is at least, or at most, (face − at) · inverse.
class SlabLoop {
 public:
  SlabLoop(const Box& a, const Box& b) noexcept {
    for (std::size_t k = 0; k != 3; ++k) {
      add(k + 3, a.lo[k], b.lo[k] - a.lo[k], true);
      add(k, a.hi[k], b.hi[k] - a.hi[k], false);
    }
  }

  [[nodiscard]] bool meets(const Box& box) const noexcept {
    const float face[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
    float least = 0;
    float most = 1;
    for (std::size_t i = 0; i != lower_; ++i) {
      const float t = (face[at_least_[i].face] - at_least_[i].at) * at_least_[i].inverse;
      least = t > least ? t : least;
    }
    for (std::size_t i = 0; i != upper_; ++i) {
      const float t = (face[at_most_[i].face] - at_most_[i].at) * at_most_[i].inverse;
      most = t < most ? t : most;
    }
    for (std::size_t i = 0; i != resting_; ++i) {
      const bool is_met =
          at_rest_[i].inverse > 0 ? at_rest_[i].at <= face[at_rest_[i].face] : at_rest_[i].at >= face[at_rest_[i].face];
      if (!is_met) return false;
    }
    return least <= most;
  }

  /// A bit for each box.
  [[nodiscard]] std::uint64_t meets(std::span<const Box> boxes) const noexcept {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i != boxes.size(); ++i) bits |= std::uint64_t{meets(boxes[i])} << i;
    return bits;
  }

 private:
  struct Inequality {
    std::size_t face;
    float at;
    float inverse;
  };

  /// `at` + t · `way` is to be at most this face, or at least.
  void add(std::size_t face, float at, float way, bool at_most) noexcept {
    if (way == 0) {
      at_rest_[resting_++] = {face, at, at_most ? 1.0F : -1.0F};
    } else if ((way > 0) == at_most) {
      at_most_[upper_++] = {face, at, 1 / way};
    } else {
      at_least_[lower_++] = {face, at, 1 / way};
    }
  }

  Inequality at_least_[6];
  Inequality at_most_[6];
  Inequality at_rest_[6];
  std::size_t lower_ = 0;
  std::size_t upper_ = 0;
  std::size_t resting_ = 0;
};

}  // namespace shaftcull::bench
