// SPDX-License-Identifier: MIT
#include "exact/triangle.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "compiled/moving_faces.hpp"
#include "exact/added.hpp"
#include "exact/expansion.hpp"
#include "exact/measured.hpp"
#include "exact/open_contact.hpp"
#include "exact/orientation.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {
namespace {

/// A double, and the sum of the magnitudes of what it is a sum of: it is off by less than twenty roundings of that, as
/// polynomials here are of degree six at most.
class Approximate {
 public:
  static Approximate difference(double a, double b) noexcept { return {a - b, std::fabs(a - b)}; }

  [[nodiscard]] bool is_known() const noexcept { return size_ == 0 || std::fabs(value_) > 0x1p-48 * size_; }
  [[nodiscard]] bool is_negative() const noexcept { return value_ < 0 && is_known(); }
  [[nodiscard]] bool is_positive() const noexcept { return value_ > 0 && is_known(); }

  friend Approximate operator-(const Approximate& a) noexcept { return {-a.value_, a.size_}; }
  friend Approximate operator+(const Approximate& a, const Approximate& b) noexcept {
    return {a.value_ + b.value_, a.size_ + b.size_};
  }
  friend Approximate operator-(const Approximate& a, const Approximate& b) noexcept { return a + -b; }
  friend Approximate operator*(const Approximate& a, const Approximate& b) noexcept {
    return {a.value_ * b.value_, a.size_ * b.size_};
  }

 private:
  Approximate(double value, double size) noexcept : value_(value), size_(size) {}

  double value_;
  double size_;
};

/// Most terms of a polynomial of degree three with the fewest it is computed by here.
constexpr std::size_t most_triangle_gap_terms = 192;
using TriangleGapTerms = Expansion<most_triangle_gap_terms>;

/// OrderTerms that a sum of degree five in floats and differences of them has at most, however many are added up: its
/// terms are multiples of 2⁻⁷⁴⁵ below 2⁶⁵⁰ and do not overlap. It is what keeps them on a small stack.
constexpr std::size_t most_order_terms = 745 + 650;
using OrderTerms = Expansion<most_order_terms>;

/// What is left of such a sum, so that no two of them are on the stack at the same time.
struct KnownSign {
  int value;
  [[nodiscard]] int sign() const noexcept { return value; }
};

inline const Approximate& widened(const Approximate& value) noexcept { return value; }
inline const Measured& widened(const Measured& value) noexcept { return value; }
template <std::size_t N>
TriangleGapTerms widened(const Expansion<N>& value) noexcept {
  static_assert(N <= most_triangle_gap_terms);
  TriangleGapTerms result;
  for (std::size_t i = 0; i < value.size(); ++i) result.append(value[i]);
  return result;
}

/// Adds `sign` times a product to a sum.
template <std::size_t N>
SHAFTCULL_NOINLINE void add_product(OrderTerms& sum, const TriangleGapTerms& a, const Expansion<N>& b,
                                    double sign) noexcept {
  for (std::size_t i = 0; i < b.size(); ++i) {
    const auto part = a * (sign * b[i]);
    for (std::size_t k = 0; k < part.size(); ++k) sum.grow(part[k]);
  }
}

/// A direction along which box and triangle may be apart, and how far the box reaches over the near end of the triangle
/// there: the *gap*, linear in t, which is 0 or more where they are not apart. With open contact it must be more, but
/// where both are flat in that direction: then they are in one plane where it is 0.
struct TriangleGap {
  enum class Kind : std::uint8_t { of_box, of_normal, of_edge };
  Kind kind;
  std::uint8_t axis;  ///< of the box's face, or along which an edge is projected
  std::uint8_t edge;
  int sign;              ///< of the direction
  std::uint8_t face[3];  ///< of the box, farthest in the direction: one an axis
  std::uint8_t vertex;   ///< of the triangle, nearest in it
  bool are_both_flat;    ///< in it
};

/// All gaps of a triangle and a shaft.
class TriangleGaps {
 public:
  TriangleGaps(const ShaftData& shaft, const float (&triangle)[9]) noexcept
      : faces_(shaft), x_(triangle), flat_axes_(flat_axes(faces_)), contact_(shaft.contact) {
    for (std::uint8_t k = 0; k < 3; ++k) add_of_box(k);
    int turn[3];
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      turn[k] = determinant_sign(edge(0, i), edge(0, j), edge(1, i), edge(1, j));
    }
    if (turn[0] != 0 || turn[1] != 0 || turn[2] != 0) {
      bool is_flat = true;
      for (unsigned k = 0; k < 3; ++k) is_flat = is_flat && (turn[k] == 0 || is_flat_on(k));
      for (const int sign : {1, -1}) {
        TriangleGap& gap = add(TriangleGap::Kind::of_normal, 0, sign, 0, is_flat);
        for (std::uint8_t k = 0; k < 3; ++k) gap.face[k] = static_cast<std::uint8_t>(sign * turn[k] > 0 ? k + 3 : k);
      }
    }
    for (std::uint8_t k = 0; k < 3; ++k) {
      for (std::uint8_t e = 0; e < 3; ++e) add_of_edge(k, e, turn[k]);
    }
  }

