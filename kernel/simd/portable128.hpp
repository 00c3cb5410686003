/// The set `portable128`: vectors of 4 floats and of 8 integers as the compilers have them, without intrinsics. It runs
/// on any processor, and is what those run that have no set of their own.
#pragma once

#include <cstddef>

#include "simd/operations.hpp"
#include "simd/portable.hpp"

namespace shaftcull::kernel::portable128 {

struct Set;
struct Integers16;

struct Floats : PortableFloats<Set, 4> {
  using Integers16 = portable128::Integers16;
};

struct Integers16 : PortableIntegers16<Floats> {
  static constexpr std::size_t fewest_shafts_on_grid = 5;
  static constexpr std::size_t fewest_tests_on_grid = 6144;
};

static_assert(FloatOperations<Floats> && Integer16Operations<Integers16>);

}  // namespace shaftcull::kernel::portable128
