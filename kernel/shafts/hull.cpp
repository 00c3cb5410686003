// SPDX-License-Identifier: MIT
#include "shaftcull/hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "compiled/hull_data.hpp"
#include "compiled/shaft_data.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shafts/hull_formation.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {

using kernel::HullData;

struct ConvexHull::Parts {
  HullData data;
  std::array<Vec3, HullData::most_vertices> vertex;  ///< as given, points first; `data` has each of them once
  std::size_t points;
  std::size_t vertices;
  kernel::SmallHull triangles;  ///< of `data`
  std::size_t first_end;        ///< how many of the points are of the first of two ends, or 0
  CompiledShaft middle;         ///< if there are two ends
};

namespace {

bool is_finite(const Vec3& v) noexcept {
  constexpr float largest = std::numeric_limits<float>::max();
  return std::fabs(v[0]) <= largest && std::fabs(v[1]) <= largest && std::fabs(v[2]) <= largest;
}

void require_finite(const char* what, std::size_t i, const Vec3& v) {
  if (is_finite(v)) [[likely]]
    return;
  for (std::size_t k = 0; k != 3; ++k) {
    if (std::isfinite(v[k])) continue;
    kernel::fail(InvalidArgument(std::string(what) + " " + std::to_string(i) + ": " + "xyz"[k] + " = " +
                                 kernel::text(v[k]) + " is not finite"));
  }
}

void require_vertices(std::span<const Vec3> points, std::span<const Vec3> directions) {
  kernel::require_memory("points", points, "points");
  kernel::require_memory("directions", directions, "directions");
  if (points.empty()) kernel::fail(InvalidArgument("ConvexHull: there is no point; a hull needs one or more"));
  constexpr std::size_t most = ConvexHull::max_vertices;
  if (points.size() > most || directions.size() > most - points.size()) {
    kernel::fail(InvalidArgument("ConvexHull: " + std::to_string(points.size()) + " points and " +
                                 std::to_string(directions.size()) + " directions; together there can be " +
                                 std::to_string(most)));
  }
  for (std::size_t i = 0; i != points.size(); ++i) require_finite("ConvexHull: point", i, points[i]);
  for (std::size_t i = 0; i != directions.size(); ++i) {
    require_finite("ConvexHull: direction", i, directions[i]);
    if (directions[i] == Vec3{0, 0, 0}) {
      kernel::fail(InvalidArgument("ConvexHull: direction " + std::to_string(i) + " is zero"));
    }
  }
}

void require_finite_corners(std::span<const Vec3> p, std::span<const Vec3> q) {
  for (std::size_t i = 0; i != p.size(); ++i) require_finite("between_polygons: p: corner", i, p[i]);
  for (std::size_t i = 0; i != q.size(); ++i) require_finite("between_polygons: q: corner", i, q[i]);
}

/// Writes each of some vertices once, behind those that the hull has.
void add_different(HullData& hull, std::span<const Vec3> vertices) noexcept {
  for (auto vertex = vertices.begin(); vertex != vertices.end(); ++vertex) {
    if (std::find(vertices.begin(), vertex, *vertex) != vertex) continue;
    std::copy_n(vertex->data(), 3, hull.vertex[hull.vertices++]);
  }
}

/// The vertices of a hull: points first, and none twice.
void fill(HullData& hull, std::span<const Vec3> points, std::span<const Vec3> directions) noexcept {
  hull.vertices = 0;
  add_different(hull, points);
  hull.points = hull.vertices;
  add_different(hull, directions);
}

bool has_point(const HullData& hull, const Vec3& point) noexcept {
  return std::any_of(hull.vertex, hull.vertex + hull.points, [&](const float(&vertex)[3]) {
    return vertex[0] == point[0] && vertex[1] == point[1] && vertex[2] == point[2];
  });
}

/// The largest float that is at most x, and not −∞.
float rounded_down(double x) noexcept {
  const auto rounded = static_cast<float>(
      std::clamp(x, -double{std::numeric_limits<float>::max()}, double{std::numeric_limits<float>::max()}));
  return double{rounded} > x ? std::nextafter(rounded, -std::numeric_limits<float>::max()) : rounded;
}

/// A box around the mean of some points, within the box around the points.
Box around_mean(std::span<const Vec3> points, const Box& around) noexcept {
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    double sum = 0;
    double magnitude = 0;
    for (const Vec3& point : points) {
      sum += double{point[k]};
      magnitude += std::fabs(double{point[k]});
    }
    const double error = 0x1p-46 * magnitude;  // of at most 32 sums and a quotient
    const double mean = sum / static_cast<double>(points.size());
    box.lo[k] = std::max(around.lo[k], rounded_down(mean - error));
    box.hi[k] = std::min(around.hi[k], -rounded_down(-mean - error));
  }
  return box;
}

