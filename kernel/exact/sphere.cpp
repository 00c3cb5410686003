#include <cmath>
#include <limits>

#include "exact/added.hpp"
#include "exact/edge.hpp"
#include "exact/measured.hpp"
#include "exact/predicates.hpp"

// The sphere is outside iff the smallest squared distance of its centre c from box(t), over t in [0, 1],
//   f(t) = Σ gap_g(t)²  over the gaps that are positive,
// is larger than r². Each axis has two gaps, lo_k(t) − c_k and c_k − hi_k(t), linear in t, so f is convex and
// piecewise quadratic, and breaks only where a gap is zero.
namespace shaftcull::kernel {
namespace {

constexpr double unit = 0x1p-53;

/// gap(t) = start + t · slope, and end for t = 1: how far the centre is beyond a face of box(t).
struct Gap {
  double start_minuend;
  double start_subtrahend;
  double slope_minuend;
  double slope_subtrahend;
  double end_minuend;
  double end_subtrahend;

  [[nodiscard]] double start() const noexcept { return start_minuend - start_subtrahend; }
  [[nodiscard]] double slope() const noexcept { return slope_minuend - slope_subtrahend; }
  /// As a Measured or an Expansion<2>.
  template <class Number>
  [[nodiscard]] Number start_in() const noexcept {
    return Number::difference(start_minuend, start_subtrahend);
  }
  template <class Number>
  [[nodiscard]] Number slope_in() const noexcept {
    return Number::difference(slope_minuend, slope_subtrahend);
  }
  [[nodiscard]] Expansion<2> exact_start() const noexcept { return start_in<Expansion<2>>(); }
  [[nodiscard]] Expansion<2> exact_slope() const noexcept { return slope_in<Expansion<2>>(); }
};

struct Gaps {
  Gap gap[6];
  unsigned axis[6];
  unsigned count = 0;

  Gaps(const Box& a, const Box& b, const float (&sphere)[4]) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      const double c = sphere[k];
      if (!std::isfinite(c)) continue;
      axis[count] = axis[count + 1] = k;
      gap[count++] = {a.lo[k], c, b.lo[k], a.lo[k], b.lo[k], c};
      gap[count++] = {c, a.hi[k], a.hi[k], b.hi[k], c, b.hi[k]};
    }
  }
};

enum class Verdict : unsigned char { outside, meets, undecided };

/// Where f seems to be least: t, and the gaps that are positive there, gap g as bit g.
struct Minimum {
  double t;
  unsigned positive;
};

/// The two gaps of an axis, side by side, as the compilers' own vectors: any processor that has none gets plain
/// doubles.
using Two [[gnu::vector_size(16)]] = double;

double sum(Two x) noexcept { return x[0] + x[1]; }

/// x where it is positive, and 0 elsewhere; without a branch, which would be mispredicted.
Two where_positive(Two x, Two condition) noexcept { return condition > 0 ? x : Two{}; }

double larger(double x, double y) noexcept { return x < y ? y : x; }

/// Gaps in doubles, and f as they give it.
class RoundedGaps {
 public:
  explicit RoundedGaps(const Gaps& gaps) noexcept {
    double reach = 0;  // largest magnitude that a rounding error of a gap can be relative to
    slopes_ = 0;
    for (unsigned g = 0; g < gaps.count; ++g) {
      const double start = gaps.gap[g].start();
      const double slope = gaps.gap[g].slope();
      start_[g / 2][g % 2] = start;
      slope_[g / 2][g % 2] = slope;
      slopes_ += std::fabs(slope);
      reach = larger(reach, std::fabs(start) + std::fabs(slope));
    }
    // A gap is off by at most 4 units of reach: its start and slope by one each, product and sum by one each.
    gap_error_ = 4 * unit * reach;
  }

  [[nodiscard]] bool is_still(unsigned g) const noexcept { return slope_[g / 2][g % 2] == 0; }

