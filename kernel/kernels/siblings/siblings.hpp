// SPDX-License-Identifier: MIT
/// Sibling shafts: those from one box to each of up to 64 others, a shaft a lane.
///
/// Elsewhere a shaft is tested with many bounds. Where groups of patches are compared, many shafts are tested with few
/// bounds, and each shaft with others: so lanes are shafts here, and a bound is in all lanes.
///
/// A shaft's box moves from box a to box b, t from 0 to 1. Constraints on t that concern different axes separate it
/// from a bound, or let it pass through one (docs/exactness.md). As for occluded boxes
/// (kernels/blocking/blocking_boxes.hpp), one that bounds t from below by s and one that bounds 1 − t from below by u
/// leave no t if s + u is 1 or more.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "exact/patch_plane.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Most siblings.
inline constexpr unsigned most_siblings = 64;

/// A box whose faces are read one at a time: lo x, y, z, hi x, y, z. The last two floats say nothing.
struct alignas(32) BoxRow {
  float face[8];
};

/// Shafts from box `fixed` to box i of six streams, in the form that tests read. `outer` are the faces of the shaft's
/// box, and `inner` those of the two boxes that are farther inside. Of a face that moves, the reciprocal of its travel
/// is in `forward` if the coordinate grows on the way to b, and in `backward` if it shrinks, always positive.
struct Siblings {
  unsigned count;
  Contact contact;
  /// Whether boxes are those of groups. Then, with open contact, a flat bound is kept if it touches: it may lie in a
  /// face of the shaft, where a flat shaft between two of their patches meets it.
  bool are_groups;
  bool solids_around_ends;    ///< whether a solid that reaches into an end may block
  const float* fixed;         ///< six faces
  const float* const* other;  ///< six streams
  /// Which faces of the boxes are left out of the ends, where solids are concerned (OpenBox in exact/blocking.hpp).
  const float* fixed_inward;
  const float* const* other_inward;
  std::uint64_t inexact;  ///< where floats overflow: exact predicates decide alone
  alignas(64) float outer[6][most_siblings];
  alignas(64) float inner[6][most_siblings];
  alignas(64) float forward[6][most_siblings];
  alignas(64) float backward[6][most_siblings];
};

/// Boxes of siblings that are left, side by side: a vector may be written behind them.
struct PackedBoxes {
  alignas(64) float face[6][most_siblings + 16];
};

/// Bounds of a list, and which rows and columns of a product may have to do with each.
struct ListedSides {
  const std::uint32_t* list;
  const std::uint64_t* rows;
  const std::uint64_t* columns;
};

/// Planes of patches, or of groups of them: bounds of the components of their normals, and of their offsets, in which
/// the tolerance is. Those of a patch are equal, and stand for all of its planes.
struct PlaneStreams {
  const float* least_normal[3];
  const float* largest_normal[3];
  const float* least_offset;
  const float* error;  ///< of a computed normal·p − offset; NaN where floats overflow
  ExactPlanes exact;   ///< of patches
};

/// A plane of PlaneStreams alone.
struct PlaneRow {
  float least_normal[3];
  float largest_normal[3];
  float least_offset;
  float error;
  ExactPlanes exact;  ///< of patches
  unsigned lane;      ///< which of them it is
};

/// A plane behind which what a solid hides from one end lies. Of the computed heights normal·p − offset of a patch's
/// corners, the highest must be at most `highest`, and the lowest at most `lowest`: if they are above what is possible,
/// the patch is not behind the plane, and if they are not above what is certain, it is. Where floats overflow, all is
/// possible, and nothing is certain.
struct ConePlane {
  float normal[3];
  float offset;
  struct Limits {
    float highest;
    float lowest;
  };
  Limits possible;
  Limits certain;
};

/// Lanes behind all planes of a cone: those that may be, and those among them that are for certain.
struct BehindCone {
  std::uint64_t possible;
  std::uint64_t certain;
};

