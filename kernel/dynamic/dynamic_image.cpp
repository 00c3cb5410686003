// SPDX-License-Identifier: MIT
/// Images of dynamic trees. Blocks are written as they lie in memory; where the bounds of indices are, and the nodes
/// above blocks, follow from them.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "dynamic/state_parts.hpp"
#include "dynamic/writer.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/tree_image.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "tree/image_header.hpp"

namespace shaftcull::kernel {
namespace {

/// The first three lines of an image. Behind them are the generations of all indices, the free indices, and the blocks,
/// each as a BlockRecord, its leaves, their indices, and their layers if there are any.
struct DynamicHeader {
  ImageHeader image;

  std::uint64_t count;
  std::uint64_t index_end;
  std::uint64_t free;
  std::uint64_t blocks;
  std::uint64_t numbers;  ///< of blocks are below this
  std::uint64_t node_size_count;
  float node_size;
  std::uint32_t has_layers;
  std::uint64_t is_any_in_other_layers;  ///< or was, changes that were never committed included

  double sorted_per_change;
  double saved;
  std::uint64_t sorted_last;
  std::uint64_t sorted_since_size;
  std::uint64_t next_looked_at;
  std::array<std::uint64_t, 3> unused;  ///< 0
};
static_assert(sizeof(DynamicHeader) == 3 * image_line && std::is_trivially_copyable_v<DynamicHeader>);

/// What a block is besides its leaves.
struct BlockRecord {
  std::uint32_t number;
  std::uint32_t count;
  std::uint32_t count_when_sorted;
  std::uint32_t empties;
  std::uint64_t changed;
  std::uint32_t is_large;
  std::uint32_t is_apart;
  double surface_when_sorted;
  double surface;
  std::uint64_t gaps;
  std::uint64_t unused;  ///< 0
  std::uint64_t taken[block_words];
  std::uint32_t word_layers[block_words];
  float node[6][block_words];
};
static_assert(sizeof(BlockRecord) % image_line == 0 && std::is_trivially_copyable_v<BlockRecord>);

template <class Bound>
constexpr ImageKind kind_of = std::is_same_v<Bound, Box> ? ImageKind::dynamic_boxes : ImageKind::dynamic_spheres;

template <class Bound>
std::uint64_t block_bytes(bool has_layers) noexcept {
  const std::uint64_t words = rows_of<Bound> + (has_layers ? 2 : 1);
  return sizeof(BlockRecord) + words * block_leaves * sizeof(float);
}

/// Of all but the blocks.
std::uint64_t bytes_before_blocks(const DynamicHeader& header) noexcept {
  return sizeof header + in_lines(header.index_end * sizeof(std::uint32_t)) +
         in_lines(header.free * sizeof(std::uint32_t));
}

template <class Bound>
DynamicHeader header_of(const DynamicTree<Bound>& tree) {
  DynamicHeader header{};
  header.sorted_per_change = Upkeep().per_change;
  if (const auto& writer = DynamicAccess::writer(tree)) {
    if (!writer->changes.empty()) {
      fail(InvalidArgument("the image of a dynamic tree whose changes wait; call commit() first"));
    }
    const DynamicState<Bound>& state = writer->state();
    header.count = state.count;
    header.index_end = writer->slots.size();
    header.free = writer->free.size();
    header.blocks = state.blocks.size();
    header.numbers = state.position_of.size();
    header.node_size_count = state.node_size_count;
    header.node_size = state.node_size;
    header.has_layers = state.has_layers ? 1 : 0;
    header.is_any_in_other_layers = writer->layers ? 1 : 0;
    header.sorted_per_change = writer->upkeep.per_change;
    header.saved = writer->upkeep.saved;
    header.sorted_last = writer->upkeep.sorted_last;
    header.sorted_since_size = writer->upkeep.sorted_since_size;
    header.next_looked_at = writer->upkeep.next_looked_at;
  }
  const std::uint64_t bytes = bytes_before_blocks(header) + header.blocks * block_bytes<Bound>(header.has_layers != 0);
  header.image = image_header(kind_of<Bound>, static_cast<std::size_t>(bytes));
  return header;
}

/// Copies all but leaves, to a record from a block or back.
template <class From, class To>
void copy_numbers(const From& from, To& to) noexcept {
  const auto copy = [](const auto& number, auto& copied) {
    copied = static_cast<std::remove_reference_t<decltype(copied)>>(number);
  };
  copy(from.count, to.count);
  copy(from.count_when_sorted, to.count_when_sorted);
  copy(from.empties, to.empties);
  copy(from.changed, to.changed);
  copy(from.is_large, to.is_large);
  copy(from.is_apart, to.is_apart);
  copy(from.surface_when_sorted, to.surface_when_sorted);
  copy(from.surface, to.surface);
  copy(from.gaps, to.gaps);
  std::copy_n(from.taken, block_words, to.taken);
  std::copy_n(from.word_layers, block_words, to.word_layers);
  std::copy_n(&from.node[0][0], 6 * block_words, &to.node[0][0]);
}

template <class Item>
std::byte* put(std::span<const Item> items, std::byte* to) noexcept {
  if (!items.empty()) std::memcpy(to, items.data(), items.size_bytes());
  return to + items.size_bytes();
}
template <class Item>
const std::byte* take(std::span<Item> items, const std::byte* from) noexcept {
  if (!items.empty()) std::memcpy(items.data(), from, items.size_bytes());
  return from + items.size_bytes();
}

template <class Bound>
void write_block(const LeafBlock<Bound>& block, std::uint32_t number, std::byte* to) noexcept {
  BlockRecord record{};
  record.number = number;
  copy_numbers(block, record);
  to = put(std::span<const BlockRecord>(&record, 1), to);
  to = put(std::span<const float>(block.floats()), to);
  to = put(std::span<const std::uint32_t>(block.order(), block_leaves), to);
  if (block.layers() != nullptr) put(std::span<const std::uint32_t>(block.layers(), block_leaves), to);
}

[[noreturn]] void refuse_damaged(const std::string& why) { refuse_image("is damaged: " + why); }

/// The header of an image, which may be one of such a tree.
template <class Bound>
DynamicHeader checked_header(std::span<const std::byte> image) {
  DynamicHeader header{};
  header.image = checked_image_header(image, kind_of<Bound>);
  if (image.size() < sizeof header) refuse_damaged("it ends within its header");
  std::memcpy(&header, image.data(), sizeof header);
  constexpr std::uint64_t most = std::uint64_t{1} << 32U;
  const bool is_possible =
      header.index_end <= most && header.free <= most && header.blocks <= most && header.numbers <= most &&
      header.has_layers <= 1 && header.count + header.free == header.index_end && header.blocks <= header.numbers &&
      (header.numbers != 0 || header.index_end == 0) &&
      bytes_before_blocks(header) + header.blocks * block_bytes<Bound>(header.has_layers != 0) == header.image.bytes;
  if (!is_possible) {
    refuse_damaged(std::to_string(header.count) + " bounds in " + std::to_string(header.blocks) +
                   " blocks do not take " + std::to_string(header.image.bytes) + " bytes");
  }
  if (!is_sealed(image, header.image)) refuse_damaged("its checksum is another");
  return header;
}

/// A dynamic tree from an image.
template <class Bound>
class FromImage {
 public:
  using Writer =
      typename std::remove_cvref_t<decltype(DynamicAccess::writer(std::declval<DynamicTree<Bound>&>()))>::element_type;

