// SPDX-License-Identifier: MIT
/// How far a sphere's centre is from a shaft: the gaps between it and the faces of box(t).
///
/// The sphere is outside iff the smallest squared distance of its centre c from box(t), over t from 0 to its end,
///   f(t) = Σ gap_g(t)²  over the gaps that are positive,
/// is larger than r², or with open contact not less. Each axis has two gaps, lo_k(t) − c_k and c_k − hi_k(t), linear in
/// t, so f is convex and piecewise quadratic, and breaks only where a gap is zero. If t has no end, f is least before
/// the last of the gaps that shrink is zero: from there on it only grows, as some gap does without end.
///
/// Three steps find out, each for what the one before leaves undecided: doubles with a bound on their error
/// (rounded_gaps.hpp), certificates for where f seems to be least (gap_certificates.cpp), and expansions
/// (gap_expansions.cpp).
#pragma once

#include <cmath>

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"
#include "exact/expansion.hpp"

namespace shaftcull::kernel {

/// gap(t) = start + t · slope: how far the centre is beyond a face of box(t).
struct Gap {
  double start_minuend;
  double start_subtrahend;
  double slope_minuend;
  double slope_subtrahend;
  double end_minuend;  ///< the gap for t = 1, in a shaft between two boxes
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
  bool ends_at_b;      ///< whether the gaps' ends are there
  double end_minuend;  ///< t ends at the difference; +∞ if it does not
  double end_subtrahend;

  Gaps(const ShaftData& shaft, const float (&sphere)[4]) noexcept : ends_at_b(shaft.kind == ShaftData::Kind::between) {
    const MovingFaces faces(shaft);
    end_minuend = faces.end_minuend;
    end_subtrahend = faces.end_subtrahend;
    const float* const b = shaft.b;
    for (unsigned k = 0; k < 3; ++k) {
      const double c = sphere[k];
      if (!std::isfinite(c)) continue;
      axis[count] = axis[count + 1] = k;
      gap[count++] = {faces.p[k], c, faces.minuend[k], faces.subtrahend[k], b[k], c};
      gap[count++] = {c, faces.p[k + 3], faces.subtrahend[k + 3], faces.minuend[k + 3], c, b[k + 3]};
    }
  }

  [[nodiscard]] bool is_endless() const noexcept { return end_minuend == HUGE_VAL; }
};

/// What a step says of a sphere and a shaft.
enum class Verdict : unsigned char { outside, meets, undecided };

/// Where f seems to be least: where t starts, where it ends, or at a t between with these positive gaps, gap g as bit
/// g.
struct Minimum {
  enum class Where : unsigned char { start, end, between };
  Where where;
  unsigned positive;
};

/// Decides for certain from where f seems to be least, if what matters is computed without rounding, or nearly so.
/// `constant` says that the gaps of `least.positive` are the same for every t.
Verdict certify(const ShaftData& shaft, const Gaps& gaps, const Minimum& least, bool constant,
                const float (&sphere)[4]) noexcept;

/// Whether the sphere is outside, decided by expansions alone.
bool exactly_outside(const Gaps& gaps, double radius, Contact contact) noexcept;

}  // namespace shaftcull::kernel
