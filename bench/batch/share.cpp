// SPDX-License-Identifier: MIT
#include "batch/share.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "batch/parallel.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/query.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::uint64_t bounds_at_once = std::uint64_t{1} << 20;
constexpr std::size_t bounds_a_task = std::size_t{1} << 14;
constexpr std::uint64_t shafts_at_once = 4096;
constexpr std::size_t shafts_a_task = 64;

/// Calls take(first, floats, count) for chunks of the bounds, one behind the other.
template <class Take>
void for_bounds(const BoundsSource& bounds, std::uint64_t first, std::uint64_t count, const Take& take) {
  std::vector<std::byte> scratch;
  for (std::uint64_t done = 0; done < count; done += bounds_at_once) {
    const std::uint64_t size = std::min(bounds_at_once, count - done);
    take(first + done, bounds.read(first + done, size, scratch).data(), static_cast<std::size_t>(size));
  }
}

/// Adds the lists of the shafts in `kept`; those of all others are empty. Positions in the share become those in the
/// file, by `ids` unless that is empty, and ascend.
void add_lists(const IndexLists& from, const std::vector<std::size_t>& kept, const std::vector<std::uint64_t>& ids,
               BlockLists& to) {
  const std::size_t begin = to.indices.size();
  to.indices.resize(begin + from.indices.size());
  for (const std::size_t s : kept) to.sizes.push_back(from[s].size());
  for_chunks(from.size(), shafts_a_task, [&](std::size_t first, std::size_t size) {
    for (std::size_t s = first; s != first + size; ++s) {
      const std::span<const std::uint32_t> list = from[s];
      const auto out = to.indices.begin() + static_cast<std::ptrdiff_t>(begin + from.offsets[s]);
      const auto end = std::ranges::copy(list, out).out;
      std::sort(out, end);  // ids ascend as positions in the share do
      if (ids.empty()) continue;
      for (auto at = out; at != end; ++at) *at = ids[static_cast<std::size_t>(*at)];
    }
  });
}

}  // namespace

std::uint64_t bytes_a_bound(BoundKind kind, bool several) noexcept {
  // A tree holds the floats, a position and some nodes, and has as much again under way while it is sorted. Of several
  // shares the floats and positions in the file are copied first.
  const std::uint64_t floats = kind == BoundKind::box ? 24 : kind == BoundKind::sphere ? 16 : 36;
  const std::uint64_t building = kind == BoundKind::triangle ? 110 : 2 * floats + 16;
  return floats + 8 + building + (several ? floats + 8 : 0);
}

std::vector<std::uint64_t> share_sizes(const BoundsSource& bounds, const SharePlan& plan, std::uint64_t first,
                                       std::uint64_t count) {
  std::vector<std::uint64_t> sizes(plan.shares());
  std::mutex mutex;
  const std::size_t columns = bounds.array().columns();
  for_bounds(bounds, first, count, [&](std::uint64_t at, const float* floats, std::size_t size) {
    for_chunks(size, bounds_a_task, [&](std::size_t begin, std::size_t some) {
      std::vector<std::uint64_t> here(sizes.size());
      for (std::size_t i = begin; i != begin + some; ++i) {
        ++here[plan.share_of({middle_of(bounds.box_around(floats + i * columns)), at + i})];
      }
      const std::lock_guard lock(mutex);
      for (std::size_t s = 0; s != here.size(); ++s) sizes[s] += here[s];
    });
  });
  return sizes;
}

Share::Share(const BoundsSource& bounds, const SharePlan& plan, std::size_t which, std::uint64_t size)
    : several_(plan.shares() > 1), box_(box_around(std::span<const Vec3>())) {
  const std::size_t columns = bounds.array().columns();
  if (!several_) {
    std::vector<std::byte> scratch;
    build(bounds, bounds.read(0, bounds.size(), scratch));
    return;
  }
  std::vector<float> kept;
  kept.reserve(static_cast<std::size_t>(size) * columns);
  ids_.reserve(static_cast<std::size_t>(size));
  std::vector<std::vector<std::uint32_t>> found;
  for_bounds(bounds, 0, bounds.size(), [&](std::uint64_t at, const float* floats, std::size_t some) {
    found.resize(some / bounds_a_task + 1);
    for_chunks(some, bounds_a_task, [&](std::size_t begin, std::size_t few) {
      std::vector<std::uint32_t>& here = found[begin / bounds_a_task];
      here.clear();
      for (std::size_t i = begin; i != begin + few; ++i) {
        const ShareKey key{middle_of(bounds.box_around(floats + i * columns)), at + i};
        if (plan.share_of(key) == which) here.push_back(static_cast<std::uint32_t>(i));
      }
    });
    for (std::size_t chunk = 0; chunk * bounds_a_task < some; ++chunk) {
      for (const std::uint32_t i : found[chunk]) {
        const float* const bound = floats + i * columns;
        box_ = joined(box_, bounds.box_around(bound));
        kept.insert(kept.end(), bound, bound + columns);
        ids_.push_back(at + i);
      }
    }
  });
  build(bounds, kept);
}

