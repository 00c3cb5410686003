// SPDX-License-Identifier: MIT
#include "exact/sphere_entry_time.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "exact/wide_integer.hpp"
#include "support/compiler.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Twice what the zero of a gap may be off by, relatively.
constexpr double zero_margin = 0x1p-49;

/// How far from where a time seems to be its bracket may begin and end, as a share of it: the first that is sure.
constexpr double bracket_shares[] = {0x1p-48, 0x1p-42, 0x1p-36, 0x1p-30, 0x1p-24, 0x1p-18, 0x1p-12, 0x1p-6, 1};

/// The smaller root of a t² + 2 b t + c, of which a is positive and the roots are real.
class SmallerRoot {
 public:
  SmallerRoot(const WideInteger& a, const WideInteger& b, const WideInteger& c) noexcept : a_(a), b_(b), c_(c) {}

  /// −1, 0 or 1: whether it is less than, equal to or more than n / d. d is not 0.
  [[nodiscard]] int side(const WideInteger& n, const WideInteger& d) const noexcept {
    const WideInteger half_slope = a_ * n + b_ * d;  // times d
    const int value = (n * half_slope + d * (b_ * n + c_ * d)).sign();
    const int slope = half_slope.sign() * d.sign();
    if (value > 0 && slope < 0) return 1;
    return value == 0 && slope <= 0 ? 0 : -1;
  }

  /// −1, 0 or 1: whether it is less than, equal to or more than another one.
  [[nodiscard]] int compare(const SmallerRoot& other) const noexcept {
    // Where t is this root, a · other(t) = a · other(t) − other.a · this(t) = 2 p t + q.
    const WideInteger p = a_ * other.b_ - other.a_ * b_;
    const WideInteger q = a_ * other.c_ - other.a_ * c_;
    const int value = p.sign() == 0 ? q.sign() : p.sign() * side(-q, p + p);
    if (value < 0) return 1;  // between both roots of the other polynomial
    // Else it is on either side of them, or one of them: the vertex is between.
    if (side(-other.b_, other.a_) > 0) return 1;
    return value == 0 ? 0 : -1;
  }

 private:
  WideInteger a_;
  WideInteger b_;
  WideInteger c_;
};

/// The gaps of a sphere and its radius, as integers: in a unit of which all floats are multiples that they are made of.
/// Times do not depend on the unit.
class WholeGaps {
 public:
  /// Of some faces, face f as bit f.
  WholeGaps(const MovingFaces& faces, const float (&sphere)[4], unsigned some) noexcept {
    int lowest = std::numeric_limits<int>::max();
    const auto count_in = [&](float x) {
      if (x != 0) lowest = std::min(lowest, FloatDigits(x).lowest_bit());
    };
    count_in(sphere[3]);
    for (unsigned f = 0; f < 6; ++f) {
      if ((some >> f & 1U) == 0) continue;
      count_in(sphere[f % 3]);
      count_in(faces.p[f]);
      count_in(faces.minuend[f]);
      count_in(faces.subtrahend[f]);
    }
    const int scale = lowest == std::numeric_limits<int>::max() ? 0 : -lowest;
    radius_ = WideInteger::scaled(sphere[3], scale);
    for (unsigned f = 0; f < 6; ++f) {
      if ((some >> f & 1U) == 0) continue;
      const WideInteger start = WideInteger::scaled(faces.p[f], scale) - WideInteger::scaled(sphere[f % 3], scale);
      const WideInteger slope =
          WideInteger::scaled(faces.minuend[f], scale) - WideInteger::scaled(faces.subtrahend[f], scale);
      start_[count_] = f < 3 ? start : -start;
      slope_[count_++] = f < 3 ? slope : -slope;
    }
  }

  /// The signs of f and of its derivative.
  struct Signs {
    int excess;
    int slope;
  };
  /// At n / d, if these are all of its gaps; d is positive.
  [[nodiscard]] Signs signs(const WideInteger& n, const WideInteger& d) const noexcept {
    const WideInteger radius = radius_ * d;
    WideInteger excess = -(radius * radius);
    WideInteger half_slope;
    for (unsigned g = 0; g < count_; ++g) {
      const WideInteger gap = start_[g] * d + slope_[g] * n;
      if (gap.sign() <= 0) continue;
      excess = excess + gap * gap;
      half_slope = half_slope + gap * slope_[g];
    }
    return {excess.sign(), half_slope.sign()};
  }
  /// Whether the sphere is reached after n / d; likewise.
  [[nodiscard]] bool is_reached_after(const WideInteger& n, const WideInteger& d) const noexcept {
    const auto [excess, slope] = signs(n, d);
    return excess > 0 && slope < 0;
  }

