// SPDX-License-Identifier: MIT
#include "flat/scan.hpp"

#include <algorithm>
#include <bit>

#include "exact/first_entry.hpp"
#include "flat/index_writer.hpp"
#include "streams/rows.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {
namespace {

/// Candidates in a chunk: their bounds are copied to the stack.
constexpr std::size_t chunk_candidates = 512;

/// Chunks of a call that ends when it has found `limit` bounds.
constexpr std::size_t chunk_for(std::size_t limit) noexcept {
  return limit == Query::no_limit ? chunk_bounds : first_chunk_bounds;
}

/// Calls use(i) for every set bit, ascending, until it returns false.
template <class Use>
void for_each_bit(const std::uint64_t* bits, std::size_t words, const Use& use) {
  for (std::size_t w = 0; w != words; ++w) {
    for (std::uint64_t left = bits[w]; left != 0; left &= left - 1) {
      if (!use(64 * w + static_cast<std::size_t>(std::countr_zero(left)))) return;
    }
  }
}

}  // namespace

Scan::Scan(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options,
           std::size_t s, const Kernels& kernels) noexcept
    : test_(kernels, question, bounds.streams.kind, options.triangle_test()),
      shaft_(shaft, test_.needs_planes(shaft)),
      bounds_(bounds),
      left_out_(options, s, bounds, kernels),
      kernels_(kernels),
      question_(question) {}

void Scan::for_each_chunk(std::size_t chunk, Visit visit) const {
  const FloatEnvironment environment;
  if (bounds_.candidates) {
    for_each_chunk_of_candidates(visit);
  } else {
    for_each_chunk_of_view(chunk, visit);
  }
}

// Not inlined, so that the memory of one is not on the stack of the other.

SHAFTCULL_NOINLINE void Scan::for_each_chunk_of_view(std::size_t chunk, Visit visit) const {
  const BoundStreams& bounds = bounds_.streams;
  std::uint64_t kept[bit_words(chunk_bounds)];
  std::uint64_t inside_memory[bit_words(chunk_bounds)];
  std::uint64_t* const inside = asks_for_inside(question_) ? inside_memory : nullptr;
  // The first chunk has the pointers of the view: reading copies that have just been written would cost a small view
  // as much as its test.
  const float* const* stream = bounds.stream;
  const float* part[9];
  for (std::size_t first = 0; first != bounds.count;) {
    const std::size_t size = std::min(chunk, bounds.count - first);
    test_(shaft_.shaft(), stream, size, kept, inside);
    left_out_.clear(first, size, kept);
    left_out_.clear(first, size, inside);
    if (!visit({first, bit_words(size), kept, inside})) return;
    first += size;
    chunk = std::min(2 * chunk, chunk_bounds);
    for (std::size_t r = 0; r != bounds.rows; ++r) part[r] = bounds.stream[r] + first;
    stream = part;
  }
}

SHAFTCULL_NOINLINE void Scan::for_each_chunk_of_candidates(Visit visit) const {
  const std::span<const std::uint32_t> candidates = *bounds_.candidates;
  float memory[9][chunk_candidates];
  const std::array<float*, 9> row = rows_in(memory);
  const float* stream[9];
  std::copy(row.begin(), row.end(), stream);
  std::uint64_t kept[bit_words(chunk_candidates)];
  std::uint64_t inside_memory[bit_words(chunk_candidates)];
  std::uint64_t* const inside = asks_for_inside(question_) ? inside_memory : nullptr;
  for (std::size_t first = 0; first < candidates.size(); first += chunk_candidates) {
    const std::size_t size = std::min(chunk_candidates, candidates.size() - first);
    gather(bounds_.streams, candidates, bounds_.position, first, size, row.data());
    test_(shaft_.shaft(), stream, size, kept, inside);
    left_out_.clear(first, size, kept);
    left_out_.clear(first, size, inside);
    if (!visit({first, bit_words(size), kept, inside})) return;
  }
}

void write_bits_of_view(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options,
                        const Kernels& kernels, std::uint64_t* kept, std::uint64_t* inside) noexcept {
  const std::size_t count = bounds.streams.count;
  if (count == 0) return;
  const FloatEnvironment environment;
  const BoundTest test(kernels, question, bounds.streams.kind, options.triangle_test());
  test(shaft, bounds.streams.stream, count, kept, inside);
  if (!options.leave_out()) return;
  const LeftOut left_out(options, 0, bounds, kernels);
  left_out.clear(0, count, kept);
  left_out.clear(0, count, inside);
}

