// SPDX-License-Identifier: MIT
/// keeps() and classify() of one bound.
#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/cull.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

/// Streams of one.
BoxView view_of(const Box& box) noexcept {
  return {{&box.lo[0], &box.lo[1], &box.lo[2], &box.hi[0], &box.hi[1], &box.hi[2]}, 1};
}
SphereView view_of(const Sphere& sphere) noexcept {
  return {{&sphere.centre[0], &sphere.centre[1], &sphere.centre[2], &sphere.radius}, 1};
}

template <class Bound>
bool keeps_one(const kernel::ShaftData& shaft, const Bound& bound) {
  const auto view = view_of(bound);
  kernel::require_formed(shaft, 0);
  const kernel::FloatEnvironment environment;
  return kernel::active_kernels().keeps_one(view)(shaft, view.stream.data());
}

template <class Bound>
Answer classify_one(const kernel::ShaftData& shaft, const Bound& bound) {
  const auto view = view_of(bound);
  kernel::require_formed(shaft, 0);
  const kernel::FloatEnvironment environment;
  return kernel::active_kernels().classify_one(view)(shaft, view.stream.data());
}

}  // namespace

bool keeps(const CompiledShaft& shaft, const Box& box) { return keeps_one(kernel::data_of(shaft), box); }

bool keeps(const CompiledShaft& shaft, const Sphere& sphere) { return keeps_one(kernel::data_of(shaft), sphere); }

bool keeps(const CompiledShaft& shaft, const Triangle& triangle, TriangleTest test) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_triangle_test("test", test);
  kernel::require_formed(data, 0);
  if (test == TriangleTest::exact) kernel::require_no_hull_for_exact_test(data, 0);
  const float* stream[9];
  for (std::size_t s = 0; s != 9; ++s) stream[s] = &triangle.vertex[s / 3][s % 3];
  const kernel::Kernels& kernels = kernel::active_kernels();
  std::uint64_t kept = 0;
  const kernel::FloatEnvironment environment;
  (test == TriangleTest::exact ? kernels.triangles_exactly : kernels.triangles_by_vertices)(data, stream, 1, &kept,
                                                                                            nullptr);
  return kept != 0;
}

Answer classify(const CompiledShaft& shaft, const Box& box) { return classify_one(kernel::data_of(shaft), box); }

Answer classify(const CompiledShaft& shaft, const Sphere& sphere) {
  return classify_one(kernel::data_of(shaft), sphere);
}

}  // namespace shaftcull
