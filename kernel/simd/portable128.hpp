// SPDX-License-Identifier: MIT
/// The set `portable128`: vectors of 4 floats as the compilers have them, without intrinsics. It runs on any processor,
/// and is what those run that have no set of their own.
///
/// It has no 16-bit integers: without an instruction for their rounded products, tests on a grid take twice as many
/// instructions as tests of floats.
#pragma once

#include "simd/operations.hpp"
#include "simd/portable.hpp"

namespace shaftcull::kernel::portable128 {

struct Set;
using Floats = PortableFloats<Set, 4>;

static_assert(FloatOperations<Floats>);

}  // namespace shaftcull::kernel::portable128
