// SPDX-License-Identifier: MIT
/// Forms shafts of moving boxes.
#include "shaftcull/volumes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"
#include "compiled/slab.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/end_face.hpp"
#include "formation/rule.hpp"
#include "formation/usable_box.hpp"
#include "formation/usable_plane.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "kernels/kernel_table.hpp"
#include "shafts/batch_arguments.hpp"
#include "shafts/planes_of_one.hpp"
#include "simd/scalar.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::Faces6;
using kernel::MovingFaces;
using kernel::ShaftData;
using Kind = ShaftData::Kind;

constexpr float largest_float = std::numeric_limits<float>::max();

/// Eight lanes, one for each face; the last two are of no face. Loops over all of them become vectors.
using Lanes8 = float[8];

/// Overwrites the slab coefficients of a shaft without end by those of the endless form, if it suits.
///
/// The first constraint is that of the face that moves fastest of those that follow the box. It bounds t from above,
/// wherever the bound is.
bool write_endless_slab(ShaftData& shaft, const Lanes8& start, const Lanes8& slope) noexcept {
  unsigned first = 0;
  float speed = -1;
  for (unsigned f = 0; f < 6; ++f) {
    const float following = f < 3 ? slope[f] : -slope[f];
    const bool is_faster = following > 0 && following > speed;
    first = is_faster ? f : first;
    speed = is_faster ? following : speed;
  }
  constexpr float no_bound = std::numeric_limits<float>::infinity();
  constexpr Lanes8 still = {no_bound, no_bound, no_bound, -no_bound, -no_bound, -no_bound, 1, 1};
  Lanes8 scale;
  int suits = 1;
  for (unsigned f = 0; f < 8; ++f) {
    // A face that does not move bounds t from above, by +∞ (met) or −∞ (not met).
    const float quotient = speed / slope[f];
    scale[f] = slope[f] == 0 ? still[f] : quotient;
    const float travel = std::fabs(slope[f]);
    const float size = std::fabs(quotient);
    // A denormal has fewer bits than the margin supposes: a face that is as much faster than all that follow the box.
    // What the corner of a sphere is rounded by counts for so much of t, and must not overflow.
    const int moves_well = (travel >= 1 / kernel::endless_limit) & (travel <= kernel::endless_limit) &
                           (size <= largest_float) & (size >= kernel::least_endless_scale) &
                           (std::fabs(start[f] * quotient) <= kernel::endless_start_limit);
    suits &= (moves_well | (slope[f] == 0)) & (std::fabs(start[f]) <= kernel::endless_limit);
  }
  if (suits == 0) return false;
  unsigned negative = 0;
  for (unsigned f = 0; f < 6; ++f) negative |= static_cast<unsigned>(scale[f] < 0) << f;
  const kernel::SlabOrder& order = kernel::slab_orders.by_negative[negative];
  std::memcpy(shaft.slab_near, &order.selectors, sizeof order.selectors);
  unsigned at = 0;  // of the first constraint, among those that bound t from above
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order.face[i];
    shaft.slab_scale[i] = scale[f];
    shaft.slab_shift[i] = start[f];
    at = f == first ? i : at;
  }
  std::swap(shaft.slab_scale[0], shaft.slab_scale[at]);
  std::swap(shaft.slab_shift[0], shaft.slab_shift[at]);
  std::swap(shaft.slab_near[0], shaft.slab_near[at]);
  shaft.slab_form = ShaftData::SlabForm::endless;
  shaft.slab_margin = kernel::endless_margin;
  return true;
}

