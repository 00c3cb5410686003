// SPDX-License-Identifier: MIT
/// Questions whose answers are lists of indices, or of times. As answers.hpp.
#pragma once

#include "answers.hpp"

namespace shaftcull::python {

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

/// What list(room) writes for one shaft, which returns how many there are. The room is kept for the next call.
template <class List>
[[nodiscard]] std::vector<std::uint32_t> one_list(List&& list) {
  thread_local std::vector<std::uint32_t> room(1024);
  std::size_t found = list(std::span(room));
  if (found > room.size()) {
    room.resize(found + found / 4);
    found = list(std::span(room));
  }
  std::vector<std::uint32_t> indices(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(found));
  constexpr std::size_t most_kept = std::size_t{1} << 22;
  if (room.size() > most_kept) room = std::vector<std::uint32_t>(1024);
  return indices;
}

template <class Holder, class Option>
[[nodiscard]] IndexLists all_lists(Holder& bounds, const Shafts& shafts, const Option& option) {
  if (shafts.one) {
    const py::gil_scoped_release release;
    IndexLists lists;
    std::apply(
        [&](const auto&... with) {
          lists.indices = one_list(
              [&](std::span<std::uint32_t> room) { return list(shafts.front(), bounds.set(), room, with...); });
        },
        option.of(0, 1));
    lists.offsets = {0, lists.indices.size()};
    return lists;
  }
  JoinedLists joined;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists lists;
    std::apply(
        [&](const auto&... with) { list_many(shafts.span().subspan(first, count), bounds.set(), lists, with...); },
        option.of(first, count));
    joined.add(first, std::move(lists));
  });
  return std::move(joined).joined();
}

template <class Holder, class Option>
[[nodiscard]] IndexLists lists_at_most(Holder& bounds, const Shafts& shafts, const Option& option, std::size_t most) {
  most = std::min(most, bounds.size());
  if (shafts.one) {
    const py::gil_scoped_release release;
    IndexLists lists;
    lists.indices.resize(most);
    lists.indices.resize(std::apply(
        [&](const auto&... with) { return list_at_most(shafts.front(), bounds.set(), lists.indices, with...); },
        option.of(0, 1)));
    lists.offsets = {0, lists.indices.size()};
    return lists;
  }
  JoinedLists joined;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> rows(count * most);
    std::vector<std::uint64_t> counts(count);
    std::apply(
        [&](const auto&... with) {
          list_at_most_many(shafts.span().subspan(first, count), bounds.set(), most, rows, counts, with...);
        },
        option.of(first, count));
    IndexLists lists;
    lists.offsets.push_back(0);
    for (std::size_t shaft = 0; shaft != count; ++shaft) {
      const auto row = rows.begin() + static_cast<std::ptrdiff_t>(shaft * most);
      lists.indices.insert(lists.indices.end(), row, row + static_cast<std::ptrdiff_t>(counts[shaft]));
      lists.offsets.push_back(lists.indices.size());
    }
    joined.add(first, std::move(lists));
  });
  return std::move(joined).joined();
}

/// One list as its indices, many as offsets and indices.
[[nodiscard]] inline py::object answer(const Shafts& shafts, IndexLists&& lists) {
  if (shafts.one) return array_of(std::move(lists.indices));
  return lists_of(std::move(lists));
}

template <class Holder>
py::object ask_list_all(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  return answer(shafts, all_lists(bounds, shafts, option));
}

template <class Holder>
py::object ask_list(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option, const py::object& at_most,
                    bool times) {
  const auto most = number_in(at_most, "at_most");
  IndexLists lists = most ? lists_at_most(bounds, shafts, option, *most) : all_lists(bounds, shafts, option);
  if (!times) return answer(shafts, std::move(lists));
  std::vector<float> entered(lists.indices.size());
  const auto enter = [&](std::size_t first, std::size_t count) {
    for (std::size_t shaft = first; shaft != first + count; ++shaft) {
      const auto begin = static_cast<std::size_t>(lists.offsets[shaft]);
      const std::size_t size = lists[shaft].size();
      entry_times(shafts.span()[shaft], bounds.set(), std::span<const std::uint32_t>(lists[shaft]),
                  std::span(entered).subspan(begin, size));
    }
  };
  if (shafts.one) {
    const py::gil_scoped_release release;
    enter(0, 1);
  } else {
    in_chunks(shafts.count, Chunks::side_by_side, enter);
  }
  const py::array all_times = array_of(std::move(entered));
  if (shafts.one) return py::make_tuple(array_of(std::move(lists.indices)), all_times);
  const py::tuple two = lists_of(std::move(lists));
  return py::make_tuple(two[0], two[1], all_times);
}

