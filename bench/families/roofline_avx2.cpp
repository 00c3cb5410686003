// SPDX-License-Identifier: MIT
#include "families/roofline_lanes.hpp"
#include "simd/x86/avx2.hpp"

namespace shaftcull::bench {
namespace {

struct RooflineLanes : kernel::avx2::Floats {};

}  // namespace

extern const RooflineKernels avx2_roofline_kernels;
const RooflineKernels avx2_roofline_kernels = roofline_kernels_for<RooflineLanes>;

}  // namespace shaftcull::bench
