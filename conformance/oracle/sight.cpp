// SPDX-License-Identifier: MIT
#include "oracle/sight.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "oracle/sight_integers.hpp"
#include "oracle/sight_numbers.hpp"
#include "oracle/sight_segments.hpp"

namespace shaftcull::oracle {

/// The answers, whatever integers they are worked out in.
class SightOracle::Questions {
 public:
  Questions() = default;
  Questions(const Questions&) = delete;
  Questions& operator=(const Questions&) = delete;
  virtual ~Questions() = default;
  [[nodiscard]] virtual SightTruth truth(std::size_t i, std::size_t j) const = 0;
  [[nodiscard]] virtual bool reaches(std::size_t i, std::size_t j, std::size_t k) const = 0;
  [[nodiscard]] virtual bool blocks(std::size_t i, std::size_t j, std::size_t k) const = 0;
  [[nodiscard]] virtual bool is_behind(std::size_t i, std::size_t j) const = 0;
};

namespace {

template <class Number>
class Answers final : public SightOracle::Questions {
 public:
  Answers(const SightQuestion& question, int doublings)
      : contact_(question.contact), solids_around_ends_(question.solids_around_ends) {
    const auto number = [&](float x) { return scaled<Number>(x, doublings); };
    const auto point = [&](const Vec3& p) { return Point{number(p[0]), number(p[1]), number(p[2])}; };
    const auto points = [&](const std::vector<Vec3>& from) {
      std::vector<Point> to;
      for (const Vec3& p : from) to.push_back(point(p));
      return to;
    };
    const auto boxes = [&](const std::vector<Box>& from) {
      std::vector<AnyBox> to;
      for (const Box& box : from) to.push_back({point(box.lo), point(box.hi)});
      return to;
    };
    const auto planes = [&](const std::vector<Plane>& from) {
      std::vector<AnyPlane> to;
      for (const Plane& plane : from) to.push_back({point(plane.normal), number(plane.offset) * number(1.0F)});
      return to;
    };
    tolerance_ = number(question.tolerance);
    const auto patches = [&](const std::vector<Box>& from, const std::vector<Plane>& with_planes,
                             const std::vector<std::vector<Vec3>>& with_corners) {
      const std::vector<AnyBox> all = boxes(from);
      const std::vector<AnyPlane> all_planes = planes(with_planes);
      std::vector<Patch> to(all.size());
      for (std::size_t i = 0; i != all.size(); ++i) {
        to[i].box = all[i];
        to[i].has_corners = !with_corners.empty();
        if (to[i].has_corners) {
          to[i].corners = points(with_corners[i]);
          to[i].planes = planes_of(to[i].corners);
          to[i].has_both_sides = question.both_sides;
        } else {
          to[i].corners = all[i].corners();
          if (!all_planes.empty()) to[i].planes = {all_planes[i]};
        }
        to[i].is_box = true;
        for (unsigned c = 0; c != 8; ++c) {
          const std::vector<Point>& own = to[i].corners;
          to[i].is_box = to[i].is_box && std::find(own.begin(), own.end(), all[i].corner(c)) != own.end();
        }
      }
      return to;
    };
    a_ = patches(question.a, question.a_planes, question.a_corners);
    b_ = patches(question.b, question.b_planes, question.b_corners);
    solids_ = boxes(question.solids);
    for (const std::vector<Vec3>& polygon : question.polygons) polygons_.push_back(points(polygon));
    for (const std::vector<Vec3>& back : question.backs) backs_.push_back(points(back));
    backs_.resize(polygons_.size());
    for (const std::vector<Vec3>& hull : question.hulls) hulls_.emplace_back(points(hull));
    for (const SightOccluder& occluder : question.occluders) {
      occluder_boxes_.push_back({point(occluder.box.lo), point(occluder.box.hi)});
      occluder_corners_.push_back(points(occluder.corners));
      occluder_triangles_.emplace_back();
      for (const std::array<Vec3, 3>& triangle : occluder.triangles) {
        Part part{{}, points({triangle.begin(), triangle.end()})};
        for (std::size_t k = 0; k != 3; ++k) {
          const auto [least, largest] = std::minmax({part.corners[0][k], part.corners[1][k], part.corners[2][k]});
          part.box.lo[k] = least;
          part.box.hi[k] = largest;
        }
        occluder_triangles_.back().push_back(std::move(part));
      }
      if (!occluder.corners.empty()) continue;
      occluder_corners_.back() = occluder_boxes_.back().corners();
    }
  }

