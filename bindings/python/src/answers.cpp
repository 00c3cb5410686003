// SPDX-License-Identifier: MIT
#include "queries.hpp"

#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

// Calls of the library, for one shaft and for many, which have the same parameters whatever they return.
template <class Answer>
using OneShaft = Answer (*)(const CompiledShaft&, const Bounds&, const Query&);
template <class To>
using ManyShafts = void (*)(std::span<const CompiledShaft>, const Bounds&, To, const Query&);
using ListOf = std::size_t (*)(const CompiledShaft&, const Bounds&, std::span<std::uint32_t>, const Query&);

/// Calls one(query) for one shaft, on this thread; or many(shafts, first, query) for chunks of many, which begin at
/// shaft `first`. Without the interpreter lock.
template <class One, class Many>
void run(const Question& question, Chunks chunks, One&& one, Many&& many) {
  if (question.shafts.one) {
    const py::gil_scoped_release release;
    one(question.options.of(0, 1));
    return;
  }
  in_chunks(question.shafts.count, chunks, [&](std::size_t first, std::size_t count) {
    many(question.shafts.span().subspan(first, count), first, question.options.of(first, count));
  });
}

/// An answer for each shaft.
template <class Answer, class Returned>
std::vector<Answer> answers(const Question& question, OneShaft<Returned> one, ManyShafts<std::span<Answer>> many) {
  std::vector<Answer> all(question.shafts.count);
  run(
      question, Chunks::side_by_side,
      [&](const Query& query) { all[0] = one(question.shafts.front(), question.bounds, query); },
      [&](auto shafts, std::size_t first, const Query& query) {
        many(shafts, question.bounds, std::span(all).subspan(first, shafts.size()), query);
      });
  return all;
}

/// A number of Python's for one shaft, an array for many: those that of(answer) takes from each.
template <class Answer, class Of>
py::object numbers(const Shafts& shafts, const std::vector<Answer>& answers, Of&& of) {
  std::vector<decltype(of(answers[0]))> taken;
  taken.reserve(answers.size());
  for (const Answer& answer : answers) taken.push_back(of(answer));
  if (shafts.one) return py::cast(taken[0]);
  return array_of(std::move(taken));
}

/// A bool for each shaft.
py::object bools(const Question& question, OneShaft<bool> one, ManyShafts<std::span<std::uint64_t>> many) {
  std::vector<std::uint8_t> all(question.shafts.count);
  run(
      question, Chunks::side_by_side,
      [&](const Query& query) { all[0] = one(question.shafts.front(), question.bounds, query) ? 1 : 0; },
      [&](auto shafts, std::size_t first, const Query& query) {
        std::vector<std::uint64_t> words(bit_words(shafts.size()));
        many(shafts, question.bounds, words, query);
        const BitView bits(words);
        for (std::size_t i = 0; i != shafts.size(); ++i) all[first + i] = bits[i] ? 1 : 0;
      });
  return bools_of(question.shafts.one, std::move(all));
}

/// A row of bits for each shaft, in words.
class BitRows {
 public:
  explicit BitRows(const Question& question)
      : bounds_(question.bounds.size()), row_(bit_words(bounds_)), words_({question.shafts.count, row_}) {
    memory_ = words_.mutable_data();
  }

  [[nodiscard]] std::span<std::uint64_t> rows(std::size_t first, std::size_t count) const {
    return {memory_ + first * row_, count * row_};
  }

  /// Without the axis of shafts for one.
  [[nodiscard]] py::object array(const Question& question, bool packed) const {
    return bits_of(question.shafts.one ? py::object(words_[py::int_(0)]) : py::object(words_), bounds_, packed);
  }

 private:
  std::size_t bounds_;
  std::size_t row_;
  py::array_t<std::uint64_t> words_;
  std::uint64_t* memory_;
};

/// Appends the lists of shafts from `first` on; with first == 0 they replace all that there were.
void append(IndexLists& all, std::size_t first, IndexLists&& lists) {
  if (first == 0) {
    all = std::move(lists);
    return;
  }
  const std::uint64_t before = all.indices.size();
  for (std::size_t shaft = 0; shaft != lists.size(); ++shaft) all.offsets.push_back(before + lists.offsets[shaft + 1]);
  all.indices.insert(all.indices.end(), lists.indices.begin(), lists.indices.end());
}

/// The indices of one shaft, the IndexLists of many.
py::object found(const Shafts& shafts, IndexLists&& lists, const py::object& times = py::none()) {
  py::array indices = array_of(std::move(lists.indices));
  if (!shafts.one) return lists_of(array_of(std::move(lists.offsets)), indices, times);
  if (times.is_none()) return indices;
  return py::make_tuple(indices, times);
}

/// The list of each shaft.
IndexLists lists_by(const Question& question, ListOf one, ManyShafts<IndexLists&> many) {
  IndexLists all{{0}, {}};
  run(
      question, Chunks::joined,
      [&](const Query& query) {
        thread_local std::vector<std::uint32_t> room(1024);  // seldom too short, so that the library seldom runs twice
        std::size_t size = one(question.shafts.front(), question.bounds, room, query);
        if (size > room.size()) {
          room.resize(size);
          size = one(question.shafts.front(), question.bounds, room, query);
        }
        all.indices.assign(room.data(), room.data() + size);
        all.offsets.push_back(size);
        if (room.size() > std::size_t{1} << 20) room = std::vector<std::uint32_t>(1024);
      },
      [&](auto shafts, std::size_t first, const Query& query) {
        IndexLists lists;
        many(shafts, question.bounds, lists, query);
        append(all, first, std::move(lists));
      });
  return all;
}

