// SPDX-License-Identifier: MIT
/// Bounds against a convex hull, one at a time: the lanes of a vector hold planes of the hull.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "compiled/hull_data.hpp"
#include "compiled/shaft_data.hpp"
#include "exact/convex_hull.hpp"
#include "kernels/hulls/hull_depths.hpp"
#include "kernels/hulls/hull_stages.hpp"
#include "kernels/shared/word.hpp"
#include "shaftcull/results.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The smallest depths of one bound below planes, a plane in each lane: what they are at most, and at least. What they
/// say is as HullDepths has it.
template <class L>
struct DepthLanes {
  using Vector = typename L::Vector;
  Vector most = L::all(INFINITY);
  Vector least = L::all(INFINITY);

  void add(Vector at_most, Vector at_least) noexcept {
    most = L::minimum(at_most, most);
    least = L::minimum(L::maximum(at_least, L::all(-INFINITY)), least);
  }
  [[nodiscard]] bool any_beyond() const noexcept { return L::bits(L::less(most, L::all(0.0F))) != 0; }
  [[nodiscard]] bool all_behind() const noexcept { return L::bits(L::less(L::all(0.0F), least)) == lanes_of<L>(0); }
};

/// Calls visit(group, lane) for the vectors of planes in lanes [first, last) of the groups of a hull.
template <class L, class Visit>
SHAFTCULL_ALWAYS_INLINE inline void for_each_plane_vector(const HullData& hull, unsigned first, unsigned last,
                                                          const Visit& visit) noexcept {
  using Group = HullData::PlaneGroup;
  for (unsigned p = first; p < last; p += L::width) visit(hull.group[p / Group::planes], p % Group::planes);
}

/// How a box lies to the box around a hull.
struct BoxInBox {
  bool is_usual;  ///< it is finite and not empty; of others nothing else is known
  bool meets;
  bool is_within;
};

/// Whether a box that meets the box around a hull touches a face of it, and reaches no further.
[[nodiscard]] inline bool touches_box(const float* box, const float (&around)[6]) noexcept {
  bool touches = false;
  for (unsigned k = 0; k < 3; ++k) touches = touches | (box[k + 3] <= around[k]) | (box[k] >= around[k + 3]);
  return touches;
}

template <class L>
[[nodiscard]] BoxInBox box_in_box(const float* box, const float (&around)[6]) noexcept {
  using Eight = typename L::EightFloats;
  if constexpr (Eight::in_one_register) {
    constexpr std::uint32_t opposite[8] = {3, 4, 5, 0, 1, 2, 1, 2};
    constexpr unsigned six = 0x3f;
    const auto is_all = [](auto mask) { return (Eight::signs(mask) & six) == six; };
    const auto faces = Eight::load_faces(box);
    const auto limits = Eight::load_faces(around);
    const auto signed_faces = Eight::negate_hi(faces);
    const auto is_finite = Eight::less_equal(Eight::magnitude(faces), Eight::all(FLT_MAX));
    return {is_all(is_finite) && Eight::is_ordered(faces),
            is_all(Eight::less_equal(signed_faces, Eight::negate_hi(Eight::permuted(limits, opposite)))),
            is_all(Eight::less_equal(Eight::negate_hi(limits), signed_faces))};
  } else {
    BoxInBox result{true, true, true};
    for (unsigned k = 0; k < 3; ++k) {
      const float lo = box[k];
      const float hi = box[k + 3];
      result.is_usual = result.is_usual && (lo >= -FLT_MAX) & (lo <= hi) & (hi <= FLT_MAX);
      result.meets = result.meets && (lo <= around[k + 3]) & (hi >= around[k]);
      result.is_within = result.is_within && (lo >= around[k]) & (hi <= around[k + 3]);
    }
    return result;
  }
}