/// Writes the slab coefficients of a shaft whose ends are rounded, as the faces' own slopes give them.
SHAFTCULL_COLD void write_slab(ShaftData& shaft, const MovingFaces& faces) noexcept {
  using Lanes = kernel::scalar::Floats;
  float slope[6];
  bool is_regular = true;
  for (unsigned f = 0; f < 6; ++f) {
    const double travel = faces.slope(f) * (faces.is_endless() ? 1 : faces.end());
    is_regular = is_regular && std::fabs(travel) <= 2 * double{kernel::regular_limit} &&
                 (travel == 0 || std::fabs(travel) >= 1 / double{kernel::regular_limit});
    slope[f] = static_cast<float>(std::clamp(travel, -double{largest_float}, double{largest_float}));
  }
  is_regular = is_regular && !faces.is_endless();
  if (is_regular && shaft.largest_coordinate > kernel::largest_plain_coordinate) {
    const kernel::TravelFromNearer<Lanes> travel(shaft);
    if (travel.from == shaft.a && kernel::write_relative_slab<Lanes>(shaft, travel, slope)) return;
  }
  kernel::write_difference_slab<Lanes>(shaft, slope);
  if (is_regular) return;
  shaft.slab_form = ShaftData::SlabForm::exact;
  shaft.slab_margin = std::numeric_limits<float>::infinity();
}

/// What moves, as ShaftData has it.
struct Movement {
  Kind kind;
  Lanes8 start = {};
  Lanes8 motion = {};
  float reach = 1;

  Movement(Kind of, const Box& from, const Vec3& first, const Vec3& second) noexcept : kind(of) {
    std::memcpy(start, &from, sizeof from);
    std::memcpy(motion, &first, sizeof first);
    std::memcpy(motion + 3, &second, sizeof second);
  }
};

/// Writes what moves.
MovingFaces write_movement(const Movement& movement, ShaftData& shaft) noexcept {
  std::memcpy(shaft.a, movement.start, sizeof shaft.a);
  std::memcpy(shaft.motion, movement.motion, sizeof shaft.motion);
  shaft.kind = movement.kind;
  shaft.reach = movement.reach;
  return MovingFaces(shaft);
}

/// Writes a shaft that ends, without planes.
void form_to_end(const kernel::Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept {
  const MovingFaces faces = write_movement(movement, shaft);
  Lanes8 end;
  // Takes where faces end from numbers of all of them.
  const auto take = [&](const auto& ends) {
    std::memcpy(end, ends.nearest, sizeof end);
    for (unsigned f = 0; f < 6; ++f) shaft.face[f] = faces.is_blue(f) ? ends.within[f] : movement.start[f];
    for (unsigned k = 0; k < 3; ++k)
      end[k + 3] = std::max(end[k], end[k + 3]);  // rounding may swap what is as good as equal
  };
  if (movement.kind == Kind::swept) {
    const kernel::DisplacedFaces displaced(movement.start, movement.motion);
    displaced.are_finite ? take(displaced) : take(kernel::EndFaces(faces));
  } else {
    take(kernel::EndFaces(faces));
  }
  Box from;
  Box to;
  std::memcpy(&from, movement.start, sizeof from);
  std::memcpy(&to, end, sizeof to);
  static_cast<void>(kernels.compile_pair(from, to, shaft));  // both are finite
  shaft.kind = movement.kind;
  if (shaft.slab_form == ShaftData::SlabForm::fused) {
    shaft.slab_margin *= kernel::rounded_end_factor;
  } else {
    write_slab(shaft, faces);
  }
  shaft.largest_coordinate *= kernel::rounded_end_factor;
}

/// Writes a shaft without end, without planes.
void form_endless(const Movement& movement, ShaftData& shaft) noexcept {
  std::memcpy(&shaft.joining_count, &kernel::batch_flags, sizeof kernel::batch_flags);
  const MovingFaces faces = write_movement(movement, shaft);
  const Lanes8& start = movement.start;
  const bool is_shadow = movement.kind == Kind::shadow_without_end;
  double slope[8];
  Lanes8 rounded_slope;
  for (unsigned f = 0; f < 8; ++f) {
    slope[f] = is_shadow ? double{start[f]} - double{movement.motion[f]} : double{movement.motion[f]};
    rounded_slope[f] = static_cast<float>(slope[f]);  // infinite ones have no endless form
  }
  double speed = 0;
  double largest = 0;
  for (unsigned f = 0; f < 6; ++f) {
    speed = std::max(speed, std::fabs(slope[f]));
    largest = std::max(largest, std::fabs(double{start[f]}));
  }
  const double t = (largest == 0 ? speed : kernel::endless_followed * largest) / speed;
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
  if (!write_endless_slab(shaft, start, rounded_slope)) write_slab(shaft, faces);
  shaft.largest_coordinate *= kernel::rounded_end_factor;
}

/// Writes a shaft, without planes.
void form(const kernel::Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept {
  if (movement.kind == Kind::swept_infinite || movement.kind == Kind::shadow_without_end) {
    form_endless(movement, shaft);
  } else {
    form_to_end(kernels, movement, shaft);
  }
}

[[noreturn]] void refuse_vector(const Vec3& vector, const char* name) {
  const auto k = static_cast<std::size_t>(
      std::find_if(vector.begin(), vector.end(), [](float x) { return !std::isfinite(x); }) - vector.begin());
  kernel::fail(
      InvalidArgument(std::string(name) + "." + "xyz"[k] + " = " + kernel::text(vector[k]) + " is not finite"));
}

void require_vector(const Vec3& vector, const char* name) {
  const auto is_finite = [](float x) { return std::fabs(x) <= largest_float; };
  if (!(is_finite(vector[0]) && is_finite(vector[1]) && is_finite(vector[2]))) [[unlikely]]
    refuse_vector(vector, name);
}

void require_apart(const Box& light, const Box& occluder) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (light.hi[k] < occluder.lo[k] || occluder.hi[k] < light.lo[k]) return;
  }
  kernel::fail(InvalidArgument(
      "shadow: light and occluder overlap or touch, and all of space is in the shadow; they must be apart on some "
      "axis"));
}