  FromImage(const DynamicHeader& header, std::span<const std::byte> image) : header_(header), image_(image) {}

  [[nodiscard]] std::unique_ptr<Writer> writer() {
    auto writer = std::make_unique<Writer>();
    writer->layers = header_.is_any_in_other_layers != 0;
    writer->count = static_cast<std::size_t>(header_.count);
    writer->upkeep.per_change = header_.sorted_per_change;
    writer->upkeep.saved = header_.saved;
    writer->upkeep.sorted_last = static_cast<std::size_t>(header_.sorted_last);
    writer->upkeep.sorted_since_size = static_cast<std::size_t>(header_.sorted_since_size);
    writer->upkeep.next_looked_at = static_cast<std::size_t>(header_.next_looked_at);
    writer->committed = DynamicAccess::snapshot_of<Bound>(state());
    take_ids(*writer);
    return writer;
  }

 private:
  Shared<StateOf<Bound>> state() {
    const bool has_layers = header_.has_layers != 0;
    const auto blocks = static_cast<std::size_t>(header_.blocks);
    std::vector<Shared<LeafBlock<Bound>>> block(blocks);
    for (Shared<LeafBlock<Bound>>& each : block) each = Shared<LeafBlock<Bound>>(new LeafBlock<Bound>(has_layers));
    std::vector<std::uint32_t> number(blocks);
    const std::byte* const first = image_.data() + bytes_before_blocks(header_);
    parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
      number[b] = read_block(*block[b], first + b * block_bytes<Bound>(has_layers));
    });
    require_numbers(number);
    require_count(block);

    const std::size_t page_count = LeafBlocks::pages_for(static_cast<std::size_t>(header_.index_end));
    std::vector<Shared<PlacePage>> pages;
    for (std::size_t i = 0; i != page_count; ++i) pages.push_back(Shared<PlacePage>(new PlacePage));
    Shared<StateOf<Bound>> state(new StateOf<Bound>);
    StateParts<Bound> parts;
    parts.prepare(blocks, static_cast<std::size_t>(header_.numbers), std::move(pages), has_layers);
    for (std::size_t b = 0; b != blocks; ++b) {
      parts.add(block[b], number[b]);
      write_places(*block[b], PlaceWriter(parts.places(), number[b]));
    }
    parts.move_to(*state, active_kernels());
    state->owns_pages = true;
    state->index_end = static_cast<std::size_t>(header_.index_end);
    state->count = static_cast<std::size_t>(header_.count);
    state->node_size = header_.node_size;
    state->node_size_count = static_cast<std::size_t>(header_.node_size_count);
    return state;
  }

