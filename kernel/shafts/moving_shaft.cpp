// SPDX-License-Identifier: MIT
#include "shafts/moving_shaft.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "compiled/moving_faces.hpp"
#include "compiled/slab.hpp"
#include "exact/end_face.hpp"
#include "formation/rule.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "simd/scalar.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {
namespace {

using Kind = ShaftData::Kind;

constexpr float largest_float = std::numeric_limits<float>::max();

/// Writes the slab coefficients of a shaft whose ends are rounded, as the faces' own slopes give them.
SHAFTCULL_COLD void write_slab(ShaftData& shaft, const MovingFaces& faces) noexcept {
  using Lanes = scalar::Floats;
  float slope[6];
  bool is_regular = true;
  for (unsigned f = 0; f < 6; ++f) {
    const double travel = faces.slope(f) * (faces.is_endless() ? 1 : faces.end());
    is_regular = is_regular && std::fabs(travel) <= 2 * double{regular_limit} &&
                 (travel == 0 || std::fabs(travel) >= 1 / double{regular_limit});
    slope[f] = static_cast<float>(std::clamp(travel, -double{largest_float}, double{largest_float}));
  }
  is_regular = is_regular && !faces.is_endless();
  if (is_regular && shaft.largest_coordinate > largest_plain_coordinate) {
    const TravelFromNearer<Lanes> travel(shaft);
    if (travel.from == shaft.a && write_relative_slab<Lanes>(shaft, travel, slope)) return;
  }
  write_difference_slab<Lanes>(shaft, slope);
  if (is_regular) return;
  shaft.slab_form = ShaftData::SlabForm::exact;
  shaft.slab_margin = std::numeric_limits<float>::infinity();
}

/// Writes what moves.
MovingFaces write_movement(const Movement& movement, ShaftData& shaft) noexcept {
  std::memcpy(shaft.a, movement.start, sizeof shaft.a);
  std::memcpy(shaft.motion, movement.motion, sizeof shaft.motion);
  shaft.kind = movement.kind;
  shaft.reach = movement.reach;
  return MovingFaces(shaft);
}

/// Writes a shaft that ends, without planes.
void form_to_end(const Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept {
  const MovingFaces faces = write_movement(movement, shaft);
  EndFaces end(faces);
  for (unsigned f = 0; f < 6; ++f) shaft.face[f] = faces.is_blue(f) ? end.within[f] : movement.start[f];
  for (unsigned k = 0; k < 3; ++k) {  // rounding may swap what is as good as equal
    end.nearest[k + 3] = std::max(end.nearest[k], end.nearest[k + 3]);
  }
  Box from;
  Box to;
  std::memcpy(&from, movement.start, sizeof from);
  std::memcpy(&to, end.nearest, sizeof to);
  static_cast<void>(kernels.compile_pair(from, to, shaft));  // both are finite
  shaft.kind = movement.kind;
  if (shaft.slab_form == ShaftData::SlabForm::fused) {
    shaft.slab_margin *= rounded_end_factor;
  } else {
    write_slab(shaft, faces);
  }
  shaft.largest_coordinate *= rounded_end_factor;
}

/// Writes a shaft without end, without planes, that has no endless slab form.
void form_endless(const Movement& movement, ShaftData& shaft) noexcept {
  std::memcpy(&shaft.joining_count, &batch_flags, sizeof batch_flags);
  const MovingFaces faces = write_movement(movement, shaft);
  const Lanes8& start = movement.start;
  const bool is_shadow = movement.kind == Kind::shadow_without_end;
  double slope[8];
  for (unsigned f = 0; f < 8; ++f) {
    slope[f] = is_shadow ? double{start[f]} - double{movement.motion[f]} : double{movement.motion[f]};
  }
  double speed = 0;
  double largest = 0;
  for (unsigned f = 0; f < 6; ++f) {
    speed = std::max(speed, std::fabs(slope[f]));
    largest = std::max(largest, std::fabs(double{start[f]}));
  }
  const double t = (largest == 0 ? speed : endless_followed * largest) / speed;
  Lanes8 end;
  for (unsigned f = 0; f < 8; ++f) end[f] = static_cast<float>(start[f] + t * slope[f]);
  float largest_end = 0;
  for (unsigned f = 0; f < 6; ++f) {
    if (f >= 3) end[f] = std::max(end[f - 3], end[f]);  // rounding may swap what is as good as equal
    largest_end = std::max(largest_end, std::fabs(end[f]));
    const float edge = f < 3 ? -largest_float : largest_float;
    shaft.face[f] = (f < 3 ? slope[f] < 0 : slope[f] > 0) ? edge : start[f];
  }
  if (largest_end > largest_float) {
    largest_end = largest_float;
    for (float& face : end) face = std::clamp(face, -largest_float, largest_float);
  }
  std::memcpy(shaft.b, end, sizeof shaft.b);
  shaft.largest_coordinate = std::max(static_cast<float>(largest), largest_end);
  write_slab(shaft, faces);
  shaft.largest_coordinate *= rounded_end_factor;
}

}  // namespace

void form(const Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept {
  if (movement.kind == Kind::swept_infinite || movement.kind == Kind::shadow_without_end) {
    form_endless(movement, shaft);
  } else {
    form_to_end(kernels, movement, shaft);
  }
}

}  // namespace shaftcull::kernel
