// SPDX-License-Identifier: MIT
/// The paper's method as a scalar baseline: a shaft box and a linked list of planes, bounds tested one by one.
///
/// Written from the description in E. Haines, "A Shaft Culling Tool", Journal of Graphics Tools 5(1), 2000. It keeps
/// that method's ways on purpose (one allocation a plane, a list, early out, corners looked up by index) and is as fast
/// as they allow: it is what the library is measured against.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace shaftcull::paper {

/// The two extreme corners of a box: lo x y z, then hi x y z.
using Corners = float[2][3];

struct Ball {
  float centre[3];
  float radius;
};

enum class Answer : std::uint8_t { outside, overlap, inside };

/// n·p ≤ offset is the inside. A record on the heap, linked to the next.
struct PlaneRecord {
  float normal[3];
  float offset;
  std::uint8_t near[3];  ///< on each axis the corner (0 lo, 1 hi) that decides whether a box is outside
  std::uint8_t far[3];   ///< and whether it is inside
  float culled_area;     ///< of the triangle that the plane cuts off the shaft box, seen along the edge
  PlaneRecord* next;
};

/// How the edges that need a plane are found.
enum class Formation : std::uint8_t {
  run_time,  ///< Listing 1
  table,     ///< 64 entries; does not know faces that coincide, so some planes may be needless
};

struct Options {
  Formation formation = Formation::run_time;
  bool sorted = true;   ///< by culled area, largest first
  bool spheres = true;  ///< normals get unit length, which only spheres need
};

class Shaft {
 public:
  /// Both boxes are finite with lo ≤ hi. Throws std::bad_alloc.
  Shaft(const Corners& box1, const Corners& box2, const Options& options);
  Shaft(Shaft&& other) noexcept;
  Shaft(const Shaft&) = delete;
  Shaft& operator=(const Shaft&) = delete;
  Shaft& operator=(Shaft&&) = delete;
  ~Shaft();

  /// Whether the box is fully outside: of the shaft box, or else of one of the planes in order.
  [[nodiscard]] bool outside(const Corners& box) const noexcept {
    if (outside_shaft_box(box)) return true;
    for (const PlaneRecord* plane = first_; plane != nullptr; plane = plane->next) {
      if (distance(*plane, box, plane->near) > 0.0F) return true;
    }
    return false;
  }

  [[nodiscard]] Answer classify(const Corners& box) const noexcept {
    if (outside(box)) return Answer::outside;
    for (int axis = 0; axis < 3; ++axis) {
      if (box[0][axis] < box_[0][axis] || box[1][axis] > box_[1][axis]) return Answer::overlap;
    }
    for (const PlaneRecord* plane = first_; plane != nullptr; plane = plane->next) {
      if (distance(*plane, box, plane->far) > 0.0F) return Answer::overlap;
    }
    return Answer::inside;
  }

  /// Conservative: a ball near an edge of the shaft may be outside without being found so. Needs options.spheres.
  [[nodiscard]] bool outside(const Ball& ball) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      if (ball.centre[axis] + ball.radius < box_[0][axis] || ball.centre[axis] - ball.radius > box_[1][axis])
        return true;
    }
    for (const PlaneRecord* plane = first_; plane != nullptr; plane = plane->next) {
      if (distance(*plane, ball) > ball.radius) return true;
    }
    return false;
  }

  [[nodiscard]] Answer classify(const Ball& ball) const noexcept {
    if (outside(ball)) return Answer::outside;
    for (int axis = 0; axis < 3; ++axis) {
      if (ball.centre[axis] - ball.radius < box_[0][axis] || ball.centre[axis] + ball.radius > box_[1][axis]) {
        return Answer::overlap;
      }
    }
    for (const PlaneRecord* plane = first_; plane != nullptr; plane = plane->next) {
      if (distance(*plane, ball) > -ball.radius) return Answer::overlap;
    }
    return Answer::inside;
  }

  [[nodiscard]] const PlaneRecord* first_plane() const noexcept { return first_; }

 private:
  [[nodiscard]] bool outside_shaft_box(const Corners& box) const noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      if (box[0][axis] > box_[1][axis] || box[1][axis] < box_[0][axis]) return true;
    }
    return false;
  }
  /// Of one corner of the box from the plane.
  [[nodiscard]] static float distance(const PlaneRecord& plane, const Corners& box,
                                      const std::uint8_t (&corner)[3]) noexcept {
    return plane.normal[0] * box[corner[0]][0] + plane.normal[1] * box[corner[1]][1] +
           plane.normal[2] * box[corner[2]][2] - plane.offset;
  }
  [[nodiscard]] static float distance(const PlaneRecord& plane, const Ball& ball) noexcept {
    return plane.normal[0] * ball.centre[0] + plane.normal[1] * ball.centre[1] + plane.normal[2] * ball.centre[2] -
           plane.offset;
  }

  void join_by_search(const Corners& box1, const Corners& box2, const Options& options);
  void join_by_table(const Corners& box1, const Corners& box2, const Options& options);
  void join(const Corners& box1, const Corners& box2, std::size_t face1, std::size_t face2, const Options& options);
  void free_planes() noexcept;

  Corners box_;
  PlaneRecord* first_ = nullptr;
};

}  // namespace shaftcull::paper