  /// Decides in double arithmetic, with a bound on its own error, or tells where f seems to be least.
  ///
  /// f is convex. If it neither rises from t = 0 on nor falls up to t = 1, it is least where its derivative is 0. The
  /// derivative is linear while the same gaps are positive, so a few of Newton's steps lead there, kept from going
  /// round in circles by the interval between steps that led to either side.
  Verdict decide(double radius, Minimum& least) const noexcept {
    constexpr unsigned most_steps = 16;
    const double radius_square = radius * radius;  // exact: 24-bit factor
    const Value at_a = at(0);
    const Value at_b = at(1);
    Value value = at(0.5);  // all three at once take hardly longer than one
    if (at_a.half_slope >= 0 || at_b.half_slope <= 0) {
      const bool is_at_b = at_a.half_slope < 0;
      least = {is_at_b ? 1.0 : 0.0, 0};
      return compare(is_at_b ? at_b : at_a, least.t, radius_square);
    }
    double t = 0.5;
    double low = 0;
    double high = 1;
    for (unsigned step = 0; step < most_steps; ++step) {
      const Verdict verdict = compare(value, t, radius_square);
      if (verdict != Verdict::undecided) return verdict;
      if (std::fabs(value.half_slope) <= half_slope_error(value)) break;
      (value.half_slope < 0 ? low : high) = t;
      const double next = t - value.half_slope / value.curvature;
      t = next > low && next < high ? next : 0.5 * (low + high);
      value = at(t);
    }
    least = {t, positive(t)};
    return Verdict::undecided;
  }

 private:
  struct Value {
    double square;      // f
    double half_slope;  // f′ / 2
    double curvature;   // f″ / 2
    double gaps;        // sum of the positive ones
  };

  // Of errors, twice what is needed pays for the rounding of the bounds themselves.

  [[nodiscard]] double square_error(const Value& value) const noexcept {
    return 4 * gap_error_ * (value.gaps + 3 * gap_error_) + 16 * unit * value.square;
  }
  [[nodiscard]] double half_slope_error(const Value& value) const noexcept {
    return 2 * slopes_ * (gap_error_ + 4 * unit * value.gaps);
  }

  /// As f is convex, min f ≤ f(t), and min f ≥ f(t) + min(f′(t) (0 − t), f′(t) (1 − t), 0).
  [[nodiscard]] Verdict compare(const Value& value, double t, double radius_square) const noexcept {
    if (value.square + square_error(value) < radius_square) return Verdict::meets;
    const double descent = larger(value.half_slope * t, -value.half_slope * (1 - t)) + half_slope_error(value);
    const double least = value.square - square_error(value) - 2 * larger(descent, 0.0) * (1 + 4 * unit);
    return least * (1 - 8 * unit) > radius_square ? Verdict::outside : Verdict::undecided;
  }

  [[nodiscard]] Value at(double t) const noexcept {
    Two square{};
    Two half_slope{};
    Two curvature{};
    Two sum_of_gaps{};
    for (unsigned k = 0; k < 3; ++k) {
      const Two value = start_[k] + t * slope_[k];
      const Two gap = where_positive(value, value);
      square += gap * gap;
      half_slope += gap * slope_[k];
      curvature += where_positive(slope_[k] * slope_[k], value);
      sum_of_gaps += gap;
    }
    return {sum(square), sum(half_slope), sum(curvature), sum(sum_of_gaps)};
  }

  [[nodiscard]] unsigned positive(double t) const noexcept {
    unsigned bits = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const Two value = start_[k] + t * slope_[k];
      bits |= static_cast<unsigned>(value[0] > 0) << 2 * k | static_cast<unsigned>(value[1] > 0) << (2 * k + 1);
    }
    return bits;
  }

  Two start_[3] = {};
  Two slope_[3] = {};
  double slopes_;  // sum of their magnitudes
  double gap_error_;
};