/// An edge of a patch, by the numbers of its corners.
struct PatchEdge {
  std::uint8_t from;
  std::uint8_t to;
};

/// A patch and up to 64 others, by their corners. Stream 3 c + k of `other` has coordinate k of corner c.
struct CornersOfPairs {
  const Vec3* fixed;
  unsigned fixed_corners;
  const PatchEdge* fixed_edge;
  unsigned fixed_edges;
  const float* const* other;
  unsigned corners;
  const PatchEdge* edge;  ///< of each of the others
  unsigned edges;
  unsigned count;

  /// How many planes go through an edge of one patch and a corner of the other.
  [[nodiscard]] constexpr unsigned planes() const noexcept { return fixed_edges * corners + edges * fixed_corners; }
  /// Most planes: of a box, which has twelve edges, and a polygon of eight corners. Of two boxes, nobody asks.
  static constexpr unsigned most_planes = 160;
};

/// Points of an occluder, or the corners of one of its triangles, and bits of pairs: those that are asked about it, and
/// what is found of these.
struct PointsBetween {
  const Vec3* points;
  std::uint32_t count;
  std::uint32_t occluder;  ///< a pair that some points reach into is not asked about the next ones with this number
  bool is_triangle;        ///< then the triangle's own plane may part it from both patches, too
  std::uint64_t asked;
  std::uint64_t reaching;  ///< certainly reach in
  std::uint64_t separate;  ///< certainly behind a plane that touches both patches
};

/// Memory that reach_between() works in: too much for a caller's stack.
struct alignas(64) ReachSpace {
  std::byte bytes[66560];
};

/// A box and a ball around a solid, a little larger than need be.
struct SolidBounds {
  bool has_interior;
  bool is_bounded;  ///< else floats may overflow, and segments are not looked at
  float lo[3];
  float hi[3];
  float middle[3];
  float half[3];  ///< from the middle to each face
  float radius;   ///< of the ball around the middle
};

/// Streams must be readable up to the end of the vector in which the last lane is: they are padded.
struct SiblingKernels {
  /// Copies the boxes of six streams that are in `lanes`. Null if that does not pay.
  void (*pack)(const float* const* other, unsigned count, std::uint64_t lanes, PackedBoxes& packed) noexcept;
  /// The lanes in which packed siblings were whose bits are set. Null like pack().
  std::uint64_t (*spread)(std::uint64_t bits, std::uint64_t lanes) noexcept;

  /// Selects the bounds that one row and some column of `lanes` may have to do with. may[i] are these columns of
  /// selected[i], by their lanes, or if they are `packed`, by where they are then. Both have room for `count`. Returns
  /// how many there are.
  std::size_t (*select)(const ListedSides& listed, std::size_t count, unsigned row, std::uint64_t lanes, bool packed,
                        std::uint32_t* selected, std::uint64_t* may) noexcept;

  /// Forms the shafts, of `count` ≤ most_siblings, that are in `lanes`: others must not be asked. `contact`,
  /// `are_groups`, `solids_around_ends`, `fixed_inward` and `other_inward` are the caller's to set.
  void (*form)(const float* fixed, const float* const* other, unsigned count, std::uint64_t lanes,
               Siblings& siblings) noexcept;

  /// The siblings of `asked` that keep some bound of a list; kept[i], unless null, are the siblings that may keep bound
  /// list[i].
  std::uint64_t (*keep_any)(const Siblings& siblings, const BoxRow* bounds, const std::uint32_t* list,
                            std::size_t count, const std::uint64_t* may_keep, std::uint64_t asked) noexcept;

  /// Writes for every bound of a list which siblings of `asked` keep it. Returns the union.
  std::uint64_t (*keep)(const Siblings& siblings, const BoxRow* bounds, const std::uint32_t* list, std::size_t count,
                        const std::uint64_t* may_keep, std::uint64_t asked, std::uint64_t* kept) noexcept;

