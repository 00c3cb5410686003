// SPDX-License-Identifier: MIT
/// The bounds and the options of a query. Every query function, called a *verb* (cull.hpp, many.hpp, first_contact.hpp,
/// occluded.hpp), takes both:
///
///     list(shaft, tree, kept, {.exclude = {me, target}, .limit = 10});
///     cull(shaft, boxes, bits, {.layer_mask = {walls | props}});
///
/// *Answers do not depend on the container.* A view, a stream and a tree of the same bounds give the same bits and the
/// same counts. Lists of a view or a stream ascend. Lists of a tree are in tree order (BoundsTree::order()), which
/// depends only on the bounds from which the tree was last built or rebuilt.
///
/// *Cost.* A view or a stream is scanned: O(count). A tree costs about 20 ns for each node or group of 64 bounds that
/// the shaft reaches, plus the time to write the results. Calls for one shaft run on the calling thread and allocate
/// nothing. Calls for many shafts run in parallel (many.hpp).
///
/// *Errors.* Before anything is written, a query throws NeedsRefit if a tree needs a refit, and InvalidArgument
///
/// * for a shaft that was never formed, with its position among many;
/// * for a null pointer or null span with a size above 0, and for bounds of a kind that the verb does not take;
/// * for an option of the wrong size, an index that is not below the number of bounds, and an option that does not
///   apply to the verb or the bounds;
/// * for an output of the wrong size, or one that shares memory with another output or with an option.
///
/// A query that throws leaves trees unchanged. Queries are safe to make from many threads. They take at most 64 KiB of
/// stack in an optimised build, so small threads and fibers can make them.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "shaftcull/dynamic_tree.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The bounds of a query: a view, a stream or a tree, of boxes, spheres or triangles; or a dynamic tree. Each of these
/// converts to Bounds. Bounds refer to the memory of the view or stream, or to the tree, which must live as long as the
/// Bounds are used. Making Bounds takes a few nanoseconds and allocates nothing.
class Bounds {
 public:
  // NOLINTBEGIN(google-explicit-constructor): containers convert to Bounds

  /// Boxes, spheres or triangles of a view. `layers`, for Query::layer_mask, has one set of bits per bound, or is
  /// empty.
  Bounds(const BoxView& boxes, std::span<const std::uint32_t> layers = {}) noexcept : from_(boxes), layers_(layers) {}
  Bounds(const SphereView& spheres, std::span<const std::uint32_t> layers = {}) noexcept
      : from_(spheres), layers_(layers) {}
  Bounds(const TriangleView& triangles, std::span<const std::uint32_t> layers = {}) noexcept
      : from_(triangles), layers_(layers) {}
  /// Boxes, spheres or triangles of a stream.
  Bounds(const BoxStream& boxes, std::span<const std::uint32_t> layers = {}) noexcept : Bounds(boxes.view(), layers) {}
  Bounds(const SphereStream& spheres, std::span<const std::uint32_t> layers = {}) noexcept
      : Bounds(spheres.view(), layers) {}
  Bounds(const TriangleStream& triangles, std::span<const std::uint32_t> layers = {}) noexcept
      : Bounds(triangles.view(), layers) {}
  /// A tree. BoundsTree::set_layers() sets its layers; a tree of triangles has none.
  Bounds(const BoxTree& tree) noexcept : from_(&tree) {}
  Bounds(const SphereTree& tree) noexcept : from_(&tree) {}
  Bounds(const TriangleTree& tree) noexcept : from_(&tree) {}
  /// A snapshot of a dynamic tree; or a dynamic tree itself, which stands for its last commit, until the next commit.
  Bounds(const BoxTreeSnapshot& snapshot) noexcept : from_(&snapshot) {}
  Bounds(const SphereTreeSnapshot& snapshot) noexcept : from_(&snapshot) {}
  Bounds(const DynamicBoxTree& tree) noexcept : Bounds(tree.committed()) {}
  Bounds(const DynamicSphereTree& tree) noexcept : Bounds(tree.committed()) {}
  // NOLINTEND(google-explicit-constructor)

  /// The number of bounds; for a dynamic tree, its index_end().
  [[nodiscard]] std::size_t size() const noexcept {  // NOLINT(bugprone-exception-escape): the variant has a value
    return std::visit(
        [](const auto& from) {
          if constexpr (requires { from->size(); }) {
            return from->size();
          } else if constexpr (requires { from->index_end(); }) {
            return from->index_end();
          } else {
            return from.count;
          }
        },
        from_);
  }