void Scan::write_bits(std::uint64_t* kept, std::uint64_t* inside) const noexcept {
  const auto set = [this](std::uint64_t* row, const ScannedChunk& chunk, const std::uint64_t* bits) {
    if (row == nullptr) return;
    for_each_bit(bits, chunk.words, [&](std::size_t i) {
      const std::uint32_t index = index_of(chunk.first + i);
      row[index / 64] |= std::uint64_t{1} << index % 64;
      return true;
    });
  };
  const std::size_t words = bit_words(bounds_.streams.count);
  if (kept != nullptr) std::fill_n(kept, words, 0);
  if (inside != nullptr) std::fill_n(inside, words, 0);
  for_each_chunk(chunk_bounds, [&](const ScannedChunk& chunk) {
    set(kept, chunk, chunk.kept);
    set(inside, chunk, chunk.inside);
    return true;
  });
}

std::size_t Scan::list(std::span<std::uint32_t> kept, std::size_t limit) const noexcept {
  if (limit == 0) return 0;
  const std::span<std::uint32_t> room = kept.first(std::min(kept.size(), limit));
  if (bounds_.candidates) {
    std::size_t count = 0;
    for_each_chunk(chunk_bounds, [&](const ScannedChunk& chunk) {
      for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        // Never ahead of what is read, so `kept` may be the candidates' own memory.
        if (count < room.size()) room[count] = index_of(chunk.first + i);
        return ++count != limit;
      });
      return count < limit;
    });
    return count;
  }
  IndexWriter listed(kernels_.set_bits, room);
  for_each_chunk(chunk_for(limit), [&](const ScannedChunk& chunk) {
    listed.add(chunk.first, chunk.kept, chunk.words);
    return listed.count() < limit;
  });
  return std::min(listed.count(), limit);
}

void Scan::list(GrowingOutput<std::uint32_t>& kept, std::size_t limit) const {
  const std::size_t before = kept.count();
  if (limit == 0) return;
  for_each_chunk(chunk_for(limit), [&](const ScannedChunk& chunk) {
    bool goes_on = true;
    for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
      kept.push(index_of(chunk.first + i));
      return goes_on = kept.count() - before < limit;
    });
    return goes_on;
  });
}

KeptCounts Scan::list_classified(std::span<std::uint32_t> overlap, std::span<std::uint32_t> inside) const noexcept {
  if (bounds_.candidates) {
    SpanOutput<std::uint32_t> overlaps(overlap);
    SpanOutput<std::uint32_t> insides(inside);
    for_each_chunk(chunk_bounds, [&](const ScannedChunk& chunk) {
      for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        const bool is_inside = (chunk.inside[i / 64] >> i % 64 & 1) != 0;
        (is_inside ? insides : overlaps).push(index_of(chunk.first + i));
        return true;
      });
      return true;
    });
    return {overlaps.count(), insides.count()};
  }
  IndexWriter overlaps(kernels_.set_bits, overlap);
  IndexWriter insides(kernels_.set_bits, inside);
  for_each_chunk(chunk_bounds, [&](const ScannedChunk& chunk) {
    for (std::size_t w = 0; w != chunk.words; ++w) chunk.kept[w] &= ~chunk.inside[w];
    overlaps.add(chunk.first, chunk.kept, chunk.words);
    insides.add(chunk.first, chunk.inside, chunk.words);
    return true;
  });
  return {overlaps.count(), insides.count()};
}

std::optional<std::uint32_t> Scan::first_kept() const noexcept {
  std::optional<std::uint32_t> first;
  for_each_chunk(first_chunk_bounds, [&](const ScannedChunk& chunk) {
    for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
      first = index_of(chunk.first + i);
      return false;
    });
    return !first.has_value();
  });
  return first;
}

template <class View>
FirstContact Scan::first_contact_of() const noexcept {
  return in_float_environment([this] {
    FirstEntry<View> first(shaft_.shaft());
    const float* const* const stream = bounds_.streams.stream;
    for_each_chunk(first_chunk_bounds, [&](const ScannedChunk& chunk) {
      for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        const std::uint32_t index = index_of(chunk.first + i);
        if (!bounds_.candidates && first.is_before_all_above(index)) return false;
        first.offer(stream, bounds_.candidates ? bounds_.position[index] : index, index);
        return true;
      });
      return bounds_.candidates || !first.is_before_all_above(chunk.first + 64 * chunk.words);
    });
    return first.contact();
  });
}

FirstContact Scan::first_contact() const noexcept {
  return bounds_.streams.are_spheres() ? first_contact_of<SphereView>() : first_contact_of<BoxView>();
}

}  // namespace shaftcull::kernel