/// One finite box against the planes of a hull, whose box it meets: the corner nearest to the hull, and if `classifies`
/// the farthest one.
template <class L, bool bounded, bool classifies>
SHAFTCULL_ALWAYS_INLINE inline void add_one_box(const HullData& hull, const float* box, DepthLanes<L>& near,
                                                DepthLanes<L>& far) noexcept {
  using Vector = typename L::Vector;
  Vector face[6];
  for (unsigned f = 0; f < 6; ++f) face[f] = L::all(box[f]);
  const auto visit = [&](const HullData::PlaneGroup& group, unsigned lane, auto culls) {
    Vector near_sum = L::load(group.offset + lane);
    Vector far_sum = near_sum;
    Vector terms = L::load(group.magnitude + lane);
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const Vector inward = L::load(group.inward[k] + lane);
      const Vector lo = L::multiply(inward, face[k]);
      const Vector hi = L::multiply(inward, face[k + 3]);
      near_sum = L::add(near_sum, L::maximum(lo, hi));
      if constexpr (classifies) far_sum = L::add(far_sum, L::minimum(lo, hi));
      if constexpr (!bounded) terms = L::add(terms, L::maximum(L::magnitude(lo), L::magnitude(hi)));
    }
    const auto add = [&](DepthLanes<L>& depths, Vector sum) {
      if constexpr (bounded) {
        depths.most = L::minimum(sum, depths.most);
      } else {
        const Vector margin = L::multiply(terms, L::all(unbounded_hull_margin));
        depths.add(L::add(sum, margin), L::subtract(sum, margin));
      }
    };
    if constexpr (culls) add(near, near_sum);
    if constexpr (classifies) add(far, far_sum);
  };
  for_each_plane_vector<L>(hull, 0, hull.culling_lanes, [&](const HullData::PlaneGroup& group, unsigned lane) {
    visit(group, lane, std::true_type());
  });
  if constexpr (classifies) {
    if (hull.is_conservative) {
      for_each_plane_vector<L>(
          hull, hull.culling_lanes, hull.lanes,
          [&](const HullData::PlaneGroup& group, unsigned lane) { visit(group, lane, std::false_type()); });
    }
  }
  if constexpr (bounded) {
    near.least = L::subtract(near.most, L::all(2 * hull_margin));
    far.least = L::subtract(far.most, L::all(2 * hull_margin));
  }
}

/// One usual sphere against the planes of a hull: whether it is outside, and if `classifies` whether it is inside.
template <class L, bool bounded, bool classifies>
SHAFTCULL_ALWAYS_INLINE inline void add_one_sphere(const HullData& hull, const float* sphere, DepthLanes<L>& outside,
                                                   DepthLanes<L>& inside) noexcept {
  using Vector = typename L::Vector;
  const Vector centre[3] = {L::all(sphere[0]), L::all(sphere[1]), L::all(sphere[2])};
  const Vector radius = L::all(sphere[3]);
  const Vector more = L::multiply(radius, L::all(1 + hull_radius_slack));
  const Vector less = L::multiply(radius, L::all(1 - hull_radius_slack));
  for_each_plane_vector<L>(hull, 0, hull.lanes, [&](const HullData::PlaneGroup& group, unsigned lane) {
    const Vector length = L::load(group.length + lane);
    Vector depth = L::load(group.offset + lane);
    Vector terms = L::load(group.magnitude + lane);
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const Vector inward = L::load(group.inward[k] + lane);
      depth = L::multiply_add(centre[k], inward, depth);
      if constexpr (!bounded) terms = L::add(terms, L::magnitude(L::multiply(centre[k], inward)));
    }
    Vector above = depth;
    Vector below = L::subtract(depth, L::all(2 * hull_margin));
    if constexpr (!bounded) {
      const Vector margin = L::multiply(L::multiply_add(radius, length, terms), L::all(unbounded_hull_margin));
      above = L::add(depth, margin);
      below = L::subtract(depth, margin);
    }
    const Vector more_depth = L::multiply(more, length);
    const Vector less_depth = L::multiply(less, length);
    outside.add(L::add(above, more_depth), L::add(below, less_depth));
    if constexpr (classifies) inside.add(L::subtract(above, less_depth), L::subtract(below, more_depth));
  });
}

/// How a sphere lies to the box around a hull. A rounded distance that is not equal to the radius is on the same side
/// of it as the exact one.
struct SphereInBox {
  bool is_usual = true;  ///< of others nothing else is known
  bool is_beyond = false;
  bool is_surely_not_beyond = true;
  bool leaves = false;
  bool is_surely_within = true;
};

