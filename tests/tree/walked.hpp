// SPDX-License-Identifier: MIT
/// Walks below the interface: with kernels that a test has changed, or through a tree that it has made up.
#pragma once

#include "compiled/shaft_data.hpp"
#include "kernels/kernel_table.hpp"
#include "query/question.hpp"
#include "shaftcull/compiled.hpp"
#include "tree/exclusion.hpp"
#include "tree/visitors.hpp"
#include "tree/walk.hpp"

namespace shaftcull {

/// Gives the visitor what the shaft keeps and `layers` lets through.
template <class Bound, class Visitor>
void walk(const kernel::TreeLevels<Bound>& tree, const kernel::Kernels& kernels, const CompiledShaft& shaft,
          kernel::Question question, Visitor& visitor, const kernel::LayerFilter& layers = {}) {
  const kernel::Exclusion excluded(kernel::LeafIndices({}, false, kernels), {}, layers);
  kernel::WordByWord words(visitor);
  kernel::Walk<Bound>(tree, kernels, kernel::data_of(shaft), question, excluded, words, words.traits).run();
}

}  // namespace shaftcull