/// Decides for certain if f is least at t = 0, or at t = 1, and what matters is computed without rounding, or nearly
/// so.
Verdict certify_at_end(const Gaps& gaps, bool at_one, double radius) noexcept {
  const Gap* positive[6];
  Measured distance[6];
  unsigned count = 0;
  Measured excess(-radius * radius);
  for (unsigned g = 0; g < gaps.count; ++g) {
    const Gap& gap = gaps.gap[g];
    const double minuend = at_one ? gap.end_minuend : gap.start_minuend;
    const double subtrahend = at_one ? gap.end_subtrahend : gap.start_subtrahend;
    if (minuend <= subtrahend) continue;
    positive[count] = &gap;
    distance[count] = Measured::difference(minuend, subtrahend);
    excess = excess + distance[count] * distance[count];
    ++count;
  }
  if (excess.is_not_positive()) return Verdict::meets;
  if (!excess.is_positive()) return Verdict::undecided;
  Measured half_slope;
  for (unsigned g = 0; g < count; ++g) half_slope = half_slope + positive[g]->slope_in<Measured>() * distance[g];
  return (at_one ? half_slope.is_not_positive() : half_slope.is_not_negative()) ? Verdict::outside : Verdict::undecided;
}

/// Decides for certain if f is least within (0, 1) where the gaps of `positive` are, and what matters is computed
/// without rounding, or nearly so.
///
/// Let S be these gaps, α their starts and β their slopes. Their sum of squares is least at t = N / D with N = −Σ α β
/// and D = Σ β², where any gap is (α D + β N) / D; by Lagrange's identity it is Σ (α_g β_h − α_h β_g)² / D there. That
/// is the minimum of f if 0 ≤ N ≤ D, gaps of S are not negative at N / D, and all others are not positive.
Verdict certify_between(const Gaps& gaps, unsigned positive, double radius) noexcept {
  Measured start[3];
  Measured slope[3];
  unsigned count = 0;
  unsigned counted[3];  // gaps
  for (unsigned g = 0; g < gaps.count; ++g) {
    if ((positive >> g & 1U) == 0) continue;
    if (count != 0 && gaps.axis[counted[count - 1]] == gaps.axis[g])
      return Verdict::undecided;  // two of an axis, by rounding
    start[count] = gaps.gap[g].start_in<Measured>();
    slope[count] = gaps.gap[g].slope_in<Measured>();
    counted[count++] = g;
  }
  Measured crosses;      // D times the least sum of squares
  Measured minus_n;      // −N
  Measured denominator;  // D
  for (unsigned g = 0; g < count; ++g) {
    for (unsigned h = g + 1; h < count; ++h) {
      const Measured cross = start[g] * slope[h] - start[h] * slope[g];
      crosses = crosses + cross * cross;
    }
    minus_n = minus_n + start[g] * slope[g];
    denominator = denominator + slope[g] * slope[g];
  }
  if (!denominator.is_positive()) return Verdict::undecided;
  const Measured excess = crosses - denominator * Measured(radius * radius);
  if (!excess.is_known()) return Verdict::undecided;
  if (!minus_n.is_not_positive() || !(minus_n + denominator).is_not_negative()) return Verdict::undecided;
  const auto scaled = [&](const Measured& of_start, const Measured& of_slope) {
    return of_start * denominator - of_slope * minus_n;
  };
  for (unsigned g = 0; g < count && count > 1; ++g) {  // if there is only one, it is 0
    if (!scaled(start[g], slope[g]).is_not_negative()) return Verdict::undecided;
  }
  if (excess.is_positive()) return Verdict::outside;  // whatever the others are
  unsigned axes = 0;
  for (unsigned g = 0; g < count; ++g) axes |= 1U << gaps.axis[counted[g]];
  for (unsigned g = 0; g < gaps.count; ++g) {
    if ((axes >> gaps.axis[g] & 1U) != 0) continue;  // a centre that is not within one face is within the other
    if (!scaled(gaps.gap[g].start_in<Measured>(), gaps.gap[g].slope_in<Measured>()).is_not_positive()) {
      return Verdict::undecided;
    }
  }
  return Verdict::meets;
}

