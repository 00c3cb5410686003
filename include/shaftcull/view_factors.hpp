// SPDX-License-Identifier: MIT
/// View factors: the share of the radiation sent out by one patch that another patch receives (docs/view-factors.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/visibility.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The view factor from one flat convex polygon to another with nothing between them, from 0 to 1: the integral of
/// cos θ₁ cos θ₂ / (π r²) over both areas, by the area of the first. It is the view factor of a pair that visibility()
/// calls `clear`; for other pairs it is an upper bound.
///
/// A polygon has 3 to 8 corners, counterclockwise as seen from the front, which radiates diffusely. The part of a
/// polygon that is behind the plane of the other polygon does not count. Corners may be slightly out of plane, as those
/// of turned walls are. Polygons may share corners and edges.
///
/// The error is below 10⁻⁸ of the factor, or 10⁻¹¹ where that is more; for slivers next to a polygon that is much
/// larger, 10⁻⁹. The result has the same bits on every machine and every instruction set. Both factors of a pair are
/// the same number divided by the area of one or the other polygon, so A₁ F₁₂ = A₂ F₂₁ except for one rounding.
///
/// About 0.4 µs for two squares that are far from each other, 6 µs at the distance of one side, and 15 µs if they share
/// an edge, since the integrand is not smooth there. Allocates nothing, and is safe to call from many threads.
/// Coordinates may be in any unit. Throws InvalidArgument for another number of corners, for a corner that is not
/// finite, and if `from` has no area.
///
/// The method: E. M. Sparrow, "A New and Simpler Formulation for Radiative Angle Factors", 1963.
[[nodiscard]] SHAFTCULL_EXPORT double view_factor(std::span<const Vec3> from, std::span<const Vec3> to);

/// Options of view_factors().
struct ViewFactorOptions {
  /// The largest number of rays per undecided pair; a multiple of 16 is cast. 1 to 65536.
  std::uint32_t rays = 4096;
  /// A pair gets fewer rays if the standard error of both its factors is expected to be at most this, whatever its rays
  /// meet: it gets 16 rays first, then as many again, and so on. With 0, each undecided pair gets all rays. The factors
  /// of large patches may need more than `rays` for this; ViewFactors::error shows it.
  double error = 1e-5;
  std::uint64_t seed = 1;  ///< as RayOptions::seed
  /// Pairs both of whose factors are below this are left out of the matrix; ViewFactors::left_out has their sums.
  double least = 0;
  /// Whether rows are scaled to sum to 1, as those of an enclosure do. The exchange between patches i and j is
  /// multiplied by a number for i and a number for j, so reciprocity stays. Patches that see nothing keep empty rows.
  /// `least` is compared before the scaling. The left-out sum of row i is multiplied by the square of the number for i.
  /// If `parts` is above 1, this must be false: join_view_factors() closes the rows of all parts. (Matrix balancing: R.
  /// Sinkhorn, "A Relationship Between Arbitrary Positive Matrices and Doubly Stochastic Matrices", 1964.)
  bool close_rows = false;
  float tolerance = 0;                          ///< as VisibilityOptions::tolerance and RayOptions::tolerance
  std::size_t memory = std::size_t{256} << 20;  ///< as VisibilityOptions::memory; the matrix is not included
  /// The call finds the factors of one part of all pairs, as with VisibilityOptions::part. The matrix has both factors
  /// of each pair in the part. join_view_factors() makes one matrix of all parts.
  std::uint32_t part = 0;
  std::uint32_t parts = 1;                                                ///< 1 or more, and above `part`
  std::function<bool(const VisibilityProgress& progress)> progress = {};  ///< as VisibilityOptions::progress
  std::uint64_t reserved[4] = {};                                         ///< for options of later versions
};

