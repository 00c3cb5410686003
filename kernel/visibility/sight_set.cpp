// SPDX-License-Identifier: MIT
#include "visibility/sight_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "exact/expansion.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {
namespace {

constexpr float largest = std::numeric_limits<float>::max();

bool is_unit_or_none(double n) noexcept { return n == 0 || std::fabs(n) == 1; }

/// Whether a normal is that of a plane across an axis, of length 1.
bool is_unit_axis(double x, double y, double z) noexcept {
  return (x != 0) + (y != 0) + (z != 0) == 1 && is_unit_or_none(x) && is_unit_or_none(y) && is_unit_or_none(z);
}

/// Errors of computed normal·p − offset, for coordinates of at most `coordinate`: three products, three sums and a
/// difference round, each by 2⁻²⁴ of what is at most |n|·|p| + |offset| in sum; underflow adds less than 2⁻¹⁴⁰. NaN
/// where products may overflow. 0 where nothing is rounded but the difference, whose sign is right then: of a plane
/// across an axis with a normal of 1. Of a group, both bounds of the normal must be such: another patch's may be
/// shorter.
float distance_error(const float (&least)[3], const float (&most)[3], float offset, float coordinate) noexcept {
  unsigned components = 0;
  double length = 0;
  bool is_unit = true;
  for (std::size_t k = 0; k != 3; ++k) {
    const float n = std::max(std::fabs(least[k]), std::fabs(most[k]));
    components += n != 0;
    is_unit = is_unit && is_unit_or_none(double{least[k]}) && is_unit_or_none(double{most[k]});
    length += double{n};
  }
  if (components == 1 && is_unit) return 0;
  const double size = length * coordinate + std::fabs(double{offset});
  if (size > 0x1p120) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(8 * 0x1p-24 * size + 0x1p-120);
}

float clamped(double x) noexcept { return static_cast<float>(std::clamp(x, -double{largest}, double{largest})); }

/// NaN if it is so large that distances may overflow.
float usable_error(double error) noexcept {
  return error <= 0x1p120 ? static_cast<float>(error) : std::numeric_limits<float>::quiet_NaN();
}

/// A plane as lanes read it.
struct Limit {
  float offset;
  float error;
};

/// Of a plane that was given.
Limit limit_of(const float (&normal)[3], float offset, float tolerance, float coordinate) noexcept {
  if (tolerance == 0) return {offset, distance_error(normal, normal, offset, coordinate)};
  if (is_unit_axis(double{normal[0]}, double{normal[1]}, double{normal[2]})) {
    return {sum_rounded_down(offset, tolerance), 0};  // coordinates compare with it as with the sum
  }
  double allowed = 0;
  for (const float n : normal) allowed += double{tolerance} * std::fabs(double{n});
  const float shifted = clamped(offset + allowed);
  const double rounding = 0x1p-23 * (std::fabs(double{offset}) + allowed);
  return {shifted, usable_error(distance_error(normal, normal, shifted, coordinate) + rounding)};
}

/// Of the planes of corners, which `normal` stands for. For all points, distances from each of these planes differ from
/// those that are computed by the error at most.
Limit limit_of(const PatchCorners& patch, const float (&normal)[3], float tolerance, float coordinate) noexcept {
  const std::span<const Vec3> corners = patch.all();
  const PatchNormals normals(corners);
  if (normals.all().empty()) return {-1, 0};  // its normal is 0, and all points are in front
  const auto dot = [&](const std::array<double, 3>& n) {
    return n[0] * corners[0][0] + n[1] * corners[0][1] + n[2] * corners[0][2];
  };
  const auto allowed = [&](const std::array<double, 3>& n) {
    return double{tolerance} * (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]));
  };
  const auto& first = normals.all().front();
  if (is_unit_axis(first[0], first[1], first[2]) &&
      std::all_of(normals.all().begin(), normals.all().end(), [&](const auto& n) { return n == first; })) {
    return {sum_rounded_down(static_cast<float>(dot(first)), tolerance), 0};  // dot() is a coordinate
  }
  const float offset = clamped(dot(first) + allowed(first));
  double deviation = 0;
  for (const std::array<double, 3>& n : normals.all()) {
    double turned = 0;
    for (std::size_t k = 0; k != 3; ++k) turned += std::fabs(n[k] - double{normal[k]});
    deviation = std::max(deviation, turned * coordinate + std::fabs(dot(n) + allowed(n) - double{offset}));
  }
  // Components of normals are off by 2⁻²⁸, three of them, of points less a corner, and of the tolerance; sums round.
  const double rounding = 0x1p-25 * (double{coordinate} + tolerance);
  const double error = distance_error(normal, normal, offset, coordinate) + (deviation + rounding) * (1 + 0x1p-20);
  return {offset, usable_error(error)};
}

