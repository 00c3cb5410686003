// SPDX-License-Identifier: MIT
/// Refining: what a shaft keeps, out of what a shaft around it kept.
///
/// A shaft between two groups of objects contains every shaft between their members. Cull all bounds with the shaft
/// between the groups, then only its candidates with those between members.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Writes those of `candidates` that the shaft keeps, in their order, and returns how many there are; what does not fit
/// is counted and not written (results.hpp). Candidates are positions in the view, or the user's indices in a tree.
/// `kept` may begin where `candidates` begins, which overwrites them; else the two must not share memory.
///
/// Throws InvalidArgument for a candidate not below the number of bounds, for spans that overlap otherwise, or as
/// cull() does, and NeedsRefit for a tree that needs a refit; nothing is written then. O(candidates.size()); safe to
/// call from many threads; at most 64 KiB of the stack. Nothing is allocated, but for a tree that was never updated by
/// index nor refined: its first such call looks up the leaf of every index, O(tree.size()), and keeps that, so it may
/// throw std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t refine(const CompiledShaft& shaft, const BoxView& boxes,
                                                  std::span<const std::uint32_t> candidates,
                                                  std::span<std::uint32_t> kept);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t refine(const CompiledShaft& shaft, const SphereView& spheres,
                                                  std::span<const std::uint32_t> candidates,
                                                  std::span<std::uint32_t> kept);
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t refine(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                  std::span<const std::uint32_t> candidates,
                                                  std::span<std::uint32_t> kept);

/// Lists, for each shaft, those of the same candidates that it keeps, in their order; in parallel. Candidates are
/// gathered once, so many shafts cost little more each than a scan of that many bounds. Reuses the memory of `lists`;
/// if this throws, they are as they were or empty. Errors as refine(), InvalidArgument if candidates are a part of
/// `lists`, and std::bad_alloc if memory runs out.
SHAFTCULL_EXPORT void refine_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                  std::span<const std::uint32_t> candidates, IndexLists& lists);
SHAFTCULL_EXPORT void refine_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                  std::span<const std::uint32_t> candidates, IndexLists& lists);
template <class Bound>
SHAFTCULL_EXPORT void refine_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                  std::span<const std::uint32_t> candidates, IndexLists& lists);

}  // namespace shaftcull
