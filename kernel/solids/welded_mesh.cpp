// SPDX-License-Identifier: MIT
#include "solids/welded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double coincident = 1e-4;  // of turns: the back of another body

/// How far a triangle is turned about an edge, from the back of a first triangle around to its front: ascends with the
/// angle, from 0, not included, to 4. `far_first` and `far` are their corners that are not on the edge.
double turn_behind(const Vec3& start, const Vec3& end, const Vec3& far_first, const Vec3& far) noexcept {
  const Double3 along = between(start, end);
  const Double3 normal = cross(along, between(start, far_first));  // of the first triangle, to its front
  const Double3 inwards = cross(normal, along);                    // from the edge into the first triangle
  const Double3 to = between(start, far);
  const double x = dot(inwards, to);
  const double y = -dot(normal, to) * length(along);
  const double part = y / (std::fabs(x) + std::fabs(y));
  if (x >= 0) return part > coincident ? part : 4 + part;
  return 2 - part;
}

/// Whether two triangles at an edge lie on each other and face apart.
bool are_back_to_back(const Vec3& start, const Vec3& end, const Vec3& far_first, const Vec3& far) noexcept {
  return turn_behind(start, end, far_first, far) > 4 - coincident;
}

}  // namespace

std::vector<RegionFace> faces_of(const Box& region) {
  std::vector<RegionFace> faces;
  for (unsigned axis = 0; axis != 3; ++axis) {
    faces.push_back({axis, false, region.lo[axis]});
    faces.push_back({axis, true, region.hi[axis]});
  }
  return faces;
}

WeldedMesh::WeldedMesh(const TriangleView& triangles, const Box& region) {
  const std::vector<std::uint32_t> vertices = weld(triangles);
  corner_.reserve(triangles.count);
  for (std::size_t t = 0; t != triangles.count; ++t) {
    std::array<std::uint32_t, 3> corner{vertices[3 * t], vertices[3 * t + 1], vertices[3 * t + 2]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    corner_.push_back(corner);
  }
  std::sort(corner_.begin(), corner_.end());
  corner_.erase(std::unique(corner_.begin(), corner_.end()), corner_.end());
  connect();
  std::optional<WeldedMesh> best;
  for (const RegionFace& ground : grounds_in(region)) {
    WeldedMesh other = *this;
    other.sort_into_parts(region, ground);
    if (!best || other.closed_parts() > best->closed_parts()) best = std::move(other);
  }
  if (best) {
    *this = std::move(*best);
  } else {
    sort_into_parts(region, std::nullopt);
  }
}

/// Numbers the positions. Returns the number of each vertex of each triangle.
std::vector<std::uint32_t> WeldedMesh::weld(const TriangleView& triangles) {
  struct Numbered {
    Vec3 position;
    std::uint32_t vertex;
  };
  std::vector<Numbered> all;
  all.reserve(3 * triangles.count);
  for (std::size_t t = 0; t != triangles.count; ++t) {
    for (Vec3 position : triangles[t].vertex) {
      for (float& x : position) x += 0.0F;  // −0 becomes 0
      all.push_back({position, static_cast<std::uint32_t>(all.size())});
    }
  }
  std::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) {
    return std::tie(a.position, a.vertex) < std::tie(b.position, b.vertex);
  });
  std::vector<std::uint32_t> numbers(all.size());
  for (const Numbered& vertex : all) {
    if (position_.empty() || position_.back() != vertex.position) position_.push_back(vertex.position);
    numbers[vertex.vertex] = static_cast<std::uint32_t>(position_.size() - 1);
  }
  return numbers;
}

/// How many corners of a triangle are on a face or beyond it.
std::ptrdiff_t WeldedMesh::excluded(const RegionFace& face, const std::array<std::uint32_t, 3>& corner) const {
  return std::count_if(corner.begin(), corner.end(),
                       [&](std::uint32_t vertex) { return face.excludes(position_[vertex]); });
}

/// The faces of the region that may be the ground: those on or beyond which the most triangles have an edge, or half as
/// many.
std::vector<RegionFace> WeldedMesh::grounds_in(const Box& region) const {
  const std::vector<RegionFace> faces = faces_of(region);
  std::array<std::ptrdiff_t, 6> standing{};
  std::ptrdiff_t most = 1;
  for (std::size_t f = 0; f != faces.size(); ++f) {
    standing[f] = std::count_if(corner_.begin(), corner_.end(),
                                [&](const auto& corner) { return excluded(faces[f], corner) == 2; });
    most = std::max(most, standing[f]);
  }
  std::vector<RegionFace> grounds;
  for (std::size_t f = 0; f != faces.size(); ++f) {
    if (2 * standing[f] >= most) grounds.push_back(faces[f]);
  }
  return grounds;
}

std::ptrdiff_t WeldedMesh::closed_parts() const {
  return std::count_if(parts_.begin(), parts_.end(), [](const Part& part) { return part.is_closed; });
}