  /// a t² + 2 b t + c, which is f just before the sphere is reached, if these are the gaps that are positive there.
  struct Polynomial {
    WideInteger a;
    WideInteger b;
    WideInteger c;
  };
  [[nodiscard]] Polynomial polynomial() const noexcept {
    Polynomial f;
    f.c = -(radius_ * radius_);
    for (unsigned g = 0; g < count_; ++g) {
      f.a = f.a + slope_[g] * slope_[g];
      f.b = f.b + start_[g] * slope_[g];
      f.c = f.c + start_[g] * start_[g];
    }
    return f;
  }
  /// When it is reached.
  [[nodiscard]] SmallerRoot time() const noexcept {
    const Polynomial f = polynomial();
    return {f.a, f.b, f.c};
  }

  [[nodiscard]] const WideInteger& radius() const noexcept { return radius_; }
  /// Gap g of those named, in the order of their faces: start + t · slope.
  [[nodiscard]] const WideInteger& start(unsigned g) const noexcept { return start_[g]; }
  [[nodiscard]] const WideInteger& slope(unsigned g) const noexcept { return slope_[g]; }

 private:
  WideInteger radius_;
  WideInteger start_[6];
  WideInteger slope_[6];
  unsigned count_ = 0;
};

/// How large gaps are when a sphere is reached, as shares of its radius.
///
/// The smaller root of a t² + 2 b t + c is (−b − √d) / a with d = b² − a c. So α + t β is then (n − β √d) / a with n =
/// a α − b β.
class SharesOfRadius {
 public:
  explicit SharesOfRadius(const WholeGaps& gaps) noexcept
      : gaps_(gaps), f_(gaps.polynomial()), d_(f_.b * f_.b - f_.a * f_.c), whole_(f_.a * gaps.radius()) {}

  /// The share of gap g, rounded to the nearest float, of two the one whose last bit is 0. It is between `low` and
  /// `high`, which are not negative.
  [[nodiscard]] float nearest(unsigned g, float low, float high) const noexcept {
    const WideInteger n = (f_.a * gaps_.start(g) - f_.b * gaps_.slope(g)) * WideInteger::scaled(1, scale);
    // −1, 0 or 1: whether the share is less than, equal to or more than m / 2^scale.
    const auto side = [&](const WideInteger& m) {
      const WideInteger left = n - m * whole_;  // and right, β √d, both times 2^scale / (a r)
      const int left_sign = left.sign();
      const int right_sign = d_.sign() == 0 ? 0 : gaps_.slope(g).sign();
      if (left_sign != right_sign) return left_sign < right_sign ? -1 : 1;
      const WideInteger right = gaps_.slope(g) * WideInteger::scaled(1, scale);
      return left_sign * (left * left - right * right * d_).sign();
    };
    // Floats that are not negative are in the order of their bits.
    auto least = std::bit_cast<std::uint32_t>(low);
    auto most = std::bit_cast<std::uint32_t>(high);
    if (least == 0 && side(WideInteger()) == 0) return 0;  // as where a corner of the box comes to an axis
    while (least != most) {
      const std::uint32_t middle = least + (most - least) / 2;
      // Both floats are multiples of 2^(1 − scale).
      const int beyond = side(WideInteger::scaled(std::bit_cast<float>(middle), scale - 1) +
                              WideInteger::scaled(std::bit_cast<float>(middle + 1), scale - 1));
      if (beyond > 0 || (beyond == 0 && middle % 2 == 1)) {
        least = middle + 1;
      } else {
        most = middle;
      }
    }
    return std::bit_cast<float>(least);
  }

 private:
  static constexpr int scale = 150;  // halves of floats are multiples of 2⁻¹⁵⁰

  const WholeGaps& gaps_;
  WholeGaps::Polynomial f_;
  WideInteger d_;
  WideInteger whole_;  // a r
};

/// Where gap f of a sphere is zero, as n / d with d > 0, if it is made of floats that differ.
struct ZeroOfGap {
  WideInteger n;
  WideInteger d;

