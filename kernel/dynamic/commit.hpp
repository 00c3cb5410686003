// SPDX-License-Identifier: MIT
/// From one state of a dynamic tree to the next.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dynamic/changes.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull::kernel {

/// What sorting blocks again may cost, in bounds.
struct Upkeep {
  double per_change = 2;
  double saved = 0;  ///< what earlier commits did not spend
  std::size_t sorted_last = 0;
  std::size_t sorted_since_size = 0;  ///< since the usual size of a node was found
  std::size_t next_looked_at = 0;     ///< the block whose overlap with others is looked at next
};

/// Blocks are sorted again, as far as the upkeep allows, if their nodes have grown more than this.
inline constexpr float grown = 1.1F;
[[nodiscard]] inline bool has_grown(const BlockSize& block) noexcept { return block.growth > grown; }

/// A state without bounds.
template <class Bound>
[[nodiscard]] Shared<StateOf<Bound>> empty_state();

/// The changes of a commit.
template <class Bound>
struct Changes {
  std::span<const Change<Bound>> all;
  std::span<const Slot> slots;  ///< of each index; those with changes name them
};

/// The state that has the changes made. Sorts every block if there are very many.
///
/// If `old` has one owner, it is changed where it is, and returned; blocks that other states share are copied first.
/// Otherwise it stays as it is. Throws std::bad_alloc, and then nothing has changed. `layers`: whether some bound may
/// be in other layers than all. `everything`: sorts every block in any case.
template <class Bound>
[[nodiscard]] Shared<StateOf<Bound>> committed(const Shared<StateOf<Bound>>& old, const Changes<Bound>& changes,
                                               bool layers, bool everything, Upkeep& upkeep);

}  // namespace shaftcull::kernel
