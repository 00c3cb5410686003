#include "simd/x86/avx512.hpp"
#include "kernels/built_sets.hpp"
#include "kernels/table_of.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::avx512_kernels =
    kernels_for<avx512::Floats, avx512::FormationFloats>;
