// SPDX-License-Identifier: MIT
#include "shaftcull/cull.hpp"

#include <algorithm>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

constexpr bool is_sphere(const BoxView& /*view*/) { return false; }
constexpr bool is_sphere(const SphereView& /*view*/) { return true; }

template <class View>
void cull_view(const kernel::ShaftData& shaft, const View& view, std::span<std::uint64_t> kept) {
  kernel::require_answers(shaft, true, false, is_sphere(view), 0);
  kernel::require_view(view);
  kernel::require_words("kept", kept, view.count);
  if (view.count == 0) return;
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view)(shaft, view.stream.data(), view.count, kept.data(), nullptr);
}

template <class View>
void classify_view(const kernel::ShaftData& shaft, const View& view, std::span<std::uint64_t> kept,
                   std::span<std::uint64_t> inside) {
  kernel::require_answers(shaft, true, true, is_sphere(view), 0);
  kernel::require_view(view);
  kernel::require_words("kept", kept, view.count);
  kernel::require_words("inside", inside, view.count);
  if (view.count == 0) return;
  kernel::require_apart("classify", "kept", kernel::bytes_of(kept), "inside", kernel::bytes_of(inside));
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view)(shaft, view.stream.data(), view.count, kept.data(), inside.data());
}

template <class View>
void contained_view(const kernel::ShaftData& shaft, const View& view, std::span<std::uint64_t> inside) {
  kernel::require_answers(shaft, false, true, is_sphere(view), 0);
  kernel::require_view(view);
  kernel::require_words("inside", inside, view.count);
  if (view.count == 0) return;
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view)(shaft, view.stream.data(), view.count, nullptr, inside.data());
}

/// Streams of one.
BoxView view_of(const Box& box) noexcept {
  return {{&box.lo[0], &box.lo[1], &box.lo[2], &box.hi[0], &box.hi[1], &box.hi[2]}, 1};
}
SphereView view_of(const Sphere& sphere) noexcept {
  return {{&sphere.centre[0], &sphere.centre[1], &sphere.centre[2], &sphere.radius}, 1};
}

template <class Bound>
bool cull_one(const kernel::ShaftData& shaft, const Bound& bound) {
  const auto view = view_of(bound);
  kernel::require_answers(shaft, true, false, is_sphere(view), 0);
  const kernel::FloatEnvironment environment;
  return kernel::active_kernels().keeps_one(view)(shaft, view.stream.data());
}

template <class Bound>
Answer classify_one(const kernel::ShaftData& shaft, const Bound& bound) {
  const auto view = view_of(bound);
  kernel::require_answers(shaft, true, true, is_sphere(view), 0);
  const kernel::FloatEnvironment environment;
  return kernel::active_kernels().classify_one(view)(shaft, view.stream.data());
}

}  // namespace

void cull(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept) {
  cull_view(kernel::data_of(shaft), boxes, kept);
}

void cull(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept) {
  cull_view(kernel::data_of(shaft), spheres, kept);
}

void classify(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside) {
  classify_view(kernel::data_of(shaft), boxes, kept, inside);
}

void classify(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside) {
  classify_view(kernel::data_of(shaft), spheres, kept, inside);
}

void contained(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> inside) {
  contained_view(kernel::data_of(shaft), boxes, inside);
}

void contained(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> inside) {
  contained_view(kernel::data_of(shaft), spheres, inside);
}

void keep_layers(std::span<std::uint64_t> bits, std::span<const std::uint32_t> layers, std::uint32_t only_layers) {
  kernel::require_memory("layers", layers, "layers");
  kernel::require_words("bits", bits, layers.size());
  kernel::require_apart("keep_layers", "bits", kernel::bytes_of(bits), "layers", kernel::bytes_of(layers));
  kernel::KeepLayers* const keep = kernel::active_kernels().keep_layers;
  const std::size_t whole = layers.size() / 64;
  for (std::size_t w = 0; w != whole; ++w) bits[w] &= keep(layers.data() + 64 * w, only_layers);
  if (whole == bits.size()) return;
  std::uint32_t last[64] = {};
  std::copy(layers.begin() + static_cast<std::ptrdiff_t>(64 * whole), layers.end(), last);
  bits[whole] &= keep(last, only_layers);
}

bool cull(const CompiledShaft& shaft, const Box& box) { return cull_one(kernel::data_of(shaft), box); }

bool cull(const CompiledShaft& shaft, const Sphere& sphere) { return cull_one(kernel::data_of(shaft), sphere); }

Answer classify(const CompiledShaft& shaft, const Box& box) { return classify_one(kernel::data_of(shaft), box); }

Answer classify(const CompiledShaft& shaft, const Sphere& sphere) {
  return classify_one(kernel::data_of(shaft), sphere);
}

}  // namespace shaftcull
