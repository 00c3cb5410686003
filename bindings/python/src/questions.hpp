// SPDX-License-Identifier: MIT
/// The questions as methods of a class in Python, with the arguments that what holds the bounds takes.
#pragma once

#include <string>

#include "lists.hpp"

namespace shaftcull::python {

inline constexpr const char* about_shafts = R"(

shafts, b: Shafts; or a ConvexHull; or boxes a and b that shafts are between, as Shafts.between() takes them.)";
inline constexpr const char* about_leaving_out = R"(
own: integers (n, k), or (k,) for one shaft: the indices of bounds to leave out for each shaft, its own two, say.
mask: bool (bounds,): True leaves a bound out for all shafts.
only_layers: integers, one or (n,): leaves out bounds that are in none of these layers (set_layers()).)";
inline constexpr const char* about_test = R"(
test: 'exact', or 'vertices', which is cheaper, keeps more, and is the only one for convex hulls.)";

/// A question as a method: what it does, and then what its arguments are.
template <class Holder, class Class, class... Extra, class... Args>
void ask(Class& to, const char* name, py::object (*question)(Holder&, const Shafts&, const OptionOf<Holder>&, Extra...),
         const std::string& text, const Args&... args) {
  using py::arg;
  const py::object none = py::none();
  if constexpr (std::is_same_v<OptionOf<Holder>, LeftOut>) {
    to.def(
        name,
        [question](Holder& self, const py::object& shafts, const py::object& b, const py::object& own,
                   const py::object& mask, const py::object& only_layers, Extra... extra) {
          const Shafts asked = shafts_in(shafts, b);
          const LeftOut left_out(own, mask, only_layers, asked, self.size());
          const Reading reading(self.usage);
          return question(self, asked, left_out, extra...);
        },
        arg("shafts"), arg("b") = none, py::kw_only(), arg("own") = none, arg("mask") = none, arg("only_layers") = none,
        args..., (text + about_shafts + about_leaving_out).c_str());
  } else if constexpr (std::is_same_v<OptionOf<Holder>, TestOption>) {
    to.def(
        name,
        [question](Holder& self, const py::object& shafts, const py::object& b, const std::string& test,
                   Extra... extra) {
          const Shafts asked = shafts_in(shafts, b);
          const Reading reading(self.usage);
          return question(self, asked, test_in(test), extra...);
        },
        arg("shafts"), arg("b") = none, py::kw_only(), arg("test") = "exact", args...,
        (text + about_shafts + about_test).c_str());
  } else {
    to.def(
        name,
        [question](Holder& self, const py::object& shafts, const py::object& b, Extra... extra) {
          const Shafts asked = shafts_in(shafts, b);
          const Reading reading(self.usage);
          return question(self, asked, FlatOption{}, extra...);
        },
        arg("shafts"), arg("b") = none, py::kw_only(), args..., (text + about_shafts).c_str());
  }
}

/// The order that lists have.
template <class Holder>
[[nodiscard]] std::string in_order() {
  return requires(Holder & holder) { holder.tree; }
  ? "in the order of the tree (order)" : "ascending";
}

/// What all bounds are asked.
template <class Holder, class Class>
void add_common_questions(Class& to) {
  using py::arg;
  to.def("__len__", &Holder::size);
  ask<Holder>(to, "cull", &ask_cull<Holder>, R"(
Which bounds are kept: not outside. bool (n, bounds), or (bounds,) for one shaft. With packed=True uint64 of
(bounds + 63) // 64 words instead: bit i % 64 of word i // 64 is bound i.)",
              arg("packed") = false);
  ask<Holder>(to, "any", &ask_any<Holder>, R"(
Whether any bound is kept. bool (n,), or one.)");
}

/// What boxes and spheres are asked.
template <class Holder, class Class>
void add_questions(Class& to) {
  using py::arg;
  const py::object none = py::none();
  add_common_questions<Holder>(to);
  ask<Holder>(to, "classify", &ask_classify<Holder>, R"(
Which bounds are kept, and which of these are inside: two arrays as that of cull().)",
              arg("packed") = false);
  ask<Holder>(to, "contained", &ask_contained<Holder>, R"(
Which bounds are inside: an array as that of cull().)",
              arg("packed") = false);
  ask<Holder>(to, "count", &ask_count<Holder>, R"(
How many bounds are kept: int64 (n,), or an int. With at_most=k it stops counting there.)",
              arg("at_most") = none);
  ask<Holder>(to, "count_classified", &ask_count_classified<Holder>, R"(
How many bounds overlap shafts and how many are inside: two of int64 (n,), or of int.)");
  ask<Holder>(to, "list", &ask_list<Holder>,
              R"(
Which bounds are kept: (offsets, indices), int64 (n + 1,) and uint32; shaft i keeps
indices[offsets[i]:offsets[i + 1]], )" +
                  in_order<Holder>() +
                  R"(.
Of one shaft the indices alone. With at_most=k it stops at the first k.
With times=True there is one array more, float32: when the moving box reaches each bound, as those of first().)",
              arg("at_most") = none, arg("times") = false);
  ask<Holder>(to, "list_classified", &ask_list_classified<Holder>, R"(
Which bounds overlap shafts, and which are inside: two results as that of list().)");
  ask<Holder>(to, "first", &ask_first<Holder>, R"(
Which bound the moving box of a shaft reaches first, and when: (indices, times), int64 and float32 (n,), or an int and a
float. -1 and infinity if it reaches none. Time is 0 at a and 1 at b; a body that is swept is at b = body +
displacement then. Times are rounded down; which bound is first is decided exactly.)");
  to.def("refine", &ask_refine<Holder>, arg("shafts"), arg("candidates"), R"(
Which of some bounds are kept, in their order: results as those of list().

shafts: Shafts, or a ConvexHull. candidates: integers, the indices of bounds, the same for all shafts.)");
  to.def("entry_times", &ask_entry_times<Holder>, arg("shafts"), arg("indices"), R"(
When the moving box of one shaft reaches bounds: float32, infinity for those that are not kept.

shafts: one shaft. indices: integers (k,).)");
}

/// What boxes are asked beyond that.
template <class Holder, class Class>
void add_blocking(Class& to) {
  ask<Holder>(to, "blocked", &ask_blocked<Holder>, R"(
Whether one of the boxes, which are solid, hides the one end of a shaft from the other: every segment from a to b passes
through it. Touching does not block. bool (n,), or one. Only shafts between boxes can be asked.)");
  ask<Holder>(to, "blocked_by", &ask_blocked_by<Holder>, R"(
The index of a box that hides the one end of a shaft from the other: int64 (n,), or an int; -1 for none.)");
  ask<Holder>(to, "list_blocking", &ask_list_blocking<Holder>, R"(
The indices of all boxes that hide the one end of a shaft from the other: a result as that of list().)");
}

}  // namespace shaftcull::python
