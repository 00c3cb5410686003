// SPDX-License-Identifier: MIT
/// Planes of patches that are seen from both sides. Of a pair, such a plane counts if it has both patches in front of
/// it or in it: what lies behind it does not stand between them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/patch_plane.hpp"
#include "exact/plane_of_points.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// The planes that count of one pair.
class OwnPlanes {
 public:
  void clear() noexcept { count_ = 0; }
  /// Adds the planes of a patch, which are those of the triangles that its first corner forms with its edges.
  void add(std::span<const Vec3> patch, std::span<const Vec3> other) noexcept;
  /// Whether moving the coordinates of points by the tolerance at most can bring them all behind one of the planes;
  /// with open contact, on it or behind it.
  [[nodiscard]] bool separate(std::span<const Vec3> points, Contact contact, float tolerance) const noexcept;

 private:
  std::array<PlaneOfPoints, 2 * (most_patch_corners - 2)> plane_;
  unsigned count_ = 0;
};

/// Those of one patch with each of at most 64 others, made when they are asked for.
class OwnPlanesOfRow {
 public:
  void begin() noexcept { made_ = 0; }
  /// The planes of a lane, which make(planes) adds if they are not there.
  template <class Make>
  const OwnPlanes& of(unsigned lane, const Make& make) {
    if (planes_.empty()) planes_.resize(most_siblings);
    OwnPlanes& planes = planes_[lane];
    if ((made_ >> lane & 1U) == 0) {
      planes.clear();
      make(planes);
      made_ |= std::uint64_t{1} << lane;
    }
    return planes;
  }

 private:
  std::vector<OwnPlanes> planes_;
  std::uint64_t made_ = 0;
};

}  // namespace shaftcull::kernel
