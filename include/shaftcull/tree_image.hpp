// SPDX-License-Identifier: MIT
/// Trees as bytes: to keep them in files, and to share them among processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/export.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Bytes of the image of a tree, a multiple of 64; those of an empty tree, too. O(1). Throws NeedsRefit if its bounds
/// were updated since the last refit().
///
/// Tree is a BoundsTree of any kind or a TriangleTree, here and below.
template <class Tree>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t image_bytes(const Tree& tree);

/// Writes the image of a tree: its bounds, their order, nodes and layers, as they lie in memory. Trees of the same
/// bounds that were built alike have the same image to the byte, whatever the number of threads and the instruction
/// set. O(image_bytes(tree)), in parallel; the image has a checksum. Allocates nothing itself. Throws InvalidArgument
/// unless `image` has image_bytes(tree) bytes, at any alignment, or if the tree lies in them; NeedsRefit as above. If
/// oneTBB cannot start its tasks, std::bad_alloc is thrown, and what is in `image` is no image.
///
/// What is written depends on the version of its format and on the order of bytes of the machine. Images are for the
/// same version of the library, or for those that say that they read it; keep the bounds as well.
template <class Tree>
SHAFTCULL_EXPORT void write_image(const Tree& tree, std::span<std::byte> image);

/// What is checked of an image before it is used.
enum class ImageCheck : std::uint8_t {
  all,     ///< that it is an image of such a tree, whole, and what was written: O(bytes), some 8 GB/s
  header,  ///< all but the checksum: O(1). For images that nothing can have damaged: a query of one that was changed
           ///< may read and write any memory
};

/// A tree that lies in an image, of which nothing is copied: a file that was mapped into memory is asked as soon as it
/// is there, and processes that share the memory share the tree. Queries take tree() as any other, and give the same
/// answers in the same order, as fast.
///
/// The image is only read, so it may be in memory that cannot be written. It has to stay as long as this. tree() is
/// const; a copy of it, O(size()), owns its memory and is a tree like others. Queries of one object from many threads
/// are safe.
template <class Tree>
class TreeInImage {
 public:
  /// Throws InvalidArgument, which says why, for memory that is null, does not begin at a multiple of 64 bytes or does
  /// not hold the whole image of a Tree and nothing else; allocates some 500 bytes, std::bad_alloc.
  explicit TreeInImage(std::span<const std::byte> image, ImageCheck check = ImageCheck::all);

  /// Valid as long as this.
  [[nodiscard]] const Tree& tree() const noexcept { return tree_; }

 private:
  Tree tree_;
};

}  // namespace shaftcull
