// SPDX-License-Identifier: MIT
/// Verbs of bits: cull() and classify(), of one shaft and of many.
#include <algorithm>

#include "dispatch/active_kernels.hpp"
#include "flat/batch_job.hpp"
#include "flat/scan.hpp"
#include "flat/tiling.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"
#include "tree/tree_query.hpp"
#include "verbs/asked.hpp"
#include "verbs/each_shaft.hpp"
#include "verbs/plain_boxes.hpp"
#include "verbs/stream_tests.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::bytes_of;
using kernel::IndexRange;
using kernel::Question;
using kernel::Scan;
using kernel::ScannedChunk;
using kernel::TreeQuery;

/// Bits of bounds, called `name` in messages, have exactly the right size, and memory of their own.
void require_bits(const Asked& asked, const char* name, std::span<const std::uint64_t> words) {
  kernel::require_words(name, words, asked.size());
  asked.options().require_apart(name, bytes_of(words));
}

void require_rows(const Asked& asked, const char* name, std::span<const std::uint64_t> words) {
  kernel::require_rows(name, words, asked.shafts().size(), asked.row_words());
  asked.options().require_apart(name, bytes_of(words));
}

/// Sets the bits of shaft s in rows of zeros, by the user's index. Rows that are null are not written.
void write_row_of_tree(const TreeQuery& walks, std::size_t s, std::uint64_t* kept, std::uint64_t* inside) {
  const auto bits_in = [&walks](std::uint64_t* row) { return kernel::IndexBits(walks.indices(), row); };
  kernel::KeptAndInsideLister visitor(bits_in(kept), bits_in(inside));
  walks.walk(s, visitor);
}

void write_row_of_candidates(const Scan& scan, std::uint64_t* kept, std::uint64_t* inside) {
  const auto set = [&scan](std::uint64_t* row, const ScannedChunk& chunk, const std::uint64_t* bits) {
    if (row == nullptr) return;
    kernel::for_each_bit(bits, chunk.words, [&](std::size_t i) {
      const std::uint32_t index = scan.index_of(chunk.first + i);
      row[index / 64] |= std::uint64_t{1} << index % 64;
      return true;
    });
  };
  scan.for_each_chunk(kernel::chunk_bounds, [&](const ScannedChunk& chunk) {
    set(kept, chunk, chunk.kept);
    set(inside, chunk, chunk.inside);
    return true;
  });
}

void write_row(const Asked& asked, std::size_t s, std::uint64_t* kept, std::uint64_t* inside) {
  if (kept != nullptr) std::fill_n(kept, asked.row_words(), 0);
  if (inside != nullptr) std::fill_n(inside, asked.row_words(), 0);
  if (const TreeQuery* const walks = asked.walks()) return write_row_of_tree(*walks, s, kept, inside);
  write_row_of_candidates(asked.scan(s), kept, inside);
}

/// Whether bits are of all bounds of a view.
bool are_of_view(const Asked& asked) noexcept { return asked.walks() == nullptr && !asked.options().only(); }

void write_bits(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  if (!are_of_view(asked)) return write_row(asked, 0, kept, inside);
  kernel::write_bits_of_view(asked.shafts()[0], asked.scanned(), asked.question(), asked.options(), asked.kernels(),
                             kept, inside);
}

void write_plain_bits(const CompiledShaft& shaft, const BoxView& boxes, std::uint64_t* kept, std::uint64_t* inside) {
  if (boxes.count == 0) return;
  const kernel::FloatEnvironment environment;
  kernel::active_kernels().boxes(kernel::data_of(shaft), boxes.stream.data(), boxes.count, kept, inside);
}

// Verbs of bits about all boxes of a view are short, and have no large stack: any other query goes on here.

SHAFTCULL_NOINLINE void cull_bounds(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                                    const Query& query) {
  const Asked asked("cull", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_candidates);
  require_bits(asked, "kept", kept);
  write_bits(asked, kept.data(), nullptr);
}

SHAFTCULL_NOINLINE void classify_bounds(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                                        std::span<std::uint64_t> inside, const Query& query) {
  const bool wants_kept = !kept.empty();
  const Asked asked("classify", {&shaft, 1}, bounds, wants_kept ? Question::kept_and_inside : Question::inside, query,
                    kernel::takes_candidates);
  if (wants_kept) require_bits(asked, "kept", kept);
  require_bits(asked, "inside", inside);
  kernel::require_apart("classify", "kept", bytes_of(kept), "inside", bytes_of(inside));
  write_bits(asked, wants_kept ? kept.data() : nullptr, inside.data());
}

/// Bits of a view: every task writes its words straight into the user's rows.
void write_rows_of_view(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  const kernel::StreamTests tests(asked);
  const kernel::BatchJob job(tests.get());
  const kernel::Tiling tiling(asked.size(), asked.shafts().size());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t first = group.first * asked.row_words() + block.first / 64;
    const kernel::Rows all_kept{kept, asked.row_words()};
    const kernel::Rows all_inside{inside, asked.row_words()};
    job.test(block, group, all_kept.from(first), all_inside.from(first));
  });
}

void write_rows(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  const std::size_t words = asked.row_words();
  if (words == 0) return;
  if (are_of_view(asked)) return write_rows_of_view(asked, kept, inside);
  const auto row = [words](std::uint64_t* rows, std::size_t s) { return rows == nullptr ? nullptr : rows + s * words; };
  kernel::for_each_shaft(asked, [&](std::size_t s) { write_row(asked, s, row(kept, s), row(inside, s)); });
}

}  // namespace

void cull(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept, const Query& query) {
  if (const BoxView* const boxes = kernel::plain_boxes(bounds, query)) [[likely]] {
    kernel::require_plain(shaft, *boxes);
    kernel::require_words("kept", kept, boxes->count);
    return write_plain_bits(shaft, *boxes, kept.data(), nullptr);
  }
  cull_bounds(shaft, bounds, kept, query);
}

void classify(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, const Query& query) {
  const bool wants_kept = !kept.empty();
  if (const BoxView* const boxes = kernel::plain_boxes(bounds, query)) [[likely]] {
    kernel::require_plain(shaft, *boxes);
    if (wants_kept) kernel::require_words("kept", kept, boxes->count);
    kernel::require_words("inside", inside, boxes->count);
    kernel::require_apart("classify", "kept", bytes_of(kept), "inside", bytes_of(inside));
    return write_plain_bits(shaft, *boxes, wants_kept ? kept.data() : nullptr, inside.data());
  }
  classify_bounds(shaft, bounds, kept, inside, query);
}

void cull_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_rows,
               const Query& query) {
  const Asked asked("cull_many", shafts, bounds, Question::kept, query, kernel::takes_candidates);
  require_rows(asked, "kept_rows", kept_rows);
  write_rows(asked, kept_rows.data(), nullptr);
}

void classify_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_rows,
                   std::span<std::uint64_t> inside_rows, const Query& query) {
  const bool wants_kept = !kept_rows.empty();
  const Asked asked("classify_many", shafts, bounds, wants_kept ? Question::kept_and_inside : Question::inside, query,
                    kernel::takes_candidates);
  if (wants_kept) require_rows(asked, "kept_rows", kept_rows);
  require_rows(asked, "inside_rows", inside_rows);
  kernel::require_apart("classify_many", "kept_rows", bytes_of(kept_rows), "inside_rows", bytes_of(inside_rows));
  write_rows(asked, wants_kept ? kept_rows.data() : nullptr, inside_rows.data());
}

}  // namespace shaftcull
