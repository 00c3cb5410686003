#include "compile/added.hpp"
#include "compile/planes.hpp"
#include "compile/slab.hpp"
#include "shaftcull/compiled.hpp"
#include "simd/float_environment.hpp"
#include "simd/scalar.hpp"
#include "test/kernels.hpp"

namespace shaftcull {
namespace {

CompiledShaft compile_formed(const Shaft& shaft) noexcept {
  CompiledShaft compiled;  // arrays stay unwritten past their counts
  const float* a[6];
  const float* b[6];
  for (unsigned k = 0; k < 3; ++k) {
    a[k] = &shaft.a().lo[k];
    a[k + 3] = &shaft.a().hi[k];
    b[k] = &shaft.b().lo[k];
    b[k + 3] = &shaft.b().hi[k];
  }
  kernel::compile_slabs<kernel::ScalarLanes>(a, b, 1, &compiled);
  kernel::compile_joining_planes(shaft.joining_planes(), compiled);
  const std::span<const Plane> added = shaft.added_planes();
  const Plane* const first_added = added.data();
  kernel::add_planes<kernel::ScalarLanes>(a, b, &first_added, added.size(), 1, &compiled);
  compiled.answers_outside = shaft.options().outside;
  compiled.answers_inside = shaft.options().inside;
  compiled.answers_spheres = shaft.options().spheres;
  return compiled;
}

}  // namespace

CompiledShaft compile(const Shaft& shaft) noexcept {
  return kernel::in_float_environment([&] { return compile_formed(shaft); });
}

CompiledShaft compile(const Box& a, const Box& b) {
  CompiledShaft compiled;
  const bool is_formed = [&] {
    const kernel::FloatEnvironment environment;
    return kernel::active_kernels().compile_pair(a, b, compiled);
  }();
  if (!is_formed) static_cast<void>(Shaft(a, b));  // throws, and says why
  return compiled;
}

void complete(CompiledShaft& shaft) noexcept {
  if (shaft.has_planes()) return;
  kernel::in_float_environment(
      [&] { kernel::compile_joining_planes(Shaft(shaft.a, shaft.b).joining_planes(), shaft); });
}

}  // namespace shaftcull
