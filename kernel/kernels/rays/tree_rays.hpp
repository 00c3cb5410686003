// SPDX-License-Identifier: MIT
/// Rays in a tree of many triangles, as RayKernels has it.
///
/// Rays of a packet that stay together are tested side by side. Where they part, each is tested alone against the
/// children of a node, or the triangles of a leaf. (I. Wald, C. Benthin and S. Boulos, "Getting Rid of Packets", 2008.)
/// Both ask passing_through(), so they find the same. Boxes are larger than their triangles by
/// the margin, which is more than what rounding does to rays.
#pragma once

#include <cstdint>

#include "kernels/rays/ray_beam.hpp"
#include "kernels/rays/ray_packet.hpp"
#include "kernels/rays/ray_tree.hpp"
#include "kernels/rays/rays.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

template <class L>
class TreeRays {
 public:
  using Vector = typename L::Vector;

  TreeRays(const RayPacket& packet, float margin) noexcept
      : packet_(packet), margin_(margin), box_margin_(margin + shortest_way), beam_(packet, box_margin_) {}

  /// Of the rays `asked`, those that pass through a triangle below a node.
  [[nodiscard]] std::uint64_t meet(const RayTree& tree, std::uint32_t root, std::uint64_t asked) noexcept {
    struct Waiting {
      std::uint32_t node;
      std::uint64_t rays;
    };
    Waiting waiting[RayTree::most_waiting];
    unsigned count = 0;
    waiting[count++] = {root, asked};
    std::uint64_t left = asked;
    while (count != 0) {
      const Waiting next = waiting[--count];
      const std::uint64_t rays = next.rays & left;
      if (rays == 0) continue;
      const RayTreeNode& node = tree.nodes[next.node];
      std::uint64_t reaching[tree_lanes];
      const std::uint32_t reached = reach_children(node, rays, reaching);
      for (std::uint32_t some = reached & ~node.leaves; some != 0; some &= some - 1) {
        const auto child = static_cast<unsigned>(trailing_zeros(some));
        prefetch_to_read(&tree.nodes[node.child[child]]);
        waiting[count++] = {node.child[child], reaching[child]};
      }
      for (std::uint32_t some = reached & node.leaves; some != 0; some &= some - 1) {
        const auto child = static_cast<unsigned>(trailing_zeros(some));
        const RayTreeLeaf& leaf = tree.leaves[node.child[child]];
        left &= ~meet_leaf(leaf, node.triangles[child], reaching[child] & left);
      }
    }
    return asked & ~left;
  }

 private:
  /// More than all ways along an axis whose inverses are not finite.
  static constexpr float shortest_way = 0x1p-126F;
  /// So many rays are tested side by side against triangles.
  static constexpr int fewest_together = 8;

  /// The children that any of these rays may reach. Of each, writes which rays.
  std::uint32_t reach_children(const RayTreeNode& node, std::uint64_t rays,
                               std::uint64_t (&reaching)[tree_lanes]) noexcept {
    std::uint32_t reached = 0;
    if ((rays & (rays - 1)) == 0) {
      reached = reached_by(node, static_cast<unsigned>(trailing_zeros(rays)));
      for (std::uint32_t some = reached; some != 0; some &= some - 1) reaching[trailing_zeros(some)] = rays;
      return reached;
    }
    const std::uint32_t by_beam = beam_.reached(node);
    if (popcount(by_beam) <= popcount(rays)) {
      for (std::uint32_t some = by_beam; some != 0; some &= some - 1) {
        const auto child = static_cast<unsigned>(trailing_zeros(some));
        reaching[child] = reach_box(node, child, rays);
        if (reaching[child] != 0) reached |= 1U << child;
      }
      return reached;
    }
    for (std::uint64_t& of_child : reaching) of_child = 0;
    for (; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<unsigned>(trailing_zeros(rays));
      const std::uint32_t by_ray = reached_by(node, ray);
      for (std::uint32_t some = by_ray; some != 0; some &= some - 1) {
        reaching[trailing_zeros(some)] |= std::uint64_t{1} << ray;
      }
      reached |= by_ray;
    }
    return reached;
  }

  /// Of these rays, those that may reach a child.
  [[nodiscard]] std::uint64_t reach_box(const RayTreeNode& node, unsigned child, std::uint64_t rays) const noexcept {
    float box[6];
    for (unsigned k = 0; k < 3; ++k) {
      box[k] = node.face[k][child] - box_margin_;
      box[k + 3] = node.face[k + 3][child] + box_margin_;
    }
    return rays & meet_box<L>(packet_, box, rays);
  }

