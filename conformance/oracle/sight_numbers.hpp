// SPDX-License-Identifier: MIT
/// Numbers and segments of the oracle of pairs of patches: infinitely small numbers, the times at which a segment
/// satisfies constraints, and convex hulls. `Number` is an integer type that does not overflow.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <vector>

namespace shaftcull::oracle {

template <class Number>
using PointOf = std::array<Number, 3>;

/// A polynomial of degree 3 in ε, which is positive and less than every positive number. So the sign is that of the
/// lowest coefficient that is not 0. Products have no higher powers where they are made here.
template <class Number>
class Infinitesimal {
 public:
  Infinitesimal(int number) : coefficient_{number, 0, 0, 0} {}
  Infinitesimal(const Number& number, const Number& of_epsilon = 0) : coefficient_{number, of_epsilon, 0, 0} {}

  friend Infinitesimal operator+(Infinitesimal a, const Infinitesimal& b) {
    for (std::size_t i = 0; i != powers; ++i) a.coefficient_[i] += b.coefficient_[i];
    return a;
  }
  friend Infinitesimal operator-(Infinitesimal a, const Infinitesimal& b) {
    for (std::size_t i = 0; i != powers; ++i) a.coefficient_[i] -= b.coefficient_[i];
    return a;
  }
  friend Infinitesimal operator-(const Infinitesimal& a) { return 0 - a; }
  friend Infinitesimal operator*(const Infinitesimal& a, const Infinitesimal& b) {
    Infinitesimal product = 0;
    for (std::size_t i = 0; i != powers; ++i) {
      if (a.coefficient_[i] == 0) continue;
      for (std::size_t k = 0; i + k != powers; ++k) {
        product.coefficient_[i + k] += a.coefficient_[i] * b.coefficient_[k];
      }
    }
    return product;
  }
  friend std::strong_ordering operator<=>(const Infinitesimal& a, const Infinitesimal& b) {
    for (std::size_t i = 0; i != powers; ++i) {
      if (a.coefficient_[i] < b.coefficient_[i]) return std::strong_ordering::less;
      if (a.coefficient_[i] > b.coefficient_[i]) return std::strong_ordering::greater;
    }
    return std::strong_ordering::equal;
  }
  friend bool operator==(const Infinitesimal& a, const Infinitesimal& b) = default;

 private:
  static constexpr std::size_t powers = 4;
  std::array<Number, powers> coefficient_;
};

template <class Number>
int sign(const Number& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// Those t in [0, 1], or in (0, 1), for which linear functions of t are not negative, or positive, or 0.
template <class Number>
class Times {
 public:
  explicit Times(bool is_open) : is_open_(is_open) {}

  /// start + t way ≥ 0, or > 0.
  void require(const Number& start, const Number& way) {
    if (way == 0) {
      is_empty_ = is_empty_ || (is_open_ ? start <= 0 : start < 0);
    } else if (way > 0) {
      if (const Fraction t{Number(-start), way}; less(after_, t)) after_ = t;
    } else {
      if (const Fraction t{start, Number(-way)}; less(t, before_)) before_ = t;
    }
  }
  /// start + t way = 0.
  void require_zero(const Number& start, const Number& way) {
    if (way == 0) {
      is_empty_ = is_empty_ || start != 0;
      return;
    }
    const Fraction t = way > 0 ? Fraction{Number(-start), way} : Fraction{start, Number(-way)};
    if (has_only_ && (less(t, only_) || less(only_, t))) is_empty_ = true;
    has_only_ = true;
    only_ = t;
  }
  [[nodiscard]] bool are_there() const {
    if (is_empty_) return false;
    const auto in_order = [&](const Fraction& t, const Fraction& u) { return is_open_ ? less(t, u) : !less(u, t); };
    return has_only_ ? in_order(after_, only_) && in_order(only_, before_) : in_order(after_, before_);
  }

 private:
  struct Fraction {
    Number over;
    Number under;  ///< positive
  };
  static bool less(const Fraction& t, const Fraction& u) { return t.over * u.under < u.over * t.under; }

  bool is_open_;
  bool is_empty_ = false;
  bool has_only_ = false;
  Fraction after_{0, 1};
  Fraction before_{1, 1};
  Fraction only_{0, 1};
};

/// The faces of the convex hull of some points, found by trying all planes through three of them.
template <class Number>
class HullOf {
 public:
  explicit HullOf(const std::vector<PointOf<Number>>& points) {
    for (std::size_t i = 0; i != points.size(); ++i) {
      for (std::size_t j = i + 1; j != points.size(); ++j) {
        for (std::size_t k = j + 1; k != points.size(); ++k) add(points, points[i], points[j], points[k]);
      }
    }
  }

  /// Outward normals, and the component of the face along them. None if the points are in one plane.
  struct Face {
    PointOf<Number> normal;
    Number offset;
  };
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }

  /// How far a point is in front of a face, times the length of the normal.
  template <class Coordinate>
  [[nodiscard]] static Coordinate height(const Face& face, const PointOf<Coordinate>& x) {
    Coordinate height(Number(-face.offset));
    for (std::size_t k = 0; k != 3; ++k) height = height + Coordinate(face.normal[k]) * x[k];
    return height;
  }

  /// Whether a segment meets the hull; if `is_open`, whether it passes through the interior.
  template <class Coordinate>
  [[nodiscard]] bool is_passed(const PointOf<Coordinate>& p, const PointOf<Coordinate>& q, bool is_open) const {
    if (faces_.empty()) return false;
    Times<Coordinate> times(is_open);
    for (const Face& face : faces_) {
      const Coordinate from = height(face, p);
      times.require(-from, from - height(face, q));
    }
    return times.are_there();
  }

 private:
  void add(const std::vector<PointOf<Number>>& points, const PointOf<Number>& p, const PointOf<Number>& q,
           const PointOf<Number>& r) {
    for (const Face& found : faces_) {
      const auto is_on = [&](const PointOf<Number>& x) { return height<Number>(found, x) == 0; };
      if (is_on(p) && is_on(q) && is_on(r)) return;
    }
    Face face{};
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      face.normal[k] = (q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i]);
    }
    face.offset = height<Number>({face.normal, 0}, p);
    bool any_in_front = false;
    bool any_behind = false;
    for (const PointOf<Number>& x : points) {
      any_in_front = any_in_front || height<Number>(face, x) > 0;
      any_behind = any_behind || height<Number>(face, x) < 0;
    }
    if (any_in_front == any_behind) return;
    if (any_in_front) {
      for (Number& n : face.normal) n = -n;
      face.offset = -face.offset;
    }
    faces_.push_back(face);
  }

  std::vector<Face> faces_;
};

}  // namespace shaftcull::oracle