/// A solid hides one end from the other only if one of the ends is behind each of its faces.
void write_across(const Box& a, const Box& b, HullData& hull) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    hull.across[k] = std::max(a.lo[k], b.lo[k]);
    hull.across[k + 3] = std::min(a.hi[k], b.hi[k]);
  }
}

/// A compiled shaft that has all its answers from a hull.
CompiledShaft referring_to(const HullData& hull) noexcept {
  CompiledShaft compiled;
  kernel::ShaftData& data = kernel::data_of(compiled);
  data.slab_form = kernel::ShaftData::SlabForm::hull;
  data.slab_uppers = 0;
  data.kind = kernel::ShaftData::Kind::hull;
  data.hull = &hull;
  data.largest_coordinate = std::numeric_limits<float>::infinity();  // no grid has a place for it
  for (unsigned f = 0; f < 6; ++f) data.a[f] = data.b[f] = data.face[f] = hull.box[f];
  data.joining_count = 0;
  data.added_count = 0;
  data.formed = true;
  data.contact = Contact::closed;
  data.still_faces = 0;
  return compiled;
}

}  // namespace

ConvexHull::ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions, HullTest test)
    : ConvexHull(points, directions, test, 0) {}

ConvexHull::ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions, HullTest test,
                       std::size_t first_end) {
  kernel::in_float_environment([&] {
    if (first_end == 0) {
      require_vertices(points, directions);  // of two ends, between_polygons() has counted them
    } else {
      require_finite_corners(points.first(first_end), points.subspan(first_end));
    }
    if (test > HullTest::conservative) {
      kernel::fail(InvalidArgument("test = " + std::to_string(static_cast<unsigned>(test)) +
                                   " is neither HullTest::exact nor HullTest::conservative"));
    }
    parts_ = std::make_unique_for_overwrite<Parts>();
    parts_->points = points.size();
    parts_->vertices = points.size() + directions.size();
    std::copy(directions.begin(), directions.end(), std::copy(points.begin(), points.end(), parts_->vertex.begin()));
    fill(parts_->data, this->points(), this->directions());
    parts_->data.is_conservative = test == HullTest::conservative;
    kernel::form_hull(parts_->data, parts_->triangles);
    parts_->first_end = first_end;
    if (first_end != 0) {
      const std::span<const Vec3> all = this->points();
      const std::span<const Vec3> first = all.first(first_end);
      const std::span<const Vec3> second = all.subspan(first_end);
      const Box around_first = box_around(first);
      const Box around_second = box_around(second);
      parts_->middle = compile(around_mean(first, around_first), around_mean(second, around_second));
      write_across(around_first, around_second, parts_->data);
    }
  });
  refer();
}

