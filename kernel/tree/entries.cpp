// SPDX-License-Identifier: MIT
#include "tree/entries.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "simd/word_writer.hpp"
#include "tree/size_class.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {
namespace {

/// Some of the legal bounds' centres, evenly spaced in the user's order.
template <class Bound, class Source>
std::vector<Vec3> sample_of(const Source& source) {
  constexpr std::size_t most = 1024;
  const std::size_t step = source.count() / most + 1;
  std::vector<Vec3> sample;
  for (std::size_t i = 0; i < source.count(); i += step) {
    float bound[rows_of<Bound>];
    source.read(i, bound);
    const Placement place = placement(bound);
    if (ReaderOf<Bound>::is_legal(bound) && place.extent >= 0) sample.push_back(place.centre);
  }
  return sample;
}

/// Some bounds in separate rows: loops over plain ones become vectors.
template <class Bound>
class Chunk {
 public:
  static constexpr std::size_t most = 64;

  template <class Source>
  Chunk(const Source& source, std::size_t first, std::size_t count) noexcept : first_(first), count_(count) {
    read_rows(source, InOrder{first}, count, rows_in(row_).data());
    unsigned others = 0;
    for (std::size_t i = 0; i != count; ++i) others |= is_plain(at(i).row) ? 0U : 1U;
    if (others == 0) {
      for (std::size_t i = 0; i != count; ++i) put(i, plain_placement(at(i).row));
    } else {
      for (std::size_t i = 0; i != count; ++i) put(i, placement(at(i).row));
      for (std::size_t i = 0; i != count; ++i) is_legal_ &= ReaderOf<Bound>::is_legal(at(i).row);
    }
    if constexpr (!shows_faults_when_packed<Source>) {
      is_legal_ = is_legal_ && first_illegal(source, first, first + count) == first + count;
    }
  }

  [[nodiscard]] bool is_legal() const noexcept { return is_legal_; }

  void write_records(float* record, const WordWriter& writer) const noexcept {
    alignas(64) float records[most * rows_of<Bound>];
    for (std::size_t i = 0; i != count_; ++i) {
      for (std::size_t s = 0; s != rows_of<Bound>; ++s) records[i * rows_of<Bound> + s] = row_[s][i];
    }
    writer.write(record, records, count_ * rows_of<Bound>);
  }

  void write_entries(const EntryStreams& entries, const WordWriter& writer) const noexcept {
    for (std::size_t k = 0; k != 3; ++k) writer.write(entries[k] + first_, centre_[k], count_);
    alignas(64) float index[most];
    for (std::size_t i = 0; i != count_; ++i) index[i] = index_bits(first_ + i);
    writer.write(entries[3] + first_, index, count_);
  }

  void count_classes(float node_size, std::array<std::size_t, size_classes>& counts) const noexcept {
    unsigned others = 0;
    for (std::size_t i = 0; i != count_; ++i) others |= is_small(extent_[i], node_size) ? 0U : 1U;
    if (others == 0) {
      counts[0] += count_;
      return;
    }
    for (std::size_t i = 0; i != count_; ++i) ++counts[size_class(extent_[i], node_size)];
  }

 private:
  struct BoundAt {
    float row[rows_of<Bound>];
  };
  [[nodiscard]] BoundAt at(std::size_t i) const noexcept {
    BoundAt bound;
    for (std::size_t s = 0; s != rows_of<Bound>; ++s) bound.row[s] = row_[s][i];
    return bound;
  }
  void put(std::size_t i, const Placement& place) noexcept {
    for (std::size_t k = 0; k != 3; ++k) centre_[k][i] = place.centre[k];
    extent_[i] = place.extent;
  }

  std::size_t first_;
  std::size_t count_;
  bool is_legal_ = true;
  float row_[rows_of<Bound>][most];
  alignas(64) float centre_[3][most];
  float extent_[most];
};

/// Writes the record and the entry of every bound in the user's order and counts classes; returns whether all bounds
/// are legal.
template <class Bound, class Source>
bool write_in_order(const Source& source, const IndexRange& range, float node_size, const EntryPlace& place,
                    std::array<std::size_t, size_classes>& counts) noexcept {
  const WordWriter writer(place.bytes);
  bool is_legal = true;
  for (std::size_t first = range.first; first < range.end(); first += Chunk<Bound>::most) {
    const Chunk<Bound> chunk(source, first, std::min(Chunk<Bound>::most, range.end() - first));
    is_legal &= chunk.is_legal();
    if (place.records != nullptr) chunk.write_records(place.records + first * rows_of<Bound>, writer);
    chunk.write_entries(place.entries, writer);
    chunk.count_classes(node_size, counts);
  }
  return is_legal;
}

/// Writes entries where those of their class go next.
template <class Bound, class Source>
void write_by_class(const Source& source, const EntryPlace& place, const IndexRange& range, float node_size,
                    std::array<std::size_t, size_classes> next) noexcept {
  const EntryStreams& entries = place.entries;
  for (std::size_t i = range.first; i != range.end(); ++i) {
    float bound[rows_of<Bound>];
    if (place.records != nullptr) {
      std::copy_n(place.records + i * rows_of<Bound>, rows_of<Bound>, bound);
    } else {
      source.read(i, bound);
    }
    const Placement at = placement(bound);
    const std::size_t to = next[size_class(at.extent, node_size)]++;
    for (std::size_t k = 0; k != 3; ++k) entries[k][to] = at.centre[k];
    entries[3][to] = index_bits(i);
  }
}

}  // namespace

