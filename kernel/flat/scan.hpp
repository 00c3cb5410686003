// SPDX-License-Identifier: MIT
/// One shaft against bounds in streams, chunk by chunk, whose bits stay on the stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "compiled/with_planes.hpp"
#include "flat/left_out.hpp"
#include "flat/scanned_bounds.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_test.hpp"
#include "query/counters.hpp"
#include "query/options.hpp"
#include "query/outputs.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/results.hpp"

namespace shaftcull::kernel {

/// Most bounds in a chunk: enough that the fixed cost of a kernel call vanishes, and few enough for bits on the stack.
inline constexpr std::size_t chunk_bounds = 16384;
/// The first chunk of a call that may end early; each has twice as many as the one before.
inline constexpr std::size_t first_chunk_bounds = 512;

/// Bits of bounds, or candidates, from `first` on, a multiple of 64. `inside` is null unless the question asks for it.
struct ScannedChunk {
  std::size_t first;
  std::size_t words;
  std::uint64_t* kept;
  const std::uint64_t* inside;
};

/// A checked question of one shaft. Refers to the bounds and the options. Its answers are those of shaftcull/cull.hpp.
class Scan {
 public:
  /// `s` is the position of the shaft among those that `options` are of.
  Scan(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options, std::size_t s,
       const Kernels& kernels) noexcept;
  Scan(const Scan&) = delete;
  Scan& operator=(const Scan&) = delete;

  /// Writes bits of candidates, by index. For Question::inside `kept` is null, for Question::kept `inside`.
  void write_bits(std::uint64_t* kept, std::uint64_t* inside) const noexcept;
  /// Gives a counter (query/counters.hpp) the bounds that the shaft keeps and that are not left out.
  template <class AnyCounter>
  void scan(AnyCounter& counter) const noexcept {
    for_each_chunk(EndsEarly<AnyCounter> ? first_chunk_bounds : chunk_bounds, [&](const ScannedChunk& chunk) {
      counter.words({nullptr, chunk.kept, chunk.inside, chunk.words});
      return !is_done(counter);
    });
  }
  /// Writes indices of kept bounds, `limit` at most, and returns how many there are.
  std::size_t list(std::span<std::uint32_t> kept, std::size_t limit) const noexcept;
  void list(GrowingOutput<std::uint32_t>& kept, std::size_t limit) const;
  KeptCounts list_classified(std::span<std::uint32_t> overlap, std::span<std::uint32_t> inside) const noexcept;
  /// The first index that list() writes.
  [[nodiscard]] std::optional<std::uint32_t> first_kept() const noexcept;
  /// Of boxes or spheres.
  [[nodiscard]] FirstContact first_contact() const noexcept;

 private:
  /// Calls visit(chunk) until it returns false. The first chunk has `chunk` bounds at most.
  using Visit = FunctionRef<bool(const ScannedChunk&)>;
  void for_each_chunk(std::size_t chunk, Visit visit) const;
  void for_each_chunk_of_view(std::size_t chunk, Visit visit) const;
  void for_each_chunk_of_candidates(Visit visit) const;
  template <class View>
  [[nodiscard]] FirstContact first_contact_of() const noexcept;

  [[nodiscard]] std::uint32_t index_of(std::size_t i) const noexcept {
    return bounds_.candidates ? (*bounds_.candidates)[i] : static_cast<std::uint32_t>(i);
  }

  BoundTest test_;
  WithPlanes shaft_;  // completed once, not chunk by chunk
  const ScannedBounds& bounds_;
  LeftOut left_out_;
  const Kernels& kernels_;
  Question question_;
};

/// Writes the bits of all bounds in streams, as Scan::write_bits().
void write_bits_of_view(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options,
                        const Kernels& kernels, std::uint64_t* kept, std::uint64_t* inside) noexcept;

}  // namespace shaftcull::kernel
