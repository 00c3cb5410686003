// SPDX-License-Identifier: MIT
/// Which patches see each other: the calls about all pairs, and their answers.
#include "shaftcull/visibility.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "long_call.hpp"
#include "module.hpp"
#include "patches.hpp"
#include "results.hpp"
#include "shaftcull/rays.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

namespace {

using py::arg;

/// The arguments of a call.
struct Asked {
  PatchSet a;
  PatchSet b;
  bool of_one_set;
  OccludersHolder occluders;
  VisibilityOptions options;

  /// Calls call(a, b, occluders, options), or without b for one set with itself.
  template <class Call>
  auto ask(const VisibilityOptions& with, Call&& call) const {
    return of_one_set ? call(a, *occluders.all, with) : call(a, b, *occluders.all, with);
  }
};

Sight sight_in(const std::string& text) {
  for (const Sight sight : all_sights) {
    if (text == name(sight)) return sight;
  }
  throw py::value_error("sight is '" + text + "'; it must be 'undecided', 'clear', 'occluded' or 'facing_away'");
}

/// What Python knows as shaftcull.Visibility.
struct Sights {
  Visibility all;
  Asked asked;

  /// Calls use(i, j) for each pair of a kind, by the user's indices.
  template <class Use>
  void for_each(Sight sight, Use&& use) const {
    for (const PairBlock& block : all.blocks) {
      if (block.sight != sight) continue;
      for (const std::uint32_t i : asked.a.order().subspan(block.a.first, block.a.count)) {
        for (const std::uint32_t j : asked.b.order().subspan(block.b.first, block.b.count)) use(i, j);
      }
    }
    if (sight != Sight::undecided) return;
    for (const PatchPair& pair : all.undecided) use(pair.a, pair.b);
  }
};

py::array pairs_of(const Sights& sights, const std::string& name) {
  const Sight sight = sight_in(name);
  py::array_t<std::uint32_t> array({static_cast<std::size_t>(sights.all.counts.of(sight)), std::size_t{2}});
  std::uint32_t* to = array.mutable_data();
  const py::gil_scoped_release release;
  sights.for_each(sight, [&to](std::uint32_t i, std::uint32_t j) {
    *to++ = i;
    *to++ = j;
  });
  return array;
}

py::object rows_of_bits(const Sights& sights, const std::string& name, bool packed) {
  const Sight sight = sight_in(name);
  const std::size_t row = bit_words(sights.asked.b.size());
  py::array_t<std::uint64_t> words({sights.asked.a.size(), row});
  {
    std::uint64_t* const to = words.mutable_data();
    const py::gil_scoped_release release;
    std::fill_n(to, sights.asked.a.size() * row, 0);
    const auto set = [&](std::size_t i, std::size_t j) { to[i * row + j / 64] |= std::uint64_t{1} << j % 64; };
    sights.for_each(sight, [&](std::uint32_t i, std::uint32_t j) {
      set(i, j);
      if (sights.asked.of_one_set) set(j, i);
    });
  }
  return bits_of(words, sights.asked.b.size(), packed);
}

/// An array in the memory of a vector, which the owner keeps, and of which nobody writes: of each element the number at
/// `offset`, or so many `numbers` from there on as a second axis.
template <class Number, class Element>
py::array seen_in(const py::object& owner, const std::vector<Element>& vector, std::size_t offset = 0,
                  std::size_t numbers = 0) {
  static constexpr Number none{};
  std::vector<std::size_t> shape{vector.size()};
  std::vector<std::size_t> strides{sizeof(Element)};
  if (numbers != 0) {
    shape.push_back(numbers);
    strides.push_back(sizeof(Number));
  }
  const auto* const bytes = reinterpret_cast<const char*>(vector.data()) + offset;
  const auto* const memory = vector.empty() ? &none : reinterpret_cast<const Number*>(bytes);
  py::array_t<Number> array(std::move(shape), std::move(strides), memory, owner);
  array.attr("setflags")(arg("write") = false);
  return array;
}

const Visibility& found_in(const py::object& self) { return self.cast<const Sights&>().all; }

void add_sights(py::module_& module) {
  py::class_<Sights>(module, "Visibility", R"(
The answers of visibility() for all pairs. pairs() and bits() return the pairs with one answer; `blocks` and
`undecided` hold the same pairs in less memory. Arrays are read-only, and keep the Visibility alive.)")
      .def_property_readonly(
          "counts", [](const Sights& self) { return counts_of(self.all.counts); },
          "The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int.")
      .def_property_readonly(
          "blocks",
          [](const py::object& self) {
            return seen_in<std::uint32_t>(self, found_in(self).blocks, offsetof(PairBlock, a), 4);
          },
          R"(
Decided pairs, in blocks: uint32 (p, 4). A row is first_a, count_a, first_b, count_b: every pair of a patch
of order_a[first_a:first_a + count_a] and a patch of order_b[first_b:first_b + count_b] has the answer in
`sights`.)")
      .def_property_readonly(
          "sights",
          [](const py::object& self) {
            return seen_in<std::uint8_t>(self, found_in(self).blocks, offsetof(PairBlock, sight));
          },
          "The answer for all pairs of each pair block: uint8 (p,): 1 clear, 2 occluded, 3 facing_away.")
      .def_property_readonly(
          "undecided",
          [](const py::object& self) { return seen_in<std::uint32_t>(self, found_in(self).undecided, 0, 2); },
          "Undecided pairs: uint32 (n, 2), indices of patches.")
      .def_property_readonly(
          "candidates",
          [](const py::object& self) -> py::object {
            if (!self.cast<const Sights&>().asked.options.candidates) return py::none();
            return lists_of(seen_in<std::ptrdiff_t>(self, found_in(self).first_candidate),
                            seen_in<std::uint32_t>(self, found_in(self).candidates));
          },
          R"(
The candidates of each undecided pair, which are the occluders that reach between its patches: IndexLists of
n ascending lists; None if candidates were not requested.)")
      .def_property_readonly(
          "order_a", [](const Sights& self) { return copy_of(self.asked.a.order()); },
          "The order to which pair blocks refer: uint32 (a,), indices of patches. A copy.")
      .def_property_readonly(
          "order_b", [](const Sights& self) { return copy_of(self.asked.b.order()); },
          "The same for patches_b: uint32 (b,); for one set with itself it is order_a.")
      .def_property_readonly(
          "occluders", [](const Sights& self) { return self.asked.occluders; }, R"(
The occluders that stood between patches: Occluders.)")
      .def("pairs", &pairs_of, arg("sight"), R"(
All pairs with one answer: uint32 (n, 2), indices of patches; for one set with itself, each pair once.

sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for other values. Other threads of
    Python continue.)")
      .def("bits", &rows_of_bits, arg("sight"), py::kw_only(), arg("packed") = false, R"(
Which pairs have one answer: bool (a, b). With packed=True, uint64 (a, (b + 63) // 64), 64 pairs per word.
For one set with itself, both bits of a pair are set.

sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for other values. Other threads of
    Python continue.)")
      .def(
          "fractions",
          [](const Sights& self, std::uint32_t rays, double error, std::uint64_t seed) {
            if (!self.asked.options.candidates) {
              throw py::value_error("there are no candidates, which rays need: ask visibility() with candidates=True");
            }
            begin_parallel();
            std::vector<float> fractions(self.all.undecided.size());
            {
              const py::gil_scoped_release release;
              visible_fractions(
                  self.asked.a, self.asked.b, *self.asked.occluders.all,
                  {self.all.undecided, self.all.first_candidate, self.all.candidates}, fractions,
                  {.rays = rays, .error = error, .seed = seed, .tolerance = self.asked.options.tolerance});
            }
            return array_of(std::move(fractions));
          },
          py::kw_only(), arg("rays") = RayOptions().rays, arg("error") = RayOptions().error,
          arg("seed") = RayOptions().seed, R"(
The visible fraction of each undecided pair, by rays between points of both patches: float32 (n,), from
0 to 1. A box counts as solid.

rays: the number of rays per pair, 1 to 65536. error: a pair gets fewer rays if its standard error is at most
this. seed: determines the points. ValueError for other values, without candidates, and for patches that are
boxes with an interior. Other threads of Python continue.)")
      .def("__repr__", [](const Sights& self) {
        const SightCounts& counts = self.all.counts;
        return "<shaftcull.Visibility of " + std::to_string(counts.total()) + " pairs, " +
               std::to_string(counts.undecided) + " undecided>";
      });
}

/// A call about all pairs, whose answer is run(asked, progress, extra…).
template <class... Extra, class Run, class... Args>
void add_call(py::module_& module, const char* name, Run run, const std::string& text, const std::string& about_extra,
              const Args&... args) {
  const py::object none = py::none();
  module.def(
      name,
      [run](const py::object& patches, const py::object& patches_b, const py::object& planes,
            const py::object& planes_b, const py::object& occluders, const py::object& solids, const py::object& hulls,
            const py::object& polygons, const py::object& triangles, const py::object& faces, const py::object& groups,
            const py::object& rounding, const std::string& contact, float tolerance, bool solids_around_ends,
            std::size_t memory, std::uint32_t part, std::uint32_t parts, const py::object& progress, Extra... extra) {
        const bool of_one_set = patches_b.is_none();
        if (of_one_set && !planes_b.is_none()) throw py::value_error("planes_b are given, but no patches_b");
        const Rounding rounded = rounding_in(rounding);
        const PatchSet a = patches_in(patches, planes, rounded, "patches", "planes");
        Asked asked{a,
                    of_one_set ? a : patches_in(patches_b, planes_b, rounded, "patches_b", "planes_b"),
                    of_one_set,
                    occluders_in(occluders, {solids, hulls, polygons, triangles, faces, groups}, rounded),
                    {}};
        asked.options.contact = contact_in(contact);
        asked.options.tolerance = tolerance;
        asked.options.solids_around_ends = solids_around_ends;
        asked.options.memory = memory;
        asked.options.part = part;
        asked.options.parts = parts;
        return run(asked, progress, extra...);
      },
      arg("patches"), arg("patches_b") = none, py::kw_only(), arg("planes") = none, arg("planes_b") = none,
      arg("occluders") = none, arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
      arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("rounding") = none,
      arg("contact") = "open", arg("tolerance") = 0.0F, arg("solids_around_ends") = true,
      arg("memory") = VisibilityOptions().memory, arg("part") = 0, arg("parts") = 1, arg("progress") = none, args...,
      (text + R"(

patches, patches_b: boxes, float32 (n, 6); corners, float32 (n, k, 3); or Patches. Without patches_b, every
    two patches are one pair.
planes, planes_b: for patches that face one side: float32 (n, 4), or (4,) for all; normal and offset.
occluders: boxes around things that may hide something; or Occluders, and then none of the arguments from
    solids to groups.
solids, hulls, polygons, triangles with faces, groups: other objects between patches, as for Occluders.
rounding: 'outwards' also accepts boxes of float64 for patches and `occluders`, as for Patches and Occluders.
contact: 'open' leaves out occluders that only touch a shaft, so a patch may lie on an occluder; 'closed'
    does not.
tolerance: how far in front of a plane a point may be and still count as behind it, for rounded corners.
solids_around_ends: whether a solid that a patch reaches into may make pairs of the patch 'occluded'.
memory: limit in bytes for answers in progress, 1 MB or more.
part, parts: divides all pairs into `parts` parts and answers part `part`, 0 to parts - 1, so that several
    processes can share the work. Each pair is in exactly one part.
progress: called as progress(done, total) several times per second, on this thread; if it raises, the call
    ends.)" +
       about_extra + R"(

TypeError, ValueError, IndexError or BadBound names the argument that does not fit. Runs on all processors.
Other threads of Python continue, and Ctrl-C ends the call. RuntimeError in a child of fork() whose parent
has made parallel calls.)")
          .c_str());
}

}  // namespace

void add_visibility(py::module_& module) {
  add_sights(module);
  add_call<bool>(
      module, "visibility",
      [](Asked& asked, const py::object& progress, bool candidates) {
        asked.options.candidates = candidates;
        Visibility all = while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          return asked.ask(options, [](const auto&... of) { return collect_visibility(of...); });
        });
        return std::make_unique<Sights>(Sights{std::move(all), std::move(asked)});
      },
      R"(
Which patches see each other. Each pair of patches gets one answer: nothing stands between them ('clear'),
one solid hides each from the other ('occluded'), one lies behind the plane of the other ('facing_away'), or
none of these ('undecided'). All answers are exact for the float32 given. Returns a Visibility, which takes
20 bytes per pair block, 16 per undecided pair, and 4 per candidate.)",
      R"(
candidates: whether undecided pairs come with candidates, the occluders that reach between the patches.)",
      arg("candidates") = true);
  add_call<>(
      module, "count_visibility",
      [](Asked& asked, const py::object& progress) {
        return counts_of(while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          return asked.ask(options, [](const auto&... of) { return count_visibility(of...); });
        }));
      },
      R"(
The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int, like the
counts of visibility(). It stores nothing per pair.)",
      "");
}

}  // namespace shaftcull::python
