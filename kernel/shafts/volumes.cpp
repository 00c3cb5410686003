// SPDX-License-Identifier: MIT
/// Calls that form shafts of moving boxes.
#include "shaftcull/volumes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "compiled/shaft_data.hpp"
#include "dispatch/active_kernels.hpp"
#include "formation/usable_box.hpp"
#include "kernels/kernel_table.hpp"
#include "shafts/batch_arguments.hpp"
#include "shafts/moving_shaft.hpp"
#include "shafts/planes_of_one.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::Movement;
using kernel::ShaftData;
using Kind = ShaftData::Kind;

constexpr float largest_float = std::numeric_limits<float>::max();

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

void require_reach(float reach) {
  if (reach >= 1 && reach <= largest_float) return;
  kernel::fail(InvalidArgument("shadow: reach = " + kernel::text(reach) + "; it must be finite, and 1 or more"));
}

// What each call forms. require() throws what the call throws. quickly() forms it in registers, unless it returns
// false.

struct Swept {
  Box body;
  Vec3 displacement;

  void require() const {
    kernel::require_finite(body, "body");
    require_vector(displacement, "displacement");
  }
  bool quickly(const kernel::Kernels& kernels, ShaftData& shaft) const noexcept {
    return kernels.compile_swept(&body, displacement.data(), shaft);
  }
  [[nodiscard]] Movement movement() const noexcept { return {Kind::swept, body, displacement, displacement}; }
};

struct SweptWithoutEnd {
  Box body;
  Vec3 direction;

  void require() const {
    kernel::require_finite(body, "body");
    require_vector(direction, "direction");
    if (direction == Vec3{0, 0, 0}) {
      kernel::fail(InvalidArgument("swept_infinite: direction is 0, which leads nowhere"));
    }
  }
  bool quickly(const kernel::Kernels& kernels, ShaftData& shaft) const noexcept {
    return kernels.compile_swept_infinite(&body, direction.data(), shaft);
  }
  [[nodiscard]] Movement movement() const noexcept { return {Kind::swept_infinite, body, direction, direction}; }
};

struct ShadowWithoutEnd {
  Box light;
  Box occluder;

  void require() const {
    kernel::require_finite(light, "light");
    kernel::require_finite(occluder, "occluder");
    require_apart(light, occluder);
  }
  bool quickly(const kernel::Kernels& kernels, ShaftData& shaft) const noexcept {
    return kernels.compile_endless_shadow(&light, &occluder, shaft);
  }
  /// Each corner of the light is opposite to the occluder's corner that moves away from it.
  [[nodiscard]] Movement movement() const noexcept { return {Kind::shadow_without_end, occluder, light.hi, light.lo}; }
};

struct Shadow {
  ShadowWithoutEnd endless;
  float reach;

  void require() const {
    endless.require();
    require_reach(reach);
  }
  static bool quickly(const kernel::Kernels& /*kernels*/, ShaftData& /*shaft*/) noexcept { return false; }
  [[nodiscard]] Movement movement() const noexcept {
    Movement movement = endless.movement();
    movement.kind = Kind::shadow;
    movement.reach = reach;
    return movement;
  }
};

/// Forms one shaft of any kind unless it is formed, and adds planes. Throws what the call throws.
template <class Volume>
SHAFTCULL_NOINLINE void complete_any(std::span<const Plane> planes, const Volume& volume, bool is_formed,
                                     ShaftData& shaft) {
  volume.require();
  if (!planes.empty()) kernel::require_planes(planes);
  const kernel::Kernels& kernels = kernel::active_kernels();
  if (!is_formed) form(kernels, volume.movement(), shaft);
  if (!planes.empty()) kernel::add_planes(kernels, planes, shaft.face, shaft);
}

/// A call for one shaft.
template <class Volume>
CompiledShaft one(std::span<const Plane> planes, const Volume& volume) {
  CompiledShaft formed;
  ShaftData& shaft = kernel::data_of(formed);
  const kernel::FloatEnvironment environment;  // all in it is behind calls
  const bool is_formed = volume.quickly(kernel::active_kernels(), shaft);
  if (!is_formed || !planes.empty()) complete_any(planes, volume, is_formed, shaft);
  return formed;
}

