/// Entries: what tree order is made from.
#pragma once

#include <array>
#include <cstddef>

#include "run/task_memory.hpp"
#include "shaftcull/streams.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Entries, in separate streams: x, y and z of a bound's centre, which is finite, and its index, as the bits of a
/// float.
using EntryStreams = std::array<float*, 4>;

/// Entries are put in order class by class: see size_class().
inline constexpr unsigned size_classes = 10;

/// Entries of class c are [ClassBounds[c], ClassBounds[c + 1]).
using ClassBounds = std::array<std::size_t, size_classes + 1>;

/// What a tree is built in: entries, as much memory to move them to, and the bounds themselves as records, because tree
/// order reads them from all over memory and a record is in one place, not in six.
template <class Bound>
class Workshop {
 public:
  explicit Workshop(std::size_t count)
      : stride_(words_for(count) * 64 + apart), entries_(8 * stride_), records_(rows_of<Bound> * count) {}

  [[nodiscard]] EntryStreams entries() const noexcept { return streams(0); }
  [[nodiscard]] EntryStreams spare() const noexcept { return streams(4); }

  /// The streams' coordinates of bound i.
  [[nodiscard]] float* record(std::size_t i) const noexcept { return records_.get() + i * rows_of<Bound>; }

  [[nodiscard]] std::size_t bytes() const noexcept { return (entries_.size() + records_.size()) * sizeof(float); }

 private:
  /// Streams a power of two apart would share few places in the caches.
  static constexpr std::size_t apart = 80;

  [[nodiscard]] EntryStreams streams(std::size_t first) const noexcept {
    float* const start = entries_.get() + first * stride_;
    return {start, start + stride_, start + 2 * stride_, start + 3 * stride_};
  }

  std::size_t stride_;
  TaskMemory<float> entries_;
  TaskMemory<float> records_;
};

/// Writes all bounds' records and entries, these sorted by size class, and returns where each class begins. Throws
/// BadBound for the first illegal bound.
template <class Bound, class Source>
ClassBounds write_entries(const Source& source, const Workshop<Bound>& workshop);

}  // namespace shaftcull::kernel