  /// Returns the number of the block.
  std::uint32_t read_block(LeafBlock<Bound>& block, const std::byte* from) const noexcept {
    BlockRecord record;
    from = take(std::span(&record, 1), from);
    from = take(block.floats(), from);
    from = take(std::span(block.order(), block_leaves), from);
    if (block.layers() != nullptr) take(std::span(block.layers(), block_leaves), from);
    copy_numbers(record, block);
    return record.number;
  }

  /// Each block has a number of its own.
  void require_numbers(std::span<const std::uint32_t> numbers) const {
    std::vector<bool> is_used(static_cast<std::size_t>(header_.numbers));
    for (const std::uint32_t number : numbers) {
      if (number == number_of_nothing || number >= is_used.size() || is_used[number]) {
        refuse_damaged("a block has the number " + std::to_string(number));
      }
      is_used[number] = true;
    }
  }

  /// There are as many bounds as the header says, each with an index of its own.
  void require_count(std::span<const Shared<LeafBlock<Bound>>> blocks) const {
    std::vector<bool> is_used(static_cast<std::size_t>(header_.index_end));
    std::uint64_t count = 0;
    for (const Shared<LeafBlock<Bound>>& block : blocks) {
      for (std::size_t w = 0; w != block_words; ++w) {
        for (std::uint64_t left = block->taken[w]; left != 0; left &= left - 1) {
          const std::uint32_t index = block->order()[w * fanout + static_cast<std::size_t>(std::countr_zero(left))];
          if (index >= is_used.size() || is_used[index])
            refuse_damaged("no bound can have index " + std::to_string(index));
          is_used[index] = true;
          ++count;
        }
      }
    }
    if (count != header_.count) refuse_damaged("its blocks hold " + std::to_string(count) + " bounds");
  }

  void take_ids(Writer& writer) const {
    std::vector<std::uint32_t> generations(static_cast<std::size_t>(header_.index_end));
    take(std::span(generations), image_.data() + sizeof header_);
    writer.slots.resize(generations.size());
    for (std::size_t i = 0; i != generations.size(); ++i) {
      writer.slots[i].generation = generations[i];
      writer.slots[i].has_bound = writer.state().has(static_cast<std::uint32_t>(i)) ? 1 : 0;
    }
    writer.free.resize(static_cast<std::size_t>(header_.free));
    take(std::span(writer.free), image_.data() + sizeof header_ + in_lines(generations.size() * sizeof(std::uint32_t)));
    std::vector<bool> is_free(generations.size());
    for (const std::uint32_t index : writer.free) {
      if (index >= is_free.size() || is_free[index] || writer.slots[index].has_bound != 0) {
        refuse_damaged("index " + std::to_string(index) + " is not free");
      }
      is_free[index] = true;
    }
  }

  const DynamicHeader& header_;
  std::span<const std::byte> image_;
};

}  // namespace
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

template <class Bound>
std::size_t image_bytes(const DynamicTree<Bound>& tree) {
  return static_cast<std::size_t>(kernel::header_of(tree).image.bytes);
}

template <class Bound>
void write_image(const DynamicTree<Bound>& tree, std::span<std::byte> image) {
  const kernel::DynamicHeader header = kernel::header_of(tree);
  kernel::require_image_size(image, static_cast<std::size_t>(header.image.bytes));
  std::byte* next = image.data() + sizeof header;
  if (const auto& writer = DynamicAccess::writer(tree)) {
    const kernel::DynamicState<Bound>& state = writer->state();
    std::vector<std::uint32_t> generations(writer->slots.size());
    std::transform(writer->slots.begin(), writer->slots.end(), generations.begin(),
                   [](const kernel::Slot& slot) { return slot.generation; });
    next = kernel::copy_section(std::as_bytes(std::span(generations)), next);
    next = kernel::copy_section(std::as_bytes(std::span(writer->free)), next);
    const std::uint64_t bytes = kernel::block_bytes<Bound>(state.has_layers);
    kernel::parallel_for(state.blocks.size(), 1, [&](std::size_t b, std::size_t) {
      kernel::write_block(*state.blocks[b], state.number_of[b], next + b * bytes);
    });
  }
  std::memcpy(image.data(), &header, sizeof header);
  kernel::seal_image(image);
}

template <class Tree>
Tree dynamic_tree_from_image(std::span<const std::byte> image) {
  using Bound = std::decay_t<decltype(std::declval<const Tree&>()[BoundId()])>;
  return kernel::in_float_environment([&] {
    const kernel::DynamicHeader header = kernel::checked_header<Bound>(image);
    Tree tree;
    if (header.numbers == 0) return tree;  // of a tree that was never changed
    DynamicAccess::writer(tree) = kernel::FromImage<Bound>(header, image).writer();
    return tree;
  });
}

#define SHAFTCULL_IMAGE(Bound)                                                \
  template std::size_t image_bytes(const DynamicTree<Bound>&);                \
  template void write_image(const DynamicTree<Bound>&, std::span<std::byte>); \
  template DynamicTree<Bound> dynamic_tree_from_image(std::span<const std::byte>);
SHAFTCULL_IMAGE(Box)
SHAFTCULL_IMAGE(Sphere)
#undef SHAFTCULL_IMAGE

}  // namespace shaftcull
