// SPDX-License-Identifier: MIT
/// Rays, which measure how much two patches see of each other if visibility() leaves the pair undecided, and how much
/// of a patch is lit.
#pragma once

#include <cstdint>
#include <span>

#include "shaftcull/export.hpp"
#include "shaftcull/visibility.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Options of visible_fractions() and lit_fractions().
struct RayOptions {
  /// Rays per pair of patches, or per patch and light; a multiple of 16 is cast. 1 to 65536.
  std::uint32_t rays = 64;
  /// A pair gets fewer rays if the estimated standard error of its fraction is at most this: it gets 16 rays first,
  /// then as many again, and so on. With 0, each pair gets all rays.
  double error = 0;
  /// The points where rays start and end depend only on the seed and the pair: the numbers of both patches, in their
  /// order, or of the patch and the light.
  std::uint64_t seed = 1;
  /// If the surface of an occluder is nearer than this to an end of a ray, the patch is taken to lie on the occluder.
  /// The occluder then blocks the ray only if the ray goes further inside. The tolerance is at least 2⁻¹⁹ of the extent
  /// of patches and occluders, which is 0.2 mm for 100 m, and at least 2⁻²² of the largest coordinate, which is two to
  /// four float steps of it: 0.12 m where coordinates are 500,000 m. So move such scenes to the origin.
  float tolerance = 0;
  std::uint64_t reserved[4] = {};  ///< for options of later versions
};

/// Writes the visible fraction of each pair, from 0 to 1. It is the share of segments that no candidate blocks, among
/// the segments from points of one patch to points of the other that leave and arrive in front; 0 if there are no such
/// segments.
///
/// `pairs` are undecided pairs of `a` and `b`, with candidates, as visibility() delivers them; or any pairs with any
/// occluders. Rays are spread evenly over both patches. A box blocks rays that pass through its inside: it counts as
/// solid, even if it was added as the box around something. A flat box blocks as a rectangle, a hull as a solid, a
/// polygon and a triangle as surfaces. Solids added by Occluders::add_found() block nothing here, since their triangles
/// do. A ray that passes the edge of a triangle within rounding may count as blocked or not; which of both may change
/// if the triangles are grouped differently.
///
/// For 16 rays, the call takes about 0.1 µs per pair of a city. The triangles of a group are in a tree: for pairs with
/// one candidate, a group of a million triangles, it takes about 4 µs. Runs in parallel if there are many pairs, in the
/// caller's task_arena. May be called from VisibilityOptions::resolve. The first call with an Occluders object prepares
/// it: O(n log n), 100 bytes per triangle. Fractions are the same bits for any number of threads and on every
/// instruction set. (In a build with SHAFTCULL_WITH_EMBREE, Embree traces rays through groups of more than 512
/// triangles. These rays may differ where they pass an edge within rounding of the coordinates. docs/tuning.md lists
/// what else differs.) The scene may have an extent from 10⁻³⁶ to 10³⁷.
///
/// Throws InvalidArgument if `fractions` does not have one element per pair, if a pair or candidate is out of range, if
/// there are no candidates (VisibilityOptions::candidates), for options out of range, and for patches that are boxes
/// with an interior. Throws std::bad_alloc if memory runs out.
SHAFTCULL_EXPORT void visible_fractions(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                        const UndecidedPairs& pairs, std::span<float> fractions,
                                        const RayOptions& options = {});

/// Writes the lit fraction of each patch for each light, from 0 to 1: the share of the patch from which no occluder
/// hides the light. `directions` point to lights that are infinitely far away, such as the sun; they need not have unit
/// length. fractions[i · directions.size() + j] is for patch i and light j.
///
/// The fraction is 0 if the patch has no area or does not face the light; a patch with the light in its plane does not
/// face it. A patch that is seen from both sides is lit on either side. Otherwise, the fraction is 1, without rays, if
/// no occluder's box is in the way; if some box is, it is the share of rays that no occluder blocks. Rays are spread
/// evenly over the patch. Occluders block rays as in visible_fractions().
///
/// With 64 rays, the error is about 0.02 where half of the patch is lit. About 0.5 µs per patch and light of a city,
/// with 64 rays. Prepares patches and occluders as visible_fractions() does, and builds a tree of the occluders in each
/// call: O(n log n), 30 bytes per occluder. Runs in parallel over patches, in the caller's task_arena. Fractions are
/// the same bits as those of visible_fractions() are. The scene may have an extent from 10⁻³⁶ to 10³⁷.
///
/// Throws InvalidArgument for a direction that is 0 or not finite, if `fractions` does not have one element for each
/// patch and direction, for options out of range, and for patches that are boxes with an interior. Throws
/// std::bad_alloc if memory runs out.
SHAFTCULL_EXPORT void lit_fractions(const PatchSet& patches, const Occluders& occluders,
                                    std::span<const Vec3> directions, std::span<float> fractions,
                                    const RayOptions& options = {});

}  // namespace shaftcull
