// SPDX-License-Identifier: MIT
/// Kinds of trees, for typed tests.
#pragma once

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

#include "shaftcull/tree.hpp"

namespace shaftcull {

/// What a kind of tree holds.
template <class Tree>
using BoundOf = std::decay_t<decltype(std::declval<const Tree&>().leaves()[0])>;

using TreeKinds = testing::Types<BoxTree, SphereTree>;

}  // namespace shaftcull
