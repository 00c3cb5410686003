// SPDX-License-Identifier: MIT
#include "answers.hpp"

#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "interrupts.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

/// Rows of bits that a question writes: one array of bools, or of words if they stay packed, for each kind of bit.
template <std::size_t Kinds>
class BitRows {
 public:
  using Spans = std::array<std::span<std::uint64_t>, Kinds>;

  BitRows(const Shafts& shafts, std::size_t bounds, bool packed)
      : bounds_(bounds), words_(bit_words(bounds)), packed_(packed) {
    std::vector<py::ssize_t> shape;
    if (!shafts.one) shape.push_back(static_cast<py::ssize_t>(shafts.count));
    shape.push_back(static_cast<py::ssize_t>(packed ? words_ : bounds));
    for (std::size_t kind = 0; kind != Kinds; ++kind) {
      if (packed) {
        py::array_t<std::uint64_t> array(shape);
        memory_[kind] = array.mutable_data();
        arrays_[kind] = array;
      } else {
        py::array_t<bool> array(shape);
        memory_[kind] = array.mutable_data();
        arrays_[kind] = array;
      }
    }
  }

  /// Calls write(spans) for rows [first, first + count), without the lock.
  template <class Write>
  void fill(std::size_t first, std::size_t count, Write&& write) {
    Spans spans;
    std::array<std::vector<std::uint64_t>, Kinds> rows;
    for (std::size_t kind = 0; kind != Kinds; ++kind) {
      if (packed_) {
        spans[kind] = {static_cast<std::uint64_t*>(memory_[kind]) + first * words_, count * words_};
      } else {
        rows[kind].resize(count * words_);
        spans[kind] = rows[kind];
      }
    }
    write(spans);
    if (packed_) return;
    for (std::size_t kind = 0; kind != Kinds; ++kind) {
      for (std::size_t row = 0; row != count; ++row) {
        unpack(rows[kind].data() + row * words_, bounds_, static_cast<bool*>(memory_[kind]) + (first + row) * bounds_);
      }
    }
  }

  [[nodiscard]] const std::array<py::object, Kinds>& arrays() const noexcept { return arrays_; }

 private:
  std::size_t bounds_;
  std::size_t words_;
  bool packed_;
  std::array<py::object, Kinds> arrays_;
  std::array<void*, Kinds> memory_{};
};

/// Asks one(spans, query) of one shaft, or many(shafts, spans, query) of chunks of them.
template <std::size_t Kinds, class One, class Many>
[[nodiscard]] std::array<py::object, Kinds> bit_arrays(const Question& question, bool packed, One&& one, Many&& many) {
  const Shafts& shafts = question.shafts;
  BitRows<Kinds> rows(shafts, question.bounds.size(), packed);
  if (shafts.one) {
    const py::gil_scoped_release release;
    rows.fill(0, 1, [&](const auto& spans) { one(spans, question.options.of(0, 1)); });
  } else {
    in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
      rows.fill(first, count, [&](const auto& spans) {
        many(shafts.span().subspan(first, count), spans, question.options.of(first, count));
      });
    });
  }
  return rows.arrays();
}

/// A bool for each shaft: one(query) of one, or many(shafts, words, query) of chunks.
template <class One, class Many>
[[nodiscard]] py::object bools_of(const Question& question, One&& one, Many&& many) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    bool answer = false;
    {
      const py::gil_scoped_release release;
      answer = one(question.options.of(0, 1));
    }
    return py::bool_(answer);
  }
  py::array_t<bool> array(static_cast<py::ssize_t>(shafts.count));
  bool* const answers = array.mutable_data();
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    std::vector<std::uint64_t> words(bit_words(count));
    many(shafts.span().subspan(first, count), words, question.options.of(first, count));
    unpack(words.data(), count, answers + first);
  });
  return array;
}

}  // namespace

py::object ask_cull(const Question& question, bool packed) {
  return bit_arrays<1>(
      question, packed,
      [&](const auto& bits, const Query& query) { cull(question.shafts.front(), question.bounds, bits[0], query); },
      [&](auto shafts, const auto& bits, const Query& query) {
        cull_many(shafts, question.bounds, bits[0], query);
      })[0];
}

py::object ask_classify(const Question& question, bool packed) {
  const auto arrays = bit_arrays<2>(
      question, packed,
      [&](const auto& bits, const Query& query) {
        classify(question.shafts.front(), question.bounds, bits[0], bits[1], query);
      },
      [&](auto shafts, const auto& bits, const Query& query) {
        classify_many(shafts, question.bounds, bits[0], bits[1], query);
      });
  return py::make_tuple(arrays[0], arrays[1]);
}

py::object ask_any(const Question& question) {
  return bools_of(
      question, [&](const Query& query) { return any(question.shafts.front(), question.bounds, query); },
      [&](auto shafts, std::span<std::uint64_t> words, const Query& query) {
        any_many(shafts, question.bounds, words, query);
      });
}

py::object ask_count(const Question& question) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    std::size_t answer = 0;
    {
      const py::gil_scoped_release release;
      answer = count(shafts.front(), question.bounds, question.options.of(0, 1));
    }
    return py::int_(answer);
  }
  std::vector<std::uint64_t> counts(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t size) {
    count_many(shafts.span().subspan(first, size), question.bounds, std::span(counts).subspan(first, size),
               question.options.of(first, size));
  });
  return array_of(std::move(counts));
}

py::object ask_count_classified(const Question& question) {
  const Shafts& shafts = question.shafts;
  if (shafts.one) {
    KeptCounts counts{};
    {
      const py::gil_scoped_release release;
      counts = count_classified(shafts.front(), question.bounds, question.options.of(0, 1));
    }
    return py::make_tuple(counts.overlap, counts.inside);
  }
  std::vector<KeptCounts> counts(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    count_classified_many(shafts.span().subspan(first, count), question.bounds, std::span(counts).subspan(first, count),
                          question.options.of(first, count));
  });
  std::vector<std::uint64_t> overlap(shafts.count);
  std::vector<std::uint64_t> inside(shafts.count);
  for (std::size_t i = 0; i != shafts.count; ++i) {
    overlap[i] = counts[i].overlap;
    inside[i] = counts[i].inside;
  }
  return py::make_tuple(array_of(std::move(overlap)), array_of(std::move(inside)));
}

py::object ask_occluded(const Question& question) {
  return bools_of(
      question, [&](const Query& query) { return occluded(question.shafts.front(), question.bounds, query); },
      [&](auto shafts, std::span<std::uint64_t> words, const Query& query) {
        occluded_many(shafts, question.bounds, words, query);
      });
}

}  // namespace shaftcull::python