/// Finds the edge across each edge.
void WeldedMesh::connect() {
  across_.assign(edges(), none);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // its two vertices, and the edge
  order.reserve(edges());
  for (std::uint32_t edge = 0; edge != edges(); ++edge) {
    const auto [low, high] = std::minmax({vertex(edge), vertex(next(edge))});
    order.emplace_back(std::uint64_t{low} << 32U | high, edge);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> between;
  for (auto first = order.begin(); first != order.end();) {
    between.clear();
    const std::uint64_t ends = first->first;
    for (; first != order.end() && first->first == ends; ++first) between.push_back(first->second);
    if (between.size() == 2 && vertex(between[0]) != vertex(between[1])) {
      across_[between[0]] = between[1];
      across_[between[1]] = between[0];
    } else if (between.size() > 2) {
      pair_crowded(between);
    }
  }
}

/// Pairs the edges between two vertices where bodies touch: each triangle with the one that is next behind it, so that
/// both bound one body. Which ones are paired is a choice: whatever is found in the parts is proven there.
void WeldedMesh::pair_crowded(std::span<const std::uint32_t> edges) {
  constexpr std::size_t most = 16;
  std::vector<std::uint32_t> forward;
  std::vector<std::uint32_t> backward;
  for (const std::uint32_t edge : edges) (vertex(edge) < vertex(next(edge)) ? forward : backward).push_back(edge);
  if (forward.size() != backward.size() || edges.size() > most) return;
  for (const std::uint32_t edge : forward) {
    const auto turn = [&](std::uint32_t other) {
      return turn_behind(start(edge), start(next(edge)), start(next(next(edge))), start(next(next(other))));
    };
    const auto nearest = std::min_element(backward.begin(), backward.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(turn(a), a) < std::pair(turn(b), b);
    });
    across_[edge] = *nearest;
    across_[*nearest] = edge;
    backward.erase(nearest);
  }
}

/// Parts triangles at edges on or beyond a face of the region: those of the ground from all others, and walls back to
/// back, of two bodies that are open there.
void WeldedMesh::part_at_faces(std::span<const RegionFace> faces, const std::vector<bool>& is_of_ground) {
  for (std::uint32_t edge = 0; edge != edges(); ++edge) {
    const std::uint32_t other = across_[edge];
    if (other == none) continue;
    const bool is_at_face = std::any_of(faces.begin(), faces.end(), [&](const RegionFace& face) {
      return face.excludes(start(edge)) && face.excludes(start(next(edge)));
    });
    const bool are_parted = is_of_ground[edge / 3] != is_of_ground[other / 3];
    if (!are_parted && (!is_at_face || !are_back_to_back(start(edge), start(next(edge)), start(next(next(edge))),
                                                         start(next(next(other)))))) {
      continue;
    }
    across_[edge] = none;
    across_[other] = none;
  }
}

/// Sorts the triangles by parts, and leaves out those of the ground. Edges were paired with them: so the bodies on both
/// sides of an edge are not joined where their faces on the ground are left out.
void WeldedMesh::sort_into_parts(const Box& region, const std::optional<RegionFace>& ground) {
  const std::size_t count = corner_.size();
  std::vector<bool> is_of_ground(count, false);
  if (ground) {
    for (std::size_t t = 0; t != count; ++t) is_of_ground[t] = excluded(*ground, corner_[t]) == 3;
  }
  part_at_faces(faces_of(region), is_of_ground);
  std::vector<std::uint32_t> order;  // new order of the triangles
  std::vector<std::uint32_t> place(count, none);
  order.reserve(count);
  for (std::uint32_t seed = 0; seed != count; ++seed) {
    if (place[seed] != none || is_of_ground[seed]) continue;
    Part part{static_cast<std::uint32_t>(order.size()), 0, {start(3 * seed), start(3 * seed)}, true, std::nullopt};
    std::vector<RegionFace> open_at = faces_of(region);  // those beyond which all edges are that have none across
    place[seed] = part.first;
    order.push_back(seed);
    for (std::size_t at = part.first; at != order.size(); ++at) {
      for (std::uint32_t edge = 3 * order[at]; edge != 3 * order[at] + 3; ++edge) {
        for (std::size_t k = 0; k != 3; ++k) {
          part.box.lo[k] = std::min(part.box.lo[k], start(edge)[k]);
          part.box.hi[k] = std::max(part.box.hi[k], start(edge)[k]);
        }
        const std::uint32_t other = across_[edge];
        if (other == none) {
          part.is_closed = false;
          std::erase_if(open_at, [&](const RegionFace& face) {
            return !face.excludes(start(edge)) || !face.excludes(start(next(edge)));
          });
        }
        if (other == none || place[other / 3] != none) continue;
        place[other / 3] = static_cast<std::uint32_t>(order.size());
        order.push_back(other / 3);
      }
    }
    part.end = static_cast<std::uint32_t>(order.size());
    std::erase_if(open_at, [&](const RegionFace& face) {  // nothing of the part is in the region
      return face.excludes(face.is_hi ? part.box.lo : part.box.hi);
    });
    if (!part.is_closed && !open_at.empty()) {
      part.is_closed = true;
      part.open_at = open_at.front();
    }
    parts_.push_back(part);
  }
  std::vector<std::array<std::uint32_t, 3>> corner(order.size());
  std::vector<std::uint32_t> across(3 * order.size(), none);
  for (std::uint32_t to = 0; to != order.size(); ++to) {
    corner[to] = corner_[order[to]];
    for (std::uint32_t i = 0; i != 3; ++i) {
      const std::uint32_t other = across_[3 * order[to] + i];
      if (other != none && place[other / 3] != none) across[3 * to + i] = 3 * place[other / 3] + other % 3;
    }
  }
  corner_ = std::move(corner);
  across_ = std::move(across);
}

SpannedPlane WeldedMesh::plane(std::uint32_t triangle) const noexcept {
  return plane_of(start(3 * triangle), start(3 * triangle + 1), start(3 * triangle + 2));
}

bool WeldedMesh::is_degenerate(std::uint32_t triangle) const noexcept {
  const SpannedPlane spanned = plane(triangle);
  return spanned.normal(0) == 0 && spanned.normal(1) == 0 && spanned.normal(2) == 0;
}

}  // namespace shaftcull::kernel
