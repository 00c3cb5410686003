// SPDX-License-Identifier: MIT
/// Which points reach between a patch and each of up to 64 others: certainly, or certainly not.
#pragma once

#include <cstddef>
#include <type_traits>

#include "kernels/shared/word.hpp"
#include "kernels/siblings/sibling_packing.hpp"
#include "kernels/siblings/tangents.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Corners of patches that are left, side by side: a vector may be written behind them.
struct PackedCorners {
  alignas(64) float of[3 * most_patch_corners][most_siblings + 16];
  const float* stream[3 * most_patch_corners];
};

/// Whether points reach between a vector of pairs.
template <class L>
class ReachInLanes {
  using Vector = typename L::Vector;

 public:
  struct Found {
    std::uint64_t reaching;
    std::uint64_t separate;
  };

  ReachInLanes(const CornersOfPairs& pairs, unsigned lane, const TangentErrors& errors) noexcept
      : pairs_(pairs), errors_(errors), tangents_(pairs, lane, errors) {}

  /// In memory of the caller's. That of the standard is one inline function, which no instruction set may compile.
  static void* operator new(std::size_t, ReachSpace& space) noexcept { return space.bytes; }

  /// Bits of those of `asked`, from bit 0 on.
  [[nodiscard]] Found of(const PointsBetween& points, std::uint64_t asked) const noexcept {
    Found found{asked, 0};
    if (points.is_triangle) found.reaching &= on_both_sides(points.points);
    constexpr std::uint32_t few = 3;
    InAllLanes first[few];
    for (std::uint32_t p = 0; p < few; ++p) first[p] = in_all_lanes(points.points[p < points.count ? p : 0]);
    for (unsigned i = 0; i < tangents_.size(); ++i) {
      const TangentInLanes<L>& plane = tangents_[i];
      auto farthest = component(plane, first[0]);
      SHAFTCULL_UNROLL(2)
      for (std::uint32_t p = 1; p < few; ++p) farthest = L::maximum(farthest, component(plane, first[p]));
      for (std::uint32_t p = few; p < points.count; ++p) {
        farthest = L::maximum(farthest, component(plane, in_all_lanes(points.points[p])));
      }
      found.reaching &= L::bits(L::less(plane.in_front, farthest));
      found.separate |= asked & L::bits(L::less(farthest, plane.behind));
      if ((found.reaching | (asked & ~found.separate)) == 0) break;
    }
    return found;
  }

 private:
  /// A point, from the origin on.
  struct InAllLanes {
    Vector at[3];
  };
  [[nodiscard]] InAllLanes in_all_lanes(const Vec3& point) const noexcept {
    InAllLanes all;
    for (unsigned c = 0; c < 3; ++c) all.at[c] = L::all(point[c] - errors_.origin[c]);
    return all;
  }
  [[nodiscard]] static Vector component(const TangentInLanes<L>& plane, const InAllLanes& point) noexcept {
    const auto sum = L::multiply_add(plane.normal[1], point.at[1], L::multiply(plane.normal[0], point.at[0]));
    return L::multiply_add(plane.normal[2], point.at[2], sum);
  }

  /// Pairs with a corner on each side of a triangle's plane, by more than the tolerance.
  [[nodiscard]] std::uint64_t on_both_sides(const Vec3* triangle) const noexcept {
    float normal[3];
    float at[3];
    float error = errors_.least;
    float thickness = 0;
    for (unsigned c = 0; c < 3; ++c) {
      const unsigned d = (c + 1) % 3;
      const unsigned e = (c + 2) % 3;
      const float left = (triangle[1][d] - triangle[0][d]) * (triangle[2][e] - triangle[0][e]);
      const float right = (triangle[1][e] - triangle[0][e]) * (triangle[2][d] - triangle[0][d]);
      normal[c] = left - right;
      at[c] = triangle[0][c] - errors_.origin[c];
      const auto magnitude = [](float x) { return x < 0 ? -x : x; };
      error += errors_.of_component[c] * (magnitude(left) + magnitude(right));
      thickness += errors_.tolerance * magnitude(normal[c]);
    }
    float highest = 0;
    float lowest = 0;
    for (unsigned i = 0; i < pairs_.fixed_corners; ++i) {
      float height = 0;
      for (unsigned c = 0; c < 3; ++c) height += normal[c] * ((pairs_.fixed[i][c] - errors_.origin[c]) - at[c]);
      if (i == 0 || height > highest) highest = height;
      if (i == 0 || height < lowest) lowest = height;
    }
    Vector most = L::all(highest);
    Vector least = L::all(lowest);
    for (unsigned k = 0; k < pairs_.corners; ++k) {
      const Vector(&corner)[3] = tangents_.from_origin(k);
      auto height = L::multiply(L::all(normal[0]), L::subtract(corner[0], L::all(at[0])));
      height = L::multiply_add(L::all(normal[1]), L::subtract(corner[1], L::all(at[1])), height);
      height = L::multiply_add(L::all(normal[2]), L::subtract(corner[2], L::all(at[2])), height);
      most = L::maximum(most, height);
      least = L::minimum(least, height);
    }
    const float margin = thickness + error;
    return L::bits(L::both(L::less(L::all(margin), most), L::less(least, L::all(-margin))));
  }

