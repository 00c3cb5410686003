// SPDX-License-Identifier: MIT
/// The classes that hold boxes, spheres and triangles: views, streams and trees.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bounds_in.hpp"
#include "holders.hpp"
#include "interrupts.hpp"
#include "module.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

using py::arg;

constexpr const char* errors_of_changes = R"(

TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
RuntimeError if another thread uses this object. Other threads of Python continue during the call.)";

/// The arguments and errors of a stream or a tree.
template <class Bound>
std::string about() {
  using Of = Kind<Bound>;
  return py::str(R"(

{}: float32
    {}.{}

BadBound, with the first bad index, for {}.
TypeError or ValueError for other arrays.)")
      .format(Of::plural, Of::shapes, Of::about_option, Of::bad);
}

/// Calls change() alone, without the interpreter lock. Trees change in parallel.
template <class Made, class Change>
void alone(Made& holder, Change&& change) {
  if constexpr (requires { holder.owner.order(); }) begin_parallel();
  const Changing changing(holder.usage);
  const py::gil_scoped_release release;
  change();
}

/// A method that returns get(tree) while no other thread changes it.
template <class Made, class Get>
auto reading(Get get) {
  return [get](Made& self) {
    const Reading reading(self.usage);
    return get(self.owner);
  };
}

/// What streams and trees have in common. The last argument is the option of the kind: `rounding` or `faces`.
template <class Bound, class Made, class Class>
void add_owner(Class& to) {
  to.def(py::init([](const py::object& given, const py::object& option) {
           const BoundsIn<Bound> in = bounds_in<Bound>(given, option);
           if constexpr (std::is_same_v<Made, Planted<Bound>>) begin_parallel();
           const py::gil_scoped_release release;
           return std::visit([](const auto& where) { return std::make_unique<Made>(typename Made::Owner(where)); },
                             in.where);
         }),
         arg(Kind<Bound>::plural), arg(Kind<Bound>::option) = py::none());
  to.def_property_readonly(
      "memory_bytes", [](const Made& self) { return self.owner.memory_bytes(); },
      "The memory that it holds, in bytes: int.");
}

template <class Bound>
void add_view(py::module_& module) {
  using Of = Kind<Bound>;
  using Made = Viewed<Bound>;
  const std::string name = std::string(Of::name) + "View";
  static const std::string advice = std::string("a ") + Of::name + "Stream copies, and may round";
  const std::string text = py::str(R"(
{0} in arrays of the caller, which are kept and never copied.

{1}: float32, each coordinate in contiguous memory of its own:
    {2}.

Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.)")
                               .format(Of::title, Of::plural, Of::columns);
  py::class_<Made, HolderOf<Bound>> view(module, name.c_str(), text.c_str());
  view.def(py::init([](const py::object& given) {
             auto in = bounds_in<Bound>(given, Of::plural, {false, advice.c_str()});
             const auto* const columns = std::get_if<typename Of::View>(&in.where);
             if (columns == nullptr || in.copied) {
               throw py::value_error(
                   py::str("{} do not lie in columns: a {}View copies nothing, so each coordinate must lie in memory "
                           "of its own, entry beside entry. Pass {}, or make a {}Stream")
                       .format(Of::plural, Of::name, Of::columns, Of::name));
             }
             auto holder = std::make_unique<Made>();
             holder->view = *columns;
             holder->kept = std::move(in.kept);
             return holder;
           }),
           arg(Of::plural));
}

template <class Bound>
void add_stream(py::module_& module) {
  using Of = Kind<Bound>;
  using Made = Streamed<Bound>;
  const std::string name = std::string(Of::name) + "Stream";
  const std::string text = py::str("A checked copy of {}, in separate aligned streams: {} bytes per bound.{}")
                               .format(Of::plural, sizeof(Bound), about<Bound>());
  py::class_<Made, HolderOf<Bound>> stream(module, name.c_str(), text.c_str());
  add_owner<Bound, Made>(stream);
  stream.def(
      "update",
      [](Made& self, const py::object& given, const py::object& first, const py::object& option) {
        const BoundsIn<Bound> in = bounds_in<Bound>(given, option);
        const std::size_t from = number_in(first, "first").value_or(0);
        alone(self, [&] { std::visit([&](const auto& where) { self.owner.update(from, where); }, in.where); });
      },
      arg(Of::plural), arg("first") = 0, arg(Of::option) = py::none(),
      (std::string("Replaces the bounds from `first` on with the given bounds, in the form that the class takes.") +
       errors_of_changes)
          .c_str());
}

