// SPDX-License-Identifier: MIT
/// first_contact() and first_contact_many() of views. A task of many shafts looks for the first one in its own bounds,
/// and then compares it with those of other tasks.
#include "shaftcull/first_contact.hpp"

#include <algorithm>
#include <bit>

#include "compiled/answers.hpp"
#include "exact/first_entry.hpp"
#include "flat/batch_job.hpp"
#include "flat/chunks.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// Offers the bounds from `from` on whose bits are set. Bounds are offered in order.
template <class View>
void offer(kernel::FirstEntry<View>& first, const View& bounds, std::size_t from, const std::uint64_t* kept,
           std::size_t words) noexcept {
  for (std::size_t w = 0; w != words; ++w) {
    for (std::uint64_t left = kept[w]; left != 0; left &= left - 1) {
      const std::size_t i = from + w * 64 + static_cast<std::size_t>(std::countr_zero(left));
      if (first.is_before_all_above(i)) return;
      first.offer(bounds.stream.data(), i, i);
    }
  }
}

/// Makes bound `index` the first one that shaft s reaches, unless the one in `first` comes before it.
template <class View>
void hand_over(const kernel::ShaftData& shaft, const View& bounds, std::uint32_t index, std::uint32_t& first) noexcept {
  const kernel::SharedNumber<std::uint32_t> best(first);
  std::uint32_t other = best.load();
  for (;;) {
    kernel::FirstEntry<View> both(shaft);
    both.offer(bounds.stream.data(), index, index);
    if (other != FirstContact::none) both.offer(bounds.stream.data(), other, other);
    if (both.index() == other) return;
    if (best.exchange(other, index)) return;
  }
}

template <class View>
FirstContact contact_in_view(const CompiledShaft& shaft, const View& bounds) {
  const kernel::Chunks<View> chunks(shaft, bounds, false);
  kernel::require_motion(kernel::data_of(shaft), 0);
  kernel::require_index_width("first_contact()", bounds.count);
  return kernel::in_float_environment([&] {
    kernel::FirstEntry<View> first(kernel::data_of(shaft));
    chunks.for_each(kernel::first_chunk_bounds,
                    [&](std::size_t from, std::size_t words, const std::uint64_t* kept, const std::uint64_t*) {
                      offer(first, bounds, from, kept, words);
                      return !first.is_before_all_above(from + 64 * words);
                    });
    return first.contact();
  });
}

template <class View>
void contacts_in_view(std::span<const CompiledShaft> shafts, const View& bounds, std::span<FirstContact> contacts) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::kept);
  kernel::require_counts("contacts", contacts, shafts.size());
  kernel::require_index_width("first_contact_many()", bounds.count);
  const std::span<const kernel::ShaftData> data = kernel::data_of(shafts);
  for (std::size_t s = 0; s != data.size(); ++s) kernel::require_motion(data[s], s);
  std::fill(contacts.begin(), contacts.end(), FirstContact());
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    std::uint64_t* const kept = bits.get();
    job.test(block, group, {kept, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      const kernel::ShaftData& shaft = data[group.first + s];
      kernel::FirstEntry<View> first(shaft);
      offer(first, bounds, block.first, kept + s * words, words);
      if (!first.is_there()) continue;
      hand_over(shaft, bounds, static_cast<std::uint32_t>(first.index()), contacts[group.first + s].index);
    }
  });
  kernel::in_float_environment([&] {
    for (std::size_t s = 0; s != contacts.size(); ++s) {
      if (!contacts[s]) continue;
      kernel::FirstEntry<View> first(data[s]);
      first.offer(bounds.stream.data(), contacts[s].index, contacts[s].index);
      contacts[s] = first.contact();
    }
  });
}

}  // namespace

FirstContact first_contact(const CompiledShaft& shaft, const BoxView& boxes) { return contact_in_view(shaft, boxes); }
FirstContact first_contact(const CompiledShaft& shaft, const SphereView& spheres) {
  return contact_in_view(shaft, spheres);
}

void first_contact_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<FirstContact> contacts) {
  contacts_in_view(shafts, boxes, contacts);
}
void first_contact_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                        std::span<FirstContact> contacts) {
  contacts_in_view(shafts, spheres, contacts);
}

}  // namespace shaftcull
