// SPDX-License-Identifier: MIT
/// The classes of dynamic trees and of their snapshots. An id is one integer: its index, and 2³² times its
/// generation.
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

/// A state of a dynamic tree.
template <class Bound>
class Shown : public HolderOf<Bound> {
 public:
  explicit Shown(TreeSnapshot<Bound>&& made) : owner(std::move(made)) {}
  [[nodiscard]] Bounds bounds() const override { return owner; }
  [[nodiscard]] bool has_layers() const override { return true; }
  void set_layers(std::span<const std::uint32_t> /*layers*/, const std::vector<std::uint32_t>* /*indices*/) override {
    throw InvalidArgument("a snapshot never changes; set layers of the tree, and commit()");
  }
  void clear_layers() override { set_layers({}, nullptr); }

  TreeSnapshot<Bound> owner;
};

template <class Bound>
class Living : public HolderOf<Bound> {
 public:
  [[nodiscard]] Bounds bounds() const override { return owner; }
  [[nodiscard]] bool has_layers() const override { return true; }
  void set_layers(std::span<const std::uint32_t> layers, const std::vector<std::uint32_t>* indices) override {
    for (std::size_t i = 0; i != layers.size(); ++i) {
      const BoundId id = owner.id_of(indices == nullptr ? static_cast<std::uint32_t>(i) : (*indices)[i]);
      if (id != BoundId{}) owner.set_layers(id, layers[i]);
    }
  }
  void clear_layers() override {
    set_layers(std::vector<std::uint32_t>(owner.committed().index_end(), all_layers), nullptr);
  }

  DynamicTree<Bound> owner;
};

[[nodiscard]] std::uint64_t number_of(BoundId id) noexcept {
  return std::uint64_t{id.generation} << 32U | std::uint64_t{id.index};
}

struct IdsIn {
  std::vector<BoundId> ids;
  bool one = false;
};

/// Integers of 0 or more: one, or (k,).
IdsIn ids_in(const py::object& given) {
  const py::array array = py::array::ensure(given);
  if (!array || (array.dtype().kind() != 'u' && array.dtype().kind() != 'i' && array.size() != 0)) {
    PyErr_Clear();
    throw py::type_error("ids must be integers, as insert() returns them");
  }
  if (array.ndim() > 1) refuse_shape("ids", array, "(k,), or a single id");
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> numbers(array);
  IdsIn in;
  in.one = array.ndim() == 0;
  for (py::ssize_t i = 0; i != numbers.size(); ++i) {
    const auto number = static_cast<std::uint64_t>(numbers.data()[i]);
    in.ids.push_back({static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32U)});
  }
  return in;
}

/// Checked bounds, one after another.
template <class Bound>
std::vector<Bound> packed_in(const BoundsIn<Bound>& in) {
  const auto stream = std::visit([](const auto& where) { return typename Kind<Bound>::Stream(where); }, in.where);
  std::vector<Bound> bounds;
  bounds.reserve(in.count);
  for (std::size_t i = 0; i != in.count; ++i) bounds.push_back(stream.view()[i]);
  return bounds;
}

template <class Bound>
py::array_t<float> rows_or_row(const std::vector<Bound>& bounds, bool one) {
  py::array_t<float> rows = rows_of(std::span<const Bound>(bounds));
  return one ? py::array_t<float>(rows.attr("ravel")()) : rows;
}

template <class Bound>
void add_snapshot(py::module_& module) {
  using Of = Kind<Bound>;
  using Made = Shown<Bound>;
  const std::string name = std::string(Of::name) + "TreeSnapshot";
  const std::string text = py::str(R"(
The {0} of a Dynamic{1}Tree after one commit(), as returned by snapshot() of the tree.
The snapshot never changes. len() is above all indices.)")
                               .format(Of::plural, Of::name);
  py::class_<Made, HolderOf<Bound>>(module, name.c_str(), text.c_str())
      .def_property_readonly(
          "bound_count", [](const Made& self) { return self.owner.bound_count(); }, "The number of bounds: int.")
      .def_property_readonly(
          "box", [](const Made& self) { return array_of(self.owner.box()); },
          "float32 (6,): the box around all bounds.");
}