  /// Whether no t has all gaps as they must be. With open contact the ends of t do not count.
  [[nodiscard]] bool are_contradictory() const noexcept {
    const bool is_open = contact_ == Contact::open;
    const int least_at_end = is_open ? 1 : 0;
    unsigned rising[most_gaps];
    unsigned falling[most_gaps];
    unsigned risings = 0;
    unsigned fallings = 0;
    for (unsigned g = 0; g < count_; ++g) {
      const int slope = sign_of([&]<class Number>() { return this->slope<Number>(gap_[g]); });
      if (slope > 0) {
        rising[risings++] = g;
        if (!faces_.is_endless() && sign_at_end(gap_[g]) < least_at_end) return true;
      } else {
        if (slope < 0) falling[fallings++] = g;
        const int least = slope == 0 && gap_[g].are_both_flat ? 0 : least_at_end;
        if (sign_of([&]<class Number>() { return this->start<Number>(gap_[g]); }) < least) return true;
      }
    }
    for (unsigned r = 0; r < risings; ++r) {
      for (unsigned f = 0; f < fallings; ++f) {
        if (exclude_each_other(gap_[rising[r]], gap_[falling[f]])) return true;
      }
    }
    return false;
  }

 private:
  static constexpr unsigned most_gaps = 17;

  /// Coordinate k of the way from vertex e to the next one.
  [[nodiscard]] Step edge(unsigned e, unsigned k) const noexcept { return {x_[3 * ((e + 1) % 3) + k], x_[3 * e + k]}; }

  /// Whether all boxes on the way are flat on axis k.
  [[nodiscard]] bool is_flat_on(unsigned k) const noexcept { return (flat_axes_ >> k & 1U) != 0; }

  TriangleGap& add(TriangleGap::Kind kind, unsigned axis, int sign, unsigned vertex, bool are_both_flat) noexcept {
    TriangleGap& gap = gap_[count_++];
    gap.kind = kind;
    gap.axis = static_cast<std::uint8_t>(axis);
    gap.sign = sign;
    gap.vertex = static_cast<std::uint8_t>(vertex);
    gap.are_both_flat = are_both_flat;
    return gap;
  }

  void add_of_box(std::uint8_t k) noexcept {
    unsigned least = 0;
    unsigned most = 0;
    for (unsigned v = 1; v < 3; ++v) {
      if (x_[3 * v + k] < x_[3 * least + k]) least = v;
      if (x_[3 * v + k] > x_[3 * most + k]) most = v;
    }
    const bool are_flat = is_flat_on(k) && x_[3 * least + k] == x_[3 * most + k];
    add(TriangleGap::Kind::of_box, k, 1, least, are_flat).face[k] = static_cast<std::uint8_t>(k + 3);
    add(TriangleGap::Kind::of_box, k, -1, most, are_flat).face[k] = k;
  }

  /// The direction that points inwards from edge e, projected along axis k, if the projection turns as `turn_of_axis`
  /// says. Where it is a segment, 0, any turn will do: its edges point both ways.
  void add_of_edge(std::uint8_t k, std::uint8_t e, int turn_of_axis) noexcept {
    const int turn = turn_of_axis < 0 ? -1 : 1;
    const auto i = static_cast<std::uint8_t>((k + 1) % 3);
    const auto j = static_cast<std::uint8_t>((k + 2) % 3);
    const auto sign_of_step = [](const Step& step) {
      return step.end > step.start ? 1 : step.end < step.start ? -1 : 0;
    };
    const int on_i = -turn * sign_of_step(edge(e, j));
    const int on_j = turn * sign_of_step(edge(e, i));
    if (on_i == 0 && on_j == 0) return;
    const bool are_flat = turn_of_axis == 0 && (on_i == 0 || is_flat_on(i)) && (on_j == 0 || is_flat_on(j));
    TriangleGap& gap = add(TriangleGap::Kind::of_edge, k, turn, e, are_flat);
    gap.edge = e;
    gap.face[i] = static_cast<std::uint8_t>(on_i > 0 ? i + 3 : i);
    gap.face[j] = static_cast<std::uint8_t>(on_j > 0 ? j + 3 : j);
  }

