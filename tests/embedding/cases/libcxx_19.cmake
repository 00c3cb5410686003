# SPDX-License-Identifier: MIT
# Another standard library.
needs(clang++-19 -stdlib=libc++)
configure(clang++-19 -D "PARENT_OPTIONS=-O0 -stdlib=libc++" -D SHAFTCULL_WITH_TBB=OFF)
build()
answers()
