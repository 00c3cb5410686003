// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "answers.hpp"
#include "arrays.hpp"
#include "interrupts.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

/// Lists of chunks, one behind the other.
class JoinedLists {
 public:
  /// The lists of shafts from `first` on; with first == 0 those that were added before are dropped.
  void add(std::size_t first, IndexLists&& lists) {
    if (first == 0) parts_.clear();
    parts_.push_back(std::move(lists));
  }

  [[nodiscard]] IndexLists joined() && {
    if (parts_.empty()) return {{0}, {}};
    if (parts_.size() == 1) return std::move(parts_.front());
    const py::gil_scoped_release release;
    IndexLists all;
    std::size_t shafts = 0;
    std::size_t indices = 0;
    for (const IndexLists& part : parts_) {
      shafts += part.size();
      indices += part.indices.size();
    }
    all.offsets.reserve(shafts + 1);
    all.offsets.push_back(0);
    all.indices.reserve(indices);
    for (IndexLists& part : parts_) {
      const std::uint64_t before = all.indices.size();
      for (std::size_t shaft = 0; shaft != part.size(); ++shaft)
        all.offsets.push_back(before + part.offsets[shaft + 1]);
      all.indices.insert(all.indices.end(), part.indices.begin(), part.indices.end());
      part = {};
    }
    return all;
  }

 private:
  std::vector<IndexLists> parts_;
};

/// The indices that write(room) writes for one shaft. It returns how many there are. The room is kept for the next
/// call.
template <class Write>
[[nodiscard]] std::vector<std::uint32_t> one_list(Write&& write) {
  thread_local std::vector<std::uint32_t> room(1024);
  std::size_t found = write(std::span(room));
  if (found > room.size()) {
    room.resize(found + found / 4);
    found = write(std::span(room));
  }
  std::vector<std::uint32_t> indices(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(found));
  constexpr std::size_t most_kept = std::size_t{1} << 22;
  if (room.size() > most_kept) room = std::vector<std::uint32_t>(1024);
  return indices;
}

/// The lists that one(room, query) writes for one shaft, or many(shafts, lists, query) for chunks.
template <class One, class Many>
[[nodiscard]] IndexLists lists_by(const Question& question, One&& one, Many&& many) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    const py::gil_scoped_release release;
    const Query query = question.options.of(0, 1);
    IndexLists lists;
    lists.indices = one_list([&](std::span<std::uint32_t> room) { return one(room, query); });
    lists.offsets = {0, lists.indices.size()};
    return lists;
  }
  JoinedLists joined;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists lists;
    many(shafts.span().subspan(first, count), lists, question.options.of(first, count));
    joined.add(first, std::move(lists));
  });
  return std::move(joined).joined();
}

/// One list as its indices, many as offsets and indices.
[[nodiscard]] py::object answer(const Shafts& shafts, IndexLists&& lists) {
  if (shafts.one) return array_of(std::move(lists.indices));
  return lists_of(std::move(lists));
}

/// When the moving boxes reach the bounds of their lists.
[[nodiscard]] std::vector<float> times_of(const Question& question, const IndexLists& lists) {
  std::vector<float> times(lists.indices.size());
  const auto enter = [&](std::size_t first, std::size_t count) {
    for (std::size_t shaft = first; shaft != first + count; ++shaft) {
      const auto begin = static_cast<std::size_t>(lists.offsets[shaft]);
      entry_times(question.shafts.span()[shaft], question.bounds, lists[shaft],
                  std::span(times).subspan(begin, lists[shaft].size()));
    }
  };
  if (question.shafts.one) {
    const py::gil_scoped_release release;
    enter(0, 1);
  } else {
    in_chunks(question.shafts.count, Chunks::side_by_side, enter);
  }
  return times;
}

}  // namespace

