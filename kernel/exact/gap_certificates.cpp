// SPDX-License-Identifier: MIT
/// The second step of the distance between a sphere's centre and a shaft: certificates for where f seems to be least.
#include <limits>

#include "exact/gap.hpp"
#include "exact/measured.hpp"
#include "exact/predicates.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether a sphere with this excess of the least f over r² is certainly outside.
bool says_outside(const Measured& excess, Contact contact) noexcept {
  return contact == Contact::open ? excess.is_not_negative() : excess.is_positive();
}
/// Whether one with this excess of any f certainly is not.
bool says_meets(const Measured& excess, Contact contact) noexcept {
  return contact == Contact::open ? excess.is_negative() : excess.is_not_positive();
}

/// Decides for certain if f is least at t = 0, or at t = 1 of a shaft between two boxes, and what matters is computed
/// without rounding, or nearly so.
Verdict certify_at_end(const Gaps& gaps, bool at_one, double radius, Contact contact) noexcept {
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
  if (says_meets(excess, contact)) return Verdict::meets;
  if (!says_outside(excess, contact)) return Verdict::undecided;
  Measured half_slope;
  for (unsigned g = 0; g < count; ++g) half_slope = half_slope + positive[g]->slope_in<Measured>() * distance[g];
  return (at_one ? half_slope.is_not_positive() : half_slope.is_not_negative()) ? Verdict::outside : Verdict::undecided;
}

/// Decides for certain if f is least between the ends of t, where the gaps of `positive` are, and what matters is
/// computed without rounding, or nearly so.
///
/// Let S be these gaps, α their starts and β their slopes. Their sum of squares is least at t = N / D with N = −Σ α β
/// and D = Σ β², where any gap is (α D + β N) / D; by Lagrange's identity it is Σ (α_g β_h − α_h β_g)² / D there. That
/// is the minimum of f if 0 ≤ N ≤ end · D, gaps of S are not negative at N / D, and all others are not positive.
Verdict certify_between(const Gaps& gaps, unsigned positive, double radius, Contact contact) noexcept {
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
  if (!minus_n.is_not_positive()) return Verdict::undecided;
  if (gaps.ends_at_b) {
    if (!(minus_n + denominator).is_not_negative()) return Verdict::undecided;
  } else if (!gaps.is_endless()) {
    const Measured end = Measured::difference(gaps.end_minuend, gaps.end_subtrahend);
    if (!(minus_n + end * denominator).is_not_negative()) return Verdict::undecided;
  }
  const auto scaled = [&](const Measured& of_start, const Measured& of_slope) {
    return of_start * denominator - of_slope * minus_n;
  };
  for (unsigned g = 0; g < count && count > 1; ++g) {  // if there is only one, it is 0
    if (!scaled(start[g], slope[g]).is_not_negative()) return Verdict::undecided;
  }
  if (says_outside(excess, contact)) return Verdict::outside;  // whatever the others are
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

/// Decides for certain if the gaps of `positive` are the same for every t.
///
/// Then their sum of squares is the minimum of f if all others are not positive at some t: if the box whose extent is
/// that of the centre, but infinite on the axes of `positive`, is not outside.
Verdict certify_constant(const ShaftData& shaft, const Gaps& gaps, unsigned positive,
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
  if (says_outside(excess, shaft.contact)) return Verdict::outside;
  const auto is_reached = [&] { return !SlabPredicate(shaft, Contact::closed).outside(rest); };
  return says_meets(excess, shaft.contact) && is_reached() ? Verdict::meets : Verdict::undecided;
}

}  // namespace

Verdict certify(const ShaftData& shaft, const Gaps& gaps, const Minimum& least, bool constant,
                const float (&sphere)[4]) noexcept {
  if (least.where == Minimum::Where::end && !gaps.ends_at_b) return Verdict::undecided;
  if (least.where != Minimum::Where::between)
    return certify_at_end(gaps, least.where == Minimum::Where::end, sphere[3], shaft.contact);
  return constant ? certify_constant(shaft, gaps, least.positive, sphere)
                  : certify_between(gaps, least.positive, sphere[3], shaft.contact);
}

}  // namespace shaftcull::kernel