/// A call for many: shaft i is of volume_of(i), and has planes of box a_of(i) and of box b_of(i).
template <class VolumeOf, class PositionA, class PositionB>
void many(std::span<CompiledShaft> out, const kernel::PlanesOfPairs& planes, const kernel::Kernels& kernels,
          const VolumeOf& volume_of, const PositionA& a_of, const PositionB& b_of) {
  using Volume = decltype(volume_of(0));
  // Some are read before the first of them is formed, since boxes that were just put together float by float wait to be
  // read as vectors.
  constexpr std::size_t some = 16;
  Volume volumes[some];
  const auto each = [&](const auto& work) {
    for (std::size_t begin = 0; begin < out.size(); begin += some) {
      const std::size_t count = std::min(some, out.size() - begin);
      for (std::size_t i = 0; i != count; ++i) volumes[i] = volume_of(begin + i);
      for (std::size_t i = 0; i != count; ++i) work(begin + i, volumes[i]);
    }
  };
  each([&](std::size_t i, const Volume& volume) { kernel::check_shaft(i, [&] { volume.require(); }); });
  each([&](std::size_t i, const Volume& volume) {
    ShaftData& shaft = kernel::data_of(out[i]);
    if (!volume.quickly(kernels, shaft)) form(kernels, volume.movement(), shaft);
    kernel::add_planes(kernels, {planes.a.of(planes.a.each() == 0 ? 0 : a_of(i)), planes.a.each()}, shaft.face, shaft);
    kernel::add_planes(kernels, {planes.b.of(planes.b.each() == 0 ? 0 : b_of(i)), planes.b.each()}, shaft.face, shaft);
  });
}

void require_counts(const char* call, const char* what, std::size_t a, std::size_t b, std::size_t out) {
  if (a == out && b == out) return;
  kernel::fail(InvalidArgument(std::string(call) + " needs as many " + what + " and shafts to write, not " +
                               std::to_string(a) + ", " + std::to_string(b) + " and " + std::to_string(out)));
}

/// swept_batch() and swept_infinite_batch().
template <class Volume>
void sweep_many(const char* call, const BoxView& bodies, std::span<const Vec3> ways, std::span<CompiledShaft> out,
                std::span<const Plane> planes) {
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
      out, added, kernels,
      [&](std::size_t i) {
        return Volume{bodies[i], ways[i]};
      },
      position, position);
}

/// shadow_batch(), with a reach unless it is null.
template <class PositionA, class PositionB>
void shadow_many(const BoxView& lights, const BoxView& occluders, const float* reach, std::span<CompiledShaft> out,
                 const BatchPlanes& planes, const PositionA& light_of, const PositionB& occluder_of) {
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  const kernel::PlanesOfPairs added(kernels, planes, lights.count, occluders.count);
  const auto endless = [&](std::size_t i) { return ShadowWithoutEnd{lights[light_of(i)], occluders[occluder_of(i)]}; };
  if (reach == nullptr) {
    many(out, added, kernels, endless, light_of, occluder_of);
  } else {
    require_reach(*reach);
    many(
        out, added, kernels,
        [&](std::size_t i) {
          return Shadow{endless(i), *reach};
        },
        light_of, occluder_of);
  }
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
  return one(planes, Swept{body, displacement});
}

CompiledShaft swept_infinite(const Box& body, const Vec3& direction, std::span<const Plane> planes) {
  return one(planes, SweptWithoutEnd{body, direction});
}

CompiledShaft shadow(const Box& light, const Box& occluder, std::span<const Plane> planes) {
  return one(planes, ShadowWithoutEnd{light, occluder});
}

CompiledShaft shadow(const Box& light, const Box& occluder, float reach, std::span<const Plane> planes) {
  return one(planes, Shadow{{light, occluder}, reach});
}

void swept_batch(const BoxView& bodies, std::span<const Vec3> displacements, std::span<CompiledShaft> out,
                 std::span<const Plane> planes) {
  sweep_many<Swept>("swept_batch", bodies, displacements, out, planes);
}

void swept_infinite_batch(const BoxView& bodies, std::span<const Vec3> directions, std::span<CompiledShaft> out,
                          std::span<const Plane> planes) {
  sweep_many<SweptWithoutEnd>("swept_infinite_batch", bodies, directions, out, planes);
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