py::object ask_list(const Question& question, bool times) {
  const Shafts& shafts = question.shafts;
  IndexLists lists = lists_by(
      question,
      [&](std::span<std::uint32_t> room, const Query& query) {
        return list(shafts.front(), question.bounds, room, query);
      },
      [&](auto range, IndexLists& to, const Query& query) { list_many(range, question.bounds, to, query); });
  if (!times) return answer(shafts, std::move(lists));
  const py::array all_times = array_of(times_of(question, lists));
  if (shafts.one) return py::make_tuple(array_of(std::move(lists.indices)), all_times);
  const py::tuple two = lists_of(std::move(lists));
  return py::make_tuple(two[0], two[1], all_times);
}

py::object ask_list_classified(const Question& question) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    std::vector<std::uint32_t> overlap;
    std::vector<std::uint32_t> inside;
    {
      const py::gil_scoped_release release;
      const Query query = question.options.of(0, 1);
      const KeptCounts counts = count_classified(shafts.front(), question.bounds, query);
      overlap.resize(counts.overlap);
      inside.resize(counts.inside);
      static_cast<void>(list_classified(shafts.front(), question.bounds, overlap, inside, query));
    }
    return py::make_tuple(array_of(std::move(overlap)), array_of(std::move(inside)));
  }
  JoinedLists overlap;
  JoinedLists inside;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists both[2];
    list_classified_many(shafts.span().subspan(first, count), question.bounds, both[0], both[1],
                         question.options.of(first, count));
    overlap.add(first, std::move(both[0]));
    inside.add(first, std::move(both[1]));
  });
  return py::make_tuple(lists_of(std::move(overlap).joined()), lists_of(std::move(inside).joined()));
}

py::object ask_first_contact(const Question& question) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    FirstContact contact;
    {
      const py::gil_scoped_release release;
      contact = first_contact(shafts.front(), question.bounds, question.options.of(0, 1));
    }
    return py::make_tuple(contact ? static_cast<std::int64_t>(contact.index) : std::int64_t{-1},
                          static_cast<double>(contact.time));
  }
  std::vector<FirstContact> contacts(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    first_contact_many(shafts.span().subspan(first, count), question.bounds, std::span(contacts).subspan(first, count),
                       question.options.of(first, count));
  });
  std::vector<std::int64_t> indices(shafts.count);
  std::vector<float> times(shafts.count);
  for (std::size_t i = 0; i != shafts.count; ++i) {
    indices[i] = contacts[i] ? static_cast<std::int64_t>(contacts[i].index) : -1;
    times[i] = contacts[i].time;
  }
  return py::make_tuple(array_of(std::move(indices)), array_of(std::move(times)));
}

py::object ask_find_occluder(const Question& question) {
  const Shafts& shafts = question.shafts;
  const auto ask = [&](std::size_t shaft) -> std::int64_t {
    const auto found = find_occluder(shafts.span()[shaft], question.bounds, question.options.of(shaft, 1));
    return found ? std::int64_t{*found} : -1;
  };
  if (shafts.one) {
    std::int64_t found = -1;
    {
      const py::gil_scoped_release release;
      found = ask(0);
    }
    return py::int_(found);
  }
  std::vector<std::int64_t> found(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    for (std::size_t shaft = first; shaft != first + count; ++shaft) found[shaft] = ask(shaft);
  });
  return array_of(std::move(found));
}

py::object ask_list_occluders(const Question& question) {
  return answer(question.shafts, lists_by(
                                     question,
                                     [&](std::span<std::uint32_t> room, const Query& query) {
                                       return list_occluders(question.shafts.front(), question.bounds, room, query);
                                     },
                                     [&](auto range, IndexLists& to, const Query& query) {
                                       list_occluders_many(range, question.bounds, to, query);
                                     }));
}

py::object ask_entry_times(Holder& holder, const py::object& shaft, const py::object& indices) {
  const Shafts shafts = shafts_in(shaft, py::none());
  if (!shafts.one)
    throw py::value_error("entry_times() takes one shaft, shafts[i]; for many, list(shafts, times=True)");
  const IndicesIn in = indices_in(indices, "indices", holder.size(), "bounds");
  const Reading reading(holder.usage);
  std::vector<float> times(in.indices.size());
  {
    const py::gil_scoped_release release;
    entry_times(shafts.front(), holder.bounds(), in.indices, times);
  }
  return array_of(std::move(times));
}

}  // namespace shaftcull::python