  const CornersOfPairs& pairs_;
  const TangentErrors& errors_;
  TangentsInLanes<L> tangents_;
};

/// Errors for pairs in `lanes`, and points that some of them are asked about. False if floats may overflow.
template <class L>
bool bound_tangent_errors(const CornersOfPairs& pairs, float tolerance, const PointsBetween* points, std::size_t number,
                          TangentErrors& errors) noexcept {
  float sum = 0;
  for (unsigned c = 0; c < 3; ++c) {
    const float origin = pairs.fixed[0][c];
    errors.origin[c] = origin;
    float farthest = tolerance;
    const auto take_in = [&](float coordinate) {
      const float distance = coordinate < origin ? origin - coordinate : coordinate - origin;
      if (distance > farthest) farthest = distance;
    };
    for (unsigned i = 1; i < pairs.fixed_corners; ++i) take_in(pairs.fixed[i][c]);
    for (unsigned k = 0; k < pairs.corners; ++k) {
      auto most = L::load(pairs.other[3 * k + c]);
      auto least = most;
      for (unsigned lane = L::width; lane < pairs.count; lane += L::width) {
        const auto here = L::load(pairs.other[3 * k + c] + lane);
        most = L::maximum(most, here);
        least = L::minimum(least, here);
      }
      take_in(L::largest(most));
      take_in(L::smallest(least));
    }
    for (std::size_t i = 0; i != number; ++i) {
      if (points[i].asked == 0) continue;
      for (std::uint32_t p = 0; p < points[i].count; ++p) take_in(points[i].points[p][c]);
    }
    errors.of_component[c] = 0x1p-19F * (farthest + tolerance);
    sum += farthest;
  }
  errors.least = 0x1p-120F * (1 + sum);
  errors.tolerance = tolerance;
  return sum < 0x1p36F;
}

/// As SiblingKernels has it.
template <class L>
void reach_between(const CornersOfPairs& pairs, float tolerance, PointsBetween* points, std::size_t number,
                   ReachSpace& space) noexcept {
  using Reach = ReachInLanes<L>;
  static_assert(sizeof(Reach) <= sizeof(ReachSpace) && alignof(Reach) <= alignof(ReachSpace));
  static_assert(std::is_trivially_destructible_v<Reach>);
  std::uint64_t asked = 0;
  for (std::size_t i = 0; i != number; ++i) {
    asked |= points[i].asked;
    points[i].reaching = 0;
    points[i].separate = 0;
  }
  CornersOfPairs packed = pairs;
  PackedCorners corners;
  if constexpr (MovesBits<L>) {
    packed.other = corners.stream;
    packed.count = 0;
    for (unsigned s = 0; s < 3 * pairs.corners; ++s) corners.stream[s] = corners.of[s];
    for (unsigned lane = 0; lane < pairs.count; lane += L::width) {
      const std::uint64_t some = asked >> lane & lanes_of<L>(0);
      if (some == 0) continue;
      const typename L::Compressor compressor(some);
      for (unsigned s = 0; s < 3 * pairs.corners; ++s) {
        compressor.store(corners.of[s] + packed.count, L::load(pairs.other[s] + lane));
      }
      packed.count += static_cast<unsigned>(popcount(some));
    }
  }
  TangentErrors errors;
  if (asked == 0 || !bound_tangent_errors<L>(packed, tolerance, points, number, errors)) return;
  const auto pack = [&](std::uint64_t bits) {
    if constexpr (MovesBits<L>) return L::packed_bits(bits, asked);
    return bits;
  };
  const auto spread = [&](std::uint64_t bits) {
    if constexpr (MovesBits<L>) return L::spread_bits(bits, asked);
    return bits;
  };
  const std::uint64_t all = pack(asked);
  for (unsigned lane = 0; lane < packed.count; lane += L::width) {
    if ((all & lanes_of<L>(lane)) == 0) continue;
    const Reach& reach = *new (space) Reach(packed, lane, errors);
    std::uint64_t reached = 0;
    for (std::size_t i = 0; i != number; ++i) {
      if (i == 0 || points[i].occluder != points[i - 1].occluder) reached = 0;
      const std::uint64_t here = pack(points[i].asked) >> lane & lanes_of<L>(0) & ~reached;
      if (here == 0) continue;
      const auto found = reach.of(points[i], here);
      reached |= found.reaching;
      points[i].reaching |= spread(found.reaching << lane);
      points[i].separate |= spread(found.separate << lane);
    }
  }
}

}  // namespace shaftcull::kernel
