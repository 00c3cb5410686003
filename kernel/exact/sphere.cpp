#include <cmath>

#include "exact/added.hpp"
#include "exact/edge.hpp"
#include "exact/predicates.hpp"

// The sphere is outside iff the smallest squared distance of its centre c from box(t), over t in [0, 1],
//   f(t) = Σ gap_g(t)²  over the gaps that are positive,
// is larger than r². Each axis has two gaps, lo_k(t) − c_k and c_k − hi_k(t), linear in t, so f is convex and
// piecewise quadratic, and breaks only where a gap is zero.
namespace shaftcull::kernel {
namespace {

constexpr double unit = 0x1p-53;

/// gap(t) = start + t · slope: how far the centre is beyond a face of box(t).
struct Gap {
  double start_minuend;
  double start_subtrahend;
  double slope_minuend;
  double slope_subtrahend;

  [[nodiscard]] double start() const noexcept { return start_minuend - start_subtrahend; }
  [[nodiscard]] double slope() const noexcept { return slope_minuend - slope_subtrahend; }
  [[nodiscard]] Expansion<2> exact_start() const noexcept {
    return Expansion<2>::difference(start_minuend, start_subtrahend);
  }
  [[nodiscard]] Expansion<2> exact_slope() const noexcept {
    return Expansion<2>::difference(slope_minuend, slope_subtrahend);
  }
};

struct Gaps {
  Gap gap[6];
  unsigned count = 0;

  Gaps(const Box& a, const Box& b, const float (&sphere)[4]) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      const double c = sphere[k];
      if (!std::isfinite(c)) continue;
      gap[count++] = {a.lo[k], c, b.lo[k], a.lo[k]};
      gap[count++] = {c, a.hi[k], a.hi[k], b.hi[k]};
    }
  }
};

enum class Verdict : unsigned char { outside, meets, undecided };

