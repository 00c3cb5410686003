// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "compiled/shaft_box.hpp"
#include "exact/added.hpp"
#include "exact/convex_hull.hpp"
#include "exact/edge.hpp"
#include "exact/open_contact.hpp"
#include "exact/predicates.hpp"

namespace shaftcull::kernel {
namespace {

/// The stream opposite to `stream` on the same axis: lo ↔ hi.
unsigned opposite(unsigned stream) noexcept { return stream < 3 ? stream + 3 : stream - 3; }

/// Whether the signs of the far corner over all planes are at most `most`, once it is known for the shaft box.
bool is_behind_planes(const ShaftData& shaft, const float (&bound)[6], int most) noexcept {
  const MovingFaces moving(shaft);
  const Faces faces(moving);
  for (unsigned r = 0; r < faces.reds; ++r) {
    for (unsigned b = 0; b < faces.blues; ++b) {
      if (faces.blue[b] == opposite(faces.red[r])) continue;
      const Edge edge(moving, faces.red[r], faces.blue[b]);
      if (edge.side(bound[faces.red[r]], bound[faces.blue[b]]) > most) return false;
    }
  }
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    double far[3];
    for (unsigned k = 0; k < 3; ++k) far[k] = bound[opposite(shaft.added[i].near[k])];
    if (added_side<Expansion<7>>(shaft, i, far).sign() > most) return false;
  }
  return true;
}

}  // namespace

SlabPredicate::SlabPredicate(const ShaftData& shaft) noexcept : SlabPredicate(shaft, shaft.contact) {}

SlabPredicate::SlabPredicate(const ShaftData& shaft, Contact contact) noexcept
    : faces_(shaft), is_endless_(faces_.is_endless()), end_(faces_.end()), contact_(contact), shaft_(shaft) {
  if (contact == Contact::open) flat_axes_ = flat_axes(faces_);
  for (unsigned f = 0; f < 6; ++f) face_[f] = shaft_face(shaft, f);
  const Faces faces(faces_);
  const auto constraint = [&](unsigned f) {
    return Constraint{f, opposite(f), double{faces_.p[f]}, 1 / faces_.slope(f)};
  };
  for (unsigned r = 0; r < faces.reds; ++r) upper_[uppers_++] = constraint(faces.red[r]);
  for (unsigned b = 0; b < faces.blues; ++b) lower_[lowers_++] = constraint(faces.blue[b]);
}

