# SPDX-License-Identifier: MIT
# A big-endian processor in little time: not optimised, and without the program of hashes, which `s390x` has.
set(optimised -D "CMAKE_CXX_FLAGS=-O0")
set(with_hashes "")
configure_for_processor(s390x)
build()
answers("scalar: as on record\nportable128: as on record\n")
