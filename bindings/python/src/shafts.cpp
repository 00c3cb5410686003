// SPDX-License-Identifier: MIT
#include "shafts.hpp"

#include "arrays.hpp"
#include "module.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

py::tuple shape(const Shafts& shafts) { return shafts.one ? py::tuple() : py::make_tuple(shafts.count); }

[[noreturn]] void refuse_single(const char* what) {
  throw py::type_error(std::string(what) + " of shafts of shape (): this is one shaft");
}

Shafts item(const Shafts& shafts, const py::object& key) {
  if (shafts.one) refuse_single("an item");
  if (PyIndex_Check(key.ptr()) != 0 && !py::isinstance<py::array>(key)) {
    const Py_ssize_t index = PyNumber_AsSsize_t(key.ptr(), PyExc_IndexError);
    if (index == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    const auto count = static_cast<Py_ssize_t>(shafts.count);
    if (index < -count || index >= count) {
      throw py::index_error("index " + std::to_string(index) + " is out of range for " + std::to_string(count) +
                            " shafts");
    }
    return {shafts.storage, shafts.first + static_cast<std::size_t>(index < 0 ? index + count : index), 1, true};
  }
  if (py::isinstance<py::slice>(key)) {
    std::size_t start = 0;
    std::size_t stop = 0;
    std::size_t step = 0;
    std::size_t length = 0;
    if (!py::slice(key).compute(shafts.count, &start, &stop, &step, &length)) throw py::error_already_set();
    if (step == 1) return {shafts.storage, shafts.first + start, length, false};
  }
  // NumPy reads all other indices, and refuses the rest.
  const py::object all = py::module_::import("numpy").attr("arange")(shafts.count);
  const IndicesIn in = indices_in(all[key], "the index", shafts.count, "shafts");
  if (in.shape.size() != 1) throw py::index_error("shafts have one axis; an index array of them has one, too");
  ShaftStorage storage{{}, shafts.storage->hulls};
  for (const std::uint32_t index : in.indices) storage.compiled.push_back(shafts.span()[index]);
  return shafts_of(std::move(storage), false);
}

py::array ends(const Shafts& shafts, Box (CompiledShaft::*end)() const noexcept) {
  if (shafts.one) return array_of((shafts.front().*end)());
  std::vector<Box> boxes;
  for (const CompiledShaft& shaft : shafts.span()) boxes.push_back((shaft.*end)());
  return rows_of(std::span<const Box>(boxes));
}

/// A bool for each shaft, which ask(shaft) returns.
template <class Ask>
py::object bools(const Shafts& shafts, Ask&& ask) {
  std::vector<std::uint8_t> answers(shafts.count);
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i != shafts.count; ++i) answers[i] = ask(shafts.span()[i]) ? 1 : 0;
  }
  return bools_of(shafts.one, std::move(answers));
}

/// Copies of all shafts, after change(shafts).
template <class Change>
Shafts changed(const Shafts& shafts, Change&& change) {
  ShaftStorage storage;
  {
    const py::gil_scoped_release release;
    storage.hulls = shafts.storage->hulls;
    storage.compiled.assign(shafts.span().begin(), shafts.span().end());
    change(std::span<CompiledShaft>(storage.compiled));
  }
  return shafts_of(std::move(storage), shafts.one);
}

Shafts concatenated(const py::sequence& parts) {
  ShaftStorage storage;
  for (const py::handle part : parts) {
    const Shafts shafts = shafts_in(py::reinterpret_borrow<py::object>(part), py::none());
    storage.compiled.insert(storage.compiled.end(), shafts.span().begin(), shafts.span().end());
    storage.hulls.insert(storage.hulls.end(), shafts.storage->hulls.begin(), shafts.storage->hulls.end());
  }
  return shafts_of(std::move(storage), false);
}

}  // namespace

Shafts shafts_of(ShaftStorage&& storage, bool one) {
  auto shared = std::make_shared<const ShaftStorage>(std::move(storage));
  const std::size_t count = shared->compiled.size();
  return {std::move(shared), 0, count, one};
}

Contact contact_in(const std::string& contact) {
  if (contact == "closed") return Contact::closed;
  if (contact == "open") return Contact::open;
  throw py::value_error("contact is '" + contact + "'; it must be 'closed' or 'open'");
}

