// SPDX-License-Identifier: MIT
/// All rays of a packet at once, against the children of a node.
#pragma once

#include <cstdint>

#include "kernels/rays/ray_packet.hpp"
#include "kernels/rays/ray_tree.hpp"

namespace shaftcull::kernel {

/// Rays that run along one axis in one direction: where all of them are, between the faces of a box on this axis. (S.
/// Boulos, I. Wald and P. Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets", 2006, have
/// intervals of rays, too.)
template <class L>
class RayBeam {
 public:
  using Vector = typename L::Vector;

  RayBeam(const RayPacket& packet, float margin) noexcept {
    float from[3][2];
    float way[3][2];
    float least = 0;  // of any ray along the axis
    for (unsigned k = 0; k < 3; ++k) {
      Vector from_lo = L::load(packet.from[k]);
      Vector from_hi = from_lo;
      Vector way_lo = L::load(packet.way[k]);
      Vector way_hi = way_lo;
      for (unsigned lane = L::width; lane < packet.count; lane += L::width) {
        const Vector some_from = L::load(packet.from[k] + lane);
        const Vector some_way = L::load(packet.way[k] + lane);
        from_lo = L::minimum(some_from, from_lo);
        from_hi = L::maximum(some_from, from_hi);
        way_lo = L::minimum(some_way, way_lo);
        way_hi = L::maximum(some_way, way_hi);
      }
      from[k][0] = L::smallest(from_lo) + packet.origin[k] - margin;
      from[k][1] = L::largest(from_hi) + packet.origin[k] + margin;
      way[k][0] = L::smallest(way_lo);
      way[k][1] = L::largest(way_hi);
      const float shortest = way[k][0] > 0 ? way[k][0] : -way[k][1];
      if (shortest > least) {
        least = shortest;
        axis_ = k;
      }
    }
    is_one_ = least > 0;
    if (!is_one_) return;
    const unsigned longest = way[axis_][0] > 0 ? 1 : 0;
    entry_ = longest == 1 ? axis_ : axis_ + 3;
    exit_ = longest == 1 ? axis_ + 3 : axis_;
    at_entry_ = from[axis_][longest];
    at_exit_ = from[axis_][1 - longest];
    inverse_entry_ = 1 / way[axis_][longest];
    inverse_exit_ = 1 / way[axis_][1 - longest];
    for (unsigned i = 0; i < 2; ++i) {
      across_[i] = (axis_ + 1 + i) % 3;
      for (unsigned side = 0; side < 2; ++side) {
        from_[i][side] = from[across_[i]][side];
        way_[i][side] = way[across_[i]][side];
      }
    }
  }

  /// The children of a node whose boxes any of the rays may reach.
  [[nodiscard]] std::uint32_t reached(const RayTreeNode& node) const noexcept {
    const std::uint32_t all = (1U << node.children) - 1;
    if (!is_one_) return all;
    std::uint64_t missed = 0;
    for (unsigned lane = 0; lane < tree_lanes; lane += L::width) {
      const auto face = [&](unsigned f) { return L::load(node.face[f] + lane); };
      const Vector enters = L::multiply(L::subtract(face(entry_), L::all(at_entry_)), L::all(inverse_entry_));
      const Vector leaves = L::multiply(L::subtract(face(exit_), L::all(at_exit_)), L::all(inverse_exit_));
      const Vector first = L::maximum(enters, L::all(0.0F));
      const Vector last = L::minimum(leaves, L::all(1.0F));
      auto misses = L::less(last, first);
      for (unsigned i = 0; i < 2; ++i) {
        const auto way = [&](unsigned side, Vector t) { return L::multiply(t, L::all(way_[i][side])); };
        const Vector lo = L::add(L::all(from_[i][0]), L::minimum(way(0, first), way(0, last)));
        const Vector hi = L::add(L::all(from_[i][1]), L::maximum(way(1, first), way(1, last)));
        misses = L::either(misses, L::either(L::less(face(across_[i] + 3), lo), L::less(hi, face(across_[i]))));
      }
      missed |= L::bits(misses) << lane;
    }
    return all & ~static_cast<std::uint32_t>(missed);
  }

 private:
  bool is_one_;
  unsigned axis_ = 0;
  unsigned entry_ = 0;  ///< the faces by which rays enter and leave
  unsigned exit_ = 0;
  float at_entry_ = 0;  ///< where the first ray enters, and the last one leaves, start, further out by the margin
  float at_exit_ = 0;
  float inverse_entry_ = 0;
  float inverse_exit_ = 0;
  unsigned across_[2] = {};  ///< the other axes
  float from_[2][2] = {};    ///< on each of them, the smallest and the largest, further out by the margin
  float way_[2][2] = {};
};

}  // namespace shaftcull::kernel
