// SPDX-License-Identifier: MIT
#include "flat/scan.hpp"

#include <algorithm>

#include "streams/rows.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {
namespace {

/// Candidates in a chunk. Their bounds are copied to the stack: 14 KB of the 64 that a call may take, beside the blocks
/// in which exact tests of triangles gather what is undecided.
constexpr std::size_t chunk_candidates = 384;

}  // namespace

Scan::Scan(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options,
           std::size_t s, const Kernels& kernels) noexcept
    : test_(kernels, question, bounds.streams.kind, options.triangle_test()),
      shaft_(shaft, test_.needs_planes(shaft)),
      bounds_(bounds),
      left_out_(options, s, bounds, kernels),
      question_(question) {}

void Scan::for_each_chunk_of_candidates(FunctionRef<bool(const ScannedChunk&)> visit) const {
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
    gather(bounds_, first, size, row.data());
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

}  // namespace shaftcull::kernel
