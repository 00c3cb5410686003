// SPDX-License-Identifier: MIT
/// Forms shafts of moving boxes.
#include "shaftcull/volumes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// How far a box that moves without end is followed for certain acceptances of spheres: so many times its largest
/// coordinate.
constexpr double followed = 16;

/// Overwrites the slab coefficients of a shaft without end by those of the endless form, if it suits.
///
/// The first constraint is that of the face that moves fastest of those that follow the box. It bounds t from above,
/// wherever the bound is.
bool write_endless_slab(ShaftData& shaft, const float (&slope)[6]) noexcept {
  unsigned first = 6;
  for (unsigned f = 0; f < 6; ++f) {
    const float size = std::fabs(slope[f]);
    if (std::fabs(shaft.a[f]) > kernel::endless_limit || size > kernel::endless_limit) return false;
    if (size != 0 && size < 1 / kernel::endless_limit) return false;
    const bool follows = f < 3 ? slope[f] > 0 : slope[f] < 0;
    if (follows && (first == 6 || size > std::fabs(slope[first]))) first = f;
  }
  const float speed = std::fabs(slope[first]);
  constexpr float no_bound = std::numeric_limits<float>::infinity();
  float scale[6];
  for (unsigned f = 0; f < 6; ++f) {
    // A face that does not move bounds t from above, by +∞ (met) or −∞ (not met).
    scale[f] = slope[f] == 0 ? (f < 3 ? no_bound : -no_bound) : speed / slope[f];
    if (slope[f] != 0 && !(std::fabs(scale[f]) <= largest_float)) return false;
    // A denormal has fewer bits than the margin supposes: a face that is as much faster than all that follow the box.
    if (slope[f] != 0 && !(std::fabs(scale[f]) >= kernel::least_endless_scale)) return false;
    // What the corner of a sphere is rounded by counts for so much of t, and must not overflow.
    if (slope[f] != 0 && !(std::fabs(shaft.a[f] * scale[f]) <= kernel::endless_start_limit)) return false;
  }
  unsigned next = 0;
  const auto write = [&](unsigned f) {
    shaft.slab_scale[next] = scale[f];
    shaft.slab_shift[next] = shaft.a[f];
    shaft.slab_near[next++] = kernel::near_stream[f];
  };
  const auto bounds_from_above = [&](unsigned f) { return (scale[f] > 0) == (f < 3); };
  write(first);
  for (unsigned f = 0; f < 6; ++f) {
    if (f != first && bounds_from_above(f)) write(f);
  }
  shaft.slab_uppers = static_cast<std::uint8_t>(next);
  for (unsigned f = 0; f < 6; ++f) {
    if (!bounds_from_above(f)) write(f);
  }
  shaft.slab_form = ShaftData::SlabForm::endless;
  shaft.slab_margin = kernel::endless_margin;
  return true;
}

