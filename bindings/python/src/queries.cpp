// SPDX-License-Identifier: MIT
/// Queries as methods of the classes that hold bounds, and the layers that queries choose by.
#include <cstdint>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "module.hpp"
#include "queries.hpp"

namespace shaftcull::python {

namespace {

using py::arg;

constexpr const char* about_shafts = R"(

shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
    ends.
exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.)";

constexpr const char* about_calls = R"(

TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.)";

// Keywords that some queries take, in the order of their names.

struct LimitKeyword {
  using Value = py::object;
  static constexpr const char* about = R"(
limit: an integer, 0 or more: stops after this many results per shaft.)";
  static py::arg_v named() { return arg("limit") = py::none(); }
  static void give(Options& options, const Value& limit) {
    options.limit = number_in(limit, "limit").value_or(Query::no_limit);
  }
};

struct OnlyKeyword {
  using Value = py::object;
  static constexpr const char* about = R"(
only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.)";
  static py::arg_v named() { return arg("only") = py::none(); }
  static void give(Options& options, const Value& only) {
    if (!only.is_none()) options.only = indices_for_all(only, "only", options.bounds);
  }
};

struct SkipKeyword {
  using Value = bool;
  static constexpr const char* about = R"(
skip_overlapping: True leaves out bounds that the box overlaps at the start. With closed contact, these are
    all bounds that touch it; with open contact, those that reach into it, so a wall beside the box still
    stops it.)";
  static py::arg_v named() { return arg("skip_overlapping") = false; }
  static void give(Options& options, Value skip) { options.skip_overlapping = skip; }
};

struct TestKeyword {
  using Value = std::string;
  static constexpr const char* about = R"(
triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.)";
  static py::arg_v named() { return arg("triangle_test") = "exact"; }
  static void give(Options& options, const Value& test) { options.triangle_test = triangle_test_in(test); }
};

/// A query as a method, with these keywords and those that leave bounds out.
template <class... Keywords, class Class, class... Extra, class... Args>
void ask(Class& to, const char* name, py::object (*question)(const Question&, Extra...), const std::string& text,
         const Args&... args) {
  const py::object none = py::none();
  to.def(
      name,
      [question](Holder& self, const py::object& shafts, const py::object& b, const py::object& exclude,
                 const py::object& exclude_each, const py::object& exclude_mask, const py::object& layer_mask,
                 const typename Keywords::Value&... values, Extra... extra) {
        const Shafts asked = shafts_in(shafts, b);
        const Reading reading(self.usage);
        Options options(asked, self, exclude, exclude_each, exclude_mask, layer_mask);
        (Keywords::give(options, values), ...);
        return question({self.bounds(), asked, options}, extra...);
      },
      arg("shafts"), arg("b") = none, py::kw_only(), arg("exclude") = none, arg("exclude_each") = none,
      arg("exclude_mask") = none, arg("layer_mask") = none, Keywords::named()..., args...,
      (text + about_shafts + (std::string() + ... + Keywords::about) + about_calls).c_str());
}

/// Queries of all bounds.
void add_queries(py::class_<Holder>& to) {
  ask<OnlyKeyword, TestKeyword>(to, "cull", &ask_cull, R"(
Which bounds the shafts keep (bounds that are not outside): bool (n, bounds), or (bounds,) for one shaft.
With packed=True, uint64 (n, (bounds + 63) // 64): bit i % 64 of word i // 64 is for bound i.)",
                                arg("packed") = false);
  ask<OnlyKeyword, TestKeyword>(to, "any", &ask_any, R"(
Whether the shafts keep any bound: bool (n,), or a bool for one shaft.)");
  ask<OnlyKeyword, TestKeyword>(to, "classify", &ask_classify, R"(
Which bounds the shafts keep, and which of these are inside: a tuple of two arrays like that of cull().)",
                                arg("packed") = false);
  ask<LimitKeyword, OnlyKeyword, TestKeyword>(to, "count", &ask_count, R"(
How many bounds the shafts keep: int64 (n,), or an int for one shaft.)");
  ask<OnlyKeyword, TestKeyword>(to, "count_classified", &ask_count_classified, R"(
How many bounds overlap the shafts and how many are inside: two int64 (n,), or two int for one shaft.)");
  ask<LimitKeyword, OnlyKeyword, TestKeyword>(to, "list", &ask_list, R"(
The indices of the bounds that the shafts keep: IndexLists of n lists, or uint32 (k,) for one shaft. Lists
ascend; lists of a tree are in tree order. With times=True, IndexLists.times (for one shaft, a second array)
has the times at which the moving box reaches each box or sphere: float32, as in first_contact().)",
                                              arg("times") = false);
  ask<OnlyKeyword, TestKeyword>(to, "list_classified", &ask_list_classified, R"(
The indices of the bounds that overlap the shafts, and of those that are inside: two results like that of
list().)");
}

