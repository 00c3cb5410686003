// Which instruction set this unit is for, to simd/lanes.hpp.
#define SHAFTCULL_UNIT_AVX2
// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_limit_avx2
#include "families/roofline_lanes.hpp"

namespace shaftcull::bench {
namespace {

struct RooflineLanes : kernel::Lanes<xsimd::fma3<xsimd::avx2>> {};

}  // namespace

extern const RooflineKernels avx2_roofline_kernels;
const RooflineKernels avx2_roofline_kernels = roofline_kernels_for<RooflineLanes>;

}  // namespace shaftcull::bench
