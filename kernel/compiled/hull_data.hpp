// SPDX-License-Identifier: MIT
/// What a compiled convex hull holds: planes as kernels read them, and the vertices that exact predicates start from.
#pragma once

#include <cstdint>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

struct ShaftData;

/// A convex hull of points, or of points and directions: conv(points) + cone(directions).
///
/// A box misses it iff one of these separates them: a face of its box, a face of the hull, or an edge of the hull's
/// projection along an axis (a plane whose normal has a zero component on that axis). docs/exactness.md has the proof.
/// Faces of the hull whose normals have a zero component are such edges, too, and are kept as edges only.
struct HullData {
  static constexpr unsigned most_vertices = 32;
  static constexpr unsigned most_faces = 2 * most_vertices - 4;  // all of them triangles
  static constexpr unsigned most_edges = 3 * most_vertices;      // as many an axis as there are vertices

  /// depth = offset + Σ inward[i] · (coordinate i): negative beyond the plane.
  struct alignas(32) Plane {
    float inward[3];
    float offset;              ///< of a bounded hull, with the margin added
    float length;              ///< of the normal
    float magnitude;           ///< at least |offset| + Σ |inward[i] · (coordinate i of a vertex in the plane)|
    std::uint8_t near[3];      ///< stream of a BoxView that holds coordinate i of a box's near corner
    std::uint8_t vertices[3];  ///< which span the plane, the first of them a point; an edge has two
    std::uint8_t axis;         ///< along which an edge is projected; its coordinates 0 and 1 are on the next two axes
    std::int8_t sign;          ///< of what the vertices' orientation says: 1, or −1 if it is positive inside
  };

  /// The coefficients of planes side by side, for tests of one bound, whose vectors hold a plane in each lane. Normals
  /// of edges are 0 along their axis. Behind the last plane, every bound is behind the plane of a lane.
  struct alignas(64) PlaneGroup {
    static constexpr unsigned planes = 16;  // a multiple of the widest vectors
    float inward[3][planes];
    float offset[planes];
    float length[planes];
    float magnitude[planes];
  };
  /// One more than planes fill: planes that boxes are culled by may have groups of their own.
  static constexpr unsigned most_groups = (most_faces + most_edges + PlaneGroup::planes - 1) / PlaneGroup::planes + 1;

  /// An edge of the hull: from a vertex that is a point, to a point or along a direction. Seen from outside, face
  /// `left` is to its left.
  struct Crease {
    std::uint8_t from;
    std::uint8_t to;
    std::uint8_t left;
    std::uint8_t right;
  };
  static constexpr unsigned most_creases = 3 * most_vertices - 6;

  float box[6];       ///< around the hull, rounded nowhere; ±∞ where directions lead
  float farthest;     ///< no term of a plane overflows for a centre whose coordinates are at most this, nor their sum
  bool is_bounded;    ///< then planes are scaled so that depths are off by less than 1, the margin
  bool suits_floats;  ///< if not, exact predicates decide alone
  bool is_conservative;  ///< boxes are outside by `apart` faces and `face_edges` alone, and by `box` if it has faces
  bool culls_by_box;     ///< boxes that do not meet `box` are outside
  std::uint8_t faces;    ///< with three coordinates each
  std::uint8_t apart;    ///< of the faces, those that come first: each of the others is nearly parallel to one of them
  std::uint8_t edges;    ///< behind the faces, with two coordinates each
  std::uint8_t face_edges;  ///< of the edges, those that come first: each is a face of the hull, too
  std::uint8_t vertices;
  std::uint8_t points;                   ///< come first; the other vertices are directions
  Plane plane[most_faces + most_edges];  ///< and so many vertices; what is behind them says nothing
  float vertex[most_vertices][3];
  /// Planes: first those that boxes are culled by, which are all or fill groups of their own. Groups behind the last
  /// plane are not written.
  PlaneGroup group[most_groups];
  Crease crease[most_creases + 1];  // and one behind the last that says nothing
  float facet[most_faces][3];       ///< normals of all faces, outwards, by the numbers that creases have
  /// Of a hull that was formed between two ends, which may be hidden from each other; null, null, 0 and 0 for others.
  const ShaftData* middle;     ///< a shaft that holds a segment between the relative interiors of the ends
  float across[6];             ///< a solid that hides them has a lo at most [k], and a hi at least [k + 3], on axis k
  const Vec3* corner;          ///< of the first end, then of the second, as they were given
  std::uint8_t first_corners;  ///< how many are of the first
  std::uint8_t corners;
  std::uint8_t creases;
  std::uint8_t facets;         ///< 0, and no creases, for hulls that were formed by a search, as flat ones are
  std::uint8_t culling_lanes;  ///< of the groups, those that boxes are culled by
  std::uint8_t lanes;          ///< of the groups, those that hold planes
};

}  // namespace shaftcull::kernel
