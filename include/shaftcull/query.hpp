// SPDX-License-Identifier: MIT
/// Which bounds a query is about, and its options. Every verb (cull.hpp, many.hpp, first_contact.hpp, occluded.hpp)
/// takes both:
///
///     list(shaft, tree, kept, {.exclude = {me, target}, .limit = 10});
///     cull(shaft, boxes, bits, {.layer_mask = {walls | props}});
///
/// *Answers do not depend on the container.* A view, a stream and a tree of the same bounds get the same bits and the
/// same counts. Lists of a view or a stream ascend; lists of a tree are in tree order (BoundsTree::order()), which
/// depends only on the bounds that the tree was last built or rebuilt from.
///
/// *Cost.* A view or a stream is scanned: O(count). A tree costs about 20 ns for each node or group of 64 bounds that
/// the shaft reaches, and what is written. Calls for one shaft run on the calling thread and allocate nothing. Calls
/// for many shafts run in parallel (many.hpp).
///
/// *Errors.* Before anything is written, a query throws NeedsRefit if a tree needs a refit, and InvalidArgument
///
/// * for a shaft that was never formed, or formed without the answer asked for, by its position among many;
/// * for a null pointer or span that is not empty, and for bounds of a kind that the verb does not take;
/// * for an option of the wrong size, an index that is not below the number of bounds, and an option that means nothing
///   to this verb or these bounds;
/// * for an output of the wrong size, or one that shares memory with another output or with an option.
///
/// Trees stay as they are, whatever a query throws. Queries are safe to make from many threads, and take at most 64 KiB
/// of the stack in an optimised build, so that small threads and fibers may make them.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The bounds that a query is about: a view, a stream or a tree, of boxes, spheres or triangles. It is made of each of
/// these where a call takes one. It refers to the memory of a view or stream and to the tree itself, which must live as
/// long as it is used. Some nanoseconds; no allocation.
class Bounds {
 public:
  // NOLINTBEGIN(google-explicit-constructor): containers go where bounds go

  /// Boxes, spheres or triangles of a view. `layers` are theirs, one set of bits for each, for Query::layer_mask: as
  /// many as bounds, or none.
  Bounds(const BoxView& boxes, std::span<const std::uint32_t> layers = {}) noexcept : from_(boxes), layers_(layers) {}
  Bounds(const SphereView& spheres, std::span<const std::uint32_t> layers = {}) noexcept
      : from_(spheres), layers_(layers) {}
  Bounds(const TriangleView& triangles, std::span<const std::uint32_t> layers = {}) noexcept
      : from_(triangles), layers_(layers) {}
  /// The same of a stream.
  Bounds(const BoxStream& boxes, std::span<const std::uint32_t> layers = {}) noexcept : Bounds(boxes.view(), layers) {}
  Bounds(const SphereStream& spheres, std::span<const std::uint32_t> layers = {}) noexcept
      : Bounds(spheres.view(), layers) {}
  Bounds(const TriangleStream& triangles, std::span<const std::uint32_t> layers = {}) noexcept
      : Bounds(triangles.view(), layers) {}
  /// A tree, whose layers are set by BoundsTree::set_layers(). A tree of triangles has none.
  Bounds(const BoxTree& tree) noexcept : from_(&tree) {}
  Bounds(const SphereTree& tree) noexcept : from_(&tree) {}
  Bounds(const TriangleTree& tree) noexcept : from_(&tree) {}
  // NOLINTEND(google-explicit-constructor)

  /// How many bounds there are.
  [[nodiscard]] std::size_t size() const noexcept {  // NOLINT(bugprone-exception-escape): the variant has a value
    return std::visit(
        [](const auto& from) {
          if constexpr (requires { from->size(); }) {
            return from->size();
          } else {
            return from.count;
          }
        },
        from_);
  }

 private:
  friend struct BoundsAccess;  // the library reads what they refer to

  std::variant<BoxView, SphereView, TriangleView, const BoxTree*, const SphereTree*, const TriangleTree*> from_;
  std::span<const std::uint32_t> layers_{};
};

/// Numbers that a query reads: a span of the caller's, which must live as long as the query, or up to eight in braces,
/// which are copied.
class Numbers {
 public:
  static constexpr std::size_t most_in_braces = 8;  ///< more are named as a span, a vector or an array

  constexpr Numbers() noexcept = default;
  /// A vector, an array or a span.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const std::uint32_t>>
  constexpr Numbers(const Range& numbers) noexcept  // NOLINT(google-explicit-constructor)
      : given_(numbers) {}
  /// Numbers in braces.
  template <std::convertible_to<std::uint32_t>... Number>
  requires(sizeof...(Number) != 0 &&
           sizeof...(Number) <=
               most_in_braces) constexpr Numbers(Number... number) noexcept  // NOLINT(google-explicit-constructor)
      : in_braces_{static_cast<std::uint32_t>(number)...}, count_(sizeof...(Number)) {}

  /// All of them. Valid as long as this object, and what it refers to.
  [[nodiscard]] constexpr std::span<const std::uint32_t> span() const noexcept {
    return count_ == 0 ? given_ : std::span<const std::uint32_t>(in_braces_, count_);
  }

 private:
  std::span<const std::uint32_t> given_{};
  std::uint32_t in_braces_[most_in_braces]{};
  std::size_t count_ = 0;
};

/// The options of a query. Each works with every container, view or tree, of boxes, spheres or triangles, except where
/// it says otherwise. A verb to which one means nothing refuses it by name.
struct Query {
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();  ///< all results

  /// Leaves these bounds out for all shafts, by index: a moving body itself, say. O(their number) for each group of
  /// bounds that is found; exclude_mask is the option for very many.
  Numbers exclude{};
  /// Leaves out bounds of its own for each shaft: a row of indices a shaft, rows of equal length, one behind the other.
  /// A shaft's own two objects, say.
  std::span<const std::uint32_t> exclude_each{};
  /// Leaves bound i out for all shafts if bit i % 64 of word i / 64 is set. Empty, or bit_words(number of bounds)
  /// words.
  std::span<const std::uint64_t> exclude_mask{};
  /// Leaves out every bound that is in none of these layers: layers & layer_mask == 0. One mask for all shafts or one
  /// for each; empty: bounds are asked about whatever their layers. The bounds must have layers
  /// (BoundsTree::set_layers(), or the second argument of Bounds). A tree passes over whole nodes.
  Numbers layer_mask{};
  /// Stops at so many results for each shaft, those that come first. Calls that count or list kept bounds, and
  /// list_occluders(), take it.
  std::size_t limit = no_limit;
  /// Asks only about these bounds, by index: the candidates that a larger shaft kept, say. Lists keep their order. Not
  /// given: all bounds are asked about. All verbs take it, except those of occluded.hpp. O(candidates) for each shaft.
  /// A tree that was never updated by index looks up the leaf of every index at the first such query, O(size()), and
  /// keeps that: 4 bytes a bound, so that call may throw std::bad_alloc. Calls for many shafts allocate a copy of the
  /// candidates' bounds.
  std::optional<std::span<const std::uint32_t>> only{};
  /// How triangles are tested. Other bounds take the default alone.
  TriangleTest triangle_test = TriangleTest::exact;
};

/// The options of most queries: none. A default argument that is made once, not for each call.
inline constexpr Query no_options{};

}  // namespace shaftcull
