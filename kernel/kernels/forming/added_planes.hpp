// SPDX-License-Identifier: MIT
/// Added planes of a batch of shafts: margins and selectors of a vector of planes at a time. docs/exactness.md derives
/// the margins.
///
/// Everything is computed in floats, with a slack that pays for it many times over, so that a plane added alone has the
/// bits of one added in a batch.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "compiled/shaft_data.hpp"
#include "kernels/forming/slab_constraints.hpp"

namespace shaftcull::kernel {

inline constexpr float added_margin_per_term = 6 * float_unit * margin_slack;
inline constexpr float added_slack_per_length = 12 * float_unit * margin_slack;
inline constexpr float added_denormals = 0x1p-140F;  // what underflow may take away, and more

/// Normals whose largest component is within these limits have a length that neither over- nor underflows. Others get a
/// margin that leaves every bound to the exact predicates, and so do planes whose margin is above the last limit.
inline constexpr float smallest_added_normal = 0x1p-60F;
inline constexpr float largest_added_normal = 0x1p60F;
inline constexpr float largest_added_margin = 0x1p100F;

// Rows of eight floats are written onto records.
static_assert(sizeof(ShaftData::AddedPlane) == 8 * sizeof(float));
static_assert(offsetof(ShaftData::AddedPlane, near) == 7 * sizeof(float));
static_assert(sizeof(Plane) == 4 * sizeof(float) && offsetof(Plane, offset) == 3 * sizeof(float));

/// The normals and the offset of a whole vector of planes.
template <class L>
void load_planes(const Plane* const (&plane)[L::width], typename L::Vector (&column)[4]) noexcept {
  const void* row[L::width];
  for (unsigned lane = 0; lane < L::width; ++lane) row[lane] = plane[lane];
  L::load_columns(row, column);
}

/// Writes plane[i] as added plane `slot` of out[i], for the first `lanes` of a whole vector of shafts whose boxes have
/// faces `face`.
template <class L>
void add_plane_vector(const typename L::Vector (&face)[6], const Plane* const (&plane)[L::width], unsigned lanes,
                      unsigned slot, ShaftData* out) noexcept {
  using Vector = typename L::Vector;
  const Vector zero = L::all(0.0F);
  Vector column[4];
  load_planes<L>(plane, column);
  const Vector offset = column[3];

  Vector most[3];   // of each term of n · p, at the near corner of a bound that meets the shaft box
  Vector sizes[3];  // of each term, at a corner within the shaft box
  Vector length_sum = zero;
  Vector length_square = zero;
  Vector largest = zero;
  for (unsigned k = 0; k < 3; ++k) {
    const Vector at_lo = L::multiply(column[k], face[k]);
    const Vector at_hi = L::multiply(column[k], face[k + 3]);
    most[k] = L::maximum(at_lo, at_hi);
    sizes[k] = L::maximum(L::magnitude(at_lo), L::magnitude(at_hi));
    const Vector size = L::magnitude(column[k]);
    length_sum = L::add(length_sum, size);
    length_square = L::add(length_square, L::multiply(size, size));
    largest = L::maximum(size, largest);
  }
  Vector sum = L::magnitude(offset);
  const Vector excess = L::subtract(offset, L::add(most[0], L::add(most[1], most[2])));
  for (unsigned k = 0; k < 3; ++k) {
    // Below this a term alone decides that the bound is not beyond the plane.
    const Vector decisive = L::add(excess, most[k]);
    sum = L::add(sum, L::maximum(sizes[k], L::magnitude(decisive)));
  }
  const Vector margin = L::add(L::multiply(sum, L::all(added_margin_per_term)), L::all(added_denormals));
  const auto regular = L::both(L::less_equal(margin, L::all(largest_added_margin)),
                               L::both(L::less_equal(L::all(smallest_added_normal), largest),
                                       L::less_equal(largest, L::all(largest_added_normal))));

  // The near corner is the lo one where the normal is positive, else the hi one. A byte for each axis: the integer is
  // added to 2²³ in its low bits.
  constexpr float place[3] = {1.0F, 256.0F, 65536.0F};
  const auto selector = [&](unsigned k, float axis) {
    return L::choose(L::less(zero, column[k]), L::all(axis * place[k]), L::all((axis + 3) * place[k]));
  };
  Vector selectors = L::add(L::all(0x1p23F), L::add(selector(0, 0), L::add(selector(1, 1), selector(2, 2))));
  const auto any_zero = L::less_equal(
      L::minimum(L::magnitude(column[0]), L::minimum(L::magnitude(column[1]), L::magnitude(column[2]))), zero);
  if (L::bits(any_zero) != 0) {
    // A zero component reads a stream that is read anyway: 0 · x of an infinite extent would be NaN otherwise.
    Vector stream = zero;  // of the last axis with a component that is not zero
    for (unsigned k = 0; k < 3; ++k) {
      const auto number = static_cast<float>(k);
      const Vector its = L::choose(L::less(zero, column[k]), L::all(number), L::all(number + 3));
      stream = L::choose(L::less(zero, L::magnitude(column[k])), its, stream);
    }
    selectors = L::all(0x1p23F);
    for (unsigned k = 0; k < 3; ++k) {
      const auto number = static_cast<float>(k);
      const Vector its = L::choose(L::less(zero, column[k]), L::all(number), L::all(number + 3));
      const Vector read = L::choose(L::less(zero, L::magnitude(column[k])), its, stream);
      selectors = L::add(selectors, L::multiply(read, L::all(place[k])));
    }
  }

  const Vector columns[8] = {column[0],
                             column[1],
                             column[2],
                             L::subtract(L::all(-0.0F), offset),
                             L::choose(regular, margin, L::all(INFINITY)),
                             L::square_root(length_square),
                             L::add(L::multiply(length_sum, L::all(added_slack_per_length)), L::all(added_denormals)),
                             selectors};
  typename L::EightFloats::Vector row[L::width];
  L::transpose(columns, row);
  for (unsigned lane = 0; lane < lanes; ++lane) {
    ShaftData::AddedPlane& added = out[lane].added[slot];
    L::EightFloats::store(&added, row[lane]);
    if constexpr (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {  // the low bits are in the last byte
      const std::uint8_t last_first[4] = {added.near[3], added.near[2], added.near[1], added.near[0]};
      std::memcpy(added.near, last_first, sizeof last_first);
    }
  }
}

/// Whether every plane is finite and has a normal that is not zero.
template <class L>
bool all_planes_usable(const Plane* planes, std::size_t count) noexcept {
  const auto most = L::all(FLT_MAX);
  bool usable = true;
  for (std::size_t i = 0; i < count; i += L::width) {
    const Plane* plane[L::width];
    for (unsigned lane = 0; lane < L::width; ++lane) plane[lane] = planes + (i + lane < count ? i + lane : i);
    typename L::Vector column[4];
    load_planes<L>(plane, column);
    auto each = L::less_equal(L::magnitude(column[3]), most);
    auto largest = L::all(0.0F);
    for (unsigned k = 0; k < 3; ++k) {
      const auto size = L::magnitude(column[k]);
      each = L::both(each, L::less_equal(size, most));
      largest = L::maximum(size, largest);
    }
    each = L::both(each, L::less(L::all(0.0F), largest));
    usable = usable && L::bits(each) == (std::uint64_t{1} << L::width) - 1;
  }
  return usable;
}

/// Face `f` of the shaft boxes of a whole vector of pairs, as shaft_face() has it.
template <class L>
typename L::Vector shaft_faces(unsigned f, const float* on_a, const float* on_b) noexcept {
  return f < 3 ? L::minimum(L::load(on_a), L::load(on_b)) : L::maximum(L::load(on_a), L::load(on_b));
}

/// Adds planes[i][0 … planes_each) to shaft out[i] between boxes a[·][i] and b[·][i], after those that it has; all have
/// equally many.
template <class L>
void add_planes(const float* const* a, const float* const* b, const Plane* const* planes, std::size_t planes_each,
                std::size_t count, ShaftData* out) noexcept {
  typename L::Vector face[6];
  const Plane* plane[L::width];
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    for (unsigned f = 0; f < 6; ++f) face[f] = shaft_faces<L>(f, a[f] + i, b[f] + i);
    const unsigned slot = out[i].added_count;
    for (unsigned j = 0; j < planes_each; ++j) {
      for (unsigned lane = 0; lane < L::width; ++lane) plane[lane] = planes[i + lane] + j;
      add_plane_vector<L>(face, plane, L::width, slot + j, out + i);
    }
    for (unsigned lane = 0; lane < L::width; ++lane)
      out[i + lane].added_count = static_cast<std::uint8_t>(slot + planes_each);
  }
  if (i == count) return;
  // The rest, padded with the last shaft.
  const auto lanes = static_cast<unsigned>(count - i);
  const auto source = [&](unsigned lane) { return lane < lanes ? i + lane : count - 1; };
  for (unsigned f = 0; f < 6; ++f) {
    float on_a[L::width];
    float on_b[L::width];
    for (unsigned lane = 0; lane < L::width; ++lane) {
      on_a[lane] = a[f][source(lane)];
      on_b[lane] = b[f][source(lane)];
    }
    face[f] = shaft_faces<L>(f, on_a, on_b);
  }
  const unsigned slot = out[i].added_count;
  for (unsigned j = 0; j < planes_each; ++j) {
    for (unsigned lane = 0; lane < L::width; ++lane) plane[lane] = planes[source(lane)] + j;
    add_plane_vector<L>(face, plane, lanes, slot + j, out + i);
  }
  for (unsigned lane = 0; lane < lanes; ++lane)
    out[i + lane].added_count = static_cast<std::uint8_t>(slot + planes_each);
}

}  // namespace shaftcull::kernel