Shafts shafts_in(const py::object& shafts, const py::object& b) {
  if (py::isinstance<Shafts>(shafts) || py::isinstance<ConvexHull>(shafts)) {
    if (!b.is_none()) throw py::type_error("b goes with boxes a; these are shafts already");
    if (py::isinstance<Shafts>(shafts)) return shafts.cast<const Shafts&>();
    auto hull = shafts.cast<std::shared_ptr<const ConvexHull>>();
    ShaftStorage storage{{hull->compiled()}, {hull}};
    return shafts_of(std::move(storage), true);
  }
  if (b.is_none()) {
    throw py::type_error(
        "a query takes Shafts, a ConvexHull, or two arguments a and b: the boxes that shafts are between");
  }
  return between(shafts, b, py::none(), py::none(), py::none(), "closed",
                 {false, "Shafts.between() takes rounding='outwards'; array.astype(numpy.float32) rounds to nearest"});
}

void add_shafts(py::module_& module) {
  using py::arg;
  py::class_<Shafts> shafts(module, "Shafts", R"(
An array of shafts, of shape (n,), or () for one shaft.

between(), swept(), swept_infinite(), shadow() and concatenate() make shafts. Shafts never change, and take
832 bytes each. An integer index gives one shaft, a slice of step 1 gives a view, and other indices give
copies.)");
  add_volumes(shafts);
  shafts
      .def_static("concatenate", &concatenated, arg("parts"), R"(
All shafts of several Shafts and ConvexHulls, in the given order: shape (n,). The result keeps the hulls
alive.

parts: a sequence of Shafts and ConvexHulls. TypeError for other parts.)")
      .def(
          "__len__",
          [](const Shafts& self) {
            if (self.one) refuse_single("len()");
            return self.count;
          },
          "The number of shafts. TypeError for one shaft, of shape ().")
      .def("__getitem__", &item, arg("key"), R"(
One or several shafts, selected as in NumPy by an integer, a slice, or an array of integers (k,) or of bool
(n,). IndexError for an index out of range.)")
      .def("__repr__",
           [](const Shafts& self) -> py::object {
             if (!self.one) return py::str("<shaftcull.Shafts of shape {}>").format(shape(self));
             return py::str("<shaftcull.Shafts of shape (): a {}, b {}>")
                 .format(ends(self, &CompiledShaft::a).attr("tolist")(),
                         ends(self, &CompiledShaft::b).attr("tolist")());
           })
      .def_property_readonly("shape", &shape, "A tuple of int: (n,), or () for one shaft.")
      .def_property_readonly(
          "a", [](const Shafts& self) { return ends(self, &CompiledShaft::a); },
          "float32 (n, 6) or (6,): the boxes where shafts begin; for a convex hull, the box around it.")
      .def_property_readonly(
          "b", [](const Shafts& self) { return ends(self, &CompiledShaft::b); },
          "float32 (n, 6) or (6,): the boxes where shafts end, rounded to nearest; without end, a box on the way.")
      .def_property_readonly(
          "open_contact",
          [](const Shafts& self) {
            return bools(self, [](const CompiledShaft& shaft) { return shaft.contact() == Contact::open; });
          },
          "bool (n,), or a bool: whether bounds that only touch a shaft are left out.")
      .def(
          "with_contact",
          [](const Shafts& self, const std::string& contact) {
            const Contact touching = contact_in(contact);
            return changed(self, [touching](std::span<CompiledShaft> all) { set_contact(all, touching); });
          },
          arg("contact"), R"(
Copies that keep ('closed') or leave out ('open') bounds that only touch them. For a hull, use
Shafts.concatenate([hull]). ValueError for other values.)")
      .def(
          "completed",
          [](const Shafts& self) {
            return changed(self, [](std::span<CompiledShaft> all) {
              for (CompiledShaft& shaft : all) complete(shaft);
            });
          },
          R"(
Copies whose joining planes are computed, in about 65 ns per shaft. Answers are the same. This pays off for
shafts of several queries about spheres, or about bounds that are inside.)")
      .def(
          "occluded_by_polygon",
          [](const Shafts& self, const py::object& corners) {
            const VectorsIn polygon = vectors_in(corners, "corners");
            return bools(self, [&polygon](const CompiledShaft& shaft) { return occluded(shaft, polygon.vectors); });
          },
          arg("corners"), R"(
Whether a convex polygon, such as a wall at any angle, hides one end of a shaft from the other. bool (n,), or
a bool for one shaft.

corners: float32 (k, 3) in order, either way round, k >= 3. ValueError for fewer corners, for corners that
    are not finite, and for shafts that are not between boxes or polygons. Runs on the calling thread. Other
    threads of Python continue.)");
}

}  // namespace shaftcull::python
