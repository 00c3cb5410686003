// SPDX-License-Identifier: MIT
/// Kinds of trees, for typed tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>
#include <utility>

#include "shaftcull/tree.hpp"

namespace shaftcull {

/// What a kind of tree holds, and by what it is numbered.
template <class Tree>
using BoundOf = std::decay_t<decltype(std::declval<const Tree&>().leaves()[0])>;
template <class Tree>
using IndexOf = std::decay_t<decltype(std::declval<const Tree&>().order()[0])>;

/// Each bound and each index once; where nothing is optimised, all pairs of them.
#ifdef NDEBUG
using TreeKinds = testing::Types<BoxTree, BoundsTree<Sphere, std::uint64_t>>;
#else
using TreeKinds =
    testing::Types<BoxTree, SphereTree, BoundsTree<Box, std::uint64_t>, BoundsTree<Sphere, std::uint64_t>>;
#endif

}  // namespace shaftcull