  ZeroOfGap(const MovingFaces& faces, const float (&sphere)[4], unsigned f) noexcept {
    // 2⁻¹⁴⁹ divides every float.
    constexpr int scale = 149;
    n = WideInteger::scaled(sphere[f % 3], scale) - WideInteger::scaled(faces.p[f], scale);
    d = WideInteger::scaled(faces.minuend[f], scale) - WideInteger::scaled(faces.subtrahend[f], scale);
    if (d.sign() > 0) return;
    n = -n;
    d = -d;
  }
};

// Functions of their own, so that callers have no wide integers on their stacks.

/// Whether a sphere with these gaps is reached after the start.
SHAFTCULL_COLD bool is_reached_after_start(const MovingFaces& faces, const float (&sphere)[4], unsigned gaps) noexcept {
  return WholeGaps(faces, sphere, gaps).is_reached_after({}, WideInteger::scaled(1, 0));
}

/// Whether it is reached after gap f is zero.
SHAFTCULL_COLD bool is_reached_after_zero(const MovingFaces& faces, const float (&sphere)[4], unsigned gaps,
                                          unsigned f) noexcept {
  const ZeroOfGap zero(faces, sphere, f);
  return WholeGaps(faces, sphere, gaps).is_reached_after(zero.n, zero.d);
}

/// The share of its radius that gap g of those named in `gaps` is when it is reached, between `low` and `high`.
SHAFTCULL_COLD float exact_share(const MovingFaces& faces, const float (&sphere)[4], unsigned gaps, unsigned g,
                                 float low, float high) noexcept {
  const WholeGaps whole(faces, sphere, gaps);
  return SharesOfRadius(whole).nearest(g, low, high);
}

/// Whether the box touches it at the start without overlapping it, and moves into it, if these are the gaps that are
/// positive there.
SHAFTCULL_COLD bool is_touched_at_start(const MovingFaces& faces, const float (&sphere)[4], unsigned gaps) noexcept {
  const auto [excess, slope] = WholeGaps(faces, sphere, gaps).signs({}, WideInteger::scaled(1, 0));
  return excess == 0 && slope < 0;
}

/// The largest finite float that is not larger than x ≥ 0.
float float_below(double x) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  if (x >= most) return most;
  const auto nearest = static_cast<float>(x);
  return nearest > x ? std::nextafter(nearest, 0.0F) : nearest;
}

}  // namespace

/// What doubles know of a sphere.
struct SphereEntryTimes::Starts {
  double start[6];  // α of the gap of each face, rounded once; of faces that put no constraint on it, 0
  unsigned gaps;    // the others, that of face f as bit f
  double radius_square;

  Starts(const MovingFaces& faces, const float (&sphere)[4]) noexcept
      : gaps(0), radius_square(static_cast<double>(sphere[3]) * sphere[3]) {  // exact: 24-bit factor
    for (unsigned f = 0; f < 6; ++f) {
      const double c = sphere[f % 3];
      start[f] = 0;
      if (!std::isfinite(c)) continue;
      start[f] = f < 3 ? faces.p[f] - c : c - faces.p[f];
      gaps |= 1U << f;
    }
  }
  [[nodiscard]] bool has(unsigned f) const noexcept { return (gaps >> f & 1U) != 0; }
};

SphereEntryTimes::SphereEntryTimes(const ShaftData& shaft) noexcept : boxes_(shaft), faces_(shaft) {
  for (unsigned f = 0; f < 6; ++f) {
    slope_[f] = f < 3 ? faces_.slope(f) : -faces_.slope(f);
    minus_inverse_[f] = slope_[f] == 0 ? 0 : -1 / slope_[f];
  }
}