template <Contact contact>
bool SlabPredicate::outside_by(const float (&bound)[6]) const noexcept {
  const unsigned both_flat = contact == Contact::open ? flat_axes_ & flat_axes(bound) : 0;
  if constexpr (contact == Contact::open) {
    if (is_beyond_open_box(shaft_, faces_, face_, both_flat, bound)) return true;
  } else {
    for (unsigned k = 0; k < 3; ++k) {
      if (bound[k + 3] < face_[k] || bound[k] > face_[k + 3]) return true;
    }
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double upper[6];
  double lower[6];
  double smallest_upper = infinity;
  double largest_lower = -infinity;
  const auto value = [&](const Constraint& c, double none) {
    const double x = bound[c.near];
    return std::isfinite(x) ? (x - c.p) * c.inverse : none;
  };
  for (unsigned i = 0; i < uppers_; ++i) {
    upper[i] = value(upper_[i], infinity);
    smallest_upper = std::min(smallest_upper, upper[i]);
  }
  for (unsigned i = 0; i < lowers_; ++i) {
    lower[i] = value(lower_[i], -infinity);
    largest_lower = std::max(largest_lower, lower[i]);
  }
  // Within the shaft box every lower bound on t is at most the end of t and every upper one at least 0, so a pair can
  // only separate where both are between these. Four roundings leave the computed ones within 2⁻⁵¹ of their size, and a
  // difference of them within 2⁻⁵⁰ of the larger one, which is the lower bound or nearly so where they matter.
  const double margin = 0x1p-48 * (is_endless_ ? std::max(largest_lower, 0.0) : end_);
  if (largest_lower > smallest_upper + margin) return true;
  if (largest_lower < smallest_upper - margin) return false;
  for (unsigned i = 0; i < uppers_; ++i) {
    if (upper[i] > smallest_upper + 4 * margin) continue;
    for (unsigned j = 0; j < lowers_; ++j) {
      if (lower[j] < largest_lower - 4 * margin) continue;
      const unsigned red = upper_[i].face;
      const unsigned blue = lower_[j].face;
      const int side = Edge(faces_, red, blue).side(bound[upper_[i].near], bound[lower_[j].near]);
      if (contact == Contact::open ? is_beyond_open_edge(side, both_flat, red, blue) : side > 0) return true;
    }
  }
  return false;
}

bool SlabPredicate::outside(const float (&bound)[6]) const noexcept {
  return contact_ == Contact::closed ? outside_by<Contact::closed>(bound) : outside_by<Contact::open>(bound);
}

bool box_outside(const ShaftData& shaft, const float (&bound)[6]) noexcept {
  const bool is_open = shaft.contact == Contact::open;
  const MovingFaces moving(shaft);
  unsigned both_flat = 0;
  if (is_open) {
    float face[6];
    for (unsigned f = 0; f < 6; ++f) face[f] = shaft_face(shaft, f);
    both_flat = flat_axes(moving) & flat_axes(bound);
    if (is_beyond_open_box(shaft, moving, face, both_flat, bound)) return true;
  } else {
    for (unsigned k = 0; k < 3; ++k) {
      if (bound[k + 3] < shaft_face(shaft, k) || bound[k] > shaft_face(shaft, k + 3)) return true;
    }
  }
  // A lo face is tested against the bound's hi, its near corner, and a hi face against the bound's lo.
  const Faces faces(moving);
  for (unsigned r = 0; r < faces.reds; ++r) {
    const float x = bound[opposite(faces.red[r])];
    if (!std::isfinite(x)) continue;
    for (unsigned b = 0; b < faces.blues; ++b) {
      if (faces.blue[b] == opposite(faces.red[r])) continue;
      const float y = bound[opposite(faces.blue[b])];
      if (!std::isfinite(y)) continue;
      const int side = Edge(moving, faces.red[r], faces.blue[b]).side(x, y);
      if (is_open ? is_beyond_open_edge(side, both_flat, faces.red[r], faces.blue[b]) : side > 0) return true;
    }
  }
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    double near[3];
    bool bounded = true;
    for (unsigned k = 0; k < 3; ++k) {
      near[k] = bound[shaft.added[i].near[k]];
      bounded = bounded && (shaft.added[i].normal[k] == 0 || std::isfinite(near[k]));
    }
    if (bounded && added_side<Expansion<7>>(shaft, i, near).sign() > (is_open ? -1 : 0)) return true;
  }
  return false;
}

bool is_outside_between(const float (&a)[6], const float (&b)[6], Contact contact, const float (&bound)[6]) noexcept {
  ShaftData shaft;  // what exact predicates read of it: the rest is not written
  for (unsigned f = 0; f != 6; ++f) {
    shaft.a[f] = a[f];
    shaft.b[f] = b[f];
  }
  shaft.slab_form = ShaftData::SlabForm::exact;
  shaft.kind = ShaftData::Kind::between;
  shaft.contact = contact;
  shaft.added_count = 0;
  return box_outside(shaft, bound);
}

bool box_inside(const ShaftData& shaft, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!(bound[k] >= shaft_face(shaft, k) && bound[k + 3] <= shaft_face(shaft, k + 3))) return false;
  }
  return is_behind_planes(shaft, bound, 0);
}

bool box_strictly_inside(const ShaftData& shaft, const float (&bound)[6]) noexcept {
  if (shaft.is_hull()) return hull_box_strictly_inside(*shaft.hull, bound);
  for (unsigned k = 0; k < 3; ++k) {
    if (!(bound[k] > shaft_face(shaft, k) && bound[k + 3] < shaft_face(shaft, k + 3))) return false;
  }
  return is_behind_planes(shaft, bound, -1);
}

}  // namespace shaftcull::kernel
