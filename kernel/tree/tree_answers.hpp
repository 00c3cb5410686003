// SPDX-License-Identifier: MIT
/// The answers of one shaft to a question about a tree, for verbs of one shaft and of many. They are those of
/// shaftcull/cull.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "tree/tree_query.hpp"

namespace shaftcull::kernel {

/// Writes bits by the user's index. Rows that are null are not written; there is one for each answer asked for.
void write_bits(const TreeQuery& query, std::size_t s, std::uint64_t* kept, std::uint64_t* inside);
std::size_t list(const TreeQuery& query, std::size_t s, std::span<std::uint32_t> kept, std::size_t limit);
KeptCounts list_classified(const TreeQuery& query, std::size_t s, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside);
/// The first in tree order.
[[nodiscard]] std::optional<std::uint32_t> first_kept(const TreeQuery& query, std::size_t s);

}  // namespace shaftcull::kernel