  /// The siblings of `asked` that a solid of a list blocks; `may_block` as may_keep.
  std::uint64_t (*block)(const Siblings& siblings, const BoxRow* solids, const std::uint32_t* list, std::size_t count,
                         const std::uint64_t* may_block, std::uint64_t asked) noexcept;

  /// Writes for every solid of a list which siblings of `asked` it may block. The siblings are groups whose boxes have
  /// lo and hi exchanged. If a sibling's bit is 0, the solid blocks no patch of the one group from a patch of the
  /// other.
  void (*may_block)(const Siblings& siblings, const BoxRow* solids, const std::uint32_t* list, std::size_t count,
                    const std::uint64_t* may_block, std::uint64_t asked, std::uint64_t* kept) noexcept;

  /// The boxes, of `count` ≤ 64 in six streams, that lie on or behind a patch's plane.
  std::uint64_t (*behind_plane)(const PlaneRow& plane, const float* const* boxes, unsigned count) noexcept;

  /// The patches of `asked`, of `count` ≤ 64, on or behind whose planes the box lies.
  std::uint64_t (*behind_planes)(const PlaneStreams& planes, unsigned count, const float* box,
                                 std::uint64_t asked) noexcept;

  /// The patches, of `count` ≤ 64, all of whose corners lie on or behind a patch's plane. Stream 3 c + k of
  /// 3 · `corners` has coordinate k of corner c.
  std::uint64_t (*corners_behind_plane)(const PlaneRow& plane, const float* const* corner, unsigned corners,
                                        unsigned count, std::uint64_t asked) noexcept;

  /// Likewise of points, all of which lie there.
  std::uint64_t (*points_behind_planes)(const PlaneStreams& planes, unsigned count, const Vec3* points,
                                        std::size_t size, std::uint64_t asked) noexcept;

  /// The patches of `asked`, of `count` ≤ 64 with corners in streams as above, such that no segment from a corner of
  /// theirs to one of `fixed` certainly misses a solid.
  std::uint64_t (*may_meet_solid)(const SolidBounds& solid, const Vec3* fixed, unsigned fixed_corners,
                                  const float* const* corner, unsigned corners, unsigned count,
                                  std::uint64_t asked) noexcept;

  /// The planes of `asked`, of `count` ≤ 64 in streams, that some point has a normal·p above the limit of.
  std::uint64_t (*planes_behind_points)(const float (&normal)[3][most_siblings], const float* limit, unsigned count,
                                        const Vec3* points, std::size_t size, std::uint64_t asked) noexcept;

  /// Which of a list of points reach between a patch and others, not both of them boxes. What is not certain is left
  /// open.
  void (*reach_between)(const CornersOfPairs& pairs, float tolerance, PointsBetween* points, std::size_t number,
                        ReachSpace& space) noexcept;

  /// The patches of `asked`, of `count` ≤ 64, all of whose corners, in streams as above, lie behind all planes. Bits
  /// are the same on all instruction sets.
  BehindCone (*corners_behind_cone)(const ConePlane* planes, std::size_t number, const float* const* corner,
                                    unsigned corners, unsigned count, std::uint64_t asked) noexcept;

  /// Likewise of boxes in six streams.
  BehindCone (*boxes_behind_cone)(const ConePlane* planes, std::size_t number, const float* const* boxes,
                                  unsigned count, std::uint64_t asked) noexcept;

  /// The groups of `asked`, of `count` ≤ 64, such that the box lies on or behind every patch's plane. It may say no.
  std::uint64_t (*behind_groups)(const PlaneStreams& groups, unsigned count, const float* box,
                                 std::uint64_t asked) noexcept;

  /// The boxes, of `count` ≤ 64 in six streams, that lie on or behind every plane of a group. It may say no.
  std::uint64_t (*behind_group)(const PlaneRow& group, const float* const* boxes, unsigned count) noexcept;
};

}  // namespace shaftcull::kernel