/// Decides for certain if the gaps of `positive` stay as they are on the way from a to b.
///
/// Then their sum of squares is the minimum of f if all others are not positive at some t: if the box whose extent is
/// that of the centre, but infinite on the axes of `positive`, is not outside.
Verdict certify_still(const CompiledShaft& shaft, const Gaps& gaps, unsigned positive,
                      const float (&sphere)[4]) noexcept {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float rest[6] = {sphere[0], sphere[1], sphere[2], sphere[0], sphere[1], sphere[2]};
  Measured excess(-static_cast<double>(sphere[3]) * sphere[3]);
  for (unsigned g = 0; g < gaps.count; ++g) {
    if ((positive >> g & 1U) == 0) continue;
    const Measured start = gaps.gap[g].start_in<Measured>();
    excess = excess + start * start;
    rest[gaps.axis[g]] = -infinity;
    rest[gaps.axis[g] + 3] = infinity;
  }
  if (excess.is_positive()) return Verdict::outside;
  return excess.is_not_positive() && !SlabPredicate(shaft).outside(rest) ? Verdict::meets : Verdict::undecided;
}

/// Decides for certain from where f seems to be least, if what matters is computed without rounding, or nearly so.
Verdict certify(const CompiledShaft& shaft, const Gaps& gaps, const RoundedGaps& rounded, const Minimum& least,
                const float (&sphere)[4]) noexcept {
  if (least.t == 0 || least.t == 1) return certify_at_end(gaps, least.t == 1, sphere[3]);
  bool still = true;
  for (unsigned g = 0; g < gaps.count; ++g) still = still && ((least.positive >> g & 1U) == 0 || rounded.is_still(g));
  return still ? certify_still(shaft, gaps, least.positive, sphere) : certify_between(gaps, least.positive, sphere[3]);
}

/// t = numerator / denominator with denominator > 0, exactly.
struct Ratio {
  Expansion<2> numerator;
  Expansion<2> denominator;
};

/// denominator · gap(t), exactly.
Expansion<16> scaled_gap(const Gap& gap, const Ratio& t) noexcept {
  return gap.exact_start() * t.denominator + gap.exact_slope() * t.numerator;
}

/// Terms that a sum of degree four in floats and differences of them has at most, however many are added up: its terms
/// are multiples of 2⁻⁵⁹⁶ below 2⁵²⁴ and do not overlap, so that no two share a bit. It is what keeps them on a small
/// stack.
constexpr std::size_t most_terms = 596 + 524;

/// Sign of f′(t), exactly.
int derivative_sign(const Gaps& gaps, const Ratio& t) noexcept {
  Expansion<6 * 64> sum;
  for (unsigned g = 0; g < gaps.count; ++g) {
    const auto gap = scaled_gap(gaps.gap[g], t);
    if (gap.sign() <= 0) continue;
    const auto term = gap * gaps.gap[g].exact_slope();
    for (std::size_t i = 0; i < term.size(); ++i) sum.grow(term[i]);
  }
  return sum.sign();
}

/// Whether f(t) > r², exactly.
[[gnu::noinline]] bool farther_at(const Gaps& gaps, const Ratio& t, double radius) noexcept {
  Expansion<most_terms> sum;
  for (unsigned g = 0; g < gaps.count; ++g) {
    const auto gap = scaled_gap(gaps.gap[g], t);
    if (gap.sign() <= 0) continue;
    const auto square = gap * gap;
    for (std::size_t i = 0; i < square.size(); ++i) sum.grow(square[i]);
  }
  const auto limit = t.denominator * t.denominator * (radius * radius);
  for (std::size_t i = 0; i < limit.size(); ++i) sum.grow(-limit[i]);
  return sum.sign() > 0;
}

