// SPDX-License-Identifier: MIT
/// From bounds of any kind and holder, and a shaftcull_query, to the call of the C++ interface that answers.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>

#include "arguments.hpp"
#include "sources.hpp"

namespace shaftcull::binding {

/// What a question is asked of: a view of boxes or spheres (of a stream, too), a tree of them, or triangles.
template <class Set>
concept FlatSet = std::same_as<Set, BoxView> || std::same_as<Set, SphereView>;
template <class Set>
concept TreeSet = std::same_as<Set, BoxTree> || std::same_as<Set, SphereTree>;
template <class Set>
concept TriangleSet = std::same_as<Set, TriangleView> || std::same_as<Set, TriangleTree>;

template <class Set>
concept BoundSet = FlatSet<Set> || TreeSet<Set>;
template <class Set>
concept AnySet = BoundSet<Set> || TriangleSet<Set>;
template <class Set>
concept BoxSet = std::same_as<Set, BoxView> || std::same_as<Set, BoxTree>;

/// What calls take for messages that refuse bounds.
inline constexpr const char* takes_any = "bounds of all kinds";
inline constexpr const char* takes_bounds = "boxes and spheres";
inline constexpr const char* takes_boxes = "boxes";
inline constexpr const char* takes_views = "boxes and spheres in views and streams";
inline constexpr const char* takes_trees = "trees of boxes and spheres";

/// What a query says of bounds of this type: nothing, a test of triangles, or what to leave out.
template <FlatSet Set>
[[nodiscard]] std::tuple<> option_for(const Set& /*set*/, const shaftcull_query& /*query*/) {
  return {};
}
template <TriangleSet Set>
[[nodiscard]] std::tuple<TriangleTest> option_for(const Set& /*set*/, const shaftcull_query& query) {
  return as_triangle_test(query.triangle_test);
}
template <TreeSet Set>
[[nodiscard]] std::tuple<Excluding> option_for(const Set& /*set*/, const shaftcull_query& query) {
  Excluding excluding;
  excluding.own = as_span(query.own, query.own_count, "query.own");
  excluding.mask = as_span(query.mask, query.mask_words, "query.mask");
  excluding.only_layers = as_span(query.only_layers, query.only_layers_count, "query.only_layers");
  return excluding;
}

/// Refuses what a query says that bounds of this type have no use for.
template <AnySet Set>
void check_query(const shaftcull_query& query) {
  for (const std::uint64_t reserved : query.reserved) {
    if (reserved != 0) refuse("query.reserved is not 0; set all of a query to 0 first");
  }
  if (query.reserved_word != 0) refuse("query.reserved_word is not 0; set all of a query to 0 first");
  if (!TriangleSet<Set> && query.triangle_test != SHAFTCULL_TRIANGLES_EXACT) {
    refuse("query.triangle_test = " + std::to_string(query.triangle_test) + "; only triangles have one");
  }
  const bool leaves_out = query.own != nullptr || query.own_count != 0 || query.mask != nullptr ||
                          query.mask_words != 0 || query.only_layers != nullptr || query.only_layers_count != 0;
  if (!TreeSet<Set> && leaves_out) refuse("query leaves bounds out; only a tree of boxes or spheres can do that");
}

/// Calls use(set) with the view or tree behind bounds.
template <class Use>
void visit_bounds(const shaftcull_bounds* bounds, Use&& use) {
  std::visit(
      [&use](const auto& holder) {
        if constexpr (requires { holder.view(); }) {
          use(holder.view());
        } else {
          use(holder);
        }
      },
      given(bounds, "bounds").holder);
}

[[noreturn]] inline void refuse_bounds(const shaftcull_bounds& bounds, const char* takes) {
  refuse("bounds are " + name_of(bounds) + "; this call takes " + takes);
}

/// Calls use(set) if it takes bounds of this type, and refuses them otherwise: calls without a query.
template <class Use>
void use_bounds(const shaftcull_bounds* bounds, const char* takes, Use&& use) {
  visit_bounds(bounds, [&]<class Set>(const Set& set) {
    if constexpr (std::is_invocable_v<Use&, const Set&>) {
      use(set);
    } else {
      refuse_bounds(*bounds, takes);
    }
  });
}

/// Calls use(set, option…) likewise, with what the query says: option_for().
template <class Use>
void ask_bounds(const shaftcull_bounds* bounds, const shaftcull_query* query, const char* takes, Use&& use) {
  static constexpr shaftcull_query everything{};
  const shaftcull_query& asked = query == nullptr ? everything : *query;
  visit_bounds(bounds, [&]<class Set>(const Set& set) {
    std::apply(
        [&]<class... Option>(const Option&... option) {
          if constexpr (std::is_invocable_v<Use&, const Set&, const Option&...>) {
            check_query<Set>(asked);
            use(set, option...);
          } else {
            refuse_bounds(*bounds, takes);
          }
        },
        option_for(set, asked));
  });
}

}  // namespace shaftcull::binding
