// SPDX-License-Identifier: MIT
/// The options of a query, checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "compiled/shaft_data.hpp"
#include "query/bound_streams.hpp"
#include "query/question.hpp"
#include "shaftcull/query.hpp"

namespace shaftcull::kernel {

/// The options that a verb takes, besides those that leave bounds out.
struct Takes {
  bool limit = false;
  bool only = true;
  bool skip_overlapping = false;
};

inline constexpr Takes takes_candidates{};
inline constexpr Takes takes_limit{.limit = true};

/// Throws InvalidArgument unless all shafts answer the question, by position.
void require_answers_of(std::span<const ShaftData> shafts, Question question);

/// Bounds that are left out by index, for one shaft.
struct ExcludedIndices {
  std::span<const std::uint32_t> of_all;    ///< Query::exclude
  std::span<const std::uint32_t> of_shaft;  ///< its row of Query::exclude_each
  std::span<const std::uint64_t> mask;

  [[nodiscard]] bool is_on() const noexcept { return !of_all.empty() || !of_shaft.empty() || !mask.empty(); }
  [[nodiscard]] bool has(std::uint32_t index) const noexcept {
    bool is_out = !mask.empty() && (mask[index / 64] >> index % 64 & 1) != 0;
    for (const std::uint32_t i : of_all) is_out |= i == index;
    for (const std::uint32_t i : of_shaft) is_out |= i == index;
    return is_out;
  }
};

/// Refers to the query, which outlives it. Most queries have no options, and pay for a few comparisons.
class Options {
 public:
  /// For a call of the name `call` about so many shafts and bounds. Throws InvalidArgument as shaftcull/query.hpp says.
  Options(const Query& query, const char* call, const Takes& takes, std::size_t shafts, std::size_t bounds,
          BoundKind kind, bool have_layers)
      : query_(query), call_(call) {
    if (&query == &no_options) [[likely]]
      return;
    leave_out_ = leaves_out(query);
    if (leave_out_ || asks_for_more(query)) {
      check(takes, shafts, bounds, kind, have_layers);
    }
  }

  /// Whether a query has options.
  [[nodiscard]] static bool are_given(const Query& query) noexcept {
    return &query != &no_options && (leaves_out(query) || asks_for_more(query));
  }

  /// Throws InvalidArgument if `output`, called `name` in the message, shares memory with an option. The beginning of
  /// `output` may be that of the candidates where `may_begin_at_only` says so.
  void require_apart(const char* name, std::span<const std::byte> output, bool may_begin_at_only = false) const {
    if (leave_out_ || query_.only) check_apart(name, output, may_begin_at_only);
  }

  [[nodiscard]] const char* call() const noexcept { return call_; }
  [[nodiscard]] std::size_t limit() const noexcept { return query_.limit; }
  [[nodiscard]] bool has_limit() const noexcept { return query_.limit != Query::no_limit; }
  [[nodiscard]] const std::optional<std::span<const std::uint32_t>>& only() const noexcept { return query_.only; }
  [[nodiscard]] TriangleTest triangle_test() const noexcept { return query_.triangle_test; }

  [[nodiscard]] bool skip_overlapping() const noexcept { return query_.skip_overlapping; }

  [[nodiscard]] ExcludedIndices excluded(std::size_t s) const noexcept {
    return {query_.exclude.span(), query_.exclude_each.subspan(s * each_, each_), query_.exclude_mask};
  }
  /// The layers that shaft s asks for. Nothing if bounds of all layers and of none are asked about.
  [[nodiscard]] std::optional<std::uint32_t> layers(std::size_t s) const noexcept {
    const std::span<const std::uint32_t> masks = query_.layer_mask.span();
    if (masks.empty()) return {};
    return masks[masks.size() == 1 ? 0 : s];
  }
  /// Whether any bound may be left out.
  [[nodiscard]] bool leave_out() const noexcept { return leave_out_; }

 private:
  [[nodiscard]] static bool leaves_out(const Query& query) noexcept {
    return !query.exclude.span().empty() || !query.exclude_each.empty() || !query.exclude_mask.empty() ||
           !query.layer_mask.span().empty();
  }
  [[nodiscard]] static bool asks_for_more(const Query& query) noexcept {
    return query.only || query.limit != Query::no_limit || query.triangle_test != TriangleTest::exact ||
           query.skip_overlapping;
  }

  void check(const Takes& takes, std::size_t shafts, std::size_t bounds, BoundKind kind, bool have_layers);
  void check_apart(const char* name, std::span<const std::byte> output, bool may_begin_at_only) const;

  const Query& query_;
  const char* call_;
  std::size_t each_ = 0;  ///< indices of exclude_each for each shaft
  bool leave_out_ = false;
};

}  // namespace shaftcull::kernel
