# SPDX-License-Identifier: MIT
# -ffast-math by another compiler, and C++23.
needs(clang++-19)
configure(clang++-19 -D "PARENT_OPTIONS=-O1 -ffast-math" -D CMAKE_CXX_STANDARD=23 -D SHAFTCULL_WITH_TBB=OFF)
build()
answers()