/// What a tree of boxes or spheres can do beyond queries: its bounds may change.
template <class Bound>
void add_changes(py::class_<Planted<Bound>, HolderOf<Bound>>& tree) {
  using Made = Planted<Bound>;
  tree.def(
          "update",
          [](Made& self, const py::object& given, const py::object& indices, const py::object& option) {
            const BoundsIn<Bound> in = bounds_in<Bound>(given, option);
            const bool some = !indices.is_none();
            const IndicesIn which = some ? indices_in(indices, "indices", self.size(), "bounds") : IndicesIn{};
            alone(self, [&] {
              std::visit(
                  [&](const auto& where) { some ? self.owner.update(which.indices, where) : self.owner.update(where); },
                  in.where);
            });
          },
          arg(Kind<Bound>::plural), arg("indices") = py::none(), arg(Kind<Bound>::option) = py::none(),
          (std::string(R"(
Gives bounds new values, in the form that the class takes: all bounds, in the order of their indices; or the
bounds at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
out of range.)") +
           errors_of_changes)
              .c_str())
      .def(
          "refit", [](Made& self) { alone(self, [&self] { self.owner.refit(); }); },
          "Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree.")
      .def_property_readonly(
          "needs_refit", [](const Made& self) { return self.owner.needs_refit(); },
          "bool: whether bounds were updated by indices since the last refit().")
      .def(
          "rebuild", [](Made& self) { alone(self, [&self] { self.owner.rebuild(); }); }, R"(
Sorts the bounds again, as they are now. Indices stay, `order` changes. This pays off when sah_ratio() is 2
or 3. RuntimeError if another thread uses the tree.)")
      .def(
          "reorder", [](Made& self) { alone(self, [&self] { self.owner.reorder(); }); }, R"(
Renumbers the bounds by their positions in the order of the tree. RuntimeError if another thread uses the
tree.)")
      .def("sah_ratio", reading<Made>([](const auto& made) { return made.sah_ratio(); }),
           R"(
How much larger the smallest nodes have become since the tree was built: float, 1 at first.
NeedsRefit if the tree needs refit().)");
}

template <class Bound>
void add_tree(py::module_& module) {
  using Of = Kind<Bound>;
  using Made = Planted<Bound>;
  constexpr bool may_change = requires(Made & tree) { tree.owner.refit(); };
  const std::string name = std::string(Of::name) + "Tree";
  const std::string text =
      py::str(R"(
A tree over a copy of {}, sorted by space, for many queries: {} bytes per bound, at most
2**32 - 1 bounds. Answers equal those of a {}Stream.{}

Any number of threads may query one tree at once. {})")
          .format(Of::plural, sizeof(Bound) + 4, Of::name, about<Bound>(),
                  may_change ? "No other call may run during a change, such as update()." : "It does not change.");
  py::class_<Made, HolderOf<Bound>> tree(module, name.c_str(), text.c_str());
  add_owner<Bound, Made>(tree);
  if constexpr (may_change) add_changes<Bound>(tree);
  tree.def_property_readonly("order", reading<Made>([](const auto& made) { return copy_of(made.order()); }),
                             "uint32 (bounds,): the indices of the bounds in the order of the tree. A copy.")
      .def_property_readonly("box", reading<Made>([](const auto& made) { return array_of(made.box()); }),
                             "float32 (6,): the box around all bounds. NeedsRefit if the tree needs refit().");
}

template <class Bound>
void add_kind(py::module_& module) {
  add_view<Bound>(module);
  add_stream<Bound>(module);
  add_tree<Bound>(module);
}

}  // namespace

void add_holders(py::module_& module) {
  add_kind<Box>(module);
  add_kind<Sphere>(module);
  add_kind<Triangle>(module);
}

}  // namespace shaftcull::python
