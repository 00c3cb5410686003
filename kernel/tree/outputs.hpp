/// Where lists go: into the caller's memory, into memory that grows, or into pieces of it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "run/parallel.hpp"
#include "tree/leaf_indices.hpp"

namespace shaftcull::kernel {

// Those of items, all but the last, have the same interface, or as much of it as they are used for:
//   room()          where `most_added` items may be written, or null
//   advance(items)  so many were written there
//   push(item)      adds one
//   last()          the item added last, or null if it was not written
//   count()         how many there are

/// Items that a list adds at most between two looks at the room there is: a word of leaves.
inline constexpr std::size_t most_added = 64;

/// Room in the caller's memory: what does not fit is counted only.
template <class Item>
class SpanOutput {
 public:
  explicit SpanOutput(std::span<Item> room) noexcept : room_(room) {}

  [[nodiscard]] Item* room() noexcept { return count_ + most_added <= room_.size() ? room_.data() + count_ : nullptr; }
  void advance(std::size_t items) noexcept { count_ += items; }
  void push(Item item) noexcept {
    if (count_ < room_.size()) room_[count_] = item;
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] Item* last() noexcept { return count_ <= room_.size() ? room_.data() + count_ - 1 : nullptr; }

 private:
  std::span<Item> room_;
  std::size_t count_ = 0;
};

/// Memory that grows, in one piece.
template <class Item>
class GrowingOutput {
 public:
  GrowingOutput() noexcept = default;
  GrowingOutput(GrowingOutput&& other) noexcept
      : items_(std::exchange(other.items_, nullptr)),
        count_(std::exchange(other.count_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  GrowingOutput& operator=(GrowingOutput&&) = delete;
  ~GrowingOutput() {
    if (items_ != nullptr) Allocator().deallocate(items_, capacity_);
  }

  [[nodiscard]] Item* room() {
    if (capacity_ - count_ < most_added) grow();
    return items_ + count_;
  }
  void advance(std::size_t items) noexcept { count_ += items; }
  void push(Item item) {
    *room() = item;
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] Item* last() noexcept { return items_ + count_ - 1; }
  [[nodiscard]] const Item* data() const noexcept { return items_; }
  void clear() noexcept { count_ = 0; }

 private:
  using Allocator = TaskAllocator<Item>;

  void grow() {
    const std::size_t capacity = std::max(16 * most_added, 2 * capacity_);
    Item* const items = Allocator().allocate(capacity);
    std::copy(items_, items_ + count_, items);
    if (items_ != nullptr) Allocator().deallocate(items_, capacity_);
    items_ = items;
    capacity_ = capacity;
  }

  Item* items_ = nullptr;
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
};

/// Memory that grows in pieces, so that nothing is copied on the way.
template <class Item>
class PiecewiseOutput {
 public:
  [[nodiscard]] Item* room() {
    if (pieces_.empty() || pieces_.back().size > pieces_.back().room - most_added) {
      pieces_.emplace_back(std::clamp(count_, least_piece, most_piece));
    }
    return pieces_.back().end();
  }
  void advance(std::size_t items) noexcept {
    pieces_.back().size += items;
    count_ += items;
  }
  void push(Item item) {
    *room() = item;
    advance(1);
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] Item* last() noexcept { return pieces_.back().end() - 1; }

  /// Calls use(items, count) for piece after piece.
  template <class Use>
  void for_each_piece(const Use& use) const {
    for (const Piece& piece : pieces_) use(static_cast<const Item*>(piece.items), piece.size);
  }

 private:
  using Allocator = TaskAllocator<Item>;
  static constexpr std::size_t least_piece = 1024;
  static constexpr std::size_t most_piece = std::size_t{1} << 17;

  struct Piece {
    explicit Piece(std::size_t items_at_most) : items(Allocator().allocate(items_at_most)), room(items_at_most) {}
    Piece(Piece&& other) noexcept : items(std::exchange(other.items, nullptr)), room(other.room), size(other.size) {}
    Piece& operator=(Piece&&) = delete;
    ~Piece() {
      if (items != nullptr) Allocator().deallocate(items, room);
    }
    [[nodiscard]] Item* end() const noexcept { return items + size; }

    Item* items;
    std::size_t room;
    std::size_t size = 0;
  };

  std::vector<Piece> pieces_;
  std::size_t count_ = 0;
};

/// Leaves that a shaft keeps, before it is known where their indices go: words of them, and runs that are kept as a whole.
/// From four leaves a word on that takes less memory than indices, and these are not copied once more.
template <class Index>
class FoundOutput {
 public:
  void add_word(std::size_t first, std::uint64_t bits) {
    if (bits == 0) return;
    found_.push({bits, static_cast<Index>(first), 0});
    count_ += static_cast<std::size_t>(std::popcount(bits));
  }
  void add_run(std::size_t first, std::size_t size) {
    found_.push({0, static_cast<Index>(first), static_cast<Index>(size)});
    count_ += size;
  }
  /// Number of leaves.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Writes their indices from `out` on, count() of them and nothing else.
  void write(const LeafIndices<Index>& indices, Index* out) const noexcept {
    const Index* const end = out + count_;
    found_.for_each_piece([&](const Found* found, std::size_t size) {
      for (std::size_t i = 0; i != size; ++i) {
        if (i + fetched_words < size) indices.fetch(found[i + fetched_words].first);
        const auto [bits, first, run] = found[i];
        if (run != 0) {
          out = indices.copy(first, run, out);
        } else if (end - out >= static_cast<std::ptrdiff_t>(most_added)) {
          out += indices.pick(first, bits, out);
        } else {
          out += indices.pick_only(first, bits, out);  // what follows is somebody else's
        }
      }
    });
  }

 private:
  /// A word's bits, or a run of whole words.
  struct Found {
    std::uint64_t bits;
    Index first;
    Index run;  ///< size, or 0 for a word
  };
  /// Words ahead of the one written whose indices are fetched.
  static constexpr std::size_t fetched_words = 16;

  PiecewiseOutput<Found> found_;
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