template <class L>
[[nodiscard]] SphereInBox sphere_in_box(const float* sphere, const HullData& hull) noexcept {
  const float radius = sphere[3];
  const float farthest = hull.is_bounded ? hull.farthest : FLT_MAX;
  SphereInBox result;
  result.is_usual = (radius >= 0) & (radius <= FLT_MAX);
  for (unsigned k = 0; k < 3; ++k) {
    const float centre = sphere[k];
    result.is_usual &= fabsf(centre) <= farthest;
    const float above_lo = centre - hull.box[k];
    const float below_hi = hull.box[k + 3] - centre;
    result.is_beyond |= (radius < -above_lo) | (radius < -below_hi);
    result.is_surely_not_beyond &= (-above_lo < radius) & (-below_hi < radius);
    result.leaves |= (above_lo < radius) | (below_hi < radius);
    result.is_surely_within &= (radius < above_lo) & (radius < below_hi);
  }
  return result;
}

/// What an exact predicate says of one bound.
template <class L, unsigned floats>
SHAFTCULL_COLD bool decide_one(const HullData& hull, const float* bound,
                               bool (*predicate)(const HullData&, const float (&)[floats]) noexcept) noexcept {
  float value[floats];
  for (unsigned i = 0; i < floats; ++i) value[i] = bound[i];
  return decide_lanes<L>(1, [&](unsigned) { return predicate(hull, value); }) != 0;
}

/// What a hull says of one usual box. Unless `classifies`, boxes that are inside overlap.
template <class L, bool bounded, bool classifies, Contact contact>
[[nodiscard]] Answer answer_one_box(const HullData& hull, const float* box, bool is_within) noexcept {
  DepthLanes<L> near;
  DepthLanes<L> far;
  add_one_box<L, bounded, classifies>(hull, box, near, far);
  if (near.any_beyond()) return Answer::outside;
  if constexpr (contact == Contact::open) {
    if ((!near.all_behind() || touches_box(box, hull.box)) && decide_one<L>(hull, box, hull_box_outside_openly))
      return Answer::outside;
  } else if (!near.all_behind() && decide_one<L>(hull, box, hull_box_outside)) {
    return Answer::outside;
  }
  if (!classifies || !is_within || far.any_beyond()) return Answer::overlap;
  return far.all_behind() || decide_one<L>(hull, box, hull_box_inside) ? Answer::inside : Answer::overlap;
}

/// Likewise of one usual sphere.
template <class L, bool bounded, bool classifies, Contact contact>
[[nodiscard]] Answer answer_one_sphere(const HullData& hull, const float* sphere, const SphereInBox& in_box) noexcept {
  DepthLanes<L> outside;
  DepthLanes<L> inside;
  add_one_sphere<L, bounded, classifies>(hull, sphere, outside, inside);
  if (outside.any_beyond()) return Answer::outside;
  const bool is_kept = in_box.is_surely_not_beyond && outside.all_behind();
  constexpr auto is_outside = contact == Contact::open ? hull_sphere_outside_openly : hull_sphere_outside;
  if (!is_kept && decide_one<L>(hull, sphere, is_outside)) return Answer::outside;
  if (!classifies || in_box.leaves || inside.any_beyond()) return Answer::overlap;
  const bool is_inside = in_box.is_surely_within && inside.all_behind();
  return is_inside || decide_one<L>(hull, sphere, hull_sphere_inside) ? Answer::inside : Answer::overlap;
}

/// By the stages of many bounds: for those that are not usual, and hulls that floats do not suit.
template <class L, unsigned streams, class Cull, class FindInside>
[[nodiscard]] Answer answer_by_stages(const float* bound, Cull cull, FindInside find_inside) noexcept {
  const float* stream[streams];
  for (unsigned s = 0; s < streams; ++s) stream[s] = bound + s;
  std::uint64_t bits = 1;
  cull(stream, &bits);
  if (bits == 0) return Answer::outside;
  find_inside(stream, &bits);
  return bits == 0 ? Answer::overlap : Answer::inside;
}

template <class L>
SHAFTCULL_NOINLINE Answer answer_box_by_stages(const HullData& hull, Contact contact, const float* box) noexcept {
  return answer_by_stages<L, 6>(
      box,
      [&](const float* const* stream, std::uint64_t* bits) {
        if (contact == Contact::open) return HullStages<L>::cull_boxes_openly(hull, stream, 1, bits);
        HullStages<L>::cull_boxes(hull, stream, 1, bits);
      },
      [&](const float* const* stream, std::uint64_t* bits) {
        HullStages<L>::find_boxes_inside(hull, stream, 1, bits);
      });
}

