#include "shaftcull/cull.hpp"

#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

constexpr bool is_sphere(const BoxView& /*view*/) { return false; }
constexpr bool is_sphere(const SphereView& /*view*/) { return true; }

template <class View>
void cull_view(const CompiledShaft& shaft, const View& view, std::span<std::uint64_t> kept, Form form) {
  kernel::require_answers(shaft, true, false, is_sphere(view), 0);
  kernel::require_form(form);
  kernel::require_view(view);
  kernel::require_words("kept", kept, view.count);
  if (view.count == 0) return;
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view, form)(shaft, view.stream.data(), view.count, kept.data(), nullptr);
}

template <class View>
void classify_view(const CompiledShaft& shaft, const View& view, std::span<std::uint64_t> kept,
                   std::span<std::uint64_t> inside, Form form) {
  kernel::require_answers(shaft, true, true, is_sphere(view), 0);
  kernel::require_form(form);
  kernel::require_view(view);
  kernel::require_words("kept", kept, view.count);
  kernel::require_words("inside", inside, view.count);
  if (view.count == 0) return;
  kernel::require_apart("classify", "kept", kernel::bytes_of(kept), "inside", kernel::bytes_of(inside));
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view, form)(shaft, view.stream.data(), view.count, kept.data(), inside.data());
}

template <class View>
void contain_view(const CompiledShaft& shaft, const View& view, std::span<std::uint64_t> inside) {
  kernel::require_answers(shaft, false, true, is_sphere(view), 0);
  kernel::require_view(view);
  kernel::require_words("inside", inside, view.count);
  if (view.count == 0) return;
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().test(view, Form::planes)(shaft, view.stream.data(), view.count, nullptr, inside.data());
}

Answer answer_of(std::uint64_t kept, std::uint64_t inside) noexcept {
  if (kept == 0) return Answer::outside;
  return inside == 0 ? Answer::overlap : Answer::inside;
}

}  // namespace

void cull(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept, Form form) {
  cull_view(shaft, boxes, kept, form);
}

void cull(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept, Form form) {
  cull_view(shaft, spheres, kept, form);
}

void classify(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, Form form) {
  classify_view(shaft, boxes, kept, inside, form);
}

void classify(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, Form form) {
  classify_view(shaft, spheres, kept, inside, form);
}

void contain(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> inside) {
  contain_view(shaft, boxes, inside);
}

void contain(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> inside) {
  contain_view(shaft, spheres, inside);
}

Answer classify(const CompiledShaft& shaft, const Box& box) {
  const BoxView view{{&box.lo[0], &box.lo[1], &box.lo[2], &box.hi[0], &box.hi[1], &box.hi[2]}, 1};
  std::uint64_t kept = 0;
  std::uint64_t inside = 0;
  classify(shaft, view, {&kept, 1}, {&inside, 1});
  return answer_of(kept, inside);
}

Answer classify(const CompiledShaft& shaft, const Sphere& sphere) {
  const SphereView view{{&sphere.centre[0], &sphere.centre[1], &sphere.centre[2], &sphere.radius}, 1};
  std::uint64_t kept = 0;
  std::uint64_t inside = 0;
  classify(shaft, view, {&kept, 1}, {&inside, 1});
  return answer_of(kept, inside);
}

}  // namespace shaftcull
