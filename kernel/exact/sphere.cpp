// SPDX-License-Identifier: MIT
#include <cmath>

#include "compiled/shaft_box.hpp"
#include "exact/added.hpp"
#include "exact/edge.hpp"
#include "exact/gap.hpp"
#include "exact/measured.hpp"
#include "exact/predicates.hpp"
#include "exact/rounded_gaps.hpp"

namespace shaftcull::kernel {
namespace {

/// A joining plane as seen from a point on its inner side: value() is the distance times the length of the normal.
struct JoiningPlaneFromInside {
  const Edge& edge;
  double x;
  double y;

  [[nodiscard]] Measured value() const noexcept { return -edge.side_in<Measured>(x, y); }
  [[nodiscard]] Measured squared_length() const noexcept { return edge.squared_length_in<Measured>(); }
  [[nodiscard]] auto exact_value() const noexcept { return -edge.side_in<Expansion<2>>(x, y); }
  [[nodiscard]] auto exact_squared_length() const noexcept { return edge.squared_length_in<Expansion<2>>(); }
};

/// Likewise added plane `i`, as seen from a point on its outer side (sign 1) or its inner side (sign −1).
struct AddedPlaneFromPoint {
  const ShaftData& shaft;
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

/// As is_within(), for face `f` of the shaft box of a moving box, which need not be a float.
bool is_within_face(const ShaftData& shaft, const MovingFaces& faces, unsigned f, double c, double radius) noexcept {
  const double sign = f < 3 ? 1 : -1;
  if (is_within(sign * c, sign * shaft.face[f], radius)) return true;  // a face no farther out
  if (!faces.is_blue(f)) return false;                                 // which is where it is
  if (faces.is_endless()) return true;
  const auto distance = Expansion<2>::difference(faces.end_minuend, faces.end_subtrahend) *
                        Expansion<2>::difference(faces.minuend[f], faces.subtrahend[f]);
  Expansion<11> sum(-sign * radius);
  sum.grow(c);
  sum.grow(-double{faces.p[f]});
  for (std::size_t i = 0; i < distance.size(); ++i) sum.grow(-distance[i]);
  return static_cast<double>(sum.sign()) * sign >= 0;
}

/// Whether a sphere of finite radius ≥ 0 is outside the hull of a and b.
bool outside_hull(const ShaftData& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (radius == 0) {  // a point is a box
    return SlabPredicate(shaft).outside({sphere[0], sphere[1], sphere[2], sphere[0], sphere[1], sphere[2]});
  }
  const Gaps gaps(shaft, sphere);
  const RoundedGaps rounded(gaps);
  Minimum least{};
  Verdict verdict = rounded.decide(radius, least);
  if (verdict == Verdict::undecided)
    verdict = certify(shaft, gaps, least, rounded.are_constant(least.positive), sphere);
  return verdict == Verdict::undecided ? exactly_outside(gaps, radius, shaft.contact) : verdict == Verdict::outside;
}

}  // namespace

bool sphere_outside(const ShaftData& shaft, const float (&sphere)[4]) noexcept {
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
    if (bounded && beyond(AddedPlaneFromPoint{shaft, i, centre, 1}, radius, shaft.contact == Contact::open))
      return true;
  }
  return false;
}

bool sphere_inside(const ShaftData& shaft, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (!(radius >= 0) || std::isinf(radius)) return false;
  const MovingFaces moving(shaft);
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (!std::isfinite(c)) return false;
    if (shaft.kind != ShaftData::Kind::between) {
      if (!is_within_face(shaft, moving, k, c, radius) || !is_within_face(shaft, moving, k + 3, c, radius))
        return false;
    } else if (!is_within(c, shaft_face(shaft, k), radius) || !is_within(shaft_face(shaft, k + 3), c, radius)) {
      return false;
    }
  }
  const Faces faces(moving);
  for (unsigned r = 0; r < faces.reds; ++r) {
    for (unsigned b = 0; b < faces.blues; ++b) {
      const unsigned red = faces.red[r];
      const unsigned blue = faces.blue[b];
      if (red % 3 == blue % 3) continue;
      const Edge edge(moving, red, blue);
      if (!beyond(JoiningPlaneFromInside{edge, sphere[red % 3], sphere[blue % 3]}, radius, true)) return false;
    }
  }
  const double centre[3] = {sphere[0], sphere[1], sphere[2]};
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    if (!beyond(AddedPlaneFromPoint{shaft, i, centre, -1}, radius, true)) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
