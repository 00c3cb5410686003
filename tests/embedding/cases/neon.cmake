# SPDX-License-Identifier: MIT
# 64-bit ARM in little time: not optimised, and without the program of hashes, which `arm64` has.
set(optimised -D "CMAKE_CXX_FLAGS=-O0")
set(with_hashes "")
configure_for_processor(aarch64)
build()
answers("scalar: as on record\nneon: as on record\n")