template <class Bound>
void add_changes_by_ids(py::class_<Living<Bound>, HolderOf<Bound>>& tree) {
  using Of = Kind<Bound>;
  using Made = Living<Bound>;
  const py::object none = py::none();
  tree.def(
          "insert",
          [](Made& self, const py::object& given, const py::object& layers, const py::object& option) -> py::object {
            const BoundsIn<Bound> in = bounds_in<Bound>(given, option);
            const std::vector<Bound> bounds = packed_in(in);
            std::vector<std::uint32_t> sets;
            if (!layers.is_none()) sets = layers_in(layers, "layers");
            if (sets.size() == 1) sets.resize(bounds.size(), sets[0]);
            std::vector<BoundId> ids(bounds.size());
            const Changing changing(self.usage);
            self.owner.insert(bounds, ids, sets);
            if (in.one) return py::int_(number_of(ids[0]));
            std::vector<std::uint64_t> numbers;
            for (const BoundId id : ids) numbers.push_back(number_of(id));
            return array_of(std::move(numbers));
          },
          arg(Of::plural), arg("layers") = none, arg(Of::option) = none,
          (std::string("Inserts ") + Of::plural + ", in the form that a " + Of::name +
           R"(Tree takes, and returns their ids: int64 (n,),
or an int for one. ids & 0xffffffff are the indices that queries return.

layers: integers from 0 to 2**32 - 1, one or (n,): the layers of each bound; all layers if not given.

TypeError, ValueError or BadBound names the argument that does not fit; then nothing is inserted.)")
              .c_str())
      .def(
          "erase",
          [](Made& self, const py::object& ids) {
            const IdsIn in = ids_in(ids);
            const Changing changing(self.usage);
            self.owner.erase(in.ids);
          },
          arg("ids"), "Erases bounds. ids: integers (k,), or one integer. ValueError for an id that occurs twice.")
      .def(
          "move",
          [](Made& self, const py::object& ids, const py::object& given, const py::object& option) {
            const IdsIn in = ids_in(ids);
            const std::vector<Bound> bounds = packed_in(bounds_in<Bound>(given, option));
            const Changing changing(self.usage);
            self.owner.move(in.ids, bounds);
          },
          arg("ids"), arg(Of::plural), arg(Of::option) = none,
          "Gives bounds new values, one per id. ValueError for an id without a bound, BadBound for bad values.")
      .def(
          "move_by",
          [](Made& self, const py::object& ids, const py::object& displacements) {
            const IdsIn in = ids_in(ids);
            const VectorsIn by = vectors_in(displacements, "displacements");
            const Changing changing(self.usage);
            self.owner.move_by(in.ids, by.vectors);
          },
          arg("ids"), arg("displacements"),
          "Moves bounds by vectors: float32 (k, 3), or (3,) for one id. ValueError for an id that occurs twice.");
}

