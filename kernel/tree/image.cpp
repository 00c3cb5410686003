// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include "shaftcull/error.hpp"
#include "shaftcull/tree_image.hpp"
#include "streams/stream_access.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "tree/image_header.hpp"
#include "tree/tree_access.hpp"
#include "tree/triangle_parts.hpp"

namespace shaftcull::kernel {
namespace {

/// The first two lines of an image. Its sections are what a tree holds, in the order of for_sections().
struct TreeHeader {
  ImageHeader image;

  std::uint64_t size;  ///< of bounds
  double surface_when_built;
  std::uint32_t has_layers;
  std::uint32_t layers_of_any;
  std::uint32_t layers_of_all;
  std::uint32_t is_any_in_no_layer;
  std::uint64_t chunks;  ///< of triangles; from here on only theirs
  std::uint64_t short_chunk;
  std::uint64_t missing;
  std::uint64_t unused;
};
static_assert(sizeof(TreeHeader) == 2 * image_line && offsetof(TreeHeader, size) == image_line);
static_assert(std::is_trivially_copyable_v<TreeHeader>);

template <class Tree>
struct KindOf;
template <class Bound>
struct KindOf<BoundsTree<Bound>> {
  static constexpr ImageKind kind{rows_of<Bound>};
};
template <>
struct KindOf<TriangleTree> {
  static constexpr ImageKind kind = ImageKind::triangles;
};

/// Calls use(bytes) for everything that a tree holds in memory.
template <class Bound, class Use>
void for_sections(const TreeParts<Bound>& parts, const Use& use) {
  use(StreamAccess::memory(parts.leaves));
  use(StreamAccess::memory(parts.nodes));
  use(bytes_of(parts.gaps));
  use(bytes_of(parts.order));
  use(bytes_of(parts.least_index));
  use(bytes_of(parts.layers.leaves));
  use(bytes_of(parts.layers.nodes));
}
template <class Use>
void for_sections(const TriangleParts& parts, const Use& use) {
  use(StreamAccess::memory(parts.triangles));
  use(bytes_of(parts.order));
}

template <class Tree>
void require_refitted_for_image(const Tree& tree) {
  if (tree.needs_refit()) kernel::fail(NeedsRefit("the image of a tree whose bounds were updated; call refit() first"));
}

/// What a tree holds; null for an empty one.
template <class Bound>
const TreeParts<Bound>* parts_of(const BoundsTree<Bound>& tree) {
  require_refitted_for_image(tree);
  return tree.size() == 0 ? nullptr : TreeAccess::parts(tree);
}
const TriangleParts* parts_of(const TriangleTree& tree) {
  require_refitted_for_image(tree);
  return tree.size() == 0 ? nullptr : &TriangleTreeAccess::parts(tree);
}

template <class Bound>
void describe(const TreeParts<Bound>& parts, TreeHeader& header) noexcept {
  header.size = parts.size;
  header.surface_when_built = parts.surface_when_built;
  header.has_layers = parts.layers.exist() ? 1 : 0;
  header.layers_of_any = parts.layers.of_any;
  header.layers_of_all = parts.layers.of_all;
  header.is_any_in_no_layer = parts.layers.is_any_in_none ? 1 : 0;
}
void describe(const TriangleParts& parts, TreeHeader& header) noexcept {
  header.size = parts.order.size();
  header.chunks = parts.chunks.size();
  header.short_chunk = parts.short_chunk;
  header.missing = parts.missing;
}

/// Reads sections, one behind the other.
class ImageReader {
 public:
  explicit ImageReader(const std::byte* first) noexcept : next_(first) {}

  template <class Number>
  [[nodiscard]] std::span<const Number> take(std::size_t count) noexcept {
    const auto* const first = reinterpret_cast<const Number*>(next_);  // NOLINT(bugprone-casting-through-void)
    next_ += in_lines(count * sizeof(Number));
    return {first, count};
  }
  template <class Number>
  [[nodiscard]] TreeArray<Number> array(std::size_t count) noexcept {
    return TreeArray<Number>::in_place(take<Number>(count));
  }
  template <class Stream>
  [[nodiscard]] Stream stream(std::size_t count) noexcept {
    constexpr std::size_t rows = row_count<decltype(Stream().view())>;
    return StreamAccess::in_place<Stream>(take<float>(rows * row_floats(rows, count)).data(), count);
  }
  [[nodiscard]] const std::byte* next() const noexcept { return next_; }

