// SPDX-License-Identifier: MIT
/// The node that a bound suits best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "tree/leaf_block.hpp"

namespace shaftcull::kernel {

/// The box around a bound, as corners; of a sphere about that.
inline void corners_of(const float (&box)[6], float (&corner)[6]) noexcept {
  for (std::size_t f = 0; f != 6; ++f) corner[f] = box[f];
}
inline void corners_of(const float (&sphere)[4], float (&corner)[6]) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    corner[k] = sphere[k] - sphere[3];
    corner[k + 3] = sphere[k] + sphere[3];
  }
}

/// Corners, as plain numbers: minima without a call, for loops that become vectors.
[[nodiscard]] inline float lesser(float a, float b) noexcept { return b < a ? b : a; }
[[nodiscard]] inline float greater(float a, float b) noexcept { return a < b ? b : a; }

// Nodes are six streams, as BoxView has them; i is the position of one.

/// Whether a node holds a box.
[[nodiscard]] inline bool box_holds(const float* const* node, std::size_t i, const float (&corner)[6]) noexcept {
  return node[0][i] <= corner[0] && node[1][i] <= corner[1] && node[2][i] <= corner[2] && corner[3] <= node[3][i] &&
         corner[4] <= node[4][i] && corner[5] <= node[5][i];
}
/// Makes it hold that box.
inline void grow_box(float* const* node, std::size_t i, const float (&corner)[6]) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    node[k][i] = lesser(node[k][i], corner[k]);
    node[k + 3][i] = greater(node[k + 3][i], corner[k + 3]);
  }
}
/// How large a node is, and how large it would be with a box.
[[nodiscard]] inline float measure_of(const float* const* node, std::size_t i) noexcept {
  return node_measure(node[3][i] - node[0][i], node[4][i] - node[1][i], node[5][i] - node[2][i]);
}
[[nodiscard]] inline float measure_with(const float* const* node, std::size_t i, const float (&corner)[6]) noexcept {
  return node_measure(greater(node[3][i], corner[3]) - lesser(node[0][i], corner[0]),
                      greater(node[4][i], corner[4]) - lesser(node[1][i], corner[1]),
                      greater(node[5][i], corner[5]) - lesser(node[2][i], corner[2]));
}
/// The corners of a node.
struct NodeCorners {
  float corner[6];
};
[[nodiscard]] inline NodeCorners corners_at(const float* const* node, std::size_t i) noexcept {
  return {{node[0][i], node[1][i], node[2][i], node[3][i], node[4][i], node[5][i]}};
}

inline constexpr float ruled_out = std::numeric_limits<float>::infinity();

/// A node, and what one bound more would cost it.
struct BestOfNodes {
  std::size_t node;
  float cost;
};

/// What one bound more would cost a node (BestNode in kernels/kernel_table.hpp).
[[nodiscard]] inline float cost_of_one_more(const float* const* node, std::size_t i,
                                            const float (&corner)[6]) noexcept {
  return 65 * measure_with(node, i, corner) - 64 * measure_of(node, i);
}

/// Of 64 nodes, the one that a bound suits best (BestNode in kernels/kernel_table.hpp). `bias` is 0, or `ruled_out`,
/// which one at least is not. Where nothing is finite, it is the largest of these, at an infinite cost.
[[nodiscard]] inline BestOfNodes best_node_for(const float* const* node, const float (&corner)[6],
                                               const float (&bias)[fanout], const Kernels& kernels) noexcept {
  BestOfNodes best{};
  best.node = kernels.best_node(node, corner, bias, &best.cost);
  if (best.node != fanout) return best;
  float largest = -1;
  for (std::size_t i = fanout; i-- != 0;) {
    if (bias[i] != 0) continue;
    const float now = measure_of(node, i);
    if (best.node != fanout && !(now >= largest)) continue;
    largest = now;
    best.node = i;
  }
  return best;
}

}  // namespace shaftcull::kernel