void normal_at(const PatchStreams& streams, std::size_t first_stream, std::size_t i, float (&normal)[3]) noexcept {
  for (std::size_t k = 0; k != 3; ++k) normal[k] = streams.stream(first_stream + k)[i];
}

PlaneLimits patch_limits(const PatchTree& tree, float tolerance, float coordinate) {
  const PatchStreams& streams = tree.patch_streams();
  PlaneLimits limits;
  if (!streams.has_planes()) return limits;
  limits.offset.resize(streams.size() + most_siblings);
  limits.error.resize(streams.size() + most_siblings);
  for (std::size_t i = 0; i != streams.size(); ++i) {
    float normal[3];
    normal_at(streams, 6, i, normal);
    const Limit limit = tree.has_corners() ? limit_of(tree.corners_of(i), normal, tolerance, coordinate)
                                           : limit_of(normal, streams.stream(12)[i], tolerance, coordinate);
    limits.offset[i] = limit.offset;
    limits.error[i] = limit.error;
  }
  return limits;
}

ReversedPlanes reversed_planes(const PatchTree& tree, float tolerance, float coordinate) {
  ReversedPlanes reversed;
  if (!tree.has_both_sides()) return reversed;
  const std::size_t size = tree.patch_streams().size();
  for (std::vector<float>& n : reversed.normal) n.resize(size + most_siblings);
  reversed.limits.offset.resize(size + most_siblings);
  reversed.limits.error.resize(size + most_siblings);
  for (std::size_t i = 0; i != size; ++i) {
    float normal[3];
    normal_at(tree.patch_streams(), 6, i, normal);
    for (std::size_t k = 0; k != 3; ++k) reversed.normal[k][i] = normal[k] = -normal[k];
    const Limit limit = limit_of(tree.corners_of(i).reversed(), normal, tolerance, coordinate);
    reversed.limits.offset[i] = limit.offset;
    reversed.limits.error[i] = limit.error;
  }
  return reversed;
}

/// Planes of groups, for bounds of normals: the least offset of their patches, and an error that covers theirs.
PlaneLimits group_limits(const PatchTree& tree, const PlaneLimits& patches, float tolerance, float coordinate) {
  const PatchStreams& streams = tree.group_streams();
  PlaneLimits limits;
  if (!streams.has_planes()) return limits;
  limits.offset.resize(streams.size() + most_siblings);
  limits.error.resize(streams.size() + most_siblings);
  std::vector<float> of_patches(streams.size());    // the largest error of a patch; NaN if one is
  for (std::size_t g = streams.size(); g-- > 0;) {  // children come after their parents
    const PatchGroup& group = tree.groups()[g];
    float offset = largest;
    float error = 0;
    for (std::size_t c = group.first_child; c != group.first_child + group.children; ++c) {
      offset = std::min(offset, group.has_patches ? patches.offset[c] : limits.offset[c]);
      const float other = group.has_patches ? patches.error[c] : of_patches[c];
      if (!(other <= error) && !std::isnan(error)) error = other;
    }
    float least[3];
    float most[3];
    normal_at(streams, 6, g, least);
    normal_at(streams, 9, g, most);
    of_patches[g] = error;
    limits.offset[g] = offset;
    limits.error[g] = distance_error(least, most, offset, coordinate);
    // Without corners and tolerance, normals and offsets are those that were given.
    if (tree.has_corners() || tolerance != 0) limits.error[g] = usable_error(double{limits.error[g]} + error);
  }
  return limits;
}

}  // namespace

SightSet sight_set(const PatchTree& tree, float tolerance, float coordinate) {
  return in_float_environment([&] {
    return SightSet{tree, tolerance, coordinate, tree.sight_planes({tolerance, coordinate}, [&] {
                      SightPlanes planes;
                      planes.patches = patch_limits(tree, tolerance, coordinate);
                      planes.reversed = reversed_planes(tree, tolerance, coordinate);
                      planes.groups = group_limits(tree, planes.patches, tolerance, coordinate);
                      return planes;
                    })};
  });
}

}  // namespace shaftcull::kernel