/// Decides in double arithmetic, with a bound on its own error.
///
/// f is convex, so at any t: min f ≤ f(t), and min f ≥ f(t) + min(f′(t) (0 − t), f′(t) (1 − t), 0).
Verdict estimate(const Gaps& gaps, double radius) noexcept {
  double start[6];
  double slope[6];
  double reach = 0;  // largest magnitude that a rounding error of a gap can be relative to
  for (unsigned g = 0; g < gaps.count; ++g) {
    start[g] = gaps.gap[g].start();
    slope[g] = gaps.gap[g].slope();
    reach = std::fmax(reach, std::fabs(start[g]) + std::fabs(slope[g]));
  }
  const auto half_derivative = [&](double t) {
    double sum = 0;
    for (unsigned g = 0; g < gaps.count; ++g) {
      const double gap = start[g] + t * slope[g];
      if (gap > 0) sum += slope[g] * gap;
    }
    return sum;
  };

  double low = 0;
  double high = 1;
  for (unsigned g = 0; g < gaps.count; ++g) {
    if (slope[g] == 0) continue;
    const double t = -start[g] / slope[g];
    if (!(t > low && t < high)) continue;
    (half_derivative(t) > 0 ? high : low) = t;
  }
  const double middle = 0.5 * (low + high);
  double numerator = 0;
  double denominator = 0;
  for (unsigned g = 0; g < gaps.count; ++g) {
    if (start[g] + middle * slope[g] <= 0) continue;
    numerator -= start[g] * slope[g];
    denominator += slope[g] * slope[g];
  }
  double t = denominator > 0 ? numerator / denominator : low;
  t = t < low ? low : (t > high ? high : t);

  // A gap is off by at most 4 units of reach: its start and slope by one each, product and sum by one each.
  const double gap_error = 4 * unit * reach;
  double square = 0;
  double square_error = 0;
  double half_slope = 0;
  double half_slope_error = 0;
  for (unsigned g = 0; g < gaps.count; ++g) {
    const double gap = start[g] + t * slope[g];
    if (gap > 0) {
      square += gap * gap;
      half_slope += slope[g] * gap;
    }
    if (gap <= -gap_error) continue;
    const double size = std::fabs(gap) + gap_error;
    square_error += gap_error * (2 * size + gap_error);
    half_slope_error += std::fabs(slope[g]) * (gap_error + 4 * unit * size);
  }
  square_error = 2 * (square_error + 8 * unit * square);  // twice what is needed pays for the rounding of the bound itself
  half_slope_error *= 2;

  const double radius_square = radius * radius;  // exact: 24-bit factor
  if (square + square_error < radius_square) return Verdict::meets;
  const double descent = std::fmax(half_slope * t, -half_slope * (1 - t)) + half_slope_error;
  const double least = square - square_error - 2 * std::fmax(descent, 0.0) * (1 + 4 * unit);
  if (least * (1 - 8 * unit) > radius_square) return Verdict::outside;
  return Verdict::undecided;
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
bool farther_at(const Gaps& gaps, const Ratio& t, double radius) noexcept {
  Expansion<6 * 512 + 16> sum;
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

  // Between them the same gaps are positive. With starts α and slopes β of those, Lagrange's identity gives
  //   min f = Σ_{g<h} (α_g β_h − α_h β_g)² / Σ β_g²,
  // a sum of squares, so nothing cancels.
  const Gap* active[6];
  unsigned count = 0;
  for (unsigned g = 0; g < gaps.count; ++g) {
    if (scaled_gap(gaps.gap[g], low).sign() > 0 || scaled_gap(gaps.gap[g], high).sign() > 0) active[count++] = &gaps.gap[g];
  }
  Expansion<15 * 512 + 6 * 32> sum;
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

/// Whether value > r · √(squared length), or ≥ if `or_equal`; exactly.
template <std::size_t N, std::size_t M>
bool beyond(const Expansion<N>& value, double radius, const Expansion<M>& squared_length, bool or_equal) noexcept {
  const int sign = value.sign();
  if (sign < 0) return false;
  const int difference = (value * value - squared_length * (radius * radius)).sign();
  return or_equal ? difference >= 0 : difference > 0;
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

  const Gaps gaps(shaft.a, shaft.b, sphere);
  const Verdict verdict = estimate(gaps, radius);
  if (verdict == Verdict::outside || (verdict == Verdict::undecided && exactly_outside(gaps, radius))) return true;

  const double centre[3] = {sphere[0], sphere[1], sphere[2]};
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    bool bounded = true;
    for (unsigned k = 0; k < 3; ++k) bounded = bounded && (shaft.added_normal[k][i] == 0 || std::isfinite(centre[k]));
    if (bounded && beyond(added_side(shaft, i, centre), radius, added_squared_length(shaft, i), false)) return true;
  }
  return false;
}

bool sphere_inside(const CompiledShaft& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (!(radius >= 0) || std::isinf(radius)) return false;
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (!std::isfinite(c)) return false;
    if ((Expansion<2>::difference(c, shaft_face(shaft, k)) - Expansion<1>(radius)).sign() < 0) return false;
    if ((Expansion<2>::difference(shaft_face(shaft, k + 3), c) - Expansion<1>(radius)).sign() < 0) return false;
  }
  const Faces faces(shaft.a, shaft.b);
  for (unsigned r = 0; r < faces.reds; ++r) {
    for (unsigned b = 0; b < faces.blues; ++b) {
      const unsigned red = faces.red[r];
      const unsigned blue = faces.blue[b];
      if (red % 3 == blue % 3) continue;
      const Edge edge(shaft.a, shaft.b, red, blue);
      if (!beyond(-edge.exact_side(sphere[red % 3], sphere[blue % 3]), radius, edge.squared_length(), true)) return false;
    }
  }
  const double centre[3] = {sphere[0], sphere[1], sphere[2]};
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    if (!beyond(-added_side(shaft, i, centre), radius, added_squared_length(shaft, i), true)) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
