// SPDX-License-Identifier: MIT
#include "oracle/sight_scene.hpp"

#include <algorithm>
#include <cmath>

namespace shaftcull {
namespace {

/// Draws the parts of a scene.
class SightPainter {
 public:
  SightPainter(SightScenery scenery, std::uint64_t seed, unsigned most_patches)
      : random_(seed * sight_sceneries + static_cast<unsigned>(scenery)), most_patches_(most_patches) {
    scene_.scenery = scenery;
    reach_ = 3 + static_cast<int>(random_.below(10));
    constexpr float factors[] = {1, 0.37F, 0.1F, 0x1p-20F, 1e6F};
    factor_ = factors[random_.below(5)];
    if (is(SightScenery::tiny)) factor_ = random_.one_in(2) ? 0x1p-149F : 0x1p-128F;
    if (is(SightScenery::huge)) factor_ = largest_float / static_cast<float>(2 * reach_);
  }

  SightScene paint() {
    scene_.is_of_one_set = random_.one_in(2);
    scene_.contact = random_.one_in(3) ? Contact::closed : Contact::open;
    scene_.solids_around_ends = !random_.one_in(3);
    const bool has_planes = !random_.one_in(4);
    make_patches(has_planes, scene_.a, scene_.a_planes);
    if (!scene_.is_of_one_set) {
      const bool other_has_planes = random_.one_in(6) ? !has_planes : has_planes;
      make_patches(other_has_planes, scene_.b, scene_.b_planes);
    }
    make_boxes();
    make_hulls();
    make_polygons();
    make_triangles();
    make_found();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] bool is(SightScenery scenery) const { return scene_.scenery == scenery; }

  float coordinate() {
    switch (scene_.scenery) {
      case SightScenery::uniform:
      case SightScenery::near_edges:
        return random_.uniform(-1, 1);
      case SightScenery::nudged: {
        const float x = random_.integer(8, 8 + reach_);  // not about 0, where nudges are denormals
        return random_.one_in(2) ? random_.nudge(x) : x;
      }
      case SightScenery::wild:
        return random_.one_in(3) ? random_.integer(-2, 2) : random_.wild(random_.one_in(2) ? -149 : -4, 127);
      default:
        return lattice();
    }
  }
  float lattice() { return random_.integer(-reach_, reach_) * factor_; }
  Vec3 point() {
    const float x = coordinate();
    const float y = coordinate();
    const float z = coordinate();
    return {x, y, z};
  }

  /// A box of up to `size` of a lattice, or as large in proportion.
  Box box(int size) {
    if (is(SightScenery::wild)) {
      const Vec3 p = point();
      Vec3 q = point();
      for (std::size_t k = 0; k != 3; ++k) {
        if (random_.one_in(4)) q[k] = p[k];
      }
      return Random::sorted(p, q);
    }
    const Vec3 from = point();
    Box box{from, from};
    for (std::size_t k = 0; k != 3; ++k) {
      if (is(SightScenery::uniform) || is(SightScenery::near_edges)) {
        if (!random_.one_in(8)) box.hi[k] += random_.uniform(0, 0.12F) * static_cast<float>(size);
      } else if (is(SightScenery::nudged)) {
        box.hi[k] = std::max(box.lo[k], random_.nudge(box.lo[k] + random_.integer(0, size)));
      } else {
        box.hi[k] = std::min(largest_float, box.lo[k] + random_.integer(0, size) * factor_);
      }
    }
    if (is(SightScenery::flat)) {
      const unsigned axis = random_.below(3);
      box.hi[axis] = box.lo[axis];
    }
    return box;
  }
  /// A box around the middle, one of few.
  Box shell() {
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float half = random_.integer(0, reach_) * factor_;
      box.lo[k] = -half;
      box.hi[k] = half;
    }
    return box;
  }
  Box patch() {
    if (is(SightScenery::nested) && random_.one_in(2)) return shell();
    if (is(SightScenery::points)) {
      const Vec3 p = point();
      return {p, p};
    }
    return box(2);
  }

  /// A facet of one of the six walls of a room, with the plane that it is in.
  void add_facet(std::vector<Box>& boxes, std::vector<Plane>& planes, bool has_planes) {
    const std::size_t axis = random_.below(3);
    const bool is_far = random_.one_in(2);
    const float wall = static_cast<float>(is_far ? reach_ : -reach_) * factor_;
    Box facet{};
    for (std::size_t k = 0; k != 3; ++k) {
      facet.lo[k] = lattice();
      facet.hi[k] = facet.lo[k] + random_.integer(0, 2) * factor_;
    }
    facet.lo[axis] = facet.hi[axis] = wall;
    boxes.push_back(facet);
    if (!has_planes) return;
    Plane plane{};
    plane.normal[axis] = is_far ? -1.0F : 1.0F;
    plane.offset = plane.normal[axis] * wall;
    planes.push_back(plane);
  }