/// Whether a sphere that meets the shaft is reached after t ≥ 0.
SphereEntryTimes::Place SphereEntryTimes::place(const Starts& starts, double t) const noexcept {
  const double unit = 0x1p-53;
  double square = 0;
  double square_error = 0;
  double half_slope = 0;
  double half_slope_error = 0;
  for (unsigned f = 0; f < 6; ++f) {
    if (!starts.has(f)) continue;
    const double gap = starts.start[f] + t * slope_[f];
    const double error = 4 * unit * (std::fabs(starts.start[f]) + t * std::fabs(slope_[f]));
    if (gap <= -error) continue;
    const double positive = gap > 0 ? gap : 0;
    square += positive * positive;
    square_error += error * (2 * positive + error);
    half_slope += positive * slope_[f];
    half_slope_error += std::fabs(slope_[f]) * (error + 10 * unit * positive);
  }
  constexpr double underflow = 0x1p-900;
  square_error = (square_error + 8 * unit * square) * (1 + 0x1p-40) + underflow;
  half_slope_error = half_slope_error * (1 + 0x1p-40) + underflow;
  if (square - square_error > starts.radius_square && half_slope + half_slope_error < 0) return Place::before;
  if (square + square_error < starts.radius_square || half_slope - half_slope_error > 0) return Place::not_before;
  return Place::unknown;
}

/// About when a sphere is reached: from one zero of a gap to the next one, until the root of the polynomial that holds
/// between them is there.
double SphereEntryTimes::approximate(const Starts& starts) const noexcept {
  double t = 0;
  for (unsigned step = 0; step <= 6; ++step) {
    double excess = -starts.radius_square;
    double half_slope = 0;
    double curvature = 0;
    double next = infinity;
    for (unsigned f = 0; f < 6; ++f) {
      if (!starts.has(f)) continue;
      const double slope = slope_[f];
      bool is_positive = starts.start[f] > 0;  // just after t
      if (slope != 0) {
        const double change = starts.start[f] * minus_inverse_[f];
        if (change > t) next = std::min(next, change);
        is_positive = (slope < 0) == (change > t);
      }
      if (!is_positive) continue;
      const double gap = starts.start[f] + t * slope;
      excess += gap * gap;
      half_slope += gap * slope;
      curvature += slope * slope;
    }
    if (!(excess > 0 && half_slope < 0)) break;  // at a zero, but for rounding
    const double discriminant = half_slope * half_slope - curvature * excess;
    const double root =
        t + (discriminant > 0 ? excess / (std::sqrt(discriminant) - half_slope) : -half_slope / curvature);
    if (root <= next) return root;
    t = next;
  }
  return t;
}

SphereEntryTimes::Time SphereEntryTimes::exact(const float* const* stream, std::size_t i) const noexcept {
  Time time{0, infinity, {stream[0][i], stream[1][i], stream[2][i], stream[3][i]}, 0};
  const float(&sphere)[4] = time.sphere;
  if (!std::isfinite(sphere[3])) return zero;
  const Starts starts(faces_, sphere);
  Place start = place(starts, 0);
  if (start == Place::unknown) {
    start = is_reached_after_start(faces_, sphere, starts.gaps) ? Place::before : Place::not_before;
  }
  if (start == Place::not_before) return zero;

  const double about = approximate(starts);
  for (const double share : bracket_shares) {
    if (const double low = about * (1 - share); place(starts, low) == Place::before) {
      time.low = low;
      break;
    }
  }
  for (const double share : bracket_shares) {
    if (const double high = about * (1 + share); place(starts, high) == Place::not_before) {
      time.high = high;
      break;
    }
  }

  for (unsigned f = 0; f < 6; ++f) {
    if (!starts.has(f)) continue;
    const double slope = slope_[f];
    bool is_positive = starts.start[f] > 0;
    // Gaps that change their sign before or after the sphere is reached.
    if ((slope < 0 && starts.start[f] > 0) || (slope > 0 && starts.start[f] < 0)) {
      const double change = starts.start[f] * minus_inverse_[f];
      bool is_over = change * (1 + zero_margin) < time.low;
      if (!is_over && change * (1 - zero_margin) <= time.high) {
        is_over = is_reached_after_zero(faces_, sphere, starts.gaps, f);
      }
      is_positive = is_over == (slope > 0);
    } else if (starts.start[f] == 0) {
      is_positive = slope > 0;
    }
    if (is_positive) time.gaps |= 1U << f;
  }
  return time;
}

bool SphereEntryTimes::is_surely_later(const float* const* stream, std::size_t i, const Time& than) const noexcept {
  const float sphere[4] = {stream[0][i], stream[1][i], stream[2][i], stream[3][i]};
  return std::isfinite(sphere[3]) && place(Starts(faces_, sphere), than.high) == Place::before;
}