template <class L>
SHAFTCULL_NOINLINE Answer answer_sphere_by_stages(const HullData& hull, Contact contact, const float* sphere) noexcept {
  return answer_by_stages<L, 4>(
      sphere,
      [&](const float* const* stream, std::uint64_t* bits) {
        HullStages<L>::cull_spheres(hull, contact, stream, 1, bits);
      },
      [&](const float* const* stream, std::uint64_t* bits) {
        HullStages<L>::find_spheres_inside(hull, stream, 1, bits);
      });
}

/// What a hull says of any box. Unless `classifies`, `inside` may be answered as `overlap`.
template <class L, bool classifies, Contact contact>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline Answer answer_of_hull_for_box(const HullData& hull,
                                                                           const float* box) noexcept {
  const BoxInBox in_box = box_in_box<L>(box, hull.box);
  if (!in_box.is_usual || !hull.suits_floats) [[unlikely]]
    return answer_box_by_stages<L>(hull, contact, box);
  if (!in_box.meets && hull.culls_by_box) return Answer::outside;
  return hull.is_bounded ? answer_one_box<L, true, classifies, contact>(hull, box, in_box.is_within)
                         : answer_one_box<L, false, classifies, contact>(hull, box, in_box.is_within);
}

/// Likewise of any sphere.
template <class L, bool classifies, Contact contact>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline Answer answer_of_hull_for_sphere(const HullData& hull,
                                                                              const float* sphere) noexcept {
  const SphereInBox in_box = sphere_in_box<L>(sphere, hull);
  if (!in_box.is_usual || !hull.suits_floats) [[unlikely]]
    return answer_sphere_by_stages<L>(hull, contact, sphere);
  if (in_box.is_beyond) return Answer::outside;
  return hull.is_bounded ? answer_one_sphere<L, true, classifies, contact>(hull, sphere, in_box)
                         : answer_one_sphere<L, false, classifies, contact>(hull, sphere, in_box);
}

// Not inlined, so that their registers are not saved for other shafts.

template <class L>
SHAFTCULL_NOINLINE bool hull_keeps_box(const HullData& hull, const float* box) noexcept {
  return answer_of_hull_for_box<L, false, Contact::closed>(hull, box) != Answer::outside;
}

template <class L>
SHAFTCULL_NOINLINE bool hull_keeps_sphere(const HullData& hull, const float* sphere) noexcept {
  return answer_of_hull_for_sphere<L, false, Contact::closed>(hull, sphere) != Answer::outside;
}

template <class L, Contact contact>
SHAFTCULL_NOINLINE Answer classify_box_by_hull(const HullData& hull, const float* box) noexcept {
  return answer_of_hull_for_box<L, true, contact>(hull, box);
}

template <class L, Contact contact>
SHAFTCULL_NOINLINE Answer classify_sphere_by_hull(const HullData& hull, const float* sphere) noexcept {
  return answer_of_hull_for_sphere<L, true, contact>(hull, sphere);
}

// The same for shafts of hulls, with any contact.

template <class L>
bool keeps_box_by_hull(const ShaftData& shaft, const float* box) noexcept {
  if (shaft.is_open_hull()) [[unlikely]]
    return classify_box_by_hull<L, Contact::open>(*shaft.hull, box) != Answer::outside;
  return hull_keeps_box<L>(*shaft.hull, box);
}

template <class L>
bool keeps_sphere_by_hull(const ShaftData& shaft, const float* sphere) noexcept {
  if (shaft.is_open_hull()) [[unlikely]]
    return classify_sphere_by_hull<L, Contact::open>(*shaft.hull, sphere) != Answer::outside;
  return hull_keeps_sphere<L>(*shaft.hull, sphere);
}

template <class L>
Answer classify_box_by_hull(const ShaftData& shaft, const float* box) noexcept {
  if (shaft.is_open_hull()) [[unlikely]]
    return classify_box_by_hull<L, Contact::open>(*shaft.hull, box);
  return classify_box_by_hull<L, Contact::closed>(*shaft.hull, box);
}

template <class L>
Answer classify_sphere_by_hull(const ShaftData& shaft, const float* sphere) noexcept {
  if (shaft.is_open_hull()) [[unlikely]]
    return classify_sphere_by_hull<L, Contact::open>(*shaft.hull, sphere);
  return classify_sphere_by_hull<L, Contact::closed>(*shaft.hull, sphere);
}

}  // namespace shaftcull::kernel
