// Which instruction set this unit is for, to simd/lanes.hpp.
#define SHAFTCULL_UNIT_AVX2
#define SHAFTCULL_UNIT_AVX512
// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_limit_avx512
#include "limit_lanes.hpp"

namespace shaftcull::bench {
namespace {

struct LimitLanes : kernel::Lanes<xsimd::avx512bw> {};

}  // namespace

extern const LimitKernels avx512_limit_kernels;
const LimitKernels avx512_limit_kernels = limit_kernels_for<LimitLanes>;

}  // namespace shaftcull::bench
