# SPDX-License-Identifier: MIT
# A baseline of AVX-512, by clang.
needs(clang++-19)
configure(clang++-19 -D "PARENT_OPTIONS=-O0 -march=skylake-avx512" -D SHAFTCULL_WITH_TBB=OFF)
build()
if(shaftcull_set_of_machine STREQUAL "avx512")
  answers("scalar: as on record\navx512: as on record\n")
endif()