/// Of a view and what else its casters' hull needs, which is finite; there is room for it.
ConvexHull::ConvexHull(const ConvexHull& view, const Vec3& light, bool is_direction)
    : parts_(std::make_unique_for_overwrite<Parts>()) {
  kernel::in_float_environment([&] {
    const Parts& of_view = *view.parts_;
    const Vec3* const given = of_view.vertex.data();
    Vec3* end = std::copy_n(given, of_view.points, parts_->vertex.data());
    if (!is_direction) *end++ = light;
    end = std::copy(given + of_view.points, given + of_view.vertices, end);
    if (is_direction) *end = light;
    parts_->points = of_view.points + (is_direction ? 0 : 1);
    parts_->vertices = of_view.vertices + 1;

    parts_->first_end = 0;
    HullData& data = parts_->data;
    data.is_conservative = of_view.data.is_conservative;
    if (of_view.data.points == of_view.data.vertices && !(has_point(of_view.data, light) && !is_direction)) {
      data.vertices = of_view.data.vertices;
      for (unsigned v = 0; v != data.vertices; ++v) std::copy_n(of_view.data.vertex[v], 3, data.vertex[v]);
      std::copy_n(light.data(), 3, data.vertex[data.vertices++]);
      data.points = static_cast<std::uint8_t>(data.vertices - (is_direction ? 1 : 0));
      return kernel::form_extended_hull(data, parts_->triangles, of_view.data, of_view.triangles);
    }
    fill(data, points(), directions());
    kernel::form_hull(data, parts_->triangles);
  });
  refer();
}

void ConvexHull::refer() noexcept {
  HullData& data = parts_->data;
  const bool has_ends = parts_->first_end != 0;
  data.middle = has_ends ? &kernel::data_of(parts_->middle) : nullptr;
  data.corner = has_ends ? parts_->vertex.data() : nullptr;
  data.first_corners = static_cast<std::uint8_t>(parts_->first_end);
  data.corners = static_cast<std::uint8_t>(has_ends ? parts_->points : 0);
  parts_->triangles.refer_to(data);
  compiled_ = referring_to(data);
}

ConvexHull::ConvexHull(const ConvexHull& other)
    : parts_(other.parts_ ? std::make_unique<Parts>(*other.parts_) : nullptr) {
  if (parts_) refer();
}

ConvexHull& ConvexHull::operator=(const ConvexHull& other) { return *this = ConvexHull(other); }

ConvexHull::ConvexHull(ConvexHull&& other) noexcept
    : parts_(std::move(other.parts_)), compiled_(std::exchange(other.compiled_, CompiledShaft())) {}

ConvexHull& ConvexHull::operator=(ConvexHull&& other) noexcept {
  parts_ = std::move(other.parts_);
  compiled_ = std::exchange(other.compiled_, CompiledShaft());
  return *this;
}

ConvexHull::~ConvexHull() = default;

Box ConvexHull::box() const noexcept { return compiled_.a(); }

std::span<const Vec3> ConvexHull::points() const noexcept {
  if (!parts_) return {};
  return {parts_->vertex.data(), parts_->points};
}

HullTest ConvexHull::test() const noexcept {
  return parts_ && parts_->data.is_conservative ? HullTest::conservative : HullTest::exact;
}

std::span<const Vec3> ConvexHull::directions() const noexcept {
  if (!parts_) return {};
  return {parts_->vertex.data() + parts_->points, parts_->vertices - parts_->points};
}

ConvexHull between_polygons(std::span<const Vec3> p, std::span<const Vec3> q, HullTest test) {
  kernel::require_memory("p", p, "corners");
  kernel::require_memory("q", q, "corners");
  constexpr std::size_t most = ConvexHull::max_vertices;
  if (p.empty() || q.empty()) {
    kernel::fail(InvalidArgument(std::string("between_polygons: ") + (p.empty() ? "p" : "q") +
                                 " has no corner; both ends need one or more"));
  }
  if (p.size() > most || q.size() > most - p.size()) {
    kernel::fail(InvalidArgument("between_polygons: p has " + std::to_string(p.size()) + " corners and q " +
                                 std::to_string(q.size()) + "; together there can be " + std::to_string(most)));
  }
  std::array<Vec3, most> both;
  std::copy(q.begin(), q.end(), std::copy(p.begin(), p.end(), both.begin()));
  return ConvexHull(std::span<const Vec3>(both).first(p.size() + q.size()), {}, test, p.size());
}

}  // namespace shaftcull
