// SPDX-License-Identifier: MIT
/// first_contact() and first_contact_many(). Of a view, a task of many shafts looks for the first bound among its own,
/// and then compares it with those of other tasks.
#include "shaftcull/first_contact.hpp"

#include <algorithm>

#include "compiled/answers.hpp"
#include "exact/first_entry.hpp"
#include "flat/batch_job.hpp"
#include "flat/scan.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"
#include "support/arguments.hpp"
#include "verbs/asked.hpp"
#include "verbs/each_shaft.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::IndexRange;
using kernel::Question;

constexpr kernel::Takes takes_skip{.skip_overlapping = true};

void require_askable(const Asked& asked) {
  asked.require_no_triangles();
  asked.require_index_width();
  for (std::size_t s = 0; s != asked.shafts().size(); ++s) kernel::require_motion(asked.shafts()[s], s);
}

/// By a scan of bounds in streams, or of candidates.
template <class View>
FirstContact contact_of_scan(const Asked& asked, std::size_t s) {
  const kernel::Scan scan = asked.scan(s);
  const kernel::ScannedBounds& bounds = asked.scanned();
  return kernel::in_float_environment([&] {
    kernel::FirstEntry<View> first(asked.shafts()[s], asked.options().skip_overlapping());
    scan.for_each_chunk(kernel::first_chunk_bounds, [&](const kernel::ScannedChunk& chunk) {
      kernel::for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        const std::uint32_t index = scan.index_of(chunk.first + i);
        if (!bounds.candidates && first.is_before_all_above(index)) return false;
        const kernel::BoundPlace bound = bounds.at(bounds.candidates ? bounds.position[index] : index);
        first.offer(bound.stream, bound.i, index);
        return true;
      });
      return bounds.candidates || !first.is_before_all_above(chunk.first + 64 * chunk.words);
    });
    return first.contact();
  });
}

FirstContact contact_of(const Asked& asked, std::size_t s) {
  if (const auto* const boxes = asked.walks_of<Box>()) return boxes->first_contact(s);
  if (const auto* const spheres = asked.walks_of<Sphere>()) return spheres->first_contact(s);
  return asked.kind() == kernel::BoundKind::spheres ? contact_of_scan<SphereView>(asked, s)
                                                    : contact_of_scan<BoxView>(asked, s);
}

/// Offers the bounds from `from` on whose bits are set. Bounds are offered in order.
template <class View>
void offer(kernel::FirstEntry<View>& first, const kernel::BoundStreams& bounds, std::size_t from,
           const std::uint64_t* kept, std::size_t words) noexcept {
  kernel::for_each_bit(kept, words, [&](std::size_t bit) {
    const std::size_t i = from + bit;
    if (first.is_before_all_above(i)) return false;
    first.offer(bounds.stream, i, i);
    return true;
  });
}

/// Makes bound `index` the first one that shaft s reaches, unless the one in `first` comes before it.
template <class View>
void hand_over(const kernel::ShaftData& shaft, const kernel::BoundStreams& bounds, std::uint32_t index,
               std::uint32_t& first) noexcept {
  const kernel::SharedNumber<std::uint32_t> best(first);
  std::uint32_t other = best.load();
  for (;;) {
    kernel::FirstEntry<View> both(shaft);
    both.offer(bounds.stream, index, index);
    if (other != FirstContact::none) both.offer(bounds.stream, other, other);
    if (both.index() == other) return;
    if (best.exchange(other, index)) return;
  }
}

template <class View>
void write_contacts(const Asked& asked, std::span<FirstContact> contacts) {
  const std::span<const kernel::ShaftData> shafts = asked.shafts();
  const kernel::BoundStreams& bounds = asked.scanned().streams;
  const kernel::ShaftTests tests(shafts, asked.scanned(), asked.question(), asked.options(), asked.kernels());
  const kernel::BatchJob job(tests);
  std::fill(contacts.begin(), contacts.end(), FirstContact());
  const kernel::Tiling tiling(bounds.count, shafts.size());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t words = bit_words(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    std::uint64_t* const kept = bits.get();
    job.test(block, group, {kept, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      const kernel::ShaftData& shaft = shafts[group.first + s];
      kernel::FirstEntry<View> first(shaft, asked.options().skip_overlapping());
      offer(first, bounds, block.first, kept + s * words, words);
      if (!first.is_there()) continue;
      hand_over<View>(shaft, bounds, static_cast<std::uint32_t>(first.index()), contacts[group.first + s].index);
    }
  });
  kernel::in_float_environment([&] {
    for (std::size_t s = 0; s != contacts.size(); ++s) {
      if (!contacts[s]) continue;
      kernel::FirstEntry<View> first(shafts[s]);
      first.offer(bounds.stream, contacts[s].index, contacts[s].index);
      contacts[s] = first.contact();
    }
  });
}

}  // namespace

FirstContact first_contact(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("first_contact", {&shaft, 1}, bounds, Question::kept, query, takes_skip);
  require_askable(asked);
  return contact_of(asked, 0);
}

void first_contact_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<FirstContact> contacts,
                        const Query& query) {
  const Asked asked("first_contact_many", shafts, bounds, Question::kept, query, takes_skip);
  require_askable(asked);
  kernel::require_counts("contacts", contacts, shafts.size());
  asked.options().require_apart("contacts", kernel::bytes_of(contacts));
  if (asked.walks() == nullptr && !asked.options().only()) {
    return asked.kind() == kernel::BoundKind::spheres ? write_contacts<SphereView>(asked, contacts)
                                                      : write_contacts<BoxView>(asked, contacts);
  }
  kernel::for_each_shaft(asked, [&](std::size_t s) { contacts[s] = contact_of(asked, s); });
}

}  // namespace shaftcull
