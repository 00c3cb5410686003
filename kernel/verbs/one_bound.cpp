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

/// Coordinates side by side, as kernels read them.
static_assert(sizeof(Box) == 6 * sizeof(float) && sizeof(Sphere) == 4 * sizeof(float));
const float* coordinates_of(const Box& box) noexcept { return box.lo.data(); }
const float* coordinates_of(const Sphere& sphere) noexcept { return sphere.centre.data(); }

template <kernel::KeepsOne* kernel::Kernels::*keeps, class Bound>
bool keeps_one(const kernel::ShaftData& shaft, const Bound& bound) {
  kernel::require_formed(shaft, 0);
  const kernel::FloatEnvironment environment;
  return (kernel::active_kernels().*keeps)(shaft, coordinates_of(bound));
}

template <kernel::ClassifyOne* kernel::Kernels::*classify, class Bound>
Answer classify_one(const kernel::ShaftData& shaft, const Bound& bound) {
  kernel::require_formed(shaft, 0);
  const kernel::FloatEnvironment environment;
  return (kernel::active_kernels().*classify)(shaft, coordinates_of(bound));
}

}  // namespace

bool keeps(const CompiledShaft& shaft, const Box& box) {
  return keeps_one<&kernel::Kernels::keeps_box>(kernel::data_of(shaft), box);
}

bool keeps(const CompiledShaft& shaft, const Sphere& sphere) {
  return keeps_one<&kernel::Kernels::keeps_sphere>(kernel::data_of(shaft), sphere);
}

bool keeps(const CompiledShaft& shaft, const Triangle& triangle, TriangleTest test) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_triangle_test("test", test);
  kernel::require_formed(data, 0);
  const float* stream[9];
  for (std::size_t s = 0; s != 9; ++s) stream[s] = &triangle.vertex[s / 3][s % 3];
  const kernel::Kernels& kernels = kernel::active_kernels();
  std::uint64_t kept = 0;
  const kernel::FloatEnvironment environment;
  (test == TriangleTest::exact ? kernels.triangles_exactly : kernels.triangles_by_vertices)(data, stream, 1, &kept,
                                                                                            nullptr);
  return kept != 0;
}

Answer classify(const CompiledShaft& shaft, const Box& box) {
  return classify_one<&kernel::Kernels::classify_box>(kernel::data_of(shaft), box);
}

Answer classify(const CompiledShaft& shaft, const Sphere& sphere) {
  return classify_one<&kernel::Kernels::classify_sphere>(kernel::data_of(shaft), sphere);
}

}  // namespace shaftcull
