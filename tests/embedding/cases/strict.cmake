# SPDX-License-Identifier: MIT
# A parent that has no exceptions and no type information, takes every warning for an error, joins all sources of a target
# and does not optimise; for a big-endian processor, without the program of hashes, which `s390x` has.
set(optimised -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 -D SHAFTCULL_BUILD_C=ON
  -D "PARENT_OPTIONS=-O0 -fno-exceptions -fno-rtti -Werror -Wall -Wextra -Wfloat-equal -Wuseless-cast"
  -D "PARENT_WARNINGS=-Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wcast-align -Wundef -Wpadded")
set(with_hashes "")
configure_for_processor(s390x)
build()
answers("scalar: as on record\nportable128: as on record\n")
