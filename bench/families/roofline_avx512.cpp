// SPDX-License-Identifier: MIT
#include "families/roofline_lanes.hpp"
#include "simd/x86/avx512.hpp"

namespace shaftcull::bench {
namespace {

struct RooflineLanes : kernel::avx512::Floats {};

}  // namespace

extern const RooflineKernels avx512_roofline_kernels;
const RooflineKernels avx512_roofline_kernels = roofline_kernels_for<RooflineLanes>;

}  // namespace shaftcull::bench
