# SPDX-License-Identifier: MIT
# A parent that has no exceptions and no type information, takes every warning for an error, joins all sources of a target
# and does not optimise. Of the instruction sets it wants one that is not chosen here otherwise; what is none is refused.
needs(g++)
foreach(sets IN ITEMS see4_2 "")
  fails("SHAFTCULL_INSTRUCTION_SETS is \"${sets}\"; it can be AUTO, BEST, ALL, or a list of: scalar, portable128, sse4_2,"
    ${CMAKE_COMMAND} -S ${SHAFTCULL} -B ${WORK}/refused -G ${GENERATOR} "-DSHAFTCULL_INSTRUCTION_SETS=${sets}")
endforeach()
configure(g++ -D CMAKE_BUILD_TYPE=Debug -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_BUILD_C=ON
  -D SHAFTCULL_INSTRUCTION_SETS=portable128
  -D "PARENT_OPTIONS=-fno-exceptions -fno-rtti -Werror -Wall -Wextra -Wfloat-equal -Wuseless-cast"
  -D "PARENT_WARNINGS=-Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wcast-align -Wundef -Wpadded")
build()
answers("scalar: as on record\nportable128: as on record\n")