/// The movement of each kind, or the InvalidArgument that its call throws.
Movement swept_movement(const Box& body, const Vec3& displacement) {
  kernel::require_finite(body, "body");
  require_vector(displacement, "displacement");
  return {Kind::swept, body, displacement, displacement};
}

Movement endless_movement(const Box& body, const Vec3& direction) {
  kernel::require_finite(body, "body");
  require_vector(direction, "direction");
  if (direction == Vec3{0, 0, 0}) kernel::fail(InvalidArgument("swept_infinite: direction is 0, which leads nowhere"));
  return {Kind::swept_infinite, body, direction, direction};
}

Movement shadow_movement(const Box& light, const Box& occluder) {
  kernel::require_finite(light, "light");
  kernel::require_finite(occluder, "occluder");
  require_apart(light, occluder);
  // Each corner of the light is opposite to the occluder's corner that moves away from it.
  return {Kind::shadow_without_end, occluder, light.hi, light.lo};
}

void require_reach(float reach) {
  if (reach >= 1 && reach <= largest_float) return;
  kernel::fail(InvalidArgument("shadow: reach = " + kernel::text(reach) + "; it must be finite, and 1 or more"));
}

Movement shadow_movement(const Box& light, const Box& occluder, float reach) {
  Movement movement = shadow_movement(light, occluder);
  require_reach(reach);
  movement.kind = Kind::shadow;
  movement.reach = reach;
  return movement;
}

/// Forms one shaft of any kind, or throws.
template <class MovementOf>
SHAFTCULL_NOINLINE void form_any(std::span<const Plane> planes, const MovementOf& movement_of, ShaftData& shaft) {
  const Movement movement = movement_of();
  if (!planes.empty()) kernel::require_planes(planes);
  const kernel::Kernels& kernels = kernel::active_kernels();
  form(kernels, movement, shaft);
  if (!planes.empty()) kernel::add_planes(kernels, planes, shaft.face, shaft);
}

