// SPDX-License-Identifier: MIT
/// The verbs for one shaft (shaftcull/cull.hpp).
#include "shaftcull/cull.hpp"

#include <algorithm>
#include <variant>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"
#include "tree/tree_answers.hpp"
#include "verbs/asked.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::bytes_of;
using kernel::Question;
using kernel::TreeQuery;

/// Bits of bounds, called `name` in messages, have exactly the right size, and memory of their own.
void require_bits(const Asked& asked, const char* name, std::span<const std::uint64_t> words) {
  kernel::require_words(name, words, asked.size());
  asked.options().require_apart(name, bytes_of(words));
}

/// Indices, called `name` in messages, may be written there.
void require_indices(const Asked& asked, const char* name, std::span<const std::uint32_t> indices,
                     bool may_begin_at_only) {
  asked.require_index_width();
  kernel::require_memory(name, indices, "indices");
  asked.options().require_apart(name, bytes_of(indices), may_begin_at_only);
}

void write_bits(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  if (const TreeQuery* const walks = asked.walks()) return kernel::write_bits(*walks, 0, kept, inside);
  if (asked.options().only()) return asked.scan(0).write_bits(kept, inside);
  kernel::write_bits_of_view(asked.shafts()[0], asked.scanned(), asked.question(), asked.options(), asked.kernels(),
                             kept, inside);
}

std::size_t list_kept(const Asked& asked, std::span<std::uint32_t> kept) {
  const std::size_t limit = asked.options().limit();
  if (const TreeQuery* const walks = asked.walks()) return kernel::list(*walks, 0, kept, limit);
  return asked.scan(0).list(kept, limit);
}

/// The boxes of a view that a query without options asks about, or null. Asked costs some 20 ns, as much as a test of
/// 64 boxes.
const BoxView* plain_boxes(const Bounds& bounds, const Query& query) noexcept {
  if (kernel::Options::are_given(query) || !BoundsAccess::layers(bounds).empty()) return nullptr;
  return std::get_if<BoxView>(&BoundsAccess::from(bounds));
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

}  // namespace

void cull(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept, const Query& query) {
  if (const BoxView* const boxes = plain_boxes(bounds, query)) [[likely]] {
    kernel::require_formed(kernel::data_of(shaft), 0);
    kernel::require_view(*boxes);
    kernel::require_words("kept", kept, boxes->count);
    return write_plain_bits(shaft, *boxes, kept.data(), nullptr);
  }
  cull_bounds(shaft, bounds, kept, query);
}

void classify(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
              std::span<std::uint64_t> inside, const Query& query) {
  const bool wants_kept = !kept.empty();
  if (const BoxView* const boxes = plain_boxes(bounds, query)) [[likely]] {
    kernel::require_formed(kernel::data_of(shaft), 0);
    kernel::require_view(*boxes);
    if (wants_kept) kernel::require_words("kept", kept, boxes->count);
    kernel::require_words("inside", inside, boxes->count);
    kernel::require_apart("classify", "kept", bytes_of(kept), "inside", bytes_of(inside));
    return write_plain_bits(shaft, *boxes, wants_kept ? kept.data() : nullptr, inside.data());
  }
  classify_bounds(shaft, bounds, kept, inside, query);
}

std::size_t count(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("count", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  const std::size_t limit = asked.options().limit();
  if (const TreeQuery* const walks = asked.walks()) return kernel::count(*walks, 0, limit);
  return asked.scan(0).count(limit);
}

KeptCounts count_classified(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("count_classified", {&shaft, 1}, bounds, Question::kept_and_inside, query,
                    kernel::takes_candidates);
  if (const TreeQuery* const walks = asked.walks()) return kernel::count_classified(*walks, 0);
  return asked.scan(0).count_classified();
}

std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint32_t> kept, const Query& query) {
  const Asked asked("list", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  require_indices(asked, "kept", kept, true);
  return list_kept(asked, kept);
}

std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::vector<std::uint32_t>& kept,
                 const Query& query) {
  const Asked asked("list", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  require_indices(asked, "kept", kept, true);
  constexpr std::size_t least_room = 256;
  const bool holds_candidates =
      asked.options().only() && !kept.empty() && asked.options().only()->data() == kept.data();
  if (!holds_candidates) kept.resize(std::max(kept.size(), std::min(least_room, asked.size())));
  std::size_t size = list_kept(asked, kept);
  const bool fits = size <= kept.size();
  kept.resize(size);
  if (!fits) size = list_kept(asked, kept);
  return size;
}

KeptCounts list_classified(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside, const Query& query) {
  const Asked asked("list_classified", {&shaft, 1}, bounds, Question::kept_and_inside, query, kernel::takes_candidates);
  require_indices(asked, "overlap", overlap, false);
  require_indices(asked, "inside", inside, false);
  kernel::require_apart("list_classified", "overlap", bytes_of(overlap), "inside", bytes_of(inside));
  if (const TreeQuery* const walks = asked.walks()) return kernel::list_classified(*walks, 0, overlap, inside);
  return asked.scan(0).list_classified(overlap, inside);
}

bool any(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("any", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_candidates);
  if (const TreeQuery* const walks = asked.walks()) return kernel::any(*walks, 0);
  return asked.scan(0).any();
}

}  // namespace shaftcull