/// Queries of boxes and spheres.
template <class Bound>
void add_first_contact(py::class_<HolderOf<Bound>, Holder>& to) {
  ask<OnlyKeyword, SkipKeyword>(to, "first_contact", &ask_first_contact, R"(
The bound that the moving box of each shaft reaches first, and the time: a tuple of indices, int64 (n,), and
times, float32 (n,); for one shaft, an int and a float. They are -1 and infinity if the box reaches no bound.
Time is 0 at a and 1 at b: at time 1, a swept body has moved by its whole displacement. Times are rounded
down; the first bound is determined exactly. With normals=True, a third array has the normals of contact:
float32 (n, 3), or (3,) for one shaft. They have unit length, and point from the bound towards the moving
box. For a box, the normal is one of +-x, +-y and +-z. It is zero if the two overlap at the start, or touch
at the start without the box moving into the bound. ValueError for hulls.)",
                                arg("normals") = false);
  to.def("entry_times", &ask_entry_times, arg("shafts"), arg("indices"), R"(
The times at which the moving box of one shaft reaches bounds: float32 (k,), as in first_contact(). Infinity
for bounds that the shaft does not keep.

shafts: Shafts of shape (). indices: integers (k,). ValueError for more shafts and for hulls, IndexError for
    an index out of range, NeedsRefit for a tree that needs refit(). Runs on the calling thread. Other
    threads of Python continue.)");
}

/// Queries of boxes that are solid.
void add_occluders(py::class_<HolderOf<Box>, Holder>& to) {
  ask(to, "occluded", &ask_occluded, R"(
Whether one of the boxes, which are solid, hides one end of a shaft from the other: every segment between the
relative interiors of a and b passes through the box, and does not only touch it. bool (n,), or a bool for
one shaft. ValueError for shafts that are not between boxes or polygons.)");
  ask(to, "find_occluder", &ask_find_occluder, R"(
The index of a box that hides one end of a shaft from the other, as in occluded(): int64 (n,), or an int for
one shaft; -1 if no box does.)");
  ask<LimitKeyword>(to, "list_occluders", &ask_list_occluders, R"(
The indices of all boxes that hide one end of a shaft from the other, as in occluded(): a result like that of
list().)");
}

void set_layers(Holder& self, const py::object& layers, const py::object& indices) {
  const std::vector<std::uint32_t> sets = layers_in(layers, "layers");
  const bool some = !indices.is_none();
  const IndicesIn in = some ? indices_in(indices, "indices", self.size(), "bounds") : IndicesIn{};
  const std::size_t wanted = some ? in.indices.size() : self.size();
  if (sets.size() != wanted) {
    throw py::value_error("there are " + std::to_string(wanted) + (some ? " indices" : " bounds") +
                          ", but layers has " + std::to_string(sets.size()) + " sets of layers; give one for each");
  }
  if (some && wanted != 0 && !self.has_layers()) {
    throw py::value_error("indices name some bounds, and there are no layers yet; set those of all bounds first");
  }
  const Changing changing(self.usage);
  const py::gil_scoped_release release;
  self.set_layers(sets, some ? &in.indices : nullptr);
}

void add_layers(py::class_<Holder>& to) {
  to.def("set_layers", &set_layers, arg("layers"), arg("indices") = py::none(), R"(
Puts bounds into layers, by which queries select bounds (layer_mask): bit l is set if the bound is in layer
l. A TriangleTree has no layers.

layers: integers (bounds,) from 0 to 2**32 - 1, which are copied; with indices, integers (k,), the layers of
    these bounds.

ValueError for another number of layers, IndexError for an index out of range, RuntimeError if another thread
uses this object.)")
      .def(
          "clear_layers",
          [](Holder& self) {
            const Changing changing(self.usage);
            self.clear_layers();
          },
          "Removes all layers. RuntimeError if another thread uses this object.")
      .def_property_readonly("has_layers", &Holder::has_layers, "bool: whether bounds are in layers.");
}

/// The class of one kind of bounds.
template <class Bound>
py::class_<HolderOf<Bound>, Holder> add_kind(py::module_& module) {
  using Of = Kind<Bound>;
  const std::string text = py::str("{0}: a {1}View, a {1}Stream or a {1}Tree.").format(Of::title, Of::name);
  py::class_<HolderOf<Bound>, Holder> kind(module, Of::title, text.c_str());
  kind.def("__repr__", [](const py::object& self) {
    return py::str("<shaftcull.{} of {} {}>").format(py::type::of(self).attr("__name__"), py::len(self), Of::plural);
  });
  return kind;
}

}  // namespace

void add_bounds(py::module_& module) {
  py::class_<Holder> bounds(module, "Bounds", R"(
Boxes, spheres or triangles in a view, a stream or a tree, and the queries of shafts against them. Answers do
not depend on the container. len() is the number of bounds.)");
  bounds.def("__len__", &Holder::size);
  add_queries(bounds);
  add_layers(bounds);

  auto boxes = add_kind<Box>(module);
  add_first_contact(boxes);
  add_occluders(boxes);
  auto spheres = add_kind<Sphere>(module);
  add_first_contact(spheres);
  add_kind<Triangle>(module);
}

}  // namespace shaftcull::python