  [[nodiscard]] SightTruth truth(std::size_t i, std::size_t j) const override {
    SightTruth truth;
    const Patch& a = a_[i];
    const Patch& b = b_[j];
    const std::vector<std::vector<AnyPlane>> facing_b = facing(a, b);
    const std::vector<std::vector<AnyPlane>> facing_a = facing(b, a);
    const auto are_behind_all = [&](const std::vector<std::vector<AnyPlane>>& ways, const std::vector<Point>& points) {
      return std::any_of(ways.begin(), ways.end(), [&](const auto& planes) { return are_behind(planes, points); });
    };
    truth.is_facing_away = are_behind_all(facing_b, b.corners) || are_behind_all(facing_a, a.corners);
    for (std::size_t k = 0; k != solids_.size() && !truth.is_occluded; ++k) truth.is_occluded = blocks(i, j, k);
    for (std::size_t k = 0; k != polygons_.size() && !truth.is_occluded; ++k) {
      const bool may_block = tolerance_ == 0 || !(lie_in(a.corners, polygons_[k]) || lie_in(b.corners, polygons_[k]));
      truth.is_occluded = may_block && polygon_blocks(a.corners, b.corners, polygons_[k]) &&
                          (backs_[k].empty() || polygon_blocks(a.corners, b.corners, backs_[k]));
    }
    for (std::size_t k = 0; k != hulls_.size() && !truth.is_occluded; ++k) {
      truth.is_occluded = hull_blocks(a.corners, b.corners, hulls_[k]);
    }
    const bool are_boxes = a.is_box && b.is_box;
    std::vector<std::size_t> reaching;
    for (std::size_t k = 0; k != occluder_boxes_.size(); ++k) {
      if (reaches(i, j, k)) reaching.push_back(k);
    }
    if (reaching.empty()) return truth;
    const std::vector<AnyPlane> planes = are_boxes ? std::vector<AnyPlane>() : tangents(a, b);
    const auto is_left_out = [&](const std::vector<Point>& corners) {
      return are_behind_all(facing_b, corners) || are_behind_all(facing_a, corners) || are_separate(planes, corners);
    };
    for (const std::size_t k : reaching) {
      if (is_left_out(occluder_corners_[k])) continue;
      const std::vector<Part>& parts = occluder_triangles_[k];
      if (!parts.empty() && std::none_of(parts.begin(), parts.end(), [&](const Part& part) {
            return box_reaches(a.box, b.box, part.box) && !is_left_out(part.corners) &&
                   (are_boxes || !are_on_one_side(a.corners, b.corners, part.corners));
          })) {
        continue;
      }
      truth.candidates.push_back(static_cast<std::uint32_t>(k));
    }
    return truth;
  }

  /// Of each t, the relative interiors of the box between both, or they themselves, must meet: so those of the shaft
  /// do. The relative interior of a convex hull is that of combinations with positive weights.
  [[nodiscard]] bool reaches(std::size_t i, std::size_t j, std::size_t which) const override {
    return box_reaches(a_[i].box, b_[j].box, occluder_boxes_[which]);
  }

  [[nodiscard]] bool blocks(std::size_t i, std::size_t j, std::size_t k) const override {
    const AnyBox& solid = solids_[k];
    if (!solids_around_ends_ && (holds_part_of(solid, a_[i].box) || holds_part_of(solid, b_[j].box))) return false;
    const bool is_open = !solid.is_flat(0) && !solid.is_flat(1) && !solid.is_flat(2);
    // Where a segment misses the closed box, so do those near it.
    const auto misses = [&](const Point& p, const Point& q) { return !passes_box(p, q, solid, false); };
    return all_segments(a_[i].corners, b_[j].corners, is_open, misses,
                        [&](const auto& p, const auto& q) { return passes_box(p, q, solid, true); });
  }

