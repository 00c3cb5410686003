# SPDX-License-Identifier: MIT
# A parent that has no exceptions and no type information, takes every warning for an error, joins all sources of a target
# and does not optimise.
needs(g++)
configure(g++ -D CMAKE_BUILD_TYPE=Debug -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_BUILD_C=ON
  -D "PARENT_OPTIONS=-fno-exceptions -fno-rtti -Werror -Wall -Wextra -Wfloat-equal -Wuseless-cast"
  -D "PARENT_WARNINGS=-Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wcast-align -Wundef -Wpadded")
build()
answers()
