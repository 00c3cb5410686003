// SPDX-License-Identifier: MIT
#include "exact/entry_time.hpp"

#include <cmath>
#include <limits>

#include "compiled/slab.hpp"
#include "exact/edge.hpp"
#include "exact/expansion.hpp"

namespace shaftcull::kernel {

EntryTimes::EntryTimes(const ShaftData& shaft) noexcept : moving_(shaft) {
  for (unsigned f = 0; f < 6; ++f) {
    if (moving_.is_blue(f)) face_[faces_++] = {f, near_stream[f], moving_.p[f], 1 / moving_.slope(f)};
  }
}

EntryTimes::Time EntryTimes::exact(const float* const* stream, std::size_t i) const noexcept {
  Time latest = zero;
  for (unsigned n = 0; n < faces_; ++n) {
    const Face& face = face_[n];
    const float x = stream[face.near][i];
    if (!std::isfinite(x)) continue;
    const Time time{(x - face.p) * face.inverse, face.face, x};
    if (time.value <= 0) continue;  // its sign is exact
    if (compare(time, latest) > 0) latest = time;
  }
  return latest;
}

int EntryTimes::compare(const Time& one, const Time& other) const noexcept {
  const double surely = 1 - entry_margin;
  if (one.value < other.value * surely) return -1;
  if (one.value * surely > other.value) return 1;
  if (one.is_zero() || other.is_zero()) return one.face == other.face ? 0 : one.is_zero() ? -1 : 1;
  if (one.face == other.face && one.x == other.x) return 0;
  // The side is that of the second time beyond the first.
  return -Edge(moving_, one.face, other.face).side(one.x, other.x);
}

Vec3 EntryTimes::normal(const Time& time, const float* const* stream, std::size_t i) const noexcept {
  unsigned last = no_face;
  for (unsigned n = 0; n < faces_; ++n) {
    const Face& face = face_[n];
    const float x = stream[face.near][i];
    if (!std::isfinite(x) || (last != no_face && last % 3 <= face.face % 3)) continue;
    const Time reached{(x - face.p) * face.inverse, face.face, x};
    const bool is_last = time.is_zero() ? reached.value == 0 : compare(reached, time) == 0;
    if (is_last) last = face.face;
  }
  Vec3 normal{};
  if (last != no_face) normal[last % 3] = last < 3 ? 1.0F : -1.0F;
  return normal;
}

float EntryTimes::rounded_down(const Time& time) const noexcept {
  if (time.is_zero()) return 0;
  const unsigned f = time.face;
  const auto is_after = [&](float t) {  // t > time: t · q > x − p, if q is positive
    const double surely = 1 - entry_margin;
    if (t * surely > time.value) return true;
    if (t < time.value * surely) return false;
    const auto moved = Expansion<2>::difference(moving_.minuend[f], moving_.subtrahend[f]) * static_cast<double>(t);
    const int sign = (moved - Expansion<2>::difference(time.x, moving_.p[f])).sign();
    return (moving_.slope(f) > 0 ? sign : -sign) > 0;
  };
  constexpr float most = std::numeric_limits<float>::max();  // boxes that move without end reach some far later
  if (!is_after(most)) return most;
  auto down = static_cast<float>(time.value < most ? time.value : most);
  while (is_after(down)) down = std::nextafter(down, 0.0F);
  for (float next = std::nextafter(down, most); !is_after(next); next = std::nextafter(next, most)) down = next;
  return down;
}

}  // namespace shaftcull::kernel
