// SPDX-License-Identifier: MIT
#include "visibility/sight_rays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shaftcull/geometry.hpp"

namespace shaftcull::kernel {

void RayWeights::add(const RayPacket& packet, std::uint64_t unmet) noexcept {
  // Four rays at a time: each of four sums has every fourth ray. Weights are finite, or no use is made of the sums.
  static constexpr double kept[16][4] = {
      {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 1, 0}, {0, 1, 1, 0}, {1, 1, 1, 0},
      {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}, {0, 0, 1, 1}, {1, 0, 1, 1}, {0, 1, 1, 1}, {1, 1, 1, 1}};
  double sum[4][4]{};
  for (unsigned ray = 0; ray < packet.count; ray += 4) {
    const double(&seen)[4] = kept[unmet >> ray & 15U];
    for (unsigned i = 0; i < 4; ++i) {
      const double weight = packet.weight[ray + i];
      const double weight_of_seen = weight * seen[i];
      sum[0][i] += weight;
      sum[1][i] += weight_of_seen;
      sum[2][i] += weight * weight;
      sum[3][i] += weight_of_seen * weight_of_seen;
    }
  }
  const auto total = [&](unsigned s) { return (sum[s][0] + sum[s][1]) + (sum[s][2] + sum[s][3]); };
  all += total(0);
  of_seen += total(1);
  squares += total(2);
  squares_of_seen += total(3);
}

RayPrecision::RayPrecision(const RayTally& tally, const RayWeights& weights, double mean_weight) noexcept
    : inverse_of_count(1), lack(0) {
  if (tally.facing == 0) return;
  inverse_of_count = std::min(1.0, weights.squares / (weights.all * weights.all));
  lack = std::max(0.0, 1 - weights.all / tally.rays / mean_weight) * std::sqrt(inverse_of_count);
}

double RayPrecision::expected_error() const noexcept {
  constexpr double of_one = 0.25;
  return std::max(of_one * std::sqrt(inverse_of_count), lack);
}

SeenShare::SeenShare(const RayTally& tally, const RayWeights& weights, double mean_weight) noexcept
    : part(0), error(0) {
  if (tally.facing == 0) {  // nothing is known
    part = error = 1;
    return;
  }
  const double rays = tally.rays;
  const double mean = weights.all / rays;
  const double mean_of_seen = weights.of_seen / rays;
  const double variance = weights.squares / rays - mean * mean;
  const RayPrecision precision(tally, weights, mean_weight);
  error = std::max(precision.lack, precision.inverse_of_count);  // one ray more may be the first that arrives, or not
  if (tally.seen == 0) return;
  part = static_cast<double>(tally.seen) / tally.facing;
  if (tally.seen == tally.facing || !(variance > 0) || !(mean_weight > 0) || !std::isfinite(variance)) return;
  const double covariance = weights.squares_of_seen / rays - mean_of_seen * mean;
  const double slope = covariance / variance;
  part = std::clamp((mean_of_seen - slope * (mean - mean_weight)) / mean_weight, 0.0, 1.0);
  const double variance_of_seen = weights.squares_of_seen / rays - mean_of_seen * mean_of_seen;
  const double left = std::max(0.0, variance_of_seen - slope * covariance);
  error = std::min(1.0, std::max({precision.lack, error / 4, std::sqrt(left / rays) / mean_weight}));
}

SightRays::SightRays(const PatchTree& a, const PatchTree& b, const OccluderData& occluders, float tolerance,
                     std::uint32_t most_rays, std::uint64_t seed)
    : a_(a.ray_patches()),
      b_(b.ray_patches()),
      targets_(occluders, joined(a_->around, b_->around), std::max(a.largest_coordinate(), b.largest_coordinate()),
               tolerance),
      most_rays_((most_rays + 15) / 16 * 16),
      seed_(seed),
      points_(most_rays_, 4) {}

void SightRays::cast_packet(PatchPair pair, const RayShift& shift, std::span<const std::uint32_t> candidates,
                            std::uint32_t count, RayTally& tally, RayWeights* weights) const {
  const float* points[4];
  for (std::size_t s = 0; s != 4; ++s) points[s] = points_.stream(s) + tally.rays;
  RayPacket packet;
  const std::uint64_t facing =
      targets_.kernels().form(a_->patches[pair.a], b_->patches[pair.b], points, shift.of, count, packet);
  const std::uint64_t unmet = targets_.unmet(packet, candidates, facing);
  tally.add(count, facing, unmet);
  if (weights != nullptr) weights->add(packet, unmet);
}

}  // namespace shaftcull::kernel
