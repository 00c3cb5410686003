// SPDX-License-Identifier: MIT
/// Where bounds come from: the user's views and records, read one at a time and checked as in packing.
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "parallel/parallel.hpp"
#include "shaftcull/streams.hpp"
#include "streams/strided_reader.hpp"
#include "streams/view_reader.hpp"
#include "support/compiler.hpp"
#include "support/fail.hpp"
#include "support/index_range.hpp"
#include "support/prefetch.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// The reader of records of a kind of bound.
template <class Bound>
using ReaderOf = RecordReaderOf<ViewOf<Bound>>;

/// Separate streams.
template <class Bound>
using ViewSource = ViewReader<ViewOf<Bound>>;

/// Records, as their reader reads them.
template <class Bound, class Records = StridedOf<Bound>, class Reader = ReaderOf<Bound>>
class RecordSource {
 public:
  static constexpr std::size_t rows = rows_of<Bound>;
  explicit RecordSource(const Records& records)
      : reader_(records), start_(start_of(records)), stride_(records.stride) {}

  [[nodiscard]] std::size_t count() const noexcept { return reader_.count(); }
  void read(std::size_t i, float (&bound)[rows]) const noexcept { reader_.read(i, bound); }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t i) const noexcept {
    const char* const record = start_ + i * stride_;
    prefetch_to_second_level(record, 1);
    prefetch_to_second_level(record + sizeof(Bound) - 1, 1);  // may be in the next cache line
  }
  template <class Which>
  void read_four(Which which, float* const* row) const noexcept {
    reader_.read_four(which, row);
  }
  [[nodiscard]] bool is_legal(std::size_t i) const noexcept { return reader_.is_legal(i); }
  [[nodiscard]] bool are_clearly_legal(std::size_t first, std::size_t end) const noexcept {
    return reader_.are_clearly_legal(first, end);
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept { return reader_.overlaps(memory); }
  [[nodiscard]] std::string fault(std::size_t i) const { return reader_.fault(i); }

 private:
  static const char* start_of(const StridedBoxes& records) noexcept { return static_cast<const char*>(records.lo); }
  static const char* start_of(const StridedSpheres& records) noexcept {
    return static_cast<const char*>(records.centre);
  }
  static const char* start_of(const StridedCentreExtents& records) noexcept {
    return static_cast<const char*>(records.centre);
  }

  Reader reader_;
  const char* start_;
  std::size_t stride_;
};
using CentreExtentSource = RecordSource<Box, StridedCentreExtents, CentreExtentReader>;

/// Whether a source's bound is legal if, and only if, it is legal as it is packed. A box with a small negative half
/// extent is packed as a point.
template <class Source>
inline constexpr bool shows_faults_when_packed = !std::is_same_v<Source, CentreExtentSource>;

/// Bounds in a block, which one task reads.
inline constexpr std::size_t source_block = 16384;

/// Throws BadBound for the first illegal bound; checks in parallel, in the standard floating-point modes.
template <class Bound, class Source>
void require_legal(const Source& source) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> first_bad = none;
  const std::size_t blocks = chunk_count(source.count(), source_block);
  parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
    const IndexRange block = chunk_at(source.count(), source_block, b);
    const std::size_t bad = first_illegal(source, block.first, block.end());
    if (bad == block.end()) return;
    std::size_t before = first_bad.load(std::memory_order_relaxed);
    while (bad < before && !first_bad.compare_exchange_weak(before, bad, std::memory_order_relaxed)) {
    }
  });
  const std::size_t i = first_bad.load(std::memory_order_relaxed);
  if (i == none) return;
  kernel::fail(BadBound(i, std::string(ReaderOf<Bound>::noun) + " " + std::to_string(i) + ": " + source.fault(i)));
}

}  // namespace shaftcull::kernel
