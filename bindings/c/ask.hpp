// SPDX-License-Identifier: MIT
/// The bounds of any holder, and a shaftcull_query, as the C++ interface takes them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "arguments.hpp"

namespace shaftcull::binding {

/// Bounds with their layers.
[[nodiscard]] inline Bounds bounds_of(const shaftcull_bounds* bounds, const char* name = "bounds") {
  const shaftcull_bounds& all = given(bounds, name);
  return std::visit(
      [&all](const auto& holder) -> Bounds {
        if constexpr (requires { Bounds(holder, all.layers); }) {
          return Bounds(holder, all.layers);
        } else {
          return holder;
        }
      },
      all.holder);
}

/// The options of a query, which may be NULL. The C++ interface checks what they say.
[[nodiscard]] inline Query query_of(const shaftcull_query* query) {
  static constexpr shaftcull_query everything{};
  const shaftcull_query& asked = query == nullptr ? everything : *query;
  if (asked.reserved_word != 0) refuse("query.reserved_word is not 0; set all of a query to 0 first");
  for (const std::uint64_t reserved : asked.reserved) {
    if (reserved != 0) refuse("query.reserved is not 0; set all of a query to 0 first");
  }
  std::optional<std::span<const std::uint32_t>> only;
  if (asked.only != nullptr || asked.only_count != 0) only = as_span(asked.only, asked.only_count, "query.only");
  const std::uint64_t limit = asked.limit == 0 ? Query::no_limit : asked.limit;
  return {.exclude = as_span(asked.exclude, asked.exclude_count, "query.exclude"),
          .exclude_each = as_span(asked.exclude_each, asked.exclude_each_count, "query.exclude_each"),
          .exclude_mask = as_span(asked.exclude_mask, asked.exclude_mask_words, "query.exclude_mask"),
          .layer_mask = as_span(asked.layer_masks, asked.layer_mask_count, "query.layer_masks"),
          .limit = static_cast<std::size_t>(std::min<std::uint64_t>(limit, Query::no_limit)),
          .only = only,
          .triangle_test = as_triangle_test(asked.triangle_test)};
}

}  // namespace shaftcull::binding