int SphereEntryTimes::compare(const Time& one, const Time& other) const noexcept {
  if (one.is_zero() || other.is_zero()) return one.is_zero() == other.is_zero() ? 0 : one.is_zero() ? -1 : 1;
  if (one.high < other.low) return -1;
  if (one.low > other.high) return 1;
  bool are_alike = one.gaps == other.gaps && one.sphere[3] == other.sphere[3];
  for (unsigned f = 0; f < 6 && are_alike; ++f) {
    are_alike = (one.gaps >> f & 1U) == 0 || one.sphere[f % 3] == other.sphere[f % 3];
  }
  if (are_alike) return 0;
  return WholeGaps(faces_, one.sphere, one.gaps).time().compare(WholeGaps(faces_, other.sphere, other.gaps).time());
}

float SphereEntryTimes::rounded_down(const Time& time) const noexcept {
  if (time.is_zero()) return 0;
  // Floats that are not negative are in the order of their bits.
  auto low = std::bit_cast<std::uint32_t>(float_below(time.low));
  auto high = std::bit_cast<std::uint32_t>(float_below(time.high));
  if (low == high) return std::bit_cast<float>(low);
  const SmallerRoot exactly = WholeGaps(faces_, time.sphere, time.gaps).time();
  const WideInteger one = WideInteger::scaled(1, 149);
  while (low != high) {
    const std::uint32_t middle = high - (high - low) / 2;
    if (exactly.side(WideInteger::scaled(std::bit_cast<float>(middle), 149), one) >= 0) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return std::bit_cast<float>(low);
}

Vec3 SphereEntryTimes::normal(const Time& time, const float* const* stream, std::size_t i) const noexcept {
  const float sphere[4] = {stream[0][i], stream[1][i], stream[2][i], stream[3][i]};
  if (!std::isfinite(sphere[3])) return {};
  if (sphere[3] == 0) {
    const float* const point[6] = {sphere, sphere + 1, sphere + 2, sphere, sphere + 1, sphere + 2};
    return boxes_.normal(boxes_.exact(point, 0), point, 0);
  }
  const Starts starts(faces_, sphere);
  unsigned gaps = time.gaps;
  if (time.is_zero()) {
    if (place(starts, 0) == Place::not_before) return {};
    for (unsigned f = 0; f < 6; ++f) gaps |= starts.start[f] > 0 ? 1U << f : 0;
    if (!is_touched_at_start(faces_, sphere, gaps)) return {};
  }
  // In a plane through the centre that the movement is perpendicular to, the nearest point is at w r. Movement along u
  // brings it there from −h r: the normal is w − h u, with h² = 1 − w².
  double start[3];
  double u[3];
  unsigned face[3];
  unsigned count = 0;
  double largest = 0;
  double square = 0;
  for (unsigned f = 0; f < 6; ++f) {
    if ((gaps >> f & 1U) == 0) continue;
    face[count] = f;
    start[count] = starts.start[f];
    u[count] = slope_[f];
    largest = std::max(largest, std::fabs(starts.start[f]));
    square += slope_[f] * slope_[f];
    ++count;
  }
  const double length = std::sqrt(square);
  double along = 0;
  for (unsigned g = 0; g < count; ++g) {
    u[g] /= length;
    along += start[g] * u[g];
  }
  double w[3];
  double rest = 1;
  for (unsigned g = 0; g < count; ++g) {
    w[g] = (start[g] - along * u[g]) / sphere[3];
    rest -= w[g] * w[g];
  }
  const double error_of_w = 0x1p-47 * largest / sphere[3];
  const bool is_known = error_of_w < 0x1p-30 && rest > 0;
  const double h = is_known ? std::sqrt(rest) : 0;
  const double error = error_of_w + (8 * error_of_w + 0x1p-50) / h + 0x1p-49;
  Vec3 normal{};
  for (unsigned g = 0; g < count; ++g) {
    const double about = w[g] - h * u[g];
    const auto low = static_cast<float>(is_known ? std::clamp(about - error, 0.0, 1.0) : 0);
    const auto high = static_cast<float>(is_known ? std::clamp(about + error, 0.0, 1.0) : 1);
    const float share = low == high ? low : exact_share(faces_, sphere, gaps, g, low, high);
    if (share != 0) normal[face[g] % 3] = face[g] < 3 ? share : -share;
  }
  return normal;
}

}  // namespace shaftcull::kernel