/// A call for one shaft. `quickly` forms it in registers, without planes, unless it returns false.
template <class Quickly, class MovementOf>
CompiledShaft one(std::span<const Plane> planes, const Quickly& quickly, const MovementOf& movement_of) {
  CompiledShaft formed;
  ShaftData& shaft = kernel::data_of(formed);
  const kernel::FloatEnvironment environment;  // all in it is behind calls
  if (!planes.empty() || !quickly(kernel::active_kernels(), shaft)) form_any(planes, movement_of, shaft);
  return formed;
}

/// A call for many: movement_of(i) is that of shaft i, which has planes of box a_of(i) and of box b_of(i).
template <class MovementOf, class PositionA, class PositionB>
void many(std::span<CompiledShaft> out, const kernel::PlanesOfPairs& planes, const kernel::Kernels& kernels,
          const MovementOf& movement_of, const PositionA& a_of, const PositionB& b_of) {
  for (std::size_t i = 0; i != out.size(); ++i) {
    kernel::check_shaft(i, [&] { static_cast<void>(movement_of(i)); });
  }
  for (std::size_t i = 0; i != out.size(); ++i) {
    ShaftData& shaft = kernel::data_of(out[i]);
    form(kernels, movement_of(i), shaft);
    kernel::add_planes(kernels, {planes.a.of(planes.a.each() == 0 ? 0 : a_of(i)), planes.a.each()}, shaft.face, shaft);
    kernel::add_planes(kernels, {planes.b.of(planes.b.each() == 0 ? 0 : b_of(i)), planes.b.each()}, shaft.face, shaft);
  }
}

void require_counts(const char* call, const char* what, std::size_t a, std::size_t b, std::size_t out) {
  if (a == out && b == out) return;
  kernel::fail(InvalidArgument(std::string(call) + " needs as many " + what + " and shafts to write, not " +
                               std::to_string(a) + ", " + std::to_string(b) + " and " + std::to_string(out)));
}

/// swept_batch() and swept_infinite_batch().
template <class MovementOf>
void sweep_many(const char* call, const BoxView& bodies, std::span<const Vec3> ways, std::span<CompiledShaft> out,
                std::span<const Plane> planes, const MovementOf& movement_of) {
  require_counts(call, "bodies, vectors", bodies.count, ways.size(), out.size());
  kernel::require_view(bodies);
  kernel::require_memory("vectors", ways, "vectors");
  kernel::require_memory("out", out, "shafts");
  kernel::require_memory("planes", planes, "planes");
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  const kernel::PlanesOfPairs added(kernels, {.a = planes}, bodies.count, 0);
  const auto position = [](std::size_t i) { return i; };
  many(
      out, added, kernels, [&](std::size_t i) { return movement_of(bodies[i], ways[i]); }, position, position);
}

/// shadow_batch(), with a reach unless it is null.
template <class PositionA, class PositionB>
void shadow_many(const BoxView& lights, const BoxView& occluders, const float* reach, std::span<CompiledShaft> out,
                 const BatchPlanes& planes, const PositionA& light_of, const PositionB& occluder_of) {
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  if (reach != nullptr) require_reach(*reach);
  const kernel::PlanesOfPairs added(kernels, planes, lights.count, occluders.count);
  many(
      out, added, kernels,
      [&](std::size_t i) {
        const Box light = lights[light_of(i)];
        const Box occluder = occluders[occluder_of(i)];
        return reach == nullptr ? shadow_movement(light, occluder) : shadow_movement(light, occluder, *reach);
      },
      light_of, occluder_of);
}

void require_shadow_memory(const BoxView& lights, const BoxView& occluders, std::span<CompiledShaft> out,
                           const BatchPlanes& planes) {
  kernel::require_view(lights);
  kernel::require_view(occluders);
  kernel::require_memory("out", out, "shafts");
  kernel::require_memory("planes.a", planes.a, "planes");
  kernel::require_memory("planes.b", planes.b, "planes");
}

