// SPDX-License-Identifier: MIT
#include "batch/share.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "batch/parallel.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::uint64_t formed_at_once = 4096;
constexpr std::size_t shafts_a_task = 64;

/// Adds the lists of the shafts in `kept`; those of all others are empty. Positions in the share become those in the
/// file, by `positions` unless that is empty, and ascend.
void add_lists(const IndexLists& from, const std::vector<std::size_t>& kept, std::span<const std::uint64_t> positions,
               BlockLists& to) {
  const std::size_t begin = to.indices.size();
  to.indices.resize(begin + from.indices.size());
  for (const std::size_t s : kept) to.sizes.push_back(from[s].size());
  for_chunks(from.size(), shafts_a_task, [&](std::size_t first, std::size_t size) {
    for (std::size_t s = first; s != first + size; ++s) {
      const std::span<const std::uint32_t> list = from[s];
      const auto out = to.indices.begin() + static_cast<std::ptrdiff_t>(begin + from.offsets[s]);
      const auto end = std::ranges::copy(list, out).out;
      std::sort(out, end);  // positions ascend as positions in the share do
      if (positions.empty()) continue;
      for (auto at = out; at != end; ++at) *at = positions[static_cast<std::size_t>(*at)];
    }
  });
}

void add_answers(const ShareTree& share, std::span<const CompiledShaft> shafts, std::span<const std::uint32_t> rows,
                 const Question& question, BlockAnswer& answer) {
  if (shafts.empty()) return;
  switch (question.answer) {
    case Answer::count: {
      std::vector<std::uint64_t> counts(shafts.size());
      count_many(shafts, share.bounds(), counts);
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if (counts[s] == 0) continue;
        answer.rows.push_back(rows[s]);
        answer.numbers.push_back(counts[s]);
      }
      break;
    }
    case Answer::list:
    case Answer::classify: {
      const bool both = question.answer == Answer::classify;
      std::array<IndexLists, 2> lists;
      if (both) {
        list_classified_many(shafts, share.bounds(), lists[0], lists[1]);
      } else {
        list_many(shafts, share.bounds(), lists[0]);
      }
      std::vector<std::size_t> kept;
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if (lists[0][s].empty() && (!both || lists[1][s].empty())) continue;
        answer.rows.push_back(rows[s]);
        kept.push_back(s);
      }
      add_lists(lists[0], kept, share.positions(), answer.lists[0]);
      if (both) add_lists(lists[1], kept, share.positions(), answer.lists[1]);
      break;
    }
    case Answer::first: {
      std::vector<FirstContact> contacts(shafts.size());
      first_contact_many(shafts, share.bounds(), contacts);
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if (!contacts[s]) continue;
        answer.rows.push_back(rows[s]);
        answer.numbers.push_back(share.positions().empty() ? contacts[s].index : share.positions()[contacts[s].index]);
        answer.times.push_back(contacts[s].time);
      }
      break;
    }
    case Answer::occluded: {
      std::vector<std::uint64_t> bits(bit_words(shafts.size()));
      occluded_many(shafts, share.bounds(), bits);
      for (const std::size_t s : BitView(bits)) answer.rows.push_back(rows[s]);
      break;
    }
  }
}

}  // namespace

BlockAnswer answer(const ShareTree& share, const ShaftSource& shafts, std::uint64_t first, std::uint64_t count,
                   const Question& question) {
  // Questions about inside, and some of spheres, need joining planes.
  const bool complete = question.answer == Answer::classify || share.has_spheres();
  BlockAnswer result;
  std::vector<CompiledShaft> formed(static_cast<std::size_t>(std::min(count, formed_at_once)));
  std::vector<std::uint32_t> rows(formed.size());
  for (std::uint64_t done = 0; done < count; done += formed_at_once) {
    std::size_t size = static_cast<std::size_t>(std::min(formed_at_once, count - done));
    shafts.form(first + done, std::span(formed).first(size), complete);
    for (std::size_t s = 0; s != size; ++s) rows[s] = static_cast<std::uint32_t>(done + s);
    if (share.is_one_of_several()) {
      // With closed contact: a flat bound in a face of the box around them all meets what the box only touches.
      std::vector<std::uint64_t> meets(bit_words(size));
      any_many(std::span(formed).first(size), BoxStream(std::span(&share.box(), 1)), meets);
      std::size_t kept = 0;
      for (const std::size_t s : BitView(meets)) {
        if (kept != s) formed[kept] = formed[s];
        rows[kept++] = rows[s];
      }
      size = kept;
    }
    if (question.contact == Contact::open) set_contact(std::span(formed).first(size), Contact::open);
    add_answers(share, std::span(formed).first(size), std::span(rows).first(size), question, result);
  }
  return result;
}

}  // namespace shaftcull::batch
