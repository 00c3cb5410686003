// Which instruction set this unit is for, to simd/lanes.hpp.
#define SHAFTCULL_UNIT_AVX2
// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_limit_avx2
#include "limit_lanes.hpp"

namespace shaftcull::bench {
namespace {

struct LimitLanes : kernel::Lanes<xsimd::fma3<xsimd::avx2>> {};

}  // namespace

extern const LimitKernels avx2_limit_kernels;
const LimitKernels avx2_limit_kernels = limit_kernels_for<LimitLanes>;

}  // namespace shaftcull::bench