/// View factors of all pairs of a set: a sparse matrix in rows (CSR). Row i has the factors from patch i to others:
/// factor[k] is to patch column[k], for k from first[i] to first[i + 1]. Columns ascend; factors are above 0. Where row
/// i has a factor to j, row j has one to i, and area[i] F(i, j) = area[j] F(j, i) except for rounding.
struct SHAFTCULL_EXPORT ViewFactors {
  std::vector<std::size_t> first{0};  ///< where the factors of each row begin; then the end of the last
  std::vector<std::uint32_t> column;  ///< the patch to which each factor is
  std::vector<double> factor;         ///< row by row
  std::vector<double> area;           ///< of each patch
  std::vector<double> sum;            ///< of each row, left-out factors included; 1 − sum meets no patch: the sky
  std::vector<double> error;          ///< estimated standard error of each sum
  std::vector<double> left_out;       ///< part of each sum that is below ViewFactorOptions::least
  SightCounts counts;                 ///< numbers of pairs, as visibility() counts them

  /// The number of patches.
  [[nodiscard]] std::size_t size() const noexcept { return first.size() - 1; }
  /// The factor from patch i to patch j, both below size(): 0 if the matrix has none. O(log n).
  [[nodiscard]] SHAFTCULL_EXPORT double operator()(std::size_t i, std::size_t j) const noexcept;
};

/// Returns the view factors of every two patches of a set. Pairs that visibility() calls `clear` have view_factor(),
/// and pairs that are `occluded` or `facing_away` have 0. All other pairs have view_factor() times the visible part,
/// which rays against the candidates of the pair estimate, as in visible_fractions() (rays.hpp). Rays are weighted by
/// cos θ₁ cos θ₂ / r². So no factor is above that of unobstructed patches.
///
/// Patches are polygons that radiate from their front; a flat box is a rectangle, which faces where the normal of its
/// plane points. A patch without an area has an empty row. Everything that can hide patches must be among the
/// occluders, including the bodies that patches belong to. Solids should not contain patches, since they hide them.
///
/// The error of factors of clear pairs is at most 10⁻⁶ of the factor. Time grows with the number of pairs that see each
/// other, and with the time of visibility(): a second or two for the 2,500 patches of a city, on one thread. Allocates
/// 56 bytes per pair with a factor, and the memory of visible_fractions(). The first call with a set prepares it: about
/// 800 bytes per patch, which the set keeps. Runs in parallel, in the caller's task_arena. The result is the same bits
/// for any number of threads and on every instruction set, as far as those of visible_fractions() are. Throws
/// InvalidArgument for options out of range, for patches without planes, for patches with two sides, for patches that
/// are boxes with an interior, and for rows that are to be closed and are off by more than 0.1. Throws Cancelled, and
/// std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT ViewFactors view_factors(const PatchSet& patches, const Occluders& occluders,
                                                        const ViewFactorOptions& options = {});

/// Joins the matrices of all parts (ViewFactorOptions::part), in any order, into the matrix of all pairs. So several
/// processes can share the work, and finished parts can be stored. All factors have the bits that one call of
/// view_factors() gives, except where rows are closed and factors were left out. Estimated errors, left-out sums, and
/// sums of rows with left-out factors may be rounded differently; they may depend on the order of parts. In
/// ViewFactors::counts, pairs may move between `occluded` and `facing_away` (VisibilityOptions::part). If `close_rows`
/// is true, rows are closed, as by ViewFactorOptions::close_rows. A missing part is not detected, but counts.total()
/// shows it. No parts make a matrix of no patches.
///
/// O(n log n) for n factors; allocates 24 bytes per pair with a factor. Runs in parallel, in the caller's task_arena.
/// Throws InvalidArgument for parts of different patches, for parts that have the same pair, for arrays that do not fit
/// each other or have numbers that are not finite or below 0, and for rows that are to be closed and are off by more
/// than 0.1. Throws std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT ViewFactors join_view_factors(std::span<const ViewFactors> parts,
                                                             bool close_rows = false);

}  // namespace shaftcull