/// When the moving boxes reach the bounds of their lists.
py::array times_of(const Question& question, const IndexLists& lists) {
  std::vector<float> times(lists.indices.size());
  const auto enter = [&](std::size_t shaft) {
    entry_times(question.shafts.span()[shaft], question.bounds, lists[shaft],
                std::span(times).subspan(static_cast<std::size_t>(lists.offsets[shaft]), lists[shaft].size()));
  };
  run(
      question, Chunks::side_by_side, [&](const Query&) { enter(0); },
      [&](auto shafts, std::size_t first, const Query&) {
        for (std::size_t shaft = first; shaft != first + shafts.size(); ++shaft) enter(shaft);
      });
  return array_of(std::move(times));
}

}  // namespace

py::object ask_cull(const Question& question, bool packed) {
  const BitRows kept(question);
  run(
      question, Chunks::side_by_side,
      [&](const Query& query) { cull(question.shafts.front(), question.bounds, kept.rows(0, 1), query); },
      [&](auto shafts, std::size_t first, const Query& query) {
        cull_many(shafts, question.bounds, kept.rows(first, shafts.size()), query);
      });
  return kept.array(question, packed);
}

py::object ask_classify(const Question& question, bool packed) {
  const BitRows kept(question);
  const BitRows inside(question);
  run(
      question, Chunks::side_by_side,
      [&](const Query& query) {
        classify(question.shafts.front(), question.bounds, kept.rows(0, 1), inside.rows(0, 1), query);
      },
      [&](auto shafts, std::size_t first, const Query& query) {
        const std::size_t count = shafts.size();
        classify_many(shafts, question.bounds, kept.rows(first, count), inside.rows(first, count), query);
      });
  return py::make_tuple(kept.array(question, packed), inside.array(question, packed));
}

py::object ask_any(const Question& question) { return bools(question, &any, &any_many); }

py::object ask_occluded(const Question& question) { return bools(question, &occluded, &occluded_many); }

py::object ask_count(const Question& question) {
  const auto counts = answers<std::uint64_t, std::size_t>(question, &count, &count_many);
  return numbers(question.shafts, counts, [](std::uint64_t count) { return count; });
}

py::object ask_count_classified(const Question& question) {
  const auto counts = answers<KeptCounts, KeptCounts>(question, &count_classified, &count_classified_many);
  return py::make_tuple(
      numbers(question.shafts, counts, [](const KeptCounts& of) -> std::uint64_t { return of.overlap; }),
      numbers(question.shafts, counts, [](const KeptCounts& of) -> std::uint64_t { return of.inside; }));
}

py::object ask_first_contact(const Question& question, bool normals) {
  const auto contacts = answers<FirstContact, FirstContact>(question, &first_contact, &first_contact_many);
  const auto index = [](const FirstContact& contact) { return contact ? std::int64_t{contact.index} : -1; };
  const py::object indices = numbers(question.shafts, contacts, index);
  const py::object times = numbers(question.shafts, contacts, [](const FirstContact& contact) { return contact.time; });
  if (!normals) return py::make_tuple(indices, times);
  std::vector<float> floats;
  floats.reserve(3 * contacts.size());
  for (const FirstContact& contact : contacts)
    floats.insert(floats.end(), contact.normal.begin(), contact.normal.end());
  const py::object flat = array_of(std::move(floats));
  return py::make_tuple(indices, times, question.shafts.one ? flat : flat.attr("reshape")(-1, 3));
}

py::object ask_find_occluder(const Question& question) {
  std::vector<std::int64_t> occluders(question.shafts.count, -1);
  const auto find = [&](std::size_t shaft) {
    const auto index = find_occluder(question.shafts.span()[shaft], question.bounds, question.options.of(shaft, 1));
    if (index) occluders[shaft] = std::int64_t{*index};
  };
  run(
      question, Chunks::side_by_side, [&](const Query&) { find(0); },
      [&](auto shafts, std::size_t first, const Query&) {
        for (std::size_t shaft = first; shaft != first + shafts.size(); ++shaft) find(shaft);
      });
  return numbers(question.shafts, occluders, [](std::int64_t index) { return index; });
}

py::object ask_list(const Question& question, bool times) {
  IndexLists lists = lists_by(question, &list, &list_many);
  const py::object entered = times ? py::object(times_of(question, lists)) : py::none();
  return found(question.shafts, std::move(lists), entered);
}

py::object ask_list_occluders(const Question& question) {
  return found(question.shafts, lists_by(question, &list_occluders, &list_occluders_many));
}

py::object ask_list_classified(const Question& question) {
  const Shafts& shafts = question.shafts;
  IndexLists overlap{{0}, {}};
  IndexLists inside{{0}, {}};
  run(
      question, Chunks::joined,
      [&](const Query& query) {
        const KeptCounts counts = count_classified(shafts.front(), question.bounds, query);
        overlap.indices.resize(counts.overlap);
        inside.indices.resize(counts.inside);
        static_cast<void>(list_classified(shafts.front(), question.bounds, overlap.indices, inside.indices, query));
      },
      [&](auto some, std::size_t first, const Query& query) {
        IndexLists both[2];
        list_classified_many(some, question.bounds, both[0], both[1], query);
        append(overlap, first, std::move(both[0]));
        append(inside, first, std::move(both[1]));
      });
  return py::make_tuple(found(shafts, std::move(overlap)), found(shafts, std::move(inside)));
}

py::object ask_entry_times(Holder& holder, const py::object& shaft, const py::object& indices) {
  const Shafts shafts = shafts_in(shaft, py::none());
  if (!shafts.one) {
    throw py::value_error("entry_times() takes one shaft, shafts[i]; for many, list(shafts, times=True)");
  }
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
