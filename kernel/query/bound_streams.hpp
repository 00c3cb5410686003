// SPDX-License-Identifier: MIT
/// The bounds of a query as streams of floats, whatever their kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "shaftcull/query.hpp"

namespace shaftcull {

struct BoundsAccess {
  using From = std::variant<BoxView, SphereView, TriangleView, const BoxTree*, const SphereTree*, const TriangleTree*,
                            const BoxTreeSnapshot*, const SphereTreeSnapshot*>;

  static constexpr std::size_t first_tree = 3;  ///< of these alternatives
  static_assert(std::is_same_v<std::variant_alternative_t<first_tree, From>, const BoxTree*>);

  [[nodiscard]] static const From& from(const Bounds& bounds) noexcept { return bounds.from_; }
  [[nodiscard]] static std::span<const std::uint32_t> layers(const Bounds& bounds) noexcept { return bounds.layers_; }
};

}  // namespace shaftcull

namespace shaftcull::kernel {

enum class BoundKind : std::uint8_t { boxes, spheres, triangles };

/// The word for bounds of a kind, in messages.
[[nodiscard]] constexpr const char* noun_of(BoundKind kind) noexcept {
  return kind == BoundKind::boxes ? "boxes" : kind == BoundKind::spheres ? "spheres" : "triangles";
}

struct BoundSlice;

/// `count` bounds in separate streams: six of boxes, four of spheres, nine of triangles. Refers to the pointers of a
/// view, which outlives it: copies of these would cost a small query as much as the query itself.
struct BoundStreams {
  const float* const* stream = nullptr;
  std::size_t count = 0;
  BoundKind kind = BoundKind::boxes;
  std::uint8_t rows = 0;

  BoundStreams() noexcept = default;
  explicit BoundStreams(const BoxView& boxes) noexcept : BoundStreams(boxes.stream, boxes.count, BoundKind::boxes) {}
  explicit BoundStreams(const SphereView& spheres) noexcept
      : BoundStreams(spheres.stream, spheres.count, BoundKind::spheres) {}
  explicit BoundStreams(const TriangleView& triangles) noexcept
      : BoundStreams(triangles.stream, triangles.count, BoundKind::triangles) {}

  /// The bounds [first, first + size).
  [[nodiscard]] BoundSlice slice(std::size_t first, std::size_t size) const noexcept;
  [[nodiscard]] bool are_spheres() const noexcept { return kind == BoundKind::spheres; }
  // Whose pointers would be gone.
  explicit BoundStreams(const BoxView&&) = delete;
  explicit BoundStreams(const SphereView&&) = delete;
  explicit BoundStreams(const TriangleView&&) = delete;

 private:
  template <std::size_t size>
  BoundStreams(const std::array<const float*, size>& streams, std::size_t bounds, BoundKind of_kind) noexcept
      : stream(streams.data()), count(bounds), kind(of_kind), rows(size) {}
};

/// A part of streams, with pointers of its own.
struct BoundSlice : BoundStreams {
  BoundSlice(const BoundStreams& of, std::size_t first, std::size_t size) noexcept : BoundStreams(of) {
    for (std::size_t r = 0; r != rows; ++r) memory[r] = of.stream[r] + first;
    stream = memory.data();
    count = size;
  }
  BoundSlice(const BoundSlice&) = delete;
  BoundSlice& operator=(const BoundSlice&) = delete;

  std::array<const float*, 9> memory;
};

inline BoundSlice BoundStreams::slice(std::size_t first, std::size_t size) const noexcept {
  return {*this, first, size};
}

}  // namespace shaftcull::kernel