/// Whether the minimum of f is larger than r², where it lies between `low` and `high` and no gap changes its sign
/// there; exactly. Not inlined, so that its sum and that of farther_at() are not on the stack at the same time.
///
/// The same gaps are positive there. With starts α and slopes β of those, Lagrange's identity gives
///   min f = Σ_{g<h} (α_g β_h − α_h β_g)² / Σ β_g²,
/// a sum of squares, so nothing cancels.
[[gnu::noinline]] bool farther_between(const Gaps& gaps, const Ratio& low, const Ratio& high, double radius) noexcept {
  const Gap* active[6];
  unsigned count = 0;
  for (unsigned g = 0; g < gaps.count; ++g) {
    if (scaled_gap(gaps.gap[g], low).sign() > 0 || scaled_gap(gaps.gap[g], high).sign() > 0)
      active[count++] = &gaps.gap[g];
  }
  Expansion<most_terms> sum;
  for (unsigned g = 0; g < count; ++g) {
    const auto start = active[g]->exact_start();
    const auto slope = active[g]->exact_slope();
    for (unsigned h = g + 1; h < count; ++h) {
      const auto cross = start * active[h]->exact_slope() - active[h]->exact_start() * slope;
      const auto square = cross * cross;
      for (std::size_t i = 0; i < square.size(); ++i) sum.grow(square[i]);
    }
    const auto limit = slope * slope * (radius * radius);
    for (std::size_t i = 0; i < limit.size(); ++i) sum.grow(-limit[i]);
  }
  return sum.sign() > 0;
}

/// Whether the minimum of f is larger than r², decided by expansions alone.
bool exactly_outside(const Gaps& gaps, double radius) noexcept {
  Ratio low{{}, Expansion<2>(1.0)};
  Ratio high{Expansion<2>(1.0), Expansion<2>(1.0)};
  if (derivative_sign(gaps, low) >= 0) return farther_at(gaps, low, radius);
  if (derivative_sign(gaps, high) <= 0) return farther_at(gaps, high, radius);

  // From here on f′(low) < 0 < f′(high): narrow to an interval without a breakpoint.
  const auto less = [](const Ratio& s, const Ratio& t) {
    return (s.numerator * t.denominator - t.numerator * s.denominator).sign() < 0;
  };
  for (unsigned g = 0; g < gaps.count; ++g) {
    Ratio t{-gaps.gap[g].exact_start(), gaps.gap[g].exact_slope()};
    const int direction = t.denominator.sign();
    if (direction == 0) continue;
    if (direction < 0) t = {-t.numerator, -t.denominator};
    if (!less(low, t) || !less(t, high)) continue;
    const int sign = derivative_sign(gaps, t);
    if (sign == 0) return farther_at(gaps, t, radius);
    (sign > 0 ? high : low) = t;
  }

  return farther_between(gaps, low, high, radius);
}

/// A joining plane as seen from a point on its inner side: value() is the distance times the length of the normal.
struct FromWithin {
  const Edge& edge;
  double x;
  double y;

  [[nodiscard]] Measured value() const noexcept { return -edge.side_in<Measured>(x, y); }
  [[nodiscard]] Measured squared_length() const noexcept { return edge.squared_length_in<Measured>(); }
  [[nodiscard]] auto exact_value() const noexcept { return -edge.side_in<Expansion<2>>(x, y); }
  [[nodiscard]] auto exact_squared_length() const noexcept { return edge.squared_length_in<Expansion<2>>(); }
};

/// Likewise added plane `i`, as seen from a point on its outer side (sign 1) or its inner side (sign −1).
struct FromAdded {
  const CompiledShaft& shaft;
  unsigned i;
  const double (&point)[3];
  int sign;

  [[nodiscard]] Measured value() const noexcept { return seen(added_side<Measured>(shaft, i, point)); }
  [[nodiscard]] Measured squared_length() const noexcept { return added_squared_length<Measured>(shaft, i); }
  [[nodiscard]] auto exact_value() const noexcept { return seen(added_side<Expansion<7>>(shaft, i, point)); }
  [[nodiscard]] auto exact_squared_length() const noexcept { return added_squared_length<Expansion<3>>(shaft, i); }