template <class Holder>
py::object ask_list_classified(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  if (shafts.one) {
    std::vector<std::uint32_t> overlap;
    std::vector<std::uint32_t> inside;
    {
      const py::gil_scoped_release release;
      std::apply(
          [&](const auto&... with) {
            const KeptCounts counts = count_classified(shafts.front(), bounds.set(), with...);
            overlap.resize(counts.overlap);
            inside.resize(counts.inside);
            static_cast<void>(list_classified(shafts.front(), bounds.set(), overlap, inside, with...));
          },
          option.of(0, 1));
    }
    return py::make_tuple(array_of(std::move(overlap)), array_of(std::move(inside)));
  }
  JoinedLists overlap;
  JoinedLists inside;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists both[2];
    std::apply(
        [&](const auto&... with) {
          list_classified_many(shafts.span().subspan(first, count), bounds.set(), both[0], both[1], with...);
        },
        option.of(first, count));
    overlap.add(first, std::move(both[0]));
    inside.add(first, std::move(both[1]));
  });
  return py::make_tuple(lists_of(std::move(overlap).joined()), lists_of(std::move(inside).joined()));
}

template <class Holder>
py::object ask_first(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  if (shafts.one) {
    FirstContact contact;
    {
      const py::gil_scoped_release release;
      contact = std::apply([&](const auto&... with) { return first_contact(shafts.front(), bounds.set(), with...); },
                           option.of(0, 1));
    }
    return py::make_tuple(contact ? static_cast<std::int64_t>(contact.index) : std::int64_t{-1},
                          static_cast<double>(contact.time));
  }
  std::vector<FirstContact> contacts(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    std::apply(
        [&](const auto&... with) {
          first_contact_many(shafts.span().subspan(first, count), bounds.set(),
                             std::span(contacts).subspan(first, count), with...);
        },
        option.of(first, count));
  });
  std::vector<std::int64_t> indices(shafts.count);
  std::vector<float> times(shafts.count);
  for (std::size_t i = 0; i != shafts.count; ++i) {
    indices[i] = contacts[i] ? static_cast<std::int64_t>(contacts[i].index) : -1;
    times[i] = contacts[i].time;
  }
  return py::make_tuple(array_of(std::move(indices)), array_of(std::move(times)));
}

/// What is asked of candidates has no option.
template <class Holder>
py::object ask_refine(Holder& bounds, const py::object& given, const py::object& candidates) {
  const Shafts shafts = shafts_in(given, py::none());
  IndicesIn in = indices_in(candidates, "candidates", bounds.size(), "bounds");
  const Reading reading(bounds.usage);
  if (shafts.one) {
    {
      const py::gil_scoped_release release;
      const std::span<std::uint32_t> list(in.indices);
      in.indices.resize(refine(shafts.front(), bounds.set(), std::span<const std::uint32_t>(list), list));
    }
    return array_of(std::move(in.indices));
  }
  JoinedLists joined;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists lists;
    refine_many(shafts.span().subspan(first, count), bounds.set(), std::span<const std::uint32_t>(in.indices), lists);
    joined.add(first, std::move(lists));
  });
  return lists_of(std::move(joined).joined());
}

template <class Holder>
py::object ask_entry_times(Holder& bounds, const py::object& given, const py::object& indices) {
  const Shafts shafts = shafts_in(given, py::none());
  if (!shafts.one)
    throw py::value_error("entry_times() takes one shaft, shafts[i]; for many, list(shafts, times=True)");
  const IndicesIn in = indices_in(indices, "indices", bounds.size(), "bounds");
  const Reading reading(bounds.usage);
  std::vector<float> times(in.indices.size());
  {
    const py::gil_scoped_release release;
    entry_times(shafts.front(), bounds.set(), std::span<const std::uint32_t>(in.indices), times);
  }
  return array_of(std::move(times));
}

// What blocks: boxes only.

template <class Holder>
py::object ask_blocked(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  return bools_of(
      shafts, option, [&](const auto&... with) { return blocked(shafts.front(), bounds.set(), with...); },
      [&](auto range, auto words, const auto&... with) { blocked_many(range, bounds.set(), words, with...); });
}

template <class Holder>
py::object ask_blocked_by(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  const auto ask = [&](std::size_t shaft) -> std::int64_t {
    const auto found =
        std::apply([&](const auto&... with) { return blocked_by(shafts.span()[shaft], bounds.set(), with...); },
                   option.of(shaft, 1));
    return found ? static_cast<std::int64_t>(*found) : -1;
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

template <class Holder>
py::object ask_list_blocking(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  if (shafts.one) {
    std::vector<std::uint32_t> indices;
    {
      const py::gil_scoped_release release;
      std::apply(
          [&](const auto&... with) {
            indices = one_list([&](std::span<std::uint32_t> room) {
              return list_blocking(shafts.front(), bounds.set(), room, with...);
            });
          },
          option.of(0, 1));
    }
    return array_of(std::move(indices));
  }
  JoinedLists joined;
  in_chunks(shafts.count, Chunks::joined, [&](std::size_t first, std::size_t count) {
    IndexLists lists;
    std::apply(
        [&](const auto&... with) {
          list_blocking_many(shafts.span().subspan(first, count), bounds.set(), lists, with...);
        },
        option.of(first, count));
    joined.add(first, std::move(lists));
  });
  return lists_of(std::move(joined).joined());
}

}  // namespace shaftcull::python
