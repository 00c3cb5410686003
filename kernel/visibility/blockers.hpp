// SPDX-License-Identifier: MIT
/// What a Blockers holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// A flat convex polygon that makes pairs blocked.
struct PolygonBlocker {
  std::uint32_t blocker;  ///< its number, whose points are its corners
};

/// The boxes that make pairs blocked: solids, and what they are together.
struct SolidRows {
  std::vector<BoxRow> rows;
  /// So many of them, the first ones, block what all do. If solids that hold a part of an end are to block nothing,
  /// the others are asked as well: the larger box around one may hold an end that the smaller one does not.
  std::size_t largest = 0;
};

/// These boxes, made when they are first asked for, by one thread while others wait. Copies share them.
class MergedSolids {
 public:
  using Rows = std::shared_ptr<const SolidRows>;

  MergedSolids() = default;
  MergedSolids(const MergedSolids& other) : rows_(other.made()) {}
  MergedSolids(MergedSolids&&) = delete;
  MergedSolids& operator=(const MergedSolids&) = delete;
  MergedSolids& operator=(MergedSolids&&) = delete;
  ~MergedSolids() = default;

  /// Of these solids, which must be the same from one call to the next but for forget().
  [[nodiscard]] Rows of(std::span<const Box> solids) const;
  /// Others were added. Nobody else may be asking.
  void forget() noexcept { rows_.reset(); }

 private:
  [[nodiscard]] Rows made() const {
    const std::lock_guard lock(mutex_);
    return rows_;
  }

  mutable std::mutex mutex_;
  mutable Rows rows_;
};

struct BlockerData {
  /// Of each blocker, the box around it.
  std::vector<BoxRow> boxes;
  /// Points that a blocker is the hull of, or lies in the hull of: those of blocker i from first_point[i] on. None if
  /// it is a box.
  std::vector<Vec3> points;
  std::vector<std::size_t> first_point{0};
  /// Triangles, likewise.
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> first_triangle{0};

  /// Boxes that are solid, as they were given or found in hulls.
  std::vector<Box> solids;
  MergedSolids merged_solids;
  std::vector<PolygonBlocker> polygons;
  float largest_coordinate = 0;

  [[nodiscard]] std::size_t size() const noexcept { return boxes.size(); }
  [[nodiscard]] std::span<const Vec3> points_of(std::size_t i) const noexcept {
    return {points.data() + first_point[i], first_point[i + 1] - first_point[i]};
  }
};

}  // namespace shaftcull::kernel