 private:
  template <class Number>
  [[nodiscard]] Number seen(const Number& side) const noexcept {
    return sign > 0 ? side : -side;
  }
};

/// Whether the point that a plane is seen from is farther than `radius` from it, or as far if `or_equal`; exactly.
template <class Plane>
bool beyond(const Plane& plane, double radius, bool or_equal) noexcept {
  const double radius_square = radius * radius;  // exact: 24-bit factor
  const Measured value = plane.value();
  if (value.is_known()) {
    if (value.is_negative()) return false;
    const Measured excess = value * value - plane.squared_length() * Measured(radius_square);
    if (excess.is_known()) return or_equal ? excess.is_not_negative() : excess.is_positive();
  }
  const auto exact = plane.exact_value();
  if (exact.sign() < 0) return false;
  const int difference = (exact * exact - plane.exact_squared_length() * radius_square).sign();
  return or_equal ? difference >= 0 : difference > 0;
}

/// Whether `x` − `face` is at least `radius` > 0, exactly. A rounded difference that is not equal to a float is on the
/// same side of it.
bool is_within(double x, double face, double radius) noexcept {
  const TwoTerms distance = two_sum(x, -face);
  return distance.sum > radius || (distance.sum == radius && distance.error >= 0);
}

/// Whether a sphere of finite radius ≥ 0 is outside the hull of a and b.
bool outside_hull(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (radius == 0) {  // a point is a box
    return SlabPredicate(shaft).outside({sphere[0], sphere[1], sphere[2], sphere[0], sphere[1], sphere[2]});
  }
  const Gaps gaps(shaft.a, shaft.b, sphere);
  const RoundedGaps rounded(gaps);
  Minimum least{};
  Verdict verdict = rounded.decide(radius, least);
  if (verdict == Verdict::undecided) verdict = certify(shaft, gaps, rounded, least, sphere);
  return verdict == Verdict::undecided ? exactly_outside(gaps, radius) : verdict == Verdict::outside;
}

}  // namespace

bool sphere_outside(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (std::isnan(radius)) return false;
  if (radius < 0) return true;
  for (unsigned k = 0; k < 3; ++k) {  // an infinite centre is only ever beyond a face
    const double c = sphere[k];
    if (std::isinf(c) && (c < 0 ? shaft_face(shaft, k) - c : c - shaft_face(shaft, k + 3)) > radius) return true;
  }
  if (std::isinf(radius)) return false;

  if (outside_hull(shaft, sphere)) return true;

  const double centre[3] = {sphere[0], sphere[1], sphere[2]};
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    bool bounded = true;
    for (unsigned k = 0; k < 3; ++k) bounded = bounded && (shaft.added[i].normal[k] == 0 || std::isfinite(centre[k]));
    if (bounded && beyond(FromAdded{shaft, i, centre, 1}, radius, false)) return true;
  }
  return false;
}

bool sphere_inside(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (!(radius >= 0) || std::isinf(radius)) return false;
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (!std::isfinite(c)) return false;
    if (!is_within(c, shaft_face(shaft, k), radius) || !is_within(shaft_face(shaft, k + 3), c, radius)) return false;
  }
  const Faces faces(shaft.a, shaft.b);
  for (unsigned r = 0; r < faces.reds; ++r) {
    for (unsigned b = 0; b < faces.blues; ++b) {
      const unsigned red = faces.red[r];
      const unsigned blue = faces.blue[b];
      if (red % 3 == blue % 3) continue;
      const Edge edge(shaft.a, shaft.b, red, blue);
      if (!beyond(FromWithin{edge, sphere[red % 3], sphere[blue % 3]}, radius, true)) return false;
    }
  }
  const double centre[3] = {sphere[0], sphere[1], sphere[2]};
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    if (!beyond(FromAdded{shaft, i, centre, -1}, radius, true)) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
