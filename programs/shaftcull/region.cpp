// SPDX-License-Identifier: MIT
#include "region.hpp"

#include <algorithm>
#include <cmath>

namespace shaftcull::cli {
namespace {

constexpr unsigned box_corners = 8;

Point3 moved(const Point3& start, const Point3& way, double t) {
  Point3 end{};
  for (std::size_t axis = 0; axis < 3; ++axis) end[axis] = start[axis] + t * way[axis];
  return end;
}

void add_corners(const Box& box, std::vector<Point3>& points) {
  for (unsigned corner = 0; corner < box_corners; ++corner) points.push_back(corner_of(box, corner));
}

/// Twice the area of the triangle p, q, r; above 0 if it turns left.
double turn(const Point2& p, const Point2& q, const Point2& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// The part of a polygon where `side` · x[axis] ≤ `side` · limit.
std::vector<Point2> cut_off(const std::vector<Point2>& polygon, std::size_t axis, double limit, double side) {
  std::vector<Point2> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2& p = polygon[i];
    const Point2& q = polygon[(i + 1) % polygon.size()];
    const double from_p = side * (p[axis] - limit);
    const double from_q = side * (q[axis] - limit);
    if (from_p <= 0) rest.push_back(p);
    if ((from_p < 0 && from_q > 0) || (from_p > 0 && from_q < 0)) {
      const double t = from_p / (from_p - from_q);
      Point2 crossing{p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
      crossing[axis] = limit;
      rest.push_back(crossing);
    }
  }
  return rest;
}

/// The part of a polygon within the rectangle between two corners.
std::vector<Point2> cut_off(std::vector<Point2> polygon, const Point2& lo, const Point2& hi) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    polygon = cut_off(polygon, axis, lo[axis], -1);
    polygon = cut_off(polygon, axis, hi[axis], 1);
  }
  return polygon;
}

}  // namespace

Point3 in_doubles(const Vec3& v) { return {v[0], v[1], v[2]}; }

Point3 corner_of(const Box& box, unsigned corner) {
  Point3 point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = ((corner >> axis & 1) != 0 ? box.hi : box.lo)[axis];
  return point;
}

Region region_of(const ShaftChoice& choice, const Box& from, const Box& to) {
  Region region;
  if (choice.kind() == ShaftKind::hull) {
    for (const Vec3& point : choice.points()) region.points.push_back(in_doubles(point));
    for (const Vec3& direction : choice.directions()) region.directions.push_back(in_doubles(direction));
    return region;
  }
  const Point3 motion = in_doubles(choice.motion());
  switch (choice.kind()) {
    case ShaftKind::swept:
      add_corners(from, region.points);
      for (unsigned i = 0; i < box_corners; ++i) region.points.push_back(moved(region.points[i], motion, 1));
      break;
    case ShaftKind::swept_infinite:
      add_corners(from, region.points);
      region.directions = {motion};
      break;
    case ShaftKind::shadow: {
      // As seen from the far corner of the light, each corner of the occluder moves away from it.
      add_corners(to, region.points);
      for (unsigned i = 0; i < box_corners; ++i) {
        const Point3 way = moved(corner_of(to, i), corner_of(from, box_corners - 1 - i), -1);
        if (choice.reach()) {
          region.points.push_back(moved(region.points[i], way, *choice.reach() - 1.0));
        } else {
          region.directions.push_back(way);
        }
      }
      break;
    }
    case ShaftKind::between:
    case ShaftKind::hull:
      add_corners(from, region.points);
      add_corners(to, region.points);
      break;
  }
  return region;
}

ShownSpace frame_around(const Region& region, std::span<const Point3> others) {
  ShownSpace frame{region.points.front(), region.points.front()};
  const auto include = [&](const Point3& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.lo[axis] = std::min(frame.lo[axis], point[axis]);
      frame.hi[axis] = std::max(frame.hi[axis], point[axis]);
    }
  };
  for (const Point3& point : region.points) include(point);
  for (const Point3& point : others) include(point);
  double extent = 0;
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent = std::max(extent, frame.extent(axis));
    for (const Point3& direction : region.directions) longest = std::max(longest, std::abs(direction[axis]));
  }
  if (longest == 0) return frame;
  const double far = (extent == 0 ? 1 : extent) / longest;
  for (const Point3& point : region.points) {
    for (const Point3& direction : region.directions) include(moved(point, direction, far));
  }
  return frame;
}

std::vector<Point2> hull_outline(std::vector<Point2> points) {
  // A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point2> outline;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = outline.size();
    for (auto point = begin; point != end; ++point) {
      while (outline.size() >= first + 2 && turn(outline[outline.size() - 2], outline.back(), *point) <= 0) {
        outline.pop_back();
      }
      outline.push_back(*point);
    }
    outline.pop_back();  // the other chain begins with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return outline;
}

bool meets_rectangle(const std::vector<Point2>& polygon, const Point2& lo, const Point2& hi) {
  return !cut_off(polygon, lo, hi).empty();
}

std::vector<Point2> outline_of(const Region& region, const ShownSpace& frame, std::size_t across, std::size_t up) {
  std::vector<Point2> points;
  for (const Point3& point : region.points) points.push_back({point[across], point[up]});
  // So far along a direction that what is cut off there is out of the frame.
  constexpr double times_the_frame = 1000;
  const double far = times_the_frame * std::max(frame.extent(across), frame.extent(up));
  const std::size_t count = points.size();
  for (const Point3& direction : region.directions) {
    const double length = std::hypot(direction[across], direction[up]);
    if (length == 0) continue;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back({points[i][0] + direction[across] / length * far, points[i][1] + direction[up] / length * far});
    }
  }
  return cut_off(hull_outline(std::move(points)), {frame.lo[across], frame.lo[up]}, {frame.hi[across], frame.hi[up]});
}

}  // namespace shaftcull::cli