/// Overwrites the slab coefficients of a shaft whose ends are rounded by those that the faces' own slopes give.
void write_slab(ShaftData& shaft, const MovingFaces& faces) noexcept {
  using Lanes = kernel::scalar::Floats;
  float slope[6];
  bool is_regular = true;
  for (unsigned f = 0; f < 6; ++f) {
    const double travel = faces.slope(f) * (faces.is_endless() ? 1 : faces.end());
    is_regular = is_regular && std::fabs(travel) <= 2 * double{kernel::regular_limit} &&
                 (travel == 0 || std::fabs(travel) >= 1 / double{kernel::regular_limit});
    slope[f] = static_cast<float>(std::clamp(travel, -double{largest_float}, double{largest_float}));
  }
  if (faces.is_endless()) {
    if (write_endless_slab(shaft, slope)) return;
    is_regular = false;
  } else if (is_regular && shaft.largest_coordinate > kernel::largest_plain_coordinate) {
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
  Box start;
  Faces6 motion;
  float reach;
};

/// Writes the shaft, without planes.
void form(const kernel::Kernels& kernels, const Movement& movement, ShaftData& shaft) noexcept {
  const auto write_movement = [&] {
    shaft.kind = movement.kind;
    std::copy(movement.motion.begin(), movement.motion.end(), shaft.motion);
    shaft.reach = movement.reach;
  };
  write_movement();
  const Faces6 start = kernel::positions(movement.start);
  std::copy(start.begin(), start.end(), shaft.a);
  const MovingFaces faces(shaft);

  Faces6 end;
  if (faces.is_endless()) {
    double speed = 0;
    double largest = 0;
    for (unsigned f = 0; f < 6; ++f) {
      speed = std::max(speed, std::fabs(faces.slope(f)));
      largest = std::max(largest, std::fabs(double{start[f]}));
    }
    const double t = (largest == 0 ? speed : followed * largest) / speed;
    for (unsigned f = 0; f < 6; ++f) {
      const double x = start[f] + t * faces.slope(f);
      end[f] = static_cast<float>(std::clamp(x, -double{largest_float}, double{largest_float}));
      shaft.face[f] = !faces.is_blue(f) ? start[f] : f < 3 ? -largest_float : largest_float;
    }
  } else {
    for (unsigned f = 0; f < 6; ++f) {
      const kernel::EndFace face = kernel::end_face(faces, f);
      end[f] = face.nearest;
      shaft.face[f] = faces.is_blue(f) ? face.within : start[f];
    }
  }
  for (unsigned k = 0; k < 3; ++k)
    end[k + 3] = std::max(end[k], end[k + 3]);  // rounding may swap what is as good as equal
  static_cast<void>(kernels.compile_pair(movement.start, std::bit_cast<Box>(end), shaft));  // both are finite
  write_movement();
  if (shaft.slab_form == ShaftData::SlabForm::fused && !faces.is_endless()) {
    shaft.slab_margin *= kernel::rounded_end_factor;
  } else {
    write_slab(shaft, faces);
  }
  shaft.largest_coordinate *= kernel::rounded_end_factor;
}

CompiledShaft form(const Movement& movement, std::span<const Plane> planes) noexcept {
  CompiledShaft formed;
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  kernel::ShaftData& shaft = kernel::data_of(formed);
  form(kernels, movement, shaft);
  kernel::add_planes(kernels, planes, shaft.face, shaft);
  return formed;
}

void require_vector(const Vec3& vector, const char* name) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (std::isfinite(vector[k])) continue;
    kernel::fail(
        InvalidArgument(std::string(name) + "." + "xyz"[k] + " = " + kernel::text(vector[k]) + " is not finite"));
  }
}

Faces6 twice(const Vec3& vector) noexcept { return {vector[0], vector[1], vector[2], vector[0], vector[1], vector[2]}; }

void require_apart(const Box& light, const Box& occluder) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (light.hi[k] < occluder.lo[k] || occluder.hi[k] < light.lo[k]) return;
  }
  kernel::fail(InvalidArgument(
      "shadow: light and occluder overlap or touch, and all of space is in the shadow; they must be apart on some "
      "axis"));
}

/// The light's corners, each opposite to the occluder's corner that moves away from it.
Faces6 inverted(const Box& light) noexcept {
  return {light.hi[0], light.hi[1], light.hi[2], light.lo[0], light.lo[1], light.lo[2]};
}

/// The movement of each kind, or the InvalidArgument that its call throws.
Movement swept_movement(const Box& body, const Vec3& displacement) {
  kernel::require_finite(body, "body");
  require_vector(displacement, "displacement");
  return {Kind::swept, body, twice(displacement), 1};
}

Movement endless_movement(const Box& body, const Vec3& direction) {
  kernel::require_finite(body, "body");
  require_vector(direction, "direction");
  if (direction == Vec3{0, 0, 0}) kernel::fail(InvalidArgument("swept_infinite: direction is 0, which leads nowhere"));
  return {Kind::swept_infinite, body, twice(direction), 1};
}

Movement shadow_movement(const Box& light, const Box& occluder) {
  kernel::require_finite(light, "light");
  kernel::require_finite(occluder, "occluder");
  require_apart(light, occluder);
  return {Kind::shadow_without_end, occluder, inverted(light), 1};
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

/// A call for one shaft.
template <class MovementOf>
CompiledShaft one(std::span<const Plane> planes, const MovementOf& movement_of) {
  const Movement movement = kernel::in_float_environment([&] {
    const Movement checked = movement_of();
    kernel::require_planes(planes);
    return checked;
  });
  return form(movement, planes);
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
  return one(planes, [&] { return swept_movement(body, displacement); });
}

CompiledShaft swept_infinite(const Box& body, const Vec3& direction, std::span<const Plane> planes) {
  return one(planes, [&] { return endless_movement(body, direction); });
}

CompiledShaft shadow(const Box& light, const Box& occluder, std::span<const Plane> planes) {
  return one(planes, [&] { return shadow_movement(light, occluder); });
}

CompiledShaft shadow(const Box& light, const Box& occluder, float reach, std::span<const Plane> planes) {
  return one(planes, [&] { return shadow_movement(light, occluder, reach); });
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
