// SPDX-License-Identifier: MIT
/// The options of a query, checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "compiled/shaft_data.hpp"
#include "query/bounds.hpp"
#include "query/question.hpp"
#include "shaftcull/query.hpp"

namespace shaftcull::kernel {

/// The options that a verb takes, besides those that leave bounds out.
struct Takes {
  bool limit = false;
  bool only = true;
};

/// Throws InvalidArgument unless all shafts answer the question for bounds of this kind, by position.
void require_answers_of(std::span<const ShaftData> shafts, Question question, BoundKind kind, TriangleTest test);

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

/// Refers to the query, which outlives it.
class Options {
 public:
  /// For a call of the name `call` about so many shafts and bounds. Throws InvalidArgument as shaftcull/query.hpp says.
  Options(const Query& query, const char* call, const Takes& takes, std::size_t shafts, std::size_t bounds,
          BoundKind kind, bool have_layers);

  /// Throws InvalidArgument if `output`, called `name` in the message, shares memory with an option. The beginning of
  /// `output` may be that of the candidates where `may_begin_at_only` says so.
  void require_apart(const char* name, std::span<const std::byte> output, bool may_begin_at_only = false) const;

  [[nodiscard]] const char* call() const noexcept { return call_; }
  [[nodiscard]] std::size_t limit() const noexcept { return limit_; }
  [[nodiscard]] bool has_limit() const noexcept { return limit_ != Query::no_limit; }
  [[nodiscard]] const std::optional<std::span<const std::uint32_t>>& only() const noexcept { return only_; }
  [[nodiscard]] TriangleTest triangle_test() const noexcept { return triangle_test_; }

  [[nodiscard]] ExcludedIndices excluded(std::size_t s) const noexcept {
    return {exclude_, exclude_each_.subspan(s * each_, each_), mask_};
  }
  /// The layers that shaft s asks for. Nothing if bounds of all layers and of none are asked about.
  [[nodiscard]] std::optional<std::uint32_t> layers(std::size_t s) const noexcept {
    if (layer_mask_.empty()) return {};
    return layer_mask_[layer_mask_.size() == 1 ? 0 : s];
  }
  /// Whether any bound may be left out.
  [[nodiscard]] bool leave_out() const noexcept {
    return !exclude_.empty() || each_ != 0 || !mask_.empty() || !layer_mask_.empty();
  }

 private:
  const char* call_;
  std::span<const std::uint32_t> exclude_;
  std::span<const std::uint32_t> exclude_each_;
  std::size_t each_ = 0;  ///< indices of exclude_each for each shaft
  std::span<const std::uint64_t> mask_;
  std::span<const std::uint32_t> layer_mask_;
  std::size_t limit_;
  std::optional<std::span<const std::uint32_t>> only_;
  TriangleTest triangle_test_;
};

}  // namespace shaftcull::kernel
