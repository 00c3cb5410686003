// SPDX-License-Identifier: MIT
/// The third step of the distance between a sphere's centre and a shaft: the sign of f's minimum by expansions.
#include "exact/gap.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {
namespace {

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

/// Adds x². Its terms are added as they are found: all of them would take 4 KB of the stack.
void add_square(Expansion<most_terms>& sum, const Expansion<16>& x) noexcept {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto row = x * x[i];
    for (std::size_t k = 0; k < row.size(); ++k) sum.grow(row[k]);
  }
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

/// The sign of f(t) − r², exactly.
SHAFTCULL_NOINLINE int excess_at(const Gaps& gaps, const Ratio& t, double radius) noexcept {
  Expansion<most_terms> sum;
  for (unsigned g = 0; g < gaps.count; ++g) {
    const auto gap = scaled_gap(gaps.gap[g], t);
    if (gap.sign() <= 0) continue;
    add_square(sum, gap);
  }
  const auto limit = t.denominator * t.denominator * (radius * radius);
  for (std::size_t i = 0; i < limit.size(); ++i) sum.grow(-limit[i]);
  return sum.sign();
}

/// The sign of the minimum of f less r², where it lies between `low` and `high` and no gap changes its sign there;
/// exactly. Not inlined, so that its sum and that of excess_at() are not on the stack at the same time.
///
/// The same gaps are positive there. With starts α and slopes β of those, Lagrange's identity gives
///   min f = Σ_{g<h} (α_g β_h − α_h β_g)² / Σ β_g²,
/// a sum of squares, so nothing cancels.
SHAFTCULL_NOINLINE int excess_between(const Gaps& gaps, const Ratio& low, const Ratio& high, double radius) noexcept {
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
      add_square(sum, cross);
    }
    const auto limit = slope * slope * (radius * radius);
    for (std::size_t i = 0; i < limit.size(); ++i) sum.grow(-limit[i]);
  }
  return sum.sign();
}

/// The sign of the minimum of f less r², exactly.
int least_excess(const Gaps& gaps, double radius) noexcept {
  const auto less = [](const Ratio& s, const Ratio& t) {
    return (s.numerator * t.denominator - t.numerator * s.denominator).sign() < 0;
  };
  Ratio low{{}, Expansion<2>(1.0)};
  if (derivative_sign(gaps, low) >= 0) return excess_at(gaps, low, radius);
  Ratio high = low;
  if (!gaps.is_endless()) {
    high.numerator = Expansion<2>::difference(gaps.end_minuend, gaps.end_subtrahend);
  } else {
    for (unsigned g = 0; g < gaps.count; ++g) {  // where the last gap that shrinks is zero
      const Ratio t{gaps.gap[g].exact_start(), -gaps.gap[g].exact_slope()};
      if (t.numerator.sign() > 0 && t.denominator.sign() > 0 && less(high, t)) high = t;
    }
  }
  if (derivative_sign(gaps, high) <= 0) return excess_at(gaps, high, radius);

  // From here on f′(low) < 0 < f′(high): narrow to an interval without a breakpoint.
  for (unsigned g = 0; g < gaps.count; ++g) {
    Ratio t{-gaps.gap[g].exact_start(), gaps.gap[g].exact_slope()};
    const int direction = t.denominator.sign();
    if (direction == 0) continue;
    if (direction < 0) t = {-t.numerator, -t.denominator};
    if (!less(low, t) || !less(t, high)) continue;
    const int sign = derivative_sign(gaps, t);
    if (sign == 0) return excess_at(gaps, t, radius);
    (sign > 0 ? high : low) = t;
  }

  return excess_between(gaps, low, high, radius);
}

}  // namespace

bool exactly_outside(const Gaps& gaps, double radius, Contact contact) noexcept {
  const int excess = least_excess(gaps, radius);
  return contact == Contact::open ? excess >= 0 : excess > 0;
}

}  // namespace shaftcull::kernel