template <class Bound>
void add_dynamic_tree(py::module_& module) {
  using Of = Kind<Bound>;
  using Made = Living<Bound>;
  const std::string name = std::string("Dynamic") + Of::name + "Tree";
  const std::string text = py::str(R"(
A tree of {0} that are inserted, erased and moved. Changes name bounds by ids, and queries see changes after
commit(). An id never denotes another bound, even if its index is used again. Answers equal those of a
{1}Stream.

    tree = shaftcull.Dynamic{1}Tree()
    ids = tree.insert({0})
    tree.commit()
    kept = tree.list(a, b)                   # indices: ids & 0xffffffff

One thread at a time may change the tree. Other threads query the result of snapshot(), also during a commit().
len() is above all indices: cull() and exclude_mask have that many bounds, and cull() gives False for an index
without a bound.

ValueError for an id without a bound.
BadBound for {2}.)")
                               .format(Of::plural, Of::name, Of::bad);
  py::class_<Made, HolderOf<Bound>> tree(module, name.c_str(), text.c_str());
  tree.def(py::init([]() { return std::make_unique<Made>(); }));
  add_changes_by_ids<Bound>(tree);
  tree.def(
          "commit",
          [](Made& self) {
            begin_parallel();
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            self.owner.commit();
          },
          "Makes all changes visible to queries. RuntimeError if another thread uses the tree.")
      .def(
          "rebuild",
          [](Made& self) {
            begin_parallel();
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            self.owner.rebuild();
          },
          R"(
Makes all changes visible, and sorts all bounds again: for a world that was built step by step and then stays
the same.)")
      .def(
          "snapshot",
          [](const Made& self) {
            const py::gil_scoped_release release;
            return std::make_unique<Shown<Bound>>(self.owner.snapshot());
          },
          (std::string("The state of the last commit(), as a ") + Of::name + "TreeSnapshot.").c_str())
      .def(
          "values",
          [](const Made& self, const py::object& ids) {
            const IdsIn in = ids_in(ids);
            std::vector<Bound> bounds;
            for (const BoundId id : in.ids) bounds.push_back(self.owner[id]);
            return rows_or_row(bounds, in.one);
          },
          arg("ids"),
          R"(
The values of bounds, with all changes: float32, one row per id, or a row for a single id. ValueError for an
id without a bound.)")
      .def(
          "__contains__",
          [](const Made& self, const py::object& id) {
            const IdsIn in = ids_in(id);
            if (!in.one) throw py::type_error("an id is one integer");
            return self.owner.has(in.ids[0]);
          },
          arg("id"), "Whether an id has a bound, with all changes.")
      .def(
          "ids_of",
          [](const Made& self, const py::object& indices) -> py::object {
            const IndicesIn in = indices_in(indices, "indices", std::size_t{1} << 32U, "bounds");
            std::vector<std::uint64_t> numbers;
            for (const std::uint32_t index : in.indices) {
              const BoundId id = self.owner.id_of(index);
              numbers.push_back(id == BoundId{} ? ~std::uint64_t{0} : number_of(id));
            }
            return array_of(std::move(numbers));
          },
          arg("indices"),
          R"(
The ids of the bounds that have these indices now: int64 (k,). -1 for an index without a bound. IndexError
for a value that is not an index.)")
      .def_property_readonly(
          "bound_count", [](const Made& self) { return self.owner.bound_count(); },
          "The number of bounds, with all changes: int.")
      .def_property_readonly(
          "memory_bytes", [](const Made& self) { return self.owner.memory_bytes(); },
          "The memory that it holds, in bytes: int.")
      .def(
          "set_sorted_per_change",
          [](Made& self, double sorted_per_change) {
            const Changing changing(self.usage);
            self.owner.set_sorted_per_change(sorted_per_change);
          },
          arg("sorted_per_change"), R"(
Sets how many bounds a commit may re-sort per change; 2 at first. A larger number keeps queries faster, and
makes commits slower. ValueError for a negative or infinite number.)")
      .def_property_readonly(
          "upkeep",
          [](const Made& self) {
            const TreeUpkeep upkeep = self.owner.upkeep();
            py::dict numbers;
            numbers["blocks"] = upkeep.blocks;
            numbers["sah_ratio"] = upkeep.sah_ratio;
            numbers["waiting"] = upkeep.waiting;
            numbers["sorted_last"] = upkeep.sorted_last;
            return numbers;
          },
          R"(
A dict of numbers after the last commit(): blocks; sah_ratio, the growth of nodes since they were sorted, 1
at best; waiting, bounds to be sorted again; sorted_last, bounds that the commit sorted.)");
}

template <class Bound>
void add_dynamic_kind(py::module_& module) {
  add_snapshot<Bound>(module);
  add_dynamic_tree<Bound>(module);
}

}  // namespace

void add_dynamic(py::module_& module) {
  add_dynamic_kind<Box>(module);
  add_dynamic_kind<Sphere>(module);
}

}  // namespace shaftcull::python