 private:
  friend struct BoundsAccess;  // the library reads the container

  std::variant<BoxView, SphereView, TriangleView, const BoxTree*, const SphereTree*, const TriangleTree*,
               const BoxTreeSnapshot*, const SphereTreeSnapshot*>
      from_;
  std::span<const std::uint32_t> layers_{};
};

/// Numbers that a query reads: a span of the caller's memory, which must live as long as the query, or up to eight
/// numbers in braces, which are copied.
class Numbers {
 public:
  static constexpr std::size_t most_in_braces = 8;  ///< pass more numbers as a span, a vector or an array

  constexpr Numbers() noexcept = default;
  /// A vector, an array or a span.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const std::uint32_t>>
  constexpr Numbers(const Range& numbers) noexcept  // NOLINT(google-explicit-constructor)
      : given_(numbers) {}
  /// Numbers in braces, of types with at most 32 bits: wider ones need a cast, which shows that they fit.
  template <std::integral... Number>
  requires(
      sizeof...(Number) != 0 && sizeof...(Number) <= most_in_braces &&
      ((sizeof(Number) <= sizeof(std::uint32_t) &&
        !std::same_as<Number,
                      bool>)&&...)) constexpr Numbers(Number... number) noexcept  // NOLINT(google-explicit-constructor)
      : in_braces_{static_cast<std::uint32_t>(number)...}, count_(sizeof...(Number)) {}

  /// All numbers. The span is valid as long as this object and the memory to which it refers.
  [[nodiscard]] constexpr std::span<const std::uint32_t> span() const noexcept {
    return count_ == 0 ? given_ : std::span<const std::uint32_t>(in_braces_, count_);
  }

 private:
  std::span<const std::uint32_t> given_{};
  std::uint32_t in_braces_[most_in_braces]{};
  std::size_t count_ = 0;
};

/// The options of a query. Each option works with views and trees, of boxes, spheres and triangles, unless it states
/// otherwise. A verb refuses an option that does not apply to it, and names the option.
struct Query {
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();  ///< all results

  /// Bounds to leave out for all shafts, by index: a moving body itself, for example. O(number of indices) for each
  /// group of bounds that is found; use exclude_mask for very many indices.
  Numbers exclude{};
  /// Bounds to leave out for each shaft: one row of indices per shaft, rows of equal length, row after row. Example:
  /// the two objects at the ends of each shaft.
  std::span<const std::uint32_t> exclude_each{};
  /// Bounds to leave out for all shafts, as bits: bound i is left out if bit i % 64 of word i / 64 is set. Empty, or
  /// bit_words(number of bounds) words.
  std::span<const std::uint64_t> exclude_mask{};
  /// Layers to search: a bound in none of them, layers & layer_mask == 0, is left out. One mask for all shafts, or one
  /// per shaft; if empty, layers are ignored. The bounds must have layers (BoundsTree::set_layers(), or the second
  /// argument of Bounds). A tree skips whole nodes.
  Numbers layer_mask{};
  /// Maximum number of results per shaft: the query stops after that many. Calls that count or list kept bounds, and
  /// list_occluders(), take this option.
  std::size_t limit = no_limit;
  /// The bounds to test, by index: the candidates that a larger shaft kept, for example. If not given, all bounds are
  /// tested. Lists keep the order of the candidates. All verbs take this option, except those of occluded.hpp.
  /// O(candidates) per shaft. A tree that was never updated by index looks up the leaf of every index at the first such
  /// query, O(size()), and keeps the result, 4 bytes per bound; that query may throw std::bad_alloc. Calls for many
  /// shafts allocate a copy of the candidates' bounds.
  std::optional<std::span<const std::uint32_t>> only{};
  /// Leaves out bounds that the moving box overlaps at the start, for first_contact() and first_contact_many():
  /// first_contact.hpp defines them.
  bool skip_overlapping = false;
  /// The test of triangles. Other bounds take only the default.
  TriangleTest triangle_test = TriangleTest::exact;
  std::uint64_t reserved[4] = {};  ///< for options of later versions
};

/// No options. A default argument that is made once, not for each call.
inline constexpr Query no_options{};

}  // namespace shaftcull
