// SPDX-License-Identifier: MIT
/// Trees as bytes, to store in files and to share among processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/dynamic_tree.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The size in bytes of the image of a tree: a multiple of 64, for an empty tree too. O(1). Throws NeedsRefit if bounds
/// of the tree were updated since the last refit().
///
/// Here and below, Tree is a BoundsTree of any kind or a TriangleTree.
template <class Tree>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t image_bytes(const Tree& tree);

/// Writes the image of a tree: its bounds, their order, nodes and layers, as they lie in memory, and a checksum. Trees
/// of the same bounds that were built alike have the same image to the byte, whatever the number of threads and the
/// instruction set. O(image_bytes(tree)), in parallel. Allocates nothing itself. Throws NeedsRefit as above, and
/// InvalidArgument unless `image` has image_bytes(tree) bytes, at any alignment, or if it shares memory with the tree.
/// If oneTBB cannot start its tasks, the call throws std::bad_alloc, and `image` holds no image.
///
/// The bytes depend on the version of the image format and on the byte order of the machine. An image is for the
/// library version that wrote it, and for versions that state that they read it. Keep the bounds as well.
template <class Tree>
SHAFTCULL_EXPORT void write_image(const Tree& tree, std::span<std::byte> image);

/// The size in bytes of the image of a dynamic tree, a multiple of 64. O(1). Throws InvalidArgument if changes wait for
/// a commit().
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t image_bytes(const DynamicTree<Bound>& tree);

/// Writes the image of a dynamic tree: its bounds, their order, ids and layers, erased ids, and the state of the
/// upkeep. Dynamic trees with the same history of calls have the same image to the byte. O(image_bytes(tree)), in
/// parallel. Allocates 4 bytes per index. Throws InvalidArgument unless `image` has image_bytes(tree) bytes, at any
/// alignment, and if changes wait for a commit(). If memory runs out, it throws std::bad_alloc, and `image` holds no
/// image. A call that changes the tree must not run at the same time; queries and snapshots may.
template <class Bound>
SHAFTCULL_EXPORT void write_image(const DynamicTree<Bound>& tree, std::span<std::byte> image);

/// The dynamic tree whose image this is: a copy, which may be changed. All ids are valid that were valid in the tree
/// that was written, and no others. The same calls give the same answers, ids and order of lists as they would there.
/// `image` may be anywhere in memory. O(bytes), in parallel. Throws InvalidArgument, with the reason, for anything but
/// the whole image of such a tree, with the right checksum. Throws std::bad_alloc if memory runs out.
template <class Tree>
[[nodiscard]] SHAFTCULL_EXPORT Tree dynamic_tree_from_image(std::span<const std::byte> image);

/// The checks of an image before it is used.
enum class ImageCheck : std::uint8_t {
  all,     ///< it is a whole image of such a tree, and its checksum is right: O(bytes), about 8 GB/s
  header,  ///< all except the checksum: O(1). For images that cannot be damaged: a query of a changed image may read
           ///< and write any memory
};

/// A tree that lies in an image, without a copy. A tree in a file can be queried as soon as the file is mapped into
/// memory, and processes that share the memory share the tree. Queries accept tree() like any other tree, with the same
/// answers in the same order, at the same speed.
///
/// The image is only read, so it may be in read-only memory. It must outlive this object. tree() is const; a copy of
/// it, O(size()), owns its memory and is an ordinary tree. Queries of one object from many threads are safe.
template <class Tree>
class TreeInImage {
 public:
  /// Refers to the tree in `image`. Throws InvalidArgument, with the reason, for memory that is null, does not begin at
  /// a multiple of 64 bytes, or is not exactly the whole image of a Tree. Allocates about 500 bytes; may throw
  /// std::bad_alloc.
  explicit TreeInImage(std::span<const std::byte> image, ImageCheck check = ImageCheck::all);

  /// The tree. It is valid as long as this object.
  [[nodiscard]] const Tree& tree() const noexcept { return tree_; }

 private:
  Tree tree_;
};

}  // namespace shaftcull