  [[nodiscard]] bool is_behind(std::size_t i, std::size_t j) const override {
    return are_behind(a_[i].planes, b_[j].corners);
  }

 private:
  using Point = PointOf<Number>;
  using AnyBox = BoxOf<Number>;
  struct AnyPlane {
    Point normal;
    Number offset;
  };

  struct Patch {
    AnyBox box;
    std::vector<Point> corners;  ///< those of the box if it has no others
    std::vector<AnyPlane> planes;
    bool has_corners = false;
    bool has_both_sides = false;
    bool is_box = false;  ///< whether it is the box around it
  };

  /// A triangle of an occluder.
  struct Part {
    AnyBox box;
    std::vector<Point> corners;
  };

  /// Whether two ends are on one side of a triangle's plane, but for the tolerance, and not both in it.
  [[nodiscard]] bool are_on_one_side(const std::vector<Point>& a, const std::vector<Point>& b,
                                     const std::vector<Point>& triangle) const {
    for (const AnyPlane& plane : planes_of(triangle)) {
      const Point& n = plane.normal;
      const AnyPlane back{{Number(-n[0]), Number(-n[1]), Number(-n[2])}, Number(-plane.offset)};
      for (const auto& [front, behind] : {std::pair{&plane, &back}, std::pair{&back, &plane}}) {
        bool is_any_off = false;
        bool is_any_beyond = false;
        for (const std::vector<Point>* end : {&a, &b}) {
          for (const Point& x : *end) {
            const Number beyond = lowest_height(*behind, x);
            is_any_beyond = is_any_beyond || (contact_ == Contact::open ? beyond > 0 : beyond >= 0);
            is_any_off = is_any_off || lowest_height(*front, x) > 0;
          }
        }
        if (is_any_off && !is_any_beyond) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool box_reaches(const AnyBox& a, const AnyBox& b, const AnyBox& bound) const {
    Times<Number> times(contact_ == Contact::open);
    for (std::size_t k = 0; k != 3; ++k) {
      if (contact_ == Contact::open && a.is_flat(k) && b.is_flat(k) && bound.is_flat(k)) {
        times.require_zero(a.lo[k] - bound.lo[k], b.lo[k] - a.lo[k]);
        continue;
      }
      times.require(bound.hi[k] - a.lo[k], a.lo[k] - b.lo[k]);
      times.require(a.hi[k] - bound.lo[k], b.hi[k] - a.hi[k]);
    }
    return times.are_there();
  }

  /// The planes of the triangles that the first corner forms with edges, unless they have no area.
  [[nodiscard]] static std::vector<AnyPlane> planes_of(const std::vector<Point>& corners) {
    std::vector<AnyPlane> planes;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Point u = minus(corners[i - 1], corners[0]);
      const Point v = minus(corners[i], corners[0]);
      const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
      planes.push_back({n, n[0] * corners[0][0] + n[1] * corners[0][1] + n[2] * corners[0][2]});
    }
    return planes;
  }

  /// How high above a plane the lowest point is whose coordinates differ from those of p by the tolerance at most.
  [[nodiscard]] Number lowest_height(const AnyPlane& plane, const Point& p) const {
    Number height = dot(plane.normal, p) - plane.offset;
    if (tolerance_ == 0) return height;
    for (const Number& n : plane.normal) height -= n < 0 ? Number(-n * tolerance_) : Number(n * tolerance_);
    return height;
  }
  /// Whether all points may lie in the plane of one of the triangles of a polygon, within the tolerance.
  [[nodiscard]] bool lie_in(const std::vector<Point>& points, const std::vector<Point>& polygon) const {
    const std::vector<AnyPlane> planes = planes_of(polygon);
    return std::any_of(planes.begin(), planes.end(), [&](const AnyPlane& plane) {
      const Point& n = plane.normal;
      const AnyPlane back{{Number(-n[0]), Number(-n[1]), Number(-n[2])}, Number(-plane.offset)};
      return std::all_of(points.begin(), points.end(),
                         [&](const Point& p) { return lowest_height(plane, p) <= 0 && lowest_height(back, p) <= 0; });
    });
  }
  /// Whether all points may lie on or behind all planes, each of them moved by the tolerance on its own.
  [[nodiscard]] bool are_behind(const std::vector<AnyPlane>& planes, const std::vector<Point>& points) const {
    return !planes.empty() && std::all_of(points.begin(), points.end(), [&](const Point& p) {
      return std::all_of(planes.begin(), planes.end(),
                         [&](const AnyPlane& plane) { return lowest_height(plane, p) <= 0; });
    });
  }
  /// The ways in which a patch faces another one: its planes, and of a patch that is seen from both sides, those that
  /// the other one lies in front of, or in.
  [[nodiscard]] std::vector<std::vector<AnyPlane>> facing(const Patch& patch, const Patch& other) const {
    if (!patch.has_both_sides) return {patch.planes};
    std::vector<AnyPlane> backs;
    for (const AnyPlane& plane : patch.planes) {
      const Point& n = plane.normal;
      backs.push_back({{Number(-n[0]), Number(-n[1]), Number(-n[2])}, Number(-plane.offset)});
    }
    std::vector<std::vector<AnyPlane>> ways;
    if (are_behind(backs, other.corners)) ways.push_back(patch.planes);
    if (are_behind(patch.planes, other.corners)) ways.push_back(backs);
    return ways;
  }

  /// The planes through an edge of one patch and a corner of the other that have no corner of either patch behind them,
  /// and one in front: n·x ≥ offset for all corners.
  [[nodiscard]] std::vector<AnyPlane> tangents(const Patch& a, const Patch& b) const {
    std::vector<AnyPlane> planes;
    const auto add = [&](const AnyPlane& plane) {
      bool is_in_front = false;
      bool is_behind = false;
      for (const Patch* patch : {&a, &b}) {
        for (const Point& corner : patch->corners) {
          const Number height = dot(plane.normal, corner) - plane.offset;
          is_in_front = is_in_front || height > 0;
          is_behind = is_behind || height < 0;
        }
      }
      if (is_in_front == is_behind) return;
      if (is_in_front) return planes.push_back(plane);
      const Point& n = plane.normal;
      planes.push_back({{Number(-n[0]), Number(-n[1]), Number(-n[2])}, Number(-plane.offset)});
    };
    for (const auto& [one, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
      for (const auto& [p, q] : edges_of(*one)) {
        for (const Point& r : other->corners) {
          for (const AnyPlane& plane : planes_of({p, q, r})) add(plane);
        }
      }
    }
    return planes;
  }
  /// Whether all points, or some that differ by the tolerance, are behind one of the planes; with open contact, on it
  /// or behind it.
  [[nodiscard]] bool are_separate(const std::vector<AnyPlane>& planes, const std::vector<Point>& points) const {
    return std::any_of(planes.begin(), planes.end(), [&](const AnyPlane& plane) {
      return std::all_of(points.begin(), points.end(), [&](const Point& x) {
        const Number height = lowest_height(plane, x);
        return contact_ == Contact::open ? height <= 0 : height < 0;
      });
    });
  }
  [[nodiscard]] static std::vector<std::pair<Point, Point>> edges_of(const Patch& patch) {
    std::vector<std::pair<Point, Point>> edges;
    if (patch.has_corners) {
      for (std::size_t i = 0; i != patch.corners.size(); ++i) {
        edges.emplace_back(patch.corners[i], patch.corners[(i + 1) % patch.corners.size()]);
      }
    } else {
      for (unsigned c = 0; c != 8; ++c) {
        for (const unsigned k : {1U, 2U, 4U}) {
          if ((c & k) == 0) edges.emplace_back(patch.box.corner(c), patch.box.corner(c | k));
        }
      }
    }
    return edges;
  }

  /// Whether an end reaches into the interior of a solid; if that is flat, whether it touches it.
  [[nodiscard]] static bool holds_part_of(const AnyBox& solid, const AnyBox& end) {
    const bool is_flat = solid.is_flat(0) || solid.is_flat(1) || solid.is_flat(2);
    for (std::size_t k = 0; k != 3; ++k) {
      if (is_flat ? solid.lo[k] > end.hi[k] || end.lo[k] > solid.hi[k]
                  : solid.lo[k] >= end.hi[k] || end.lo[k] >= solid.hi[k]) {
        return false;
      }
    }
    return true;
  }

  /// Whether all segments pass through the interior of a hull. Of each face, one of the ends must be behind it, and not
  /// lie in its plane within the tolerance.
  [[nodiscard]] bool hull_blocks(const std::vector<Point>& a, const std::vector<Point>& b,
                                 const HullOf<Number>& hull) const {
    using Face = typename HullOf<Number>::Face;
    const auto are_in_front_of = [&](const Face& face, const std::vector<Point>& end) {
      return std::all_of(end.begin(), end.end(), [&](const Point& x) { return hull.height(face, x) >= 0; });
    };
    const auto reaches_into = [&](const std::vector<Point>& end) {
      return std::none_of(hull.faces().begin(), hull.faces().end(),
                          [&](const Face& face) { return are_in_front_of(face, end); });
    };
    if (!solids_around_ends_ && (reaches_into(a) || reaches_into(b))) return false;
    const auto is_behind = [&](const Face& face, const std::vector<Point>& end) {
      const Point& n = face.normal;
      const AnyPlane back{{Number(-n[0]), Number(-n[1]), Number(-n[2])}, Number(-face.offset)};
      return std::none_of(end.begin(), end.end(), [&](const Point& x) { return hull.height(face, x) > 0; }) &&
             std::any_of(end.begin(), end.end(), [&](const Point& x) { return lowest_height(back, x) > 0; });
    };
    if (!std::all_of(hull.faces().begin(), hull.faces().end(),
                     [&](const Face& face) { return is_behind(face, a) || is_behind(face, b); })) {
      return false;
    }
    const auto misses = [&](const Point& p, const Point& q) { return !hull.is_passed(p, q, false); };
    return all_segments(a, b, true, misses, [&](const auto& p, const auto& q) { return hull.is_passed(p, q, true); });
  }

  Contact contact_;
  bool solids_around_ends_;
  Number tolerance_;
  std::vector<Patch> a_;
  std::vector<Patch> b_;
  std::vector<AnyBox> solids_;
  std::vector<std::vector<Point>> polygons_;
  std::vector<std::vector<Point>> backs_;  ///< of each polygon, empty unless it is a plate
  std::vector<HullOf<Number>> hulls_;
  std::vector<AnyBox> occluder_boxes_;
  std::vector<std::vector<Point>> occluder_corners_;
  std::vector<std::vector<Part>> occluder_triangles_;
};

}  // namespace

SightOracle::SightOracle(const SightQuestion& question) {
  const Digits digits = digits_of(question);
  // Determinants are sums of six products of three differences, of which the coefficients of a power of ε are three
  // products or fewer: 3 × 37 + 1 + 5 bits. Two of them are multiplied where a segment may pass through a hull.
  const int most_digits = question.hulls.empty() ? 36 : 16;
  if (digits.end - digits.first <= most_digits) {
    questions_ = std::make_unique<Answers<Wide>>(question, -digits.first);
  } else {
    questions_ = std::make_unique<Answers<mpz_class>>(question, -digits.first);
  }
}

SightOracle::~SightOracle() = default;

SightTruth SightOracle::truth(std::size_t i, std::size_t j) const { return questions_->truth(i, j); }
bool SightOracle::reaches(std::size_t i, std::size_t j, std::size_t k) const { return questions_->reaches(i, j, k); }
bool SightOracle::blocks(std::size_t i, std::size_t j, std::size_t k) const { return questions_->blocks(i, j, k); }
bool SightOracle::is_behind(std::size_t i, std::size_t j) const { return questions_->is_behind(i, j); }

}  // namespace shaftcull::oracle