 private:
  const std::byte* next_;
};

/// Bytes of the sections of a tree as a header describes it.
template <class Bound>
std::uint64_t section_bytes(const TreeHeader& header, const BoundsTree<Bound>& /*kind*/) noexcept {
  TreeLevels<Bound> levels;
  const std::size_t size = static_cast<std::size_t>(header.size);
  const std::size_t nodes = lay_out_levels(levels, size);
  const std::size_t words = bit_words(size);
  std::uint64_t bytes = rows_of<Bound> * row_floats(rows_of<Bound>, size) * sizeof(float) +
                        6 * row_floats(6, nodes) * sizeof(float) + in_lines(nodes / 64 * sizeof(std::uint64_t)) +
                        in_lines(size * sizeof(std::uint32_t)) + in_lines(words * sizeof(std::uint32_t));
  if (header.has_layers != 0) {
    bytes += in_lines(words * fanout * sizeof(std::uint32_t)) + in_lines(nodes * sizeof(std::uint32_t));
  }
  return bytes;
}
std::uint64_t section_bytes(const TreeHeader& header, const TriangleTree& /*kind*/) noexcept {
  const std::size_t size = static_cast<std::size_t>(header.size);
  TreeHeader chunks{};
  chunks.size = header.chunks;
  return 9 * row_floats(9, size) * sizeof(float) + in_lines(size * sizeof(std::uint32_t)) + sizeof(TreeHeader) +
         section_bytes(chunks, BoxTree());
}

/// Whether what a header says of a tree of triangles can be so.
template <class Tree>
bool are_chunks_possible(const TreeHeader& header) noexcept {
  if (!std::is_same_v<Tree, TriangleTree>) return true;
  constexpr std::size_t each = TriangleTree::chunk_size;
  return header.chunks == (header.size + each - 1) / each && header.short_chunk < header.chunks &&
         header.missing == header.chunks * each - header.size;
}

/// The header of an image, which may be one of such a tree.
template <class Tree>
TreeHeader checked_header(std::span<const std::byte> image, ImageCheck check) {
  require_memory("image", image, "bytes");
  if (check > ImageCheck::header) {
    kernel::fail(InvalidArgument("ImageCheck " + std::to_string(static_cast<unsigned>(check)) + " is none"));
  }
  if (reinterpret_cast<std::uintptr_t>(image.data()) % image_line != 0) {
    refuse_image("has to begin at a multiple of 64 bytes in memory; map its file, or read it to aligned memory");
  }
  (void)checked_image_header(image, KindOf<Tree>::kind);
  TreeHeader header;
  std::memcpy(&header, image.data(), sizeof header);
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  const bool is_possible = header.size == 0 || (header.size <= most && are_chunks_possible<Tree>(header));
  const std::uint64_t sections = header.size == 0 || !is_possible ? 0 : section_bytes(header, Tree());
  if (!is_possible || sizeof header + sections != header.image.bytes) {
    refuse_image("is damaged: " + std::to_string(header.size) + " bounds do not take " +
                 std::to_string(header.image.bytes) + " bytes");
  }
  if (check == ImageCheck::all && !is_sealed(image, header.image)) {
    refuse_image("is damaged: its checksum is another");
  }
  return header;
}

template <class Bound>
BoundsTree<Bound> tree_in(const TreeHeader& header, std::span<const std::byte> image,
                          const BoundsTree<Bound>& /*kind*/) {
  ImageReader reader(image.data() + sizeof header);
  TreeParts<Bound> parts;
  const std::size_t size = static_cast<std::size_t>(header.size);
  const std::size_t nodes = lay_out_levels(parts, size);
  parts.leaves = reader.stream<StreamOf<ViewOf<Bound>>>(size);
  parts.nodes = reader.stream<BoxStream>(nodes);
  parts.gaps = reader.array<std::uint64_t>(nodes / 64);
  parts.order = reader.array<std::uint32_t>(size);
  parts.least_index = reader.array<std::uint32_t>(bit_words(size));
  if (header.has_layers != 0) {
    parts.layers.leaves = reader.array<std::uint32_t>(bit_words(size) * fanout);
    parts.layers.nodes = reader.array<std::uint32_t>(nodes);
    parts.layers.of_any = header.layers_of_any;
    parts.layers.of_all = header.layers_of_all;
    parts.layers.is_any_in_none = header.is_any_in_no_layer != 0;
  }
  parts.surface_when_built = header.surface_when_built;
  return TreeAccess::tree_of(std::move(parts));
}

TriangleTree tree_in(const TreeHeader& header, std::span<const std::byte> image, const TriangleTree& /*kind*/) {
  ImageReader reader(image.data() + sizeof header);
  TriangleParts parts;
  const std::size_t size = static_cast<std::size_t>(header.size);
  parts.triangles = reader.stream<TriangleStream>(size);
  parts.order = reader.array<std::uint32_t>(size);
  const std::span<const std::byte> rest =
      image.last(static_cast<std::size_t>(image.data() + image.size() - reader.next()));
  const TreeHeader chunks = checked_header<BoxTree>(rest, ImageCheck::header);
  if (chunks.size != header.chunks) refuse_image("is damaged: it has boxes of other triangles");
  parts.chunks = tree_in(chunks, rest, BoxTree());
  parts.short_chunk = static_cast<std::size_t>(header.short_chunk);
  parts.missing = static_cast<std::size_t>(header.missing);
  return TriangleTreeAccess::tree_of(std::move(parts));
}

}  // namespace
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

template <class Tree>
std::size_t image_bytes(const Tree& tree) {
  std::size_t bytes = sizeof(kernel::TreeHeader);
  const auto* const parts = kernel::parts_of(tree);
  if (parts == nullptr) return bytes;
  kernel::for_sections(*parts, [&](std::span<const std::byte> section) { bytes += kernel::in_lines(section.size()); });
  if constexpr (std::is_same_v<Tree, TriangleTree>) bytes += image_bytes(parts->chunks);
  return bytes;
}

template <class Tree>
void write_image(const Tree& tree, std::span<std::byte> image) {
  const std::size_t bytes = image_bytes(tree);
  const auto* const parts = kernel::parts_of(tree);
  kernel::require_image_size(image, bytes);
  kernel::TreeHeader header{};
  header.image = kernel::image_header(kernel::KindOf<Tree>::kind, bytes);
  std::byte* next = image.data() + sizeof header;
  if (parts != nullptr) {
    kernel::for_sections(*parts, [&](std::span<const std::byte> section) {
      if (kernel::overlap(section, image)) kernel::refuse_shared_memory("write_image", "the image", "the tree");
    });
    kernel::describe(*parts, header);
    kernel::for_sections(*parts,
                         [&](std::span<const std::byte> section) { next = kernel::copy_section(section, next); });
    if constexpr (std::is_same_v<Tree, TriangleTree>) {
      write_image(parts->chunks, image.last(static_cast<std::size_t>(image.data() + image.size() - next)));
    }
  }
  std::memcpy(image.data(), &header, sizeof header);
  kernel::seal_image(image);
}

template <class Tree>
TreeInImage<Tree>::TreeInImage(std::span<const std::byte> image, ImageCheck check) {
  const kernel::TreeHeader header = kernel::checked_header<Tree>(image, check);
  if (header.size != 0) tree_ = kernel::tree_in(header, image, Tree());
}

#define SHAFTCULL_IMAGE(...)                                           \
  template std::size_t image_bytes(const __VA_ARGS__&);                \
  template void write_image(const __VA_ARGS__&, std::span<std::byte>); \
  template class TreeInImage<__VA_ARGS__>;
SHAFTCULL_IMAGE(BoxTree)
SHAFTCULL_IMAGE(SphereTree)
SHAFTCULL_IMAGE(TriangleTree)
#undef SHAFTCULL_IMAGE

}  // namespace shaftcull