  /// The gap, if part(k) is how far its face on axis k is from its vertex; or its slope, if it is the slope of that.
  template <class Number, class Part>
  [[nodiscard]] auto sum(const TriangleGap& gap, const Part& part) const noexcept {
    const auto signed_sum = [&](const auto& value) { return widened(gap.sign > 0 ? value : -value); };
    if (gap.kind == TriangleGap::Kind::of_box) return signed_sum(part(gap.axis));
    if (gap.kind == TriangleGap::Kind::of_edge) {
      const unsigned i = (gap.axis + 1U) % 3;
      const unsigned j = (gap.axis + 2U) % 3;
      return signed_sum(edge(gap.edge, i).template in<Number>() * part(j) -
                        edge(gap.edge, j).template in<Number>() * part(i));
    }
    const auto normal = [&](unsigned k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      return determinant<Number>(edge(0, i), edge(0, j), edge(1, i), edge(1, j));
    };
    return signed_sum(normal(0) * part(0) + normal(1) * part(1) + normal(2) * part(2));
  }
  template <class Number>
  [[nodiscard]] auto start(const TriangleGap& gap) const noexcept {
    return sum<Number>(gap,
                       [&](unsigned k) { return Number::difference(faces_.p[gap.face[k]], x_[3U * gap.vertex + k]); });
  }
  template <class Number>
  [[nodiscard]] auto slope(const TriangleGap& gap) const noexcept {
    return sum<Number>(gap, [&](unsigned k) {
      return Number::difference(faces_.minuend[gap.face[k]], faces_.subtrahend[gap.face[k]]);
    });
  }

  /// Sign of what `of` computes in the arithmetic that it is given: the first that knows it.
  template <class Of>
  [[nodiscard]] static int sign_of(const Of& of) noexcept {
    const auto known = [](const auto& value) { return value.is_positive() ? 1 : value.is_negative() ? -1 : 0; };
    if (const auto value = of.template operator()<Approximate>(); value.is_known()) return known(value);
    if (const auto value = of.template operator()<Measured>(); value.is_known()) return known(value);
    return of.template operator()<Expansion<2>>().sign();
  }

  /// Sign of a gap where t ends.
  [[nodiscard]] int sign_at_end(const TriangleGap& gap) const noexcept {
    return sign_of([&]<class Number>() {
      const auto end = Number::difference(faces_.end_minuend, faces_.end_subtrahend);
      if constexpr (requires { end.size(); }) {
        return exactly_at_end(gap, end);
      } else {
        return this->start<Number>(gap) + this->slope<Number>(gap) * end;
      }
    });
  }
  SHAFTCULL_NOINLINE [[nodiscard]] KnownSign exactly_at_end(const TriangleGap& gap,
                                                            const Expansion<2>& end) const noexcept {
    OrderTerms sum;
    add_product(sum, start<Expansion<2>>(gap), Expansion<2>(1.0), 1);
    add_product(sum, slope<Expansion<2>>(gap), end, 1);
    return {sum.sign()};
  }

  /// Whether one gap, which rises, is as it must be only later than the other, which falls.
  [[nodiscard]] bool exclude_each_other(const TriangleGap& rising, const TriangleGap& falling) const noexcept {
    // Both sides of the triangle's plane, or of a box: between its ends t can be where both are as they must be.
    if (rising.kind == falling.kind && rising.axis == falling.axis && rising.kind != TriangleGap::Kind::of_edge)
      return false;
    const int order = sign_of([&]<class Number>() {
      if constexpr (requires(Number number) { number.size(); }) {
        return exact_order(rising, falling);
      } else {
        return this->start<Number>(rising) * this->slope<Number>(falling) -
               this->start<Number>(falling) * this->slope<Number>(rising);
      }
    });
    const bool may_be_at_once = contact_ == Contact::closed || (rising.are_both_flat && falling.are_both_flat);
    return may_be_at_once ? order > 0 : order >= 0;
  }
  SHAFTCULL_NOINLINE [[nodiscard]] KnownSign exact_order(const TriangleGap& rising,
                                                         const TriangleGap& falling) const noexcept {
    OrderTerms sum;
    add_product(sum, start<Expansion<2>>(rising), slope<Expansion<2>>(falling), 1);
    add_product(sum, start<Expansion<2>>(falling), slope<Expansion<2>>(rising), -1);
    return {sum.sign()};
  }

  MovingFaces faces_;
  const float (&x_)[9];
  unsigned flat_axes_;
  Contact contact_;
  TriangleGap gap_[most_gaps];
  unsigned count_ = 0;
};

}  // namespace

bool triangle_misses(const ShaftData& shaft, const float (&triangle)[9]) noexcept {
  for (const float x : triangle) {
    if (!std::isfinite(x)) return false;
  }
  return TriangleGaps(shaft, triangle).are_contradictory();
}

bool triangle_beyond_plane(const ShaftData& shaft, const float (&triangle)[9]) noexcept {
  const int least = shaft.contact == Contact::open ? 0 : 1;
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    bool is_beyond = true;
    for (unsigned v = 0; v < 3 && is_beyond; ++v) {
      double point[3];
      for (unsigned k = 0; k < 3; ++k) {
        point[k] = triangle[3 * v + k];
        is_beyond = is_beyond && (shaft.added[i].normal[k] == 0 || std::isfinite(point[k]));
      }
      is_beyond = is_beyond && added_side<Expansion<7>>(shaft, i, point).sign() >= least;
    }
    if (is_beyond) return true;
  }
  return false;
}

}  // namespace shaftcull::kernel