  /// A plane that touches a patch, nearly or at a distance.
  Plane plane_at(const Box& patch) {
    Plane plane{};
    const unsigned kind = random_.below(5);
    const unsigned axis = random_.below(3);
    do {
      for (std::size_t k = 0; k != 3; ++k) {
        plane.normal[k] = kind == 0   ? (k == axis ? random_.integer(0, 1) * 2 - 1 : 0.0F)
                          : kind == 1 ? (k == axis ? random_.uniform(-1, 1) : 0.0F)
                          : kind == 2 ? random_.integer(-2, 2)
                                      : random_.uniform(-1, 1);
      }
      if (kind == 4 && is(SightScenery::wild)) plane.normal[axis] = random_.wild();
    } while (plane.normal == Vec3{0, 0, 0});
    double offset = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      offset += double{plane.normal[k]} * double{random_.one_in(2) ? patch.lo[k] : patch.hi[k]};
    }
    const double most = static_cast<double>(largest_float);
    plane.offset = static_cast<float>(std::clamp(offset, -most, most));
    if (random_.one_in(4)) plane.offset = random_.nudge(plane.offset);
    if (random_.one_in(12)) plane.offset = coordinate();
    return plane;
  }

  void make_patches(bool has_planes, std::vector<Box>& boxes, std::vector<Plane>& planes) {
    // Where all share few normals, groups of patches face away together.
    const bool faces_one_way = random_.one_in(3);
    const unsigned count = 1 + random_.below(most_patches_);
    while (boxes.size() != count) {
      if (is(SightScenery::room)) {
        add_facet(boxes, planes, has_planes);
        continue;
      }
      boxes.push_back(patch());
      if (!has_planes) continue;
      Plane plane = plane_at(boxes.back());
      if (faces_one_way && planes.size() > 2) {
        // Parallel to one before, so that computed distances of a group round alike; its length is another one.
        const Plane& other = planes[random_.below(3)];
        plane.normal = other.normal;
        double offset = 0;
        for (std::size_t k = 0; k != 3; ++k) offset += double{plane.normal[k]} * double{boxes.back().hi[k]};
        const double most = static_cast<double>(largest_float);
        plane.offset = static_cast<float>(std::clamp(offset, -most, most));
      }
      planes.push_back(plane);
    }
  }

  [[nodiscard]] const Box& random_patch(bool of_b) {
    const std::vector<Box>& boxes = of_b && !scene_.is_of_one_set ? scene_.b : scene_.a;
    return boxes[random_.below(static_cast<unsigned>(boxes.size()))];
  }

