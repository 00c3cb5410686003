#include <string>

#include "compile/planes.hpp"
#include "compile/slab.hpp"
#include "run/arguments.hpp"
#include "shaftcull/compiled.hpp"
#include "simd/float_environment.hpp"
#include "simd/scalar.hpp"
#include "test/kernels.hpp"

namespace shaftcull {
namespace {

struct CompileEnvironment {};

/// Throws what the constructor of Shaft throws for the first pair that it rejects, with the pair's index.
void reject_first_bad_pair(const BoxView& a, const BoxView& b) {
  for (std::size_t i = 0; i < a.count; ++i) {
    try {
      static_cast<void>(Shaft(a[i], b[i]));
    } catch (const InvalidArgument& error) {
      throw BadBound(i, "shaft " + std::to_string(i) + ": " + error.what());
    }
  }
}

}  // namespace

CompiledShaft compile(const Shaft& shaft) noexcept {
  const kernel::FloatEnvironment<CompileEnvironment> environment;
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
  kernel::compile_added_planes(shaft.added_planes(), compiled);
  compiled.answers_outside = shaft.options().outside;
  compiled.answers_inside = shaft.options().inside;
  compiled.answers_spheres = shaft.options().spheres;
  return compiled;
}

CompiledShaft compile(const Box& a, const Box& b) {
  CompiledShaft compiled;
  const bool is_formed = kernel::active_kernels().compile_pair(a, b, compiled);
  if (!is_formed) static_cast<void>(Shaft(a, b));  // throws, and says why
  return compiled;
}

void compile_batch(const BoxView& a, const BoxView& b, std::span<CompiledShaft> out) {
  if (a.count != b.count || a.count != out.size()) {
    throw InvalidArgument("compile_batch needs as many boxes a as boxes b and shafts to write, not " +
                          std::to_string(a.count) + ", " + std::to_string(b.count) + " and " + std::to_string(out.size()));
  }
  kernel::require_view(a);
  kernel::require_view(b);
  kernel::require_memory("out", out, "shafts");
  if (!kernel::active_kernels().compile_batch(a.stream.data(), b.stream.data(), a.count, out.data())) {
    reject_first_bad_pair(a, b);
  }
}

void complete(CompiledShaft& shaft) noexcept {
  if (shaft.has_planes()) return;
  const kernel::FloatEnvironment<CompileEnvironment> environment;
  kernel::compile_joining_planes(Shaft(shaft.a, shaft.b).joining_planes(), shaft);
}

}  // namespace shaftcull
