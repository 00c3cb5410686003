// SPDX-License-Identifier: MIT
#include "sights.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

Sight sight_in(const std::string& text) {
  for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
    if (text == name(sight)) return sight;
  }
  throw py::value_error("sight is '" + text + "'; it must be 'undecided', 'clear', 'occluded' or 'facing_away'");
}

/// An array in the memory of an object, which it keeps alive. It is not written to.
template <class Number>
py::array seen_in(const py::object& owner, const Number* first, std::vector<py::ssize_t> shape,
                  std::vector<py::ssize_t> strides) {
  static constexpr Number none{};
  py::array_t<Number> array(std::move(shape), std::move(strides), first == nullptr ? &none : first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array pairs_of(const Sights& sights, const std::string& name) {
  const Sight sight = sight_in(name);
  const SightCounts& counts = sights.all.counts;
  const std::array<std::uint64_t, 4> numbers = {counts.undecided, counts.clear, counts.occluded, counts.facing_away};
  py::array_t<std::uint32_t> array(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(numbers[static_cast<std::size_t>(sight)]), 2});
  std::uint32_t* to = array.mutable_data();
  const py::gil_scoped_release release;
  sights.for_each(sight, [&to](std::uint32_t i, std::uint32_t j) {
    *to++ = i;
    *to++ = j;
  });
  return array;
}

py::array bits_of(const Sights& sights, const std::string& name, bool packed) {
  const Sight sight = sight_in(name);
  const std::size_t rows = sights.a.size();
  const std::size_t words = bit_words(sights.b.size());
  const std::size_t row = packed ? words : sights.b.size();
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(row)};
  const auto fill = [&](auto* to, auto&& set) {
    std::fill_n(to, rows * row, 0);
    sights.for_each(sight, [&](std::uint32_t i, std::uint32_t j) {
      set(to + i * row, j);
      if (sights.of_one_set) set(to + j * row, i);
    });
  };
  if (packed) {
    py::array_t<std::uint64_t> array(shape);
    std::uint64_t* const to = array.mutable_data();
    const py::gil_scoped_release release;
    fill(to, [](std::uint64_t* at, std::uint32_t j) { at[j / 64] |= std::uint64_t{1} << j % 64; });
    return array;
  }
  py::array_t<bool> array(shape);
  bool* const to = array.mutable_data();
  const py::gil_scoped_release release;
  fill(to, [](bool* at, std::uint32_t j) { at[j] = true; });
  return array;
}

/// What is decided, of many pairs at once.
void add_decided(py::class_<Sights>& answers) {
  answers
      .def_property_readonly(
          "counts", [](const Sights& self) { return counts_of(self.all.counts); },
          "How many pairs are 'undecided', 'clear', 'occluded' and 'facing_away': a dict.")
      .def_property_readonly(
          "products",
          [](const py::object& self) {
            const auto& products = self.cast<const Sights&>().all.products;
            const auto stride = static_cast<py::ssize_t>(sizeof(PairBlock));
            return seen_in(self, products.empty() ? nullptr : &products.data()->a.first,
                           {static_cast<py::ssize_t>(products.size()), 4}, {stride, 4});
          },
          R"(
What is decided: uint32 (p, 4). A row is first_a, count_a, first_b, count_b: all patches of
order_a[first_a:first_a + count_a] and all of order_b[first_b:first_b + count_b] are as `sights` says.)")
      .def_property_readonly(
          "sights",
          [](const py::object& self) {
            const auto& products = self.cast<const Sights&>().all.products;
            const auto stride = static_cast<py::ssize_t>(sizeof(PairBlock));
            return seen_in(self,
                           products.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(&products.data()->sight),
                           {static_cast<py::ssize_t>(products.size())}, {stride});
          },
          "What is said of each product: uint8 (p,): 1 clear, 2 occluded, 3 facing_away.");
}

/// What is not, pair by pair.
void add_undecided(py::class_<Sights>& answers) {
  answers
      .def_property_readonly(
          "undecided",
          [](const py::object& self) {
            const auto& pairs = self.cast<const Sights&>().all.undecided;
            return seen_in(self, pairs.empty() ? nullptr : &pairs.data()->a,
                           {static_cast<py::ssize_t>(pairs.size()), 2}, {8, 4});
          },
          "What is undecided: uint32 (n, 2), indices of patches.")
      .def_property_readonly(
          "offsets",
          [](const py::object& self) -> py::object {
            const auto& sights = self.cast<const Sights&>();
            if (!sights.has_candidates) return py::none();
            const auto& first = sights.all.first_candidate;
            static_assert(sizeof(std::size_t) == 8 || sizeof(std::size_t) == 4);
            using Number = std::conditional_t<sizeof(std::size_t) == 8, std::int64_t, std::int32_t>;
            return seen_in(self, reinterpret_cast<const Number*>(first.data()),
                           {static_cast<py::ssize_t>(first.size())}, {sizeof(Number)});
          },
          "The candidates of undecided pair i are candidates[offsets[i]:offsets[i + 1]]: int64 (n + 1,), or None "
          "without candidates.")
      .def_property_readonly(
          "candidates",
          [](const py::object& self) -> py::object {
            const auto& sights = self.cast<const Sights&>();
            if (!sights.has_candidates) return py::none();
            const auto& candidates = sights.all.candidates;
            return seen_in(self, candidates.empty() ? nullptr : candidates.data(),
                           {static_cast<py::ssize_t>(candidates.size())}, {4});
          },
          "Numbers of occluders, ascending for each pair: uint32, or None.");
}

}  // namespace

py::dict counts_of(const SightCounts& counts) {
  py::dict dict;
  dict[name(Sight::undecided)] = counts.undecided;
  dict[name(Sight::clear)] = counts.clear;
  dict[name(Sight::occluded)] = counts.occluded;
  dict[name(Sight::facing_away)] = counts.facing_away;
  return dict;
}

void add_sights(py::module_& module) {
  using py::arg;
  py::class_<Sights> answers(module, "Visibility", R"(
What visibility() found, of every pair. Arrays that it gives are read-only, and keep it alive.)");
  add_decided(answers);
  add_undecided(answers);
  answers
      .def_property_readonly(
          "order_a", [](const Sights& self) { return order_of(self.a); },
          "The order that products refer to: uint32 (a,), indices of patches. A copy.")
      .def_property_readonly(
          "order_b", [](const Sights& self) { return order_of(self.b); },
          "The same of patches_b; of one set with itself it is order_a.")
      .def_property_readonly(
          "occluders", [](const Sights& self) { return self.occluders; }, "What stood between: Occluders.")
      .def("pairs", &pairs_of, arg("sight"), R"(
All pairs of one kind: uint32 (n, 2), indices of patches, of one set with itself each pair once.

sight: 'undecided', 'clear', 'occluded' or 'facing_away'.)")
      .def("bits", &bits_of, arg("sight"), py::kw_only(), arg("packed") = false, R"(
Which pairs are of one kind: bool (a, b). With packed=True uint64 of (b + 63) // 64 words per row instead. Of one set
with itself both bits of a pair are set.

sight: 'undecided', 'clear', 'occluded' or 'facing_away'.)")
      .def("__repr__", [](const Sights& self) {
        const SightCounts& counts = self.all.counts;
        return "<shaftcull.Visibility of " + std::to_string(counts.total()) + " pairs, " +
               std::to_string(counts.undecided) + " undecided>";
      });
}

}  // namespace shaftcull::python
