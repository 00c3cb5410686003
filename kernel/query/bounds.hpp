// SPDX-License-Identifier: MIT
/// The bounds of a query as streams of floats, whatever their kind.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>

#include "shaftcull/query.hpp"

namespace shaftcull {

struct BoundsAccess {
  using From = std::variant<BoxView, SphereView, TriangleView, const BoxTree*, const SphereTree*, const TriangleTree*>;

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

/// `count` bounds in separate streams: six of boxes, four of spheres, nine of triangles.
struct BoundStreams {
  std::array<const float*, 9> stream;
  std::size_t count;
  BoundKind kind;
  std::uint8_t rows;

  // NOLINTBEGIN(google-explicit-constructor): views go where streams go
  BoundStreams(const BoxView& boxes) noexcept : BoundStreams(boxes.stream, boxes.count, BoundKind::boxes) {}
  BoundStreams(const SphereView& spheres) noexcept : BoundStreams(spheres.stream, spheres.count, BoundKind::spheres) {}
  BoundStreams(const TriangleView& triangles) noexcept
      : BoundStreams(triangles.stream, triangles.count, BoundKind::triangles) {}
  // NOLINTEND(google-explicit-constructor)

  /// The bounds [first, first + size).
  [[nodiscard]] BoundStreams slice(std::size_t first, std::size_t size) const noexcept {
    BoundStreams part(*this);
    for (std::size_t r = 0; r != rows; ++r) part.stream[r] += first;
    part.count = size;
    return part;
  }
  [[nodiscard]] bool are_spheres() const noexcept { return kind == BoundKind::spheres; }

  /// The view that these streams were made of.
  template <class View>
  [[nodiscard]] View as() const noexcept {
    View view;
    std::copy_n(stream.begin(), view.stream.size(), view.stream.begin());
    view.count = count;
    return view;
  }

 private:
  template <std::size_t size>
  BoundStreams(const std::array<const float*, size>& streams, std::size_t bounds, BoundKind of_kind) noexcept
      : count(bounds), kind(of_kind), rows(size) {
    std::copy_n(streams.begin(), size, stream.begin());
  }
};

}  // namespace shaftcull::kernel