template <class Bound, class Source>
float node_size_of(const Source& source, std::size_t count) {
  return usual_node_size(sample_of<Bound>(source), count);
}

template <class Bound, class Source>
ClassBounds write_entries(const Source& source, const EntryPlace& place) {
  const std::size_t count = source.count();
  const float node_size = node_size_of<Bound>(source, count);
  const std::size_t blocks = chunk_count(count, source_block);
  std::vector<std::array<std::size_t, size_classes>> places(blocks);  // counts at first
  std::atomic<bool> all_legal = true;
  parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
    if (write_in_order<Bound>(source, chunk_at(count, source_block, b), node_size, place, places[b])) return;
    all_legal.store(false, std::memory_order_relaxed);
  });
  if (!all_legal.load(std::memory_order_relaxed)) require_legal<Bound>(source);

  ClassBounds class_first;
  std::size_t next = 0;
  bool one_class = false;
  for (unsigned c = 0; c != size_classes; ++c) {
    class_first[c] = next;
    for (std::size_t b = 0; b != blocks; ++b) next += std::exchange(places[b][c], next);
    one_class = one_class || next - class_first[c] == count;
  }
  class_first[size_classes] = next;
  if (one_class) return class_first;  // they are in order already

  parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
    write_by_class<Bound>(source, place, chunk_at(count, source_block, b), node_size, places[b]);
  });
  return class_first;
}

template <class Bound>
ClassBounds write_entries_in_task(const float* records, std::size_t count, float node_size,
                                  const EntryStreams& entries) noexcept {
  const RecordSource<Bound> source(records_in<Bound>(records, count));
  const EntryPlace place{entries, nullptr, 0};
  std::array<std::size_t, size_classes> places{};  // counts at first
  write_in_order<Bound>(source, {0, count}, node_size, place, places);
  ClassBounds class_first;
  std::size_t next = 0;
  bool one_class = false;
  for (unsigned c = 0; c != size_classes; ++c) {
    class_first[c] = next;
    next += std::exchange(places[c], next);
    one_class = one_class || next - class_first[c] == count;
  }
  class_first[size_classes] = next;
  if (!one_class) write_by_class<Bound>(source, place, {0, count}, node_size, places);
  return class_first;
}

template <class Bound>
void write_entries_and_records(const ViewOf<Bound>& bounds, const EntryPlace& place) noexcept {
  const ViewSource<Bound> source(bounds);
  const WordWriter writer(place.bytes);
  for (std::size_t first = 0; first < bounds.count; first += Chunk<Bound>::most) {
    const Chunk<Bound> chunk(source, first, std::min(Chunk<Bound>::most, bounds.count - first));
    chunk.write_records(place.records + first * rows_of<Bound>, writer);
    chunk.write_entries(place.entries, writer);
  }
}

template float node_size_of<Box>(const RecordSource<Box>&, std::size_t);
template float node_size_of<Sphere>(const RecordSource<Sphere>&, std::size_t);
template ClassBounds write_entries_in_task<Box>(const float*, std::size_t, float, const EntryStreams&) noexcept;
template ClassBounds write_entries_in_task<Sphere>(const float*, std::size_t, float, const EntryStreams&) noexcept;

template void write_entries_and_records<Box>(const BoxView&, const EntryPlace&) noexcept;
template void write_entries_and_records<Sphere>(const SphereView&, const EntryPlace&) noexcept;

template ClassBounds write_entries<Box>(const ViewSource<Box>&, const EntryPlace&);
template ClassBounds write_entries<Box>(const RecordSource<Box>&, const EntryPlace&);
template ClassBounds write_entries<Box>(const CentreExtentSource&, const EntryPlace&);
template ClassBounds write_entries<Sphere>(const ViewSource<Sphere>&, const EntryPlace&);
template ClassBounds write_entries<Sphere>(const RecordSource<Sphere>&, const EntryPlace&);

}  // namespace shaftcull::kernel
