// SPDX-License-Identifier: MIT
/// The questions that bounds are asked, and their answers as arrays. Each takes what holds the bounds, the shafts, and
/// what a query chooses; the lock is released while the library works.
#pragma once

#include <array>

#include "holders.hpp"
#include "interrupts.hpp"

namespace shaftcull::python {

/// Rows of bits that a question writes: one array of bools, or of words if they stay packed, for each kind of bit.
template <std::size_t Kinds>
class BitRows {
 public:
  using Spans = std::array<std::span<std::uint64_t>, Kinds>;

  BitRows(const Shafts& shafts, std::size_t bounds, bool packed)
      : bounds_(bounds), words_(words_for(bounds)), packed_(packed) {
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

/// Asks one(spans, option…) of one shaft, or many(range of shafts, spans, option…) of chunks of them.
template <std::size_t Kinds, class Option, class One, class Many>
[[nodiscard]] std::array<py::object, Kinds> bits_of(const Shafts& shafts, std::size_t bounds, const Option& option,
                                                    bool packed, One&& one, Many&& many) {
  BitRows<Kinds> rows(shafts, bounds, packed);
  if (shafts.one) {
    const py::gil_scoped_release release;
    rows.fill(0, 1, [&](const auto& spans) {
      std::apply([&](const auto&... with) { one(spans, with...); }, option.of(0, 1));
    });
  } else {
    in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
      rows.fill(first, count, [&](const auto& spans) {
        std::apply([&](const auto&... with) { many(shafts.span().subspan(first, count), spans, with...); },
                   option.of(first, count));
      });
    });
  }
  return rows.arrays();
}

template <class Holder>
py::object ask_cull(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option, bool packed) {
  return bits_of<1>(
      shafts, bounds.size(), option, packed,
      [&](const auto& bits, const auto&... with) { cull(shafts.front(), bounds.set(), bits[0], with...); },
      [&](auto range, const auto& bits, const auto&... with) { cull_many(range, bounds.set(), bits[0], with...); })[0];
}

template <class Holder>
py::object ask_classify(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option, bool packed) {
  const auto arrays = bits_of<2>(
      shafts, bounds.size(), option, packed,
      [&](const auto& bits, const auto&... with) { classify(shafts.front(), bounds.set(), bits[0], bits[1], with...); },
      [&](auto range, const auto& bits, const auto&... with) {
        classify_many(range, bounds.set(), bits[0], bits[1], with...);
      });
  return py::make_tuple(arrays[0], arrays[1]);
}

template <class Holder>
py::object ask_contained(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option, bool packed) {
  return bits_of<1>(
      shafts, bounds.size(), option, packed,
      [&](const auto& bits, const auto&... with) { contained(shafts.front(), bounds.set(), bits[0], with...); },
      [&](auto range, const auto& bits, const auto&... with) {
        contained_many(range, bounds.set(), bits[0], with...);
      })[0];
}

/// A bool for each shaft: one(option…) of one, or many(range, words, option…) of chunks.
template <class Option, class One, class Many>
py::object bools_of(const Shafts& shafts, const Option& option, One&& one, Many&& many) {
  if (shafts.one) {
    bool answer = false;
    {
      const py::gil_scoped_release release;
      answer = std::apply(one, option.of(0, 1));
    }
    return py::bool_(answer);
  }
  py::array_t<bool> array(static_cast<py::ssize_t>(shafts.count));
  bool* const answers = array.mutable_data();
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    std::vector<std::uint64_t> words(words_for(count));
    std::apply(
        [&](const auto&... with) {
          many(shafts.span().subspan(first, count), std::span<std::uint64_t>(words), with...);
        },
        option.of(first, count));
    unpack(words.data(), count, answers + first);
  });
  return array;
}

template <class Holder>
py::object ask_any(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  return bools_of(
      shafts, option, [&](const auto&... with) { return any(shafts.front(), bounds.set(), with...); },
      [&](auto range, auto words, const auto&... with) { any_many(range, bounds.set(), words, with...); });
}

/// A number for each shaft, likewise: one(option…) is a std::size_t, many() writes to a span of numbers.
template <class Option, class One, class Many>
py::object numbers_of(const Shafts& shafts, const Option& option, One&& one, Many&& many) {
  if (shafts.one) {
    std::size_t answer = 0;
    {
      const py::gil_scoped_release release;
      answer = std::apply(one, option.of(0, 1));
    }
    return py::int_(answer);
  }
  std::vector<std::uint64_t> numbers(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    std::apply(
        [&](const auto&... with) {
          many(shafts.span().subspan(first, count), std::span(numbers).subspan(first, count), with...);
        },
        option.of(first, count));
  });
  return array_of(std::move(numbers));
}

template <class Holder>
py::object ask_count_all(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  return numbers_of(
      shafts, option, [&](const auto&... with) { return count(shafts.front(), bounds.set(), with...); },
      [&](auto range, auto numbers, const auto&... with) { count_many(range, bounds.set(), numbers, with...); });
}

template <class Holder>
py::object ask_count(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option, const py::object& at_most) {
  const auto most = number_in(at_most, "at_most");
  if (!most) return ask_count_all(bounds, shafts, option);
  return numbers_of(
      shafts, option, [&](const auto&... with) { return count_at_most(shafts.front(), bounds.set(), *most, with...); },
      [&](auto range, auto numbers, const auto&... with) {
        count_at_most_many(range, bounds.set(), *most, numbers, with...);
      });
}

template <class Holder>
py::object ask_count_classified(Holder& bounds, const Shafts& shafts, const OptionOf<Holder>& option) {
  if (shafts.one) {
    KeptCounts counts{};
    {
      const py::gil_scoped_release release;
      counts = std::apply([&](const auto&... with) { return count_classified(shafts.front(), bounds.set(), with...); },
                          option.of(0, 1));
    }
    return py::make_tuple(counts.overlap, counts.inside);
  }
  std::vector<KeptCounts> counts(shafts.count);
  in_chunks(shafts.count, Chunks::side_by_side, [&](std::size_t first, std::size_t count) {
    std::apply(
        [&](const auto&... with) {
          count_classified_many(shafts.span().subspan(first, count), bounds.set(),
                                std::span(counts).subspan(first, count), with...);
        },
        option.of(first, count));
  });
  std::vector<std::uint64_t> overlap(shafts.count);
  std::vector<std::uint64_t> inside(shafts.count);
  for (std::size_t i = 0; i != shafts.count; ++i) {
    overlap[i] = counts[i].overlap;
    inside[i] = counts[i].inside;
  }
  return py::make_tuple(array_of(std::move(overlap)), array_of(std::move(inside)));
}

}  // namespace shaftcull::python
