// SPDX-License-Identifier: MIT
/// Bounds of a job in a tree: all of them, or a share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "batch/bounds_source.hpp"
#include "batch/dealt_bounds.hpp"
#include "batch/question.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/tree_image.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::batch {

/// A tree holds at most so many.
inline constexpr std::uint64_t most_bounds_a_share = 0xfffffffe;

/// Bytes a bound that building a share takes at its peak, and that it holds then; what is mapped from a file left out.
/// Of a share among several or of all bounds.
[[nodiscard]] std::uint64_t bytes_a_bound(BoundKind kind, bool several) noexcept;

/// A tree of a share of the bounds, and which these are. It owns its memory, or lies in an image: bytes that other
/// ranks, or a file, have.
class ShareTree {
 public:
  /// Sorts all bounds into a tree; parallel. Throws InvalidArgument, which names file and row, for a bound that cannot
  /// be used.
  explicit ShareTree(const BoundsSource& bounds);
  /// Likewise those of one of several shares.
  ShareTree(const BoundsSource& bounds, ShareBounds share);
  /// The share in an image, which write_image() wrote and which stays where it is. It begins at a multiple of 64 bytes
  /// in memory. Throws InvalidArgument if it cannot be one.
  ShareTree(BoundKind kind, std::span<const std::byte> image);
  ShareTree(const ShareTree&) = delete;
  ShareTree& operator=(const ShareTree&) = delete;
  ~ShareTree();

  /// Bytes of the image, a multiple of 64.
  [[nodiscard]] std::size_t image_bytes() const;
  /// Writes the image; parallel. There are image_bytes().
  void write_image(std::span<std::byte> image) const;

  /// Whether there are other shares.
  [[nodiscard]] bool is_one_of_several() const noexcept { return several_; }
  /// Around all bounds, if this is one of several shares.
  [[nodiscard]] const Box& box() const noexcept { return box_; }
  /// Positions in the file of the bounds of the tree, ascending; empty if they are the same.
  [[nodiscard]] std::span<const std::uint64_t> positions() const noexcept { return positions_; }

  /// The tree.
  [[nodiscard]] Bounds bounds() const {
    return std::visit([](const auto* tree) { return Bounds(*tree); }, tree_);
  }
  [[nodiscard]] bool has_spheres() const noexcept { return std::holds_alternative<const SphereTree*>(tree_); }

 private:
  struct Owned;
  struct InImage;

  std::variant<const BoxTree*, const SphereTree*, const TriangleTree*> tree_;
  std::span<const std::uint64_t> positions_;
  bool several_ = false;
  Box box_{};
  std::unique_ptr<Owned> owned_;
  std::unique_ptr<InImage> in_image_;
};

}  // namespace shaftcull::batch