  /// The children that a ray may reach.
  [[nodiscard]] std::uint32_t reached_by(const RayTreeNode& node, unsigned ray) noexcept {
    if (!is_prepared_) prepare();
    const float* entry[3];
    const float* exit[3];
    for (unsigned k = 0; k < 3; ++k) {
      const bool rises = (rises_[k] >> ray & 1) != 0;
      entry[k] = node.face[rises ? k : k + 3];
      exit[k] = node.face[rises ? k + 3 : k];
    }
    std::uint64_t reached = 0;
    for (unsigned lane = 0; lane < tree_lanes; lane += L::width) {
      Vector first = L::all(0.0F);
      Vector last = L::all(1.0F);
      for (unsigned k = 0; k < 3; ++k) {
        const Vector inverse = L::all(inverse_[k][ray]);
        const Vector enters = L::multiply(L::subtract(L::load(entry[k] + lane), L::all(at_entry_[k][ray])), inverse);
        const Vector leaves = L::multiply(L::subtract(L::load(exit[k] + lane), L::all(at_exit_[k][ray])), inverse);
        first = L::maximum(enters, first);
        last = L::minimum(leaves, last);
      }
      reached |= L::bits(L::less_equal(first, last)) << lane;
    }
    return static_cast<std::uint32_t>(reached) & ((1U << node.children) - 1);
  }

  /// Of these rays, those that pass through a triangle of a leaf.
  [[nodiscard]] std::uint64_t meet_leaf(const RayTreeLeaf& leaf, unsigned triangles,
                                        std::uint64_t rays) const noexcept {
    if (popcount(rays) >= fewest_together) {
      const auto triangle = [&leaf](std::size_t i) { return leaf.triangle(i); };
      return rays & meet_each<L>(packet_, triangle, triangles, margin_, rays);
    }
    std::uint64_t met = 0;
    for (; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<unsigned>(trailing_zeros(rays));
      if (meets(leaf, ray)) met |= std::uint64_t{1} << ray;
    }
    return met;
  }

  /// Whether a ray passes through a triangle of a leaf.
  [[nodiscard]] bool meets(const RayTreeLeaf& leaf, unsigned ray) const noexcept {
    RayVectors<L> way;
    for (unsigned k = 0; k < 3; ++k) way.of[k] = L::all(packet_.way[k][ray]);
    for (unsigned lane = 0; lane < tree_lanes; lane += L::width) {
      RayVectors<L> start;
      for (unsigned k = 0; k < 3; ++k) {
        const Vector point = L::subtract(L::load(leaf.point[k] + lane), L::all(packet_.origin[k]));
        start.of[k] = L::subtract(L::all(packet_.from[k][ray]), point);
      }
      const auto product = [&leaf, lane](const RayVectors<L>& a, OfTriangle what) {
        return what == OfTriangle::normal     ? along(a, leaf.normal, lane)
               : what == OfTriangle::across_u ? along(a, leaf.across_u, lane)
                                              : along(a, leaf.across_v, lane);
      };
      if (passing_through<L>(start, way, margin_, lanes_of<L>(0), product) != 0) return true;
    }
    return false;
  }

  static Vector along(const RayVectors<L>& a, const float (&b)[3][tree_lanes], unsigned lane) noexcept {
    const Vector xy = L::add(L::multiply(a.of[0], L::load(b[0] + lane)), L::multiply(a.of[1], L::load(b[1] + lane)));
    return L::add(xy, L::multiply(a.of[2], L::load(b[2] + lane)));
  }

  /// For tests of single rays against boxes.
  void prepare() noexcept {
    constexpr float most = 0x1.fffffep127F;  // of an inverse that may be infinite: 0 times it is 0
    for (unsigned k = 0; k < 3; ++k) {
      rises_[k] = 0;
      for (unsigned lane = 0; lane < packet_.count; lane += L::width) {
        const Vector inverse = L::maximum(L::minimum(L::load(packet_.inverse[k] + lane), L::all(most)), L::all(-most));
        const Vector at = L::add(L::load(packet_.from[k] + lane), L::all(packet_.origin[k]));
        const Vector above = L::add(at, L::all(box_margin_));
        const Vector below = L::subtract(at, L::all(box_margin_));
        const auto rises = L::less(L::all(0.0F), inverse);
        rises_[k] |= L::bits(rises) << lane;
        L::store(inverse_[k] + lane, inverse);
        L::store(at_entry_[k] + lane, L::choose(rises, above, below));
        L::store(at_exit_[k] + lane, L::choose(rises, below, above));
      }
    }
    is_prepared_ = true;
  }

  const RayPacket& packet_;
  float margin_;
  float box_margin_;
  bool is_prepared_ = false;
  RayBeam<L> beam_;
  std::uint64_t rises_[3];  ///< of each axis, the rays whose coordinate grows
  /// Where the faces that a ray enters and leaves by would be if it started at 0: further out by the margin.
  alignas(64) float at_entry_[3][most_packet_rays];
  alignas(64) float at_exit_[3][most_packet_rays];
  alignas(64) float inverse_[3][most_packet_rays];
};

/// As RayKernels has it.
template <class L>
std::uint64_t meet_tree(const RayPacket& packet, const RayTree& tree, std::uint32_t root, float margin,
                        std::uint64_t asked) noexcept {
  return TreeRays<L>(packet, margin).meet(tree, root, asked);
}

}  // namespace shaftcull::kernel
