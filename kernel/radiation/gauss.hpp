// SPDX-License-Identifier: MIT
/// Gauss and Legendre's rules: sums that are integrals from −1 to 1, exactly for polynomials of a degree below twice
/// the number of nodes.
#pragma once

namespace shaftcull::kernel {

struct GaussNode {
  double at;
  double weight;
};

inline constexpr unsigned most_gauss_nodes = 8;

/// Of 2 to 8 nodes, those that are not negative.
inline constexpr GaussNode gauss_nodes[most_gauss_nodes - 1][4] = {
    {{0.5773502691896257645, 1}},
    {{0, 0.8888888888888888889}, {0.7745966692414833770, 0.5555555555555555556}},
    {{0.3399810435848562648, 0.6521451548625461427}, {0.8611363115940525752, 0.3478548451374538574}},
    {{0, 0.5688888888888888889},
     {0.5384693101056830910, 0.4786286704993664680},
     {0.9061798459386639928, 0.2369268850561890875}},
    {{0.2386191860831969086, 0.4679139345726910473},
     {0.6612093864662645137, 0.3607615730481386076},
     {0.9324695142031520278, 0.1713244923791703450}},
    {{0, 0.4179591836734693878},
     {0.4058451513773971669, 0.3818300505051189449},
     {0.7415311855993944399, 0.2797053914892766679},
     {0.9491079123427585245, 0.1294849661688696933}},
    {{0.1834346424956498049, 0.3626837833783619830},
     {0.5255324099163289858, 0.3137066458778872873},
     {0.7966664774136267396, 0.2223810344533744705},
     {0.9602898564975362317, 0.1012285362903762591}}};

/// Node i of the rule of `count` nodes, in ascending order.
[[nodiscard]] constexpr GaussNode gauss_node(unsigned count, unsigned i) noexcept {
  const GaussNode(&of)[4] = gauss_nodes[count - 2];
  const unsigned half = count / 2;
  if (i >= half) return of[i - half];
  const GaussNode& node = of[half - 1 - i + count % 2];
  return {-node.at, node.weight};
}

}  // namespace shaftcull::kernel
