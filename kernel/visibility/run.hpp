// SPDX-License-Identifier: MIT
/// One call of visibility.hpp: products of groups are dealt to threads, and answers are delivered in order, in bounded
/// memory.
#pragma once

#include "shaftcull/visibility.hpp"
#include "visibility/occluders.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// Compares all patches of `a` with all of `b`, or each two of one set. Answers are counted, and delivered unless
/// `deliver` is null. Arguments were checked. Throws as visibility() says.
SightCounts run_visibility(const PatchTree& a, const PatchTree& b, bool is_of_one_set, const OccluderData& occluders,
                           const VisibilityOptions& options, const FunctionRef<void(const SightBatch&)>* deliver);

}  // namespace shaftcull::kernel
