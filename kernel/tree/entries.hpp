// SPDX-License-Identifier: MIT
/// Entries: what tree order is made from.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/kernel_table.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/streams.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Entries, in separate streams (kernels/kernel_table.hpp).
using EntryStreams = std::array<float*, entry_streams>;

/// What the last stream holds of an index.
[[nodiscard]] inline float index_bits(std::size_t index) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(index));
}

/// The index of entry i.
[[nodiscard]] inline std::uint32_t index_of(const EntryStreams& entries, std::size_t i) noexcept {
  return std::bit_cast<std::uint32_t>(entries[3][i]);
}

/// Entries are put in order class by class: see size_class().
inline constexpr unsigned size_classes = 10;

/// Entries of class c are [ClassBounds[c], ClassBounds[c + 1]).
using ClassBounds = std::array<std::size_t, size_classes + 1>;

/// Where entries are written, and records of the bounds themselves.
struct EntryPlace {
  EntryStreams entries;
  float* records;     ///< as many floats each as a bound has streams; null if none are wanted
  std::size_t bytes;  ///< of all this, and what is written along with it
};

/// Records of bounds as streams have them, one after the other.
template <class Bound>
[[nodiscard]] StridedOf<Bound> records_in(const float* first, std::size_t count) noexcept {
  if (count == 0) return {};
  return {first, first + 3, rows_of<Bound> * sizeof(float), count};
}

/// Scratch memory of a build: entries, as much memory to move them to, and the bounds themselves as records, because
/// tree order reads them from all over memory and a record is in one place, not in six.
template <class Bound, template <class> class Memory = TaskMemory>
class BuildScratch {
 public:
  explicit BuildScratch(std::size_t count)
      : stride_(bit_words(count) * 64 + apart),
        entries_(2 * entry_streams * stride_),
        records_(rows_of<Bound> * count) {}

  [[nodiscard]] EntryStreams entries() const noexcept { return streams(0); }
  [[nodiscard]] EntryStreams spare() const noexcept { return streams(entry_streams); }
  [[nodiscard]] EntryPlace place() const noexcept { return {entries(), records_.get(), bytes()}; }

  /// The bounds themselves.
  [[nodiscard]] float* records() const noexcept { return records_.get(); }

  [[nodiscard]] std::size_t bytes() const noexcept { return (entries_.size() + records_.size()) * sizeof(float); }

 private:
  /// Streams a power of two apart would map to the same few cache sets.
  static constexpr std::size_t apart = 80;

  [[nodiscard]] EntryStreams streams(std::size_t first) const noexcept {
    EntryStreams stream;
    for (std::size_t s = 0; s != entry_streams; ++s) stream[s] = entries_.get() + (first + s) * stride_;
    return stream;
  }

  std::size_t stride_;
  Memory<float> entries_;
  Memory<float> records_;
};

/// Writes all bounds' records and entries, these sorted by size class, and returns where each class begins. Throws
/// BadBound for the first illegal bound.
template <class Bound, class Source>
ClassBounds write_entries(const Source& source, const EntryPlace& place);

/// The size of a node of 64 small bounds (tree/size_class.hpp) among `count`, by a sample of the source.
template <class Bound, class Source>
[[nodiscard]] float node_size_of(const Source& source, std::size_t count);

/// Entries of legal bounds in records, sorted by class for nodes of that size, by one task.
template <class Bound>
ClassBounds write_entries_in_task(const float* records, std::size_t count, float node_size,
                                  const EntryStreams& entries) noexcept;

/// The same for legal bounds, in order, by one task. Both are wanted.
template <class Bound>
void write_entries_and_records(const ViewOf<Bound>& bounds, const EntryPlace& place) noexcept;

}  // namespace shaftcull::kernel
