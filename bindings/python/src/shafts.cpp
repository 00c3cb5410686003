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

/// Copies of some of the shafts, which keep all hulls.
Shafts copied(const Shafts& shafts, const std::vector<std::uint32_t>& indices) {
  ShaftStorage storage{{}, shafts.storage->hulls};
  storage.compiled.reserve(indices.size());
  for (const std::uint32_t index : indices) storage.compiled.push_back(shafts.span()[index]);
  return shafts_of(std::move(storage), false);
}

Shafts item(const Shafts& shafts, const py::object& key) {
  if (shafts.one) refuse_single("an item");
  if (PyIndex_Check(key.ptr()) != 0 && !py::isinstance<py::array>(key)) {
    Py_ssize_t index = PyNumber_AsSsize_t(key.ptr(), PyExc_IndexError);
    if (index == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    const auto count = static_cast<Py_ssize_t>(shafts.count);
    if (index < -count || index >= count) {
      throw py::index_error("index " + std::to_string(index) + " is out of range for " + std::to_string(count) +
                            " shafts");
    }
    if (index < 0) index += count;
    return {shafts.storage, shafts.first + static_cast<std::size_t>(index), 1, true};
  }
  if (py::isinstance<py::slice>(key)) {
    std::size_t start = 0;
    std::size_t stop = 0;
    std::size_t step = 0;
    std::size_t length = 0;
    if (!py::reinterpret_borrow<py::slice>(key).compute(shafts.count, &start, &stop, &step, &length)) {
      throw py::error_already_set();
    }
    if (step == 1) return {shafts.storage, shafts.first + start, length, false};
  }
  // NumPy knows what else is an index, and refuses what is none.
  const py::object all = py::module_::import("numpy").attr("arange")(shafts.count);
  const IndicesIn in = indices_in(all[key], "the index", shafts.count, "shafts");
  if (in.shape.size() != 1) throw py::index_error("shafts have one axis; an index array of them has one, too");
  return copied(shafts, in.indices);
}

py::array ends(const Shafts& shafts, Box (CompiledShaft::*end)() const noexcept) {
  if (shafts.one) return array_of((shafts.front().*end)());
  py::array_t<float> array({static_cast<py::ssize_t>(shafts.count), py::ssize_t{6}});
  float* to = array.mutable_data();
  for (const CompiledShaft& shaft : shafts.span()) {
    const Box box = (shaft.*end)();
    for (const float coordinate : box.lo) *to++ = coordinate;
    for (const float coordinate : box.hi) *to++ = coordinate;
  }
  return array;
}

/// A bool for each shaft: an array, or one of Python's.
template <class Ask>
py::object bools(const Shafts& shafts, Ask&& ask) {
  std::vector<std::uint8_t> answers(shafts.count);
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i != shafts.count; ++i) answers[i] = ask(shafts.span()[i]) ? 1 : 0;
  }
  if (shafts.one) return py::bool_(answers[0] != 0);
  return array_of(std::move(answers)).attr("view")("bool");
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

std::string text(const py::object& boxes) { return py::str(boxes.attr("tolist")()).cast<std::string>(); }

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
  return between(shafts, b, py::none(), py::none(), py::none(), "closed");
}

void add_shafts(py::module_& module) {
  using py::arg;
  py::class_<Shafts> shafts(module, "Shafts", R"(
An array of shafts: of shape (n,), or () for one shaft.

They are made by between(), swept(), swept_infinite(), shadow() and concatenate(), never change, and take 832
bytes each. An integer as index gives one shaft, a slice of step 1 a view, and other slices and index arrays copies.)");
  add_kinds(shafts);
  shafts
      .def_static("concatenate", &concatenated, arg("parts"), R"(
All shafts of several Shafts and ConvexHulls, in that order. Hulls are kept as long as the result is.)")
      .def("__len__",
           [](const Shafts& self) {
             if (self.one) refuse_single("len()");
             return self.count;
           })
      .def("__getitem__", &item, arg("key"))
      .def("__repr__",
           [](const Shafts& self) {
             std::string repr = "<shaftcull.Shafts of shape " + py::str(shape(self)).cast<std::string>();
             if (self.one) {
               repr += ": a " + text(ends(self, &CompiledShaft::a)) + ", b " + text(ends(self, &CompiledShaft::b));
             }
             return repr + ">";
           })
      .def_property_readonly("shape", &shape, "(n,), or () for one shaft.")
      .def_property_readonly(
          "a", [](const Shafts& self) { return ends(self, &CompiledShaft::a); },
          "float32 (n, 6) or (6,): the boxes where shafts begin. Of a convex hull the box around it.")
      .def_property_readonly(
          "b", [](const Shafts& self) { return ends(self, &CompiledShaft::b); },
          "float32 (n, 6) or (6,): where shafts end, rounded to nearest; if they have no end, somewhere on their way.")
      .def_property_readonly(
          "open_contact",
          [](const Shafts& self) {
            return bools(self, [](const CompiledShaft& shaft) { return shaft.contact() == Contact::open; });
          },
          "bool (n,), or one: whether bounds that only touch a shaft are left out.")
      .def(
          "with_contact",
          [](const Shafts& self, const std::string& contact) {
            const Contact touching = contact_in(contact);
            return changed(self, [touching](std::span<CompiledShaft> all) { set_contact(all, touching); });
          },
          arg("contact"), "Copies that keep bounds which only touch them ('closed') or do not ('open').")
      .def(
          "completed",
          [](const Shafts& self) {
            return changed(self, [](std::span<CompiledShaft> all) {
              for (CompiledShaft& shaft : all) complete(shaft);
            });
          },
          R"(
Copies with their planes worked out, some 65 ns each. It pays where shafts are asked more than once about what is
inside, or about spheres; answers are the same.)")
      .def(
          "occluded_by_polygon",
          [](const Shafts& self, const py::object& corners) {
            const VectorsIn polygon = vectors_in(corners, "corners");
            return bools(self, [&polygon](const CompiledShaft& shaft) { return occluded(shaft, polygon.vectors); });
          },
          arg("corners"), R"(
Whether a convex polygon hides the one end of a shaft from the other: a wall at any angle. bool (n,), or one.

corners: float32 (k, 3) in order, either way round, k >= 3.)");
}

}  // namespace shaftcull::python
