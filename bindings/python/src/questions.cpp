// SPDX-License-Identifier: MIT
/// The questions as methods of classes in Python, and the layers that they choose by.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "answers.hpp"
#include "arrays.hpp"
#include "module.hpp"

namespace shaftcull::python {

namespace {

constexpr const char* about_shafts = R"(

shafts, b: Shafts; or a ConvexHull; or boxes a and b that shafts are between, as Shafts.between() takes them.
exclude: integers (k,), or one: the indices of bounds to leave out for all shafts, a moving body itself, say.
exclude_each: integers (n, k), or (n,): indices for each of many shafts, its own two objects, say.
exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
layer_mask: integers, one or (n,): leaves out bounds that are in none of these layers (set_layers()).)";

// Keywords that some questions take, in the order of their names.

struct LimitKeyword {
  using Value = py::object;
  static constexpr const char* about = R"(
limit: an integer: stops at so many results for each shaft, those that come first.)";
  static py::arg_v named() { return py::arg("limit") = py::none(); }
  static void give(Options& options, const Value& limit) { options.set_limit(limit); }
};

struct OnlyKeyword {
  using Value = py::object;
  static constexpr const char* about = R"(
only: integers (k,): asks only about these bounds, candidates of a larger shaft, say; lists keep their order.)";
  static py::arg_v named() { return py::arg("only") = py::none(); }
  static void give(Options& options, const Value& only) { options.set_only(only); }
};

struct TestKeyword {
  using Value = std::string;
  static constexpr const char* about = R"(
triangle_test: 'exact'; of triangles also 'vertices', which is cheaper, keeps more, and is the only one for hulls.)";
  static py::arg_v named() { return py::arg("triangle_test") = "exact"; }
  static void give(Options& options, const Value& test) { options.set_triangle_test(test); }
};

/// A question as a method, with these keywords and those that leave bounds out.
template <class... Keywords, class Class, class... Extra, class... Args>
void ask(Class& to, const char* name, py::object (*question)(const Question&, Extra...), const std::string& text,
         const Args&... args) {
  using py::arg;
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
      (text + about_shafts + (std::string() + ... + Keywords::about)).c_str());
}

/// What all bounds are asked.
void add_questions(py::class_<Holder>& to) {
  using py::arg;
  ask<OnlyKeyword, TestKeyword>(to, "cull", &ask_cull, R"(
Which bounds are kept: not outside. bool (n, bounds), or (bounds,) for one shaft. With packed=True uint64 of
(bounds + 63) // 64 words instead: bit i % 64 of word i // 64 is bound i.)",
                                arg("packed") = false);
  ask<OnlyKeyword, TestKeyword>(to, "any", &ask_any, R"(
Whether any bound is kept. bool (n,), or one.)");
  ask<OnlyKeyword, TestKeyword>(to, "classify", &ask_classify, R"(
Which bounds are kept, and which of these are inside: two arrays as that of cull().)",
                                arg("packed") = false);
  ask<LimitKeyword, OnlyKeyword, TestKeyword>(to, "count", &ask_count, R"(
How many bounds are kept: int64 (n,), or an int.)");
  ask<OnlyKeyword, TestKeyword>(to, "count_classified", &ask_count_classified, R"(
How many bounds overlap shafts and how many are inside: two of int64 (n,), or of int.)");
  ask<LimitKeyword, OnlyKeyword, TestKeyword>(to, "list", &ask_list, R"(
Which bounds are kept: (offsets, indices), int64 (n + 1,) and uint32; shaft i keeps
indices[offsets[i]:offsets[i + 1]]. Of one shaft the indices alone. They ascend; those of a tree have its order.
With times=True there is one array more, float32: when the moving box reaches each box or sphere, as first_contact() says.)",
                                              arg("times") = false);
  ask<OnlyKeyword, TestKeyword>(to, "list_classified", &ask_list_classified, R"(
Which bounds overlap shafts, and which are inside: two results as that of list().)");
}

/// What boxes and spheres are asked beyond that.
template <class Bound>
void add_first_contact(py::class_<HolderOf<Bound>, Holder>& to) {
  using py::arg;
  ask<OnlyKeyword>(to, "first_contact", &ask_first_contact, R"(
Which bound the moving box of a shaft reaches first, and when: (indices, times), int64 and float32 (n,), or an int and a
float. -1 and infinity if it reaches none. Time is 0 at a and 1 at b; a body that is swept is at b = body +
displacement then. Times are rounded down; which bound is first is decided exactly.)");
  to.def("entry_times", &ask_entry_times, arg("shafts"), arg("indices"), R"(
When the moving box of one shaft reaches bounds: float32, infinity for those that are not kept.

shafts: one shaft. indices: integers (k,).)");
}

/// What boxes are asked beyond that.
void add_blocking(py::class_<HolderOf<Box>, Holder>& to) {
  ask(to, "occluded", &ask_occluded, R"(
Whether one of the boxes, which are solid, hides the one end of a shaft from the other: every segment from a to b passes
through it. Touching does not block. bool (n,), or one. Only shafts between boxes can be asked.)");
  ask(to, "find_occluder", &ask_find_occluder, R"(
The index of a box that hides the one end of a shaft from the other: int64 (n,), or an int; -1 for none.)");
  ask<LimitKeyword>(to, "list_occluders", &ask_list_occluders, R"(
The indices of all boxes that hide the one end of a shaft from the other: a result as that of list().)");
}

void add_layers(py::class_<Holder>& to) {
  using py::arg;
  to.def(
        "set_layers",
        [](Holder& self, const py::object& layers, const py::object& indices) {
          const std::vector<std::uint32_t> sets = layers_in(layers, "layers");
          const bool some = !indices.is_none();
          const IndicesIn in = some ? indices_in(indices, "indices", self.size(), "bounds") : IndicesIn{};
          const Changing changing(self.usage);
          const py::gil_scoped_release release;
          if (some) {
            self.set_layers(in.indices, sets);
          } else {
            self.set_layers(sets);
          }
        },
        arg("layers"), arg("indices") = py::none(), R"(
Puts bounds into layers, by which questions can choose (layer_mask): bit l says that a bound is in layer l. A
TriangleTree has none.

layers: integers (bounds,) from 0 to 2**32 - 1, which are copied; with indices, integers (k,), those of these bounds.)")
      .def(
          "clear_layers",
          [](Holder& self) {
            const Changing changing(self.usage);
            self.clear_layers();
          },
          "Forgets all layers.")
      .def_property_readonly("has_layers", &Holder::has_layers, "Whether bounds are in layers.");
}

}  // namespace

void add_bounds(py::module_& module) {
  py::class_<Holder> bounds(module, "Bounds", R"(
Boxes, spheres or triangles, in a view, a stream or a tree: what shafts are asked about. The container does not
change the answers.)");
  bounds.def("__len__", &Holder::size);
  add_questions(bounds);
  add_layers(bounds);

  py::class_<HolderOf<Box>, Holder> boxes(module, "Boxes", "Boxes: a BoxView, a BoxStream or a BoxTree.");
  add_first_contact(boxes);
  add_blocking(boxes);

  py::class_<HolderOf<Sphere>, Holder> spheres(module, "Spheres",
                                               "Spheres: a SphereView, a SphereStream or a SphereTree.");
  add_first_contact(spheres);

  py::class_<HolderOf<Triangle>, Holder> triangles(module, "Triangles",
                                                   "Triangles: a TriangleView, a TriangleStream or a TriangleTree.");
}

}  // namespace shaftcull::python