void shadow_each(const BoxView& lights, const BoxView& occluders, const float* reach, std::span<CompiledShaft> out,
                 const BatchPlanes& planes) {
  require_counts("shadow_batch", "lights, occluders", lights.count, occluders.count, out.size());
  require_shadow_memory(lights, occluders, out, planes);
  const auto position = [](std::size_t i) { return i; };
  shadow_many(lights, occluders, reach, out, planes, position, position);
}

void shadow_pairs(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs, const float* reach,
                  std::span<CompiledShaft> out, const BatchPlanes& planes) {
  if (pairs.size() != out.size()) {
    kernel::fail(InvalidArgument("shadow_batch needs as many pairs as shafts to write, not " +
                                 std::to_string(pairs.size()) + " and " + std::to_string(out.size())));
  }
  require_shadow_memory(lights, occluders, out, planes);
  kernel::require_memory("pairs", pairs, "pairs");
  kernel::require_indices(pairs, lights.count, occluders.count);
  shadow_many(
      lights, occluders, reach, out, planes, [&](std::size_t i) { return std::size_t{pairs[i].a}; },
      [&](std::size_t i) { return std::size_t{pairs[i].b}; });
}

}  // namespace

CompiledShaft swept(const Box& body, const Vec3& displacement, std::span<const Plane> planes) {
  return one(
      planes,
      [&](const kernel::Kernels& kernels, ShaftData& shaft) {
        return kernels.compile_swept(&body, displacement.data(), shaft);
      },
      [&] { return swept_movement(body, displacement); });
}

CompiledShaft swept_infinite(const Box& body, const Vec3& direction, std::span<const Plane> planes) {
  return one(
      planes,
      [&](const kernel::Kernels& kernels, ShaftData& shaft) {
        return kernels.compile_swept_infinite(&body, direction.data(), shaft);
      },
      [&] { return endless_movement(body, direction); });
}

CompiledShaft shadow(const Box& light, const Box& occluder, std::span<const Plane> planes) {
  return one(
      planes,
      [&](const kernel::Kernels& kernels, ShaftData& shaft) {
        return kernels.compile_endless_shadow(&light, &occluder, shaft);
      },
      [&] { return shadow_movement(light, occluder); });
}

CompiledShaft shadow(const Box& light, const Box& occluder, float reach, std::span<const Plane> planes) {
  const auto never = [](const kernel::Kernels&, ShaftData&) { return false; };
  return one(planes, never, [&] { return shadow_movement(light, occluder, reach); });
}

void swept_batch(const BoxView& bodies, std::span<const Vec3> displacements, std::span<CompiledShaft> out,
                 std::span<const Plane> planes) {
  sweep_many("swept_batch", bodies, displacements, out, planes, swept_movement);
}

void swept_infinite_batch(const BoxView& bodies, std::span<const Vec3> directions, std::span<CompiledShaft> out,
                          std::span<const Plane> planes) {
  sweep_many("swept_infinite_batch", bodies, directions, out, planes, endless_movement);
}

void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<CompiledShaft> out,
                  const BatchPlanes& planes) {
  shadow_each(lights, occluders, nullptr, out, planes);
}

void shadow_batch(const BoxView& lights, const BoxView& occluders, float reach, std::span<CompiledShaft> out,
                  const BatchPlanes& planes) {
  shadow_each(lights, occluders, &reach, out, planes);
}

void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs,
                  std::span<CompiledShaft> out, const BatchPlanes& planes) {
  shadow_pairs(lights, occluders, pairs, nullptr, out, planes);
}

void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs, float reach,
                  std::span<CompiledShaft> out, const BatchPlanes& planes) {
  shadow_pairs(lights, occluders, pairs, &reach, out, planes);
}

}  // namespace shaftcull