  /// A box with faces where those of the box between two patches are at one time: it touches the shaft, or reaches just
  /// across it.
  Box near_edge(bool is_solid) {
    const Box a = random_patch(false);
    const Box b = random_patch(true);
    const double t = random_.uniform(0, 1);
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      const auto at = [&](const Vec3& from, const Vec3& to) {
        return static_cast<float>((1 - t) * double{from[k]} + t * double{to[k]});
      };
      const float lo = at(a.lo, b.lo);
      const float hi = at(a.hi, b.hi);
      const float thickness = random_.one_in(3) ? 0.0F : random_.uniform(0, 0.5F);
      if (is_solid) {  // a slab around the shaft at that time
        const bool is_tight = !random_.one_in(4);
        box.lo[k] = is_tight ? random_.nudge(lo) : lo - random_.uniform(0, 1);
        box.hi[k] = is_tight ? std::max(box.lo[k], random_.nudge(hi)) : hi + random_.uniform(0, 1);
      } else if (random_.one_in(2)) {
        box.lo[k] = random_.one_in(2) ? hi : random_.nudge(hi);
        box.hi[k] = box.lo[k] + thickness;
      } else {
        box.hi[k] = random_.one_in(2) ? lo : random_.nudge(lo);
        box.lo[k] = box.hi[k] - thickness;
      }
    }
    return box;
  }

  void make_boxes() {
    for (unsigned left = random_.below(8); left != 0; --left) {
      scene_.boxes.push_back(is(SightScenery::near_edges) ? near_edge(false)
                             : is(SightScenery::nested)   ? shell()
                                                          : box(3));
    }
    for (unsigned left = random_.below(6); left != 0; --left) {
      Box solid = is(SightScenery::near_edges) ? near_edge(true) : is(SightScenery::nested) ? shell() : box(2 * reach_);
      if (is(SightScenery::room) && random_.one_in(2)) {  // a wall across the room
        const std::size_t axis = random_.below(3);
        for (std::size_t k = 0; k != 3; ++k) {
          if (k == axis) continue;
          solid.lo[k] = static_cast<float>(-reach_ - 1) * factor_;
          solid.hi[k] = static_cast<float>(reach_ + 1) * factor_;
        }
      }
      const std::size_t axis = random_.below(3);
      const float middle = 0.5F * solid.lo[axis] + 0.5F * solid.hi[axis];
      if (random_.one_in(3) && solid.lo[axis] < middle && middle < solid.hi[axis]) {  // two that are one together
        Box part = solid;
        part.hi[axis] = middle;
        scene_.solids.push_back(part);
        solid.lo[axis] = middle;
      }
      scene_.solids.push_back(solid);
    }
  }

  void add_hull(std::vector<Vec3>& corners, std::vector<std::size_t>& first) {
    if (random_.one_in(2)) {
      for (unsigned left = 4 + random_.below(6); left != 0; --left) corners.push_back(point());
    } else {  // a box
      const Box whole = box(reach_);
      for (unsigned c = 0; c != 8; ++c) {
        Vec3 corner{};
        for (unsigned k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? whole.hi[k] : whole.lo[k];
        corners.push_back(corner);
      }
    }
    first.push_back(corners.size());
  }
  void make_hulls() {
    if (is(SightScenery::wild) || is(SightScenery::huge)) return;  // boxes inside these have tests of their own
    for (unsigned left = random_.below(3); left != 0; --left) add_hull(scene_.hull_corners, scene_.first_hull);
  }

  void add_polygon(std::vector<Vec3>& corners, std::vector<std::size_t>& first) {
    const unsigned kind = random_.below(3);
    if (kind == 0) {  // a triangle
      for (unsigned i = 0; i != 3; ++i) corners.push_back(point());
    } else {  // a rectangle across an axis
      const std::size_t axis = random_.below(3);
      const Box whole = box(2 * reach_);
      for (const unsigned c : {0U, 1U, 3U, 2U}) {
        Vec3 corner = whole.lo;
        if ((c & 1U) != 0) corner[(axis + 1) % 3] = whole.hi[(axis + 1) % 3];
        if ((c & 2U) != 0) corner[(axis + 2) % 3] = whole.hi[(axis + 2) % 3];
        corners.push_back(corner);
        if (kind == 2 && random_.one_in(4)) corners.push_back(corner);
      }
    }
    first.push_back(corners.size());
  }
  void make_polygons() {
    for (unsigned left = random_.below(3); left != 0; --left) add_polygon(scene_.polygon_corners, scene_.first_polygon);
  }

  void make_triangles() {
    const unsigned count = random_.one_in(4) ? random_.below(80) : random_.below(8);
    while (scene_.triangles.size() != count) {
      Triangle triangle{};
      for (Vec3& vertex : triangle.vertex) vertex = point();
      scene_.triangles.push_back(triangle);
    }
    if (count == 0 || random_.one_in(2)) return;
    scene_.first_triangle.push_back(0);
    while (scene_.first_triangle.back() != count) {
      const std::size_t size = 1 + random_.below(std::max(count / 4, 1U));
      scene_.first_triangle.push_back(std::min<std::size_t>(count, scene_.first_triangle.back() + size));
    }
  }

  void make_found() {
    if (random_.one_in(2)) return;
    const bool has_hulls = !is(SightScenery::wild) && !is(SightScenery::huge);
    if (has_hulls && random_.one_in(2)) add_hull(scene_.found.hull_corners, scene_.found.first_hull_corner);
    if (random_.one_in(2)) add_polygon(scene_.found.polygon_corners, scene_.found.first_polygon_corner);
    for (unsigned left = random_.below(3); left != 0; --left) {
      Box inside = box(2 * reach_);
      if (!scene_.solids.empty() && random_.one_in(2)) {  // one that is joined with a solid
        inside = scene_.solids[random_.below(static_cast<unsigned>(scene_.solids.size()))];
        const std::size_t axis = random_.below(3);
        const float depth = inside.hi[axis] - inside.lo[axis];
        inside.lo[axis] = inside.hi[axis];
        inside.hi[axis] = std::min(largest_float, inside.hi[axis] + depth);
      }
      scene_.found.inner_boxes.push_back(inside);
    }
    if (random_.one_in(2)) make_plate();
  }

  /// The found polygon gets a back polygon, beside it or at the same place.
  void make_plate() {
    const std::size_t axis = random_.below(3);
    const float from = point()[axis];
    const float to = point()[axis];
    scene_.found.back_corners = scene_.found.polygon_corners;
    for (Vec3& corner : scene_.found.back_corners) {
      corner[axis] = std::clamp(corner[axis] + (to - from), -largest_float, largest_float);
    }
  }

  Random random_;
  unsigned most_patches_;
  int reach_;
  float factor_;
  SightScene scene_{};
};

}  // namespace

const char* name(SightScenery scenery) {
  constexpr const char* names[sight_sceneries] = {"lattice", "points",     "flat", "nested", "room", "uniform",
                                                  "nudged",  "near edges", "wild", "tiny",   "huge"};
  return names[static_cast<unsigned>(scenery)];
}

SightScene random_sight_scene(SightScenery scenery, std::uint64_t seed, unsigned most_patches) {
  return SightPainter(scenery, seed, most_patches).paint();
}

}  // namespace shaftcull
