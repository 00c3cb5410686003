// SPDX-License-Identifier: MIT
/// Workload W: the random bounds and shafts that all benchmarks run on, the same on every platform.
#pragma once

#include <cstddef>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::bench {

/// Box centres uniform in ±5 on each axis, half extents 0.01–0.11; object boxes' centres uniform in ±5, half extents
/// 0.2–1.0. 1.8 % of tests are not outside. Spheres likewise, with a radius of 0.01–0.11.
struct Workload {
  /// `bounds` boxes and as many spheres.
  explicit Workload(std::size_t bounds);

  BoxStream boxes;
  SphereStream spheres;

  /// The first of the boxes and spheres as structs, few enough to stay in an L2 cache, for tests one by one.
  std::vector<Box> box_records;
  std::vector<Sphere> sphere_records;

  /// The object boxes of shaft i are a[i] and b[i].
  std::vector<Box> a;
  std::vector<Box> b;

  static constexpr std::size_t records = 32768;   ///< 768 KiB of boxes
  static constexpr std::size_t pairs = 8192;      ///< too many for a branch predictor to remember
  static constexpr std::size_t test_shafts = 64;  ///< the first of the pairs, tested against all bounds
};

}  // namespace shaftcull::bench
