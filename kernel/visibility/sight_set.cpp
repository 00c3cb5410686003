// SPDX-License-Identifier: MIT
#include "visibility/sight_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "support/float_environment.hpp"

namespace shaftcull::kernel {
namespace {

/// Errors of computed normal·p − offset, for coordinates of at most `coordinate`: three products, three sums and a
/// difference round, each by 2⁻²⁴ of what is at most |n|·|p| + |offset| in sum; underflow adds less than 2⁻¹⁴⁰. NaN
/// where products may overflow. 0 where nothing is rounded but the difference, whose sign is right then: of a plane
/// across an axis with a normal of 1. Of a group, both bounds of the normal must be such: another patch's may be
/// shorter.
float distance_error(const float (&least)[3], const float (&largest)[3], float offset, float coordinate) noexcept {
  unsigned components = 0;
  double length = 0;
  bool is_unit = true;
  const auto is_unit_or_none = [](float n) { return n == 0 || std::fabs(n) == 1; };
  for (std::size_t k = 0; k != 3; ++k) {
    const float n = std::max(std::fabs(least[k]), std::fabs(largest[k]));
    components += n != 0;
    is_unit = is_unit && is_unit_or_none(least[k]) && is_unit_or_none(largest[k]);
    length += double{n};
  }
  if (components == 1 && is_unit) return 0;
  const double size = length * coordinate + std::fabs(double{offset});
  if (size > 0x1p120) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(8 * 0x1p-24 * size + 0x1p-120);
}

/// The errors of all planes of some streams.
std::vector<float> distance_errors(const PatchStreams& streams, float coordinate) {
  std::vector<float> error;
  if (!streams.has_planes()) return error;
  error.resize(streams.size() + most_siblings);
  for (std::size_t i = 0; i != streams.size(); ++i) {
    float least[3];
    float largest[3];
    for (std::size_t k = 0; k != 3; ++k) {
      least[k] = streams.stream(6 + k)[i];
      largest[k] = streams.stream(9 + k)[i];
    }
    error[i] = distance_error(least, largest, streams.stream(12)[i], coordinate);
  }
  return error;
}

}  // namespace

SightSet sight_set(const PatchTree& tree, float coordinate) {
  return in_float_environment([&] {
    return SightSet{tree, distance_errors(tree.patch_streams(), coordinate),
                    distance_errors(tree.group_streams(), coordinate)};
  });
}

}  // namespace shaftcull::kernel
