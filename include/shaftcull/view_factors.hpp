// SPDX-License-Identifier: MIT
/// View factors: which share of the radiation that one patch sends out another one receives (docs/view-factors.md).
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
/// cos θ₁ cos θ₂ / (π r²) over both areas, by the area of the first. The pairs that visibility() calls `clear` have it;
/// for others it is an upper bound.
///
/// A polygon has 3 to 8 corners, counterclockwise as seen from the front, which radiates diffusely. The part of one
/// that is behind the other's plane does not count. Corners that are off their plane a little, as those of turned walls
/// are, do no harm. Polygons may share corners and edges.
///
/// The error is below 10⁻⁸ of the factor, or 10⁻¹¹ where that is more. Bits are the same on every machine, whatever the
/// instruction set. Both factors of a pair are one number by the area of either polygon, so A₁ F₁₂ = A₂ F₂₁ but for one
/// rounding.
///
/// About 0.4 µs for two squares that are far from each other, 6 µs at the distance of a side, and 15 µs if they share
/// an edge, since the integrand is not smooth there. Allocates nothing, and is safe from many threads. Coordinates are
/// in any unit. Throws InvalidArgument for another number of corners, for one that is not finite, and if `from` has no
/// area.
///
/// The method: E. M. Sparrow, "A New and Simpler Formulation for Radiative Angle Factors", 1963.
[[nodiscard]] SHAFTCULL_EXPORT double view_factor(std::span<const Vec3> from, std::span<const Vec3> to);

/// Options of view_factors().
struct ViewFactorOptions {
  /// Most rays per undecided pair; a multiple of 16 is cast. 1 to 65536.
  std::uint32_t rays = 4096;
  /// A pair gets fewer rays if the estimated standard error of both its factors is at most this: 16 rays first, then as
  /// many again, and so on. 0: each undecided pair gets all rays.
  double error = 2e-5;
  std::uint64_t seed = 1;  ///< as RayOptions::seed
  /// Pairs both of whose factors are below this are left out of the matrix; ViewFactors::left_out has their sums.
  double least = 0;
  /// Whether rows are made to sum to 1, as those of an enclosure do: what patches i and j exchange is multiplied by a
  /// number of i and one of j, so reciprocity stays. Patches that see nothing keep empty rows. `least` is compared
  /// before. (Matrix balancing: R. Sinkhorn, "A Relationship Between Arbitrary Positive Matrices and Doubly Stochastic
  /// Matrices", 1964.)
  bool close_rows = false;
  float tolerance = 0;                          ///< as VisibilityOptions::tolerance and RayOptions::tolerance
  std::size_t memory = std::size_t{256} << 20;  ///< as VisibilityOptions::memory; the matrix is not included
  std::function<bool(const VisibilityProgress& progress)> progress = {};  ///< as VisibilityOptions::progress
};

/// View factors of all pairs of a set: a sparse matrix in rows (CSR). Row i has the factors from patch i to others:
/// factor[k] is to patch column[k], for k from first[i] to first[i + 1]. Columns ascend; factors are above 0. Where row
/// i has a factor to j, row j has one to i, and area[i] F(i, j) = area[j] F(j, i) but for rounding.
struct ViewFactors {
  std::vector<std::size_t> first{0};  ///< where the factors of each row begin; then the last end
  std::vector<std::uint32_t> column;  ///< to which patch each factor is
  std::vector<double> factor;         ///< row by row
  std::vector<double> area;           ///< of each patch
  std::vector<double> sum;  ///< of each row, with what is left out; 1 − sum is the share that meets no patch: the sky
  std::vector<double> error;     ///< of each sum, the estimated standard error
  std::vector<double> left_out;  ///< of each sum, the part that is below ViewFactorOptions::least
  SightCounts counts;            ///< of pairs, as visibility() counts them

  /// The number of patches.
  [[nodiscard]] std::size_t size() const noexcept { return first.size() - 1; }
  /// The factor from patch i to patch j, both below size(): 0 if the matrix has none. O(log n).
  [[nodiscard]] SHAFTCULL_EXPORT double operator()(std::size_t i, std::size_t j) const noexcept;
};

/// Returns the view factors of each two patches of a set: view_factor() of pairs that visibility() calls `clear`, 0 of
/// pairs that are `occluded` or `facing_away`, and of others view_factor() times the visible part, by rays against the
/// candidates of the pair, as visible_fractions() casts them (rays.hpp). Rays are weighted by cos θ₁ cos θ₂ / r². So no
/// factor is above that of unobstructed patches.
///
/// Patches are polygons that radiate from their front; a flat box is the rectangle that it is, and faces where the
/// normal of its plane points. A patch without an area has an empty row. What hides others is to be among the
/// occluders, the patches' own bodies included. Solids should not contain patches: they hide them.
///
/// Factors of clear pairs are off by 10⁻⁶ of themselves at most. Time grows with the pairs that see each other, and
/// with what visibility() takes: a second or two for the 2,500 patches of a city, on one thread. Allocates 56 bytes per
/// pair with a factor, and what visible_fractions() does. Runs in parallel, in the caller's task_arena. The result is
/// the same bits for any number of threads and on every instruction set. Throws InvalidArgument for options out of
/// range, for patches without planes, with two sides, or that are boxes with an interior, and for rows that are to be
/// closed and are off by more than 0.1; Cancelled; std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT ViewFactors view_factors(const PatchSet& patches, const Occluders& occluders,
                                                        const ViewFactorOptions& options = {});

}  // namespace shaftcull
