// SPDX-License-Identifier: MIT
/// Shafts, bounds and options in C and C++, and every question about them in both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "handles.hpp"
#include "oracle/random.hpp"
#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull::agreement {

using Words = std::vector<std::uint64_t>;
using Indices = std::vector<std::uint32_t>;

/// Shafts of all kinds, the same in both languages: first those between boxes, then other moving boxes, then hulls.
struct Shafts {
  std::vector<CompiledShaft> cpp;
  std::vector<ConvexHull> hulls;  // that the last of them refer to
  ShaftsHandle c;
  std::size_t between = 0;
  std::size_t moving = 0;
};
void make_shafts(Random& random, Shafts& shafts);

enum class Kind { boxes, spheres, triangles };

/// Options of a query, in no language yet. Those for each shaft are there for all shafts.
struct Options {
  std::string name;
  bool everywhere = false;  ///< asked of every shaft by itself, and not of some only
  bool null = false;        ///< C passes no query
  Indices exclude;
  Indices exclude_each;  ///< excluded_each a shaft
  Words exclude_mask;
  Indices layer_masks;  ///< none, one for all, or one for each shaft
  std::optional<Indices> only;
  std::size_t limit = 0;
  bool skip_overlapping = false;
  TriangleTest test = TriangleTest::exact;
};
inline constexpr std::size_t excluded_each = 40;

/// The same query in both languages, about `count` shafts from `first` on. Refers to the options.
class Asked {
 public:
  Asked(const Options& options, std::size_t first, std::size_t count)
      : each_(options.exclude_each.empty()
                  ? std::span<const std::uint32_t>()
                  : std::span(options.exclude_each).subspan(first * excluded_each, count * excluded_each)),
        masks_(options.layer_masks.size() <= 1 ? std::span(options.layer_masks)
                                               : std::span(options.layer_masks).subspan(first, count)),
        cpp_{.exclude = options.exclude,
             .exclude_each = each_,
             .exclude_mask = options.exclude_mask,
             .layer_mask = masks_,
             .limit = options.limit == 0 ? Query::no_limit : options.limit,
             .only = options.only ? std::optional(std::span(*options.only)) : std::nullopt,
             .skip_overlapping = options.skip_overlapping,
             .triangle_test = options.test},
        is_null_(options.null) {
    static constexpr std::uint32_t no_candidates = 0;  // not NULL
    c_.exclude = options.exclude.data();
    c_.exclude_count = options.exclude.size();
    c_.exclude_each = each_.data();
    c_.exclude_each_count = each_.size();
    c_.exclude_mask = options.exclude_mask.data();
    c_.exclude_mask_words = options.exclude_mask.size();
    c_.layer_masks = masks_.data();
    c_.layer_mask_count = masks_.size();
    if (options.only) {
      c_.only = options.only->empty() ? &no_candidates : options.only->data();
      c_.only_count = options.only->size();
    }
    c_.limit = options.limit;
    c_.skip_overlapping = options.skip_overlapping ? 1 : 0;
    c_.triangle_test =
        options.test == TriangleTest::exact ? SHAFTCULL_TRIANGLES_EXACT : SHAFTCULL_TRIANGLES_BY_VERTICES;
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  [[nodiscard]] const Query& cpp() const { return cpp_; }
  [[nodiscard]] const shaftcull_query* c() const { return is_null_ ? nullptr : &c_; }

 private:
  std::span<const std::uint32_t> each_;
  std::span<const std::uint32_t> masks_;
  Query cpp_;
  shaftcull_query c_{};
  bool is_null_;
};

/// Shafts and bounds in both languages.
struct Case {
  const Shafts& shafts;
  const shaftcull_bounds* c;
  Bounds cpp;
  Kind kind;
  bool has_layers;
};

/// The queries about a case.
struct Question {
  const Case& of;
  const Options& options;
  std::size_t start = 0;  ///< the first shaft that is asked by itself
  std::size_t step = 1;   ///< and how far it is to the next one

  [[nodiscard]] const shaftcull_shafts* shafts() const { return of.shafts.c.get(); }
  [[nodiscard]] const CompiledShaft& shaft(std::size_t s) const { return of.shafts.cpp[s]; }
  [[nodiscard]] std::size_t size() const { return of.cpp.size(); }
  /// How many of the shafts answer.
  [[nodiscard]] std::size_t count() const { return of.shafts.cpp.size(); }

  /// Whether the options mean something to these bounds.
  [[nodiscard]] bool fits() const {
    return (of.kind == Kind::triangles || options.test == TriangleTest::exact) &&
           (of.has_layers || options.layer_masks.empty()) && !options.skip_overlapping;
  }
  /// ... and to a verb that takes no limit.
  [[nodiscard]] bool fits_without_limit() const { return fits() && options.limit == 0; }
};

/// Asks all questions with these options. Some shafts are asked by themselves, others with other options.
void compare(const Case& of, const std::vector<Options>& all);

}  // namespace shaftcull::agreement