void Share::build(const BoundsSource& bounds, std::span<const float> floats) {
  const std::size_t count = floats.size() / bounds.array().columns();
  const float* const data = floats.data();
  try {
    switch (bounds.kind()) {
      case BoundKind::box:
        tree_ = BoxTree(MinMaxRecords{data, data + 3, 6 * sizeof(float), count});
        break;
      case BoundKind::sphere:
        tree_ = SphereTree(SphereRecords{data, data + 3, 4 * sizeof(float), count});
        break;
      case BoundKind::triangle:
        static_assert(sizeof(Triangle) == 9 * sizeof(float) && alignof(Triangle) == alignof(float));
        tree_ = TriangleTree(std::span(reinterpret_cast<const Triangle*>(data), count));
        break;
    }
  } catch (const BadBound& bad) {
    // "box 3: …" is of the share; rows are of the file.
    const std::string what = bad.what();
    const std::size_t colon = what.find(": ");
    throw InvalidArgument(fmt::format("{}: row {}: {}", bounds.array().name(), id(bad.index()),
                                      colon == std::string::npos ? what : what.substr(colon + 2)));
  }
}

BlockAnswer Share::answer(const ShaftSource& shafts, std::uint64_t first, std::uint64_t count,
                          const Question& question) const {
  // Questions about inside, and some of spheres, need joining planes.
  const bool complete = question.answer == Answer::classify || std::holds_alternative<SphereTree>(tree_);
  BlockAnswer answer;
  std::vector<CompiledShaft> formed(static_cast<std::size_t>(std::min(count, shafts_at_once)));
  std::vector<std::uint32_t> rows(formed.size());
  for (std::uint64_t done = 0; done < count; done += shafts_at_once) {
    std::size_t size = static_cast<std::size_t>(std::min(shafts_at_once, count - done));
    shafts.form(first + done, std::span(formed).first(size), complete);
    for (std::size_t s = 0; s != size; ++s) rows[s] = static_cast<std::uint32_t>(done + s);
    if (several_) {
      // With closed contact: a flat bound in a face of the box around them all meets what the box only touches.
      std::vector<std::uint8_t> meets(size);
      for_chunks(size, shafts_a_task, [&](std::size_t begin, std::size_t some) {
        for (std::size_t s = begin; s != begin + some; ++s) meets[s] = cull(formed[s], box_) ? 1 : 0;
      });
      std::size_t kept = 0;
      for (std::size_t s = 0; s != size; ++s) {
        if (meets[s] == 0) continue;
        if (kept != s) formed[kept] = formed[s];
        rows[kept++] = rows[s];
      }
      size = kept;
    }
    if (question.contact == Contact::open) set_contact(std::span(formed).first(size), Contact::open);
    add_answers(std::span(formed).first(size), std::span(rows).first(size), question, answer);
  }
  return answer;
}

void Share::add_answers(std::span<const CompiledShaft> shafts, std::span<const std::uint32_t> rows,
                        const Question& question, BlockAnswer& answer) const {
  if (shafts.empty()) return;
  switch (question.answer) {
    case Answer::count: {
      std::vector<std::uint64_t> counts(shafts.size());
      std::visit([&](const auto& tree) { count_many(shafts, tree, counts); }, tree_);
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
      std::visit(
          [&]<class Tree>(const Tree& tree) {
            if constexpr (!std::is_same_v<Tree, TriangleTree>) {
              if (both) return list_classified_many(shafts, tree, lists[0], lists[1]);
            }
            list_many(shafts, tree, lists[0]);
          },
          tree_);
      std::vector<std::size_t> kept;
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if (lists[0][s].empty() && (!both || lists[1][s].empty())) continue;
        answer.rows.push_back(rows[s]);
        kept.push_back(s);
      }
      add_lists(lists[0], kept, ids_, answer.lists[0]);
      if (both) add_lists(lists[1], kept, ids_, answer.lists[1]);
      break;
    }
    case Answer::first: {
      std::vector<FirstContact> contacts(shafts.size());
      std::visit(
          [&]<class Tree>(const Tree& tree) {
            if constexpr (!std::is_same_v<Tree, TriangleTree>) first_contact_many(shafts, tree, std::span(contacts));
          },
          tree_);
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if (!contacts[s]) continue;
        answer.rows.push_back(rows[s]);
        answer.numbers.push_back(id(contacts[s].index));
        answer.times.push_back(contacts[s].time);
      }
      break;
    }
    case Answer::blocked: {
      std::vector<std::uint64_t> bits(words_for(shafts.size()));
      blocked_many(shafts, std::get<BoxTree>(tree_), std::span(bits));
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        if ((bits[s / 64] >> (s % 64) & 1) != 0) answer.rows.push_back(rows[s]);
      }
      break;
    }
  }
}

}  // namespace shaftcull::batch
