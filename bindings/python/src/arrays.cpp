// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace shaftcull::python {

namespace {

constexpr py::ssize_t float_size = sizeof(float);

[[noreturn]] void refuse_shape(const std::string& name, const py::array& array, const std::string& right) {
  throw py::value_error(name + " has shape " + shape_of(array) + "; it must be " + right);
}

/// Numbers of lists and tuples that are float32 exactly.
template <class Number>
py::array_t<float> exactly(const py::array& numbers, const std::string& name) {
  const py::array_t<Number, py::array::c_style> from(numbers);
  const std::vector<py::ssize_t> shape(from.shape(), from.shape() + from.ndim());
  py::array_t<float> to(shape);
  for (py::ssize_t i = 0; i != from.size(); ++i) {
    const auto number = static_cast<double>(from.data()[i]);
    const auto rounded = static_cast<float>(number);
    if (static_cast<double>(rounded) != number && !std::isnan(number)) {
      throw py::type_error(name + " holds " + py::str(py::float_(number)).cast<std::string>() +
                           ", which is no float32; nothing is rounded silently. Pass an array of dtype float32");
    }
    to.mutable_data()[i] = rounded;
  }
  return to;
}

/// Bytes from one entry of an axis to the next.
py::ssize_t stride(const py::array& array, py::ssize_t axis) { return array.strides(axis); }

bool aligned(const py::array& array) { return reinterpret_cast<std::uintptr_t>(array.data()) % alignof(float) == 0; }

/// Whether entries of an axis lie side by side. An axis of one entry has any stride.
bool dense(const py::array& array, py::ssize_t axis) {
  return array.shape(axis) <= 1 || stride(array, axis) == float_size;
}

/// Whether an axis goes on in memory: not broadcast, nor backwards, which records cannot.
bool goes_on(const py::array& array, py::ssize_t axis) { return array.shape(axis) <= 1 || stride(array, axis) > 0; }

const float* at(const py::array_t<float>& array, py::ssize_t offset) {
  return reinterpret_cast<const float*>(reinterpret_cast<const char*>(array.data()) + offset);
}

/// Columns, each of which lies side by side.
struct Columns {
  std::vector<py::array_t<float>> arrays;
  bool copied = false;

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(arrays.front().shape(0)); }
  template <class View>
  [[nodiscard]] View view() const {
    View view;
    view.count = count();
    for (std::size_t i = 0; i != arrays.size(); ++i) view.stream[i] = arrays[i].data();
    return view;
  }
  [[nodiscard]] std::vector<py::object> kept() const { return {arrays.begin(), arrays.end()}; }
};

/// A tuple of as many arrays of one axis.
std::optional<Columns> columns_of(const py::object& given, std::size_t count, const std::string& name,
                                  const char* rounding) {
  if (!py::isinstance<py::tuple>(given) || py::len(given) != count) return {};
  for (const py::handle column : given) {
    if (!py::isinstance<py::array>(column) || py::reinterpret_borrow<py::array>(column).ndim() != 1) return {};
  }
  Columns columns;
  for (const py::handle column : given) {
    const std::string one = name + "[" + std::to_string(columns.arrays.size()) + "]";
    py::array_t<float> array = floats_in(py::reinterpret_borrow<py::object>(column), one, rounding);
    if (!columns.arrays.empty() && array.shape(0) != columns.arrays.front().shape(0)) {
      throw py::value_error(one + " has shape " + shape_of(array) + ", but " + name + "[0] has " +
                            shape_of(columns.arrays.front()) + "; columns must be equally long");
    }
    if (!dense(array, 0) || !aligned(array)) {
      array = py::array_t<float>(array.attr("copy")());
      columns.copied = true;
    }
    columns.arrays.push_back(std::move(array));
  }
  return columns;
}

/// Boxes whose lo and hi are given by arrays (n, 3), which may be parts of one.
BoxesIn boxes_of(py::array_t<float> lo, py::array_t<float> hi, bool one) {
  const auto count = static_cast<std::size_t>(one ? 1 : lo.shape(0));
  const py::ssize_t axis = one ? 0 : 1;
  BoxesIn boxes{{}, count, one, {}, false};
  const bool columns = !one && dense(lo, 0) && dense(hi, 0) && aligned(lo) && aligned(hi);
  if (columns) {
    BoxView view;
    view.count = count;
    for (std::size_t i = 0; i != 3; ++i) {
      view.stream[i] = at(lo, static_cast<py::ssize_t>(i) * stride(lo, axis));
      view.stream[i + 3] = at(hi, static_cast<py::ssize_t>(i) * stride(hi, axis));
    }
    boxes.where = view;
  } else {
    const auto fits = [&] {
      return dense(lo, axis) && dense(hi, axis) &&
             (one || count <= 1 || (goes_on(lo, 0) && stride(lo, 0) == stride(hi, 0)));
    };
    if (!fits()) {
      lo = in_c_order(lo);
      hi = in_c_order(hi);
    }
    const auto step =
        static_cast<std::size_t>(one || count <= 1 ? static_cast<py::ssize_t>(sizeof(Box)) : stride(lo, 0));
    boxes.where = StridedBoxes{lo.data(), hi.data(), step, count};
  }
  boxes.kept = {std::move(lo), std::move(hi)};
  return boxes;
}

/// Part of an array along an axis: entries [first, first + 3).
py::array_t<float> three_of(const py::array_t<float>& array, py::ssize_t axis, py::ssize_t first) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
  const std::vector<py::ssize_t> strides(array.strides(), array.strides() + array.ndim());
  shape[static_cast<std::size_t>(axis)] = 3;
  return {shape, strides, at(array, first * stride(array, axis)), array};
}

constexpr const char* box_shapes =
    "(n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one box";
constexpr const char* sphere_shapes =
    "(n, 4), a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one sphere";

/// The two arrays of a tuple (lo, hi), unless it is a tuple of other things.
std::optional<BoxesIn> boxes_by_corners(const py::object& given, const std::string& name) {
  if (!py::isinstance<py::tuple>(given) || py::len(given) != 2) return {};
  const auto tuple = py::reinterpret_borrow<py::tuple>(given);
  py::array_t<float> lo = floats_in(tuple[0], name + "[0]", "round_outwards");
  py::array_t<float> hi = floats_in(tuple[1], name + "[1]", "round_outwards");
  const auto ends_in_three = [](const py::array& array) {
    return (array.ndim() == 1 || array.ndim() == 2) && array.shape(array.ndim() - 1) == 3;
  };
  if (!ends_in_three(lo) || !ends_in_three(hi)) return {};
  if (shape_of(lo) != shape_of(hi)) {
    throw py::value_error(name + "[0], lo, has shape " + shape_of(lo) + ", but " + name + "[1], hi, has " +
                          shape_of(hi) + "; they must be the same");
  }
  const bool one = lo.ndim() == 1;
  return boxes_of(std::move(lo), std::move(hi), one);
}

}  // namespace

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis != array.ndim(); ++axis) {
    if (axis != 0) text += ", ";
    text += std::to_string(array.shape(axis));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

py::array_t<float> floats_in(const py::object& given, const std::string& name, const char* rounding) {
  const bool literal = py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given) ||
                       py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given);
  const py::object converted = py::module_::import("numpy").attr("asarray")(given);
  const auto array = py::reinterpret_borrow<py::array>(converted);
  if (py::isinstance<py::array_t<float>>(array)) return py::reinterpret_borrow<py::array_t<float>>(array);
  const char kind = array.dtype().kind();
  if (literal && (kind == 'f' || array.size() == 0)) return exactly<double>(array, name);
  if (literal && kind == 'i') return exactly<std::int64_t>(array, name);
  std::string message = name + " has dtype " + py::str(array.dtype()).cast<std::string>() + "; it must be float32";
  if (kind == 'f' && array.itemsize() == 8 && rounding != nullptr) {
    message += ". Pass shaftcull." + std::string(rounding) + "(" + name +
               "), which contains what was given, or an array.astype(numpy.float32) if rounding to nearest is right";
  } else {
    message += ": array.astype(numpy.float32), if rounding to nearest is right";
  }
  throw py::type_error(message);
}

py::array_t<float> in_c_order(const py::array_t<float>& array) {
  return py::reinterpret_borrow<py::array_t<float>>(py::array_t<float, py::array::c_style>::ensure(array));
}

BoxesIn boxes_in(const py::object& given, const std::string& name) {
  if (auto columns = columns_of(given, 6, name, "round_outwards")) {
    return {columns->view<BoxView>(), columns->count(), false, columns->kept(), columns->copied};
  }
  if (auto corners = boxes_by_corners(given, name)) return *std::move(corners);
  const py::array_t<float> array = floats_in(given, name, "round_outwards");
  const py::ssize_t axes = array.ndim();
  if (axes == 1 && array.shape(0) == 6) return boxes_of(three_of(array, 0, 0), three_of(array, 0, 3), true);
  if (axes == 2 && array.shape(1) == 6) return boxes_of(three_of(array, 1, 0), three_of(array, 1, 3), false);
  const auto corner = [&array, axes](py::ssize_t which) {
    const py::ssize_t start = which * stride(array, axes - 2);
    std::vector<py::ssize_t> shape{3};
    std::vector<py::ssize_t> strides{stride(array, axes - 1)};
    if (axes == 3) {
      shape.insert(shape.begin(), array.shape(0));
      strides.insert(strides.begin(), stride(array, 0));
    }
    return py::array_t<float>(shape, strides, at(array, start), array);
  };
  if (axes == 2 && array.shape(0) == 2 && array.shape(1) == 3) return boxes_of(corner(0), corner(1), true);
  if (axes == 3 && array.shape(1) == 2 && array.shape(2) == 3) return boxes_of(corner(0), corner(1), false);
  if (py::isinstance<py::list>(given) && array.size() == 0) return {StridedBoxes{}, 0, false, {}, false};
  refuse_shape(name, array, box_shapes);
}

SpheresIn spheres_in(const py::object& given, const std::string& name) {
  const char* const rounding = "round_spheres_outwards";
  if (auto columns = columns_of(given, 4, name, rounding)) {
    return {columns->view<SphereView>(), columns->count(), false, columns->kept(), columns->copied};
  }
  if (py::isinstance<py::tuple>(given) && py::len(given) == 2) {
    const auto tuple = py::reinterpret_borrow<py::tuple>(given);
    const py::array_t<float> centres = floats_in(tuple[0], name + "[0]", rounding);
    const py::array_t<float> radii = floats_in(tuple[1], name + "[1]", rounding);
    if (centres.ndim() != 2 || centres.shape(1) != 3 || radii.ndim() != 1 || radii.shape(0) != centres.shape(0)) {
      throw py::value_error(name + " are a tuple of shapes " + shape_of(centres) + " and " + shape_of(radii) +
                            "; it must be " + sphere_shapes);
    }
    const auto count = static_cast<std::size_t>(radii.shape(0));
    if (dense(centres, 0) && dense(radii, 0) && aligned(centres) && aligned(radii)) {
      SphereView view{
          {centres.data(), at(centres, stride(centres, 1)), at(centres, 2 * stride(centres, 1)), radii.data()}, count};
      return {view, count, false, {centres, radii}, false};
    }
    // Records have one stride for both, so here they are put together.
    py::array_t<float> records({radii.shape(0), py::ssize_t{4}});
    for (py::ssize_t i = 0; i != radii.shape(0); ++i) {
      for (py::ssize_t axis = 0; axis != 3; ++axis) records.mutable_at(i, axis) = centres.at(i, axis);
      records.mutable_at(i, 3) = radii.at(i);
    }
    return {StridedSpheres{records.data(), records.data() + 3, sizeof(Sphere), count}, count, false, {records}, false};
  }
  py::array_t<float> array = floats_in(given, name, rounding);
  const bool one = array.ndim() == 1 && array.shape(0) == 4;
  if (!one && (array.ndim() != 2 || array.shape(1) != 4)) {
    if (py::isinstance<py::list>(given) && array.size() == 0) return {StridedSpheres{}, 0, false, {}, false};
    refuse_shape(name, array, sphere_shapes);
  }
  const auto count = static_cast<std::size_t>(one ? 1 : array.shape(0));
  if (!one && dense(array, 0) && aligned(array)) {
    SphereView view;
    view.count = count;
    for (std::size_t i = 0; i != 4; ++i) view.stream[i] = at(array, static_cast<py::ssize_t>(i) * stride(array, 1));
    return {view, count, false, {array}, false};
  }
  if (!dense(array, one ? 0 : 1) || (!one && !goes_on(array, 0))) array = in_c_order(array);
  const std::size_t step = one || count <= 1 ? sizeof(Sphere) : static_cast<std::size_t>(stride(array, 0));
  return {StridedSpheres{array.data(), array.data() + 3, step, count}, count, one, {array}, false};
}

TrianglesIn triangles_in(const py::object& given, const py::object& faces, const std::string& name) {
  py::array_t<float> array = floats_in(given, name);
  if (!faces.is_none()) {
    if (array.ndim() != 2 || array.shape(1) != 3)
      refuse_shape(name, array, "vertices of shape (v, 3), as there are faces");
    if (!dense(array, 1) || !goes_on(array, 0)) array = in_c_order(array);
    const auto vertices = static_cast<std::size_t>(array.shape(0));
    IndicesIn indices = indices_in(faces, "faces", vertices, "vertices");
    if (!indices.indices.empty() && (indices.shape.size() != 2 || indices.shape[1] != 3)) {
      throw py::value_error("faces must have shape (f, 3)");
    }
    TrianglesIn triangles{{}, indices.indices.size() / 3, {array}, false, std::move(indices.indices)};
    const std::size_t step = vertices <= 1 ? sizeof(Vec3) : static_cast<std::size_t>(stride(array, 0));
    triangles.where = MeshView{array.data(), step, vertices, triangles.indices};
    return triangles;
  }
  const bool nine = array.ndim() == 2 && array.shape(1) == 9;
  if (!nine && (array.ndim() != 3 || array.shape(1) != 3 || array.shape(2) != 3)) {
    if (py::isinstance<py::list>(given) && array.size() == 0) return {std::span<const Triangle>{}, 0, {}, false, {}};
    refuse_shape(name, array, "(n, 3, 3), (n, 9), or vertices (v, 3) with faces (f, 3)");
  }
  const auto count = static_cast<std::size_t>(array.shape(0));
  if (dense(array, 0) && aligned(array)) {
    TriangleView view;
    view.count = count;
    for (py::ssize_t i = 0; i != 9; ++i) {
      const py::ssize_t offset = nine ? i * stride(array, 1) : i / 3 * stride(array, 1) + i % 3 * stride(array, 2);
      view.stream[static_cast<std::size_t>(i)] = at(array, offset);
    }
    return {view, count, {array}, false, {}};
  }
  array = in_c_order(array);
  if (!aligned(array)) array = py::array_t<float>(array.attr("copy")());
  return {std::span(reinterpret_cast<const Triangle*>(array.data()), count), count, {array}, false, {}};
}

VectorsIn vectors_in(const py::object& given, const std::string& name) {
  py::array_t<float> array = floats_in(given, name);
  const bool one = array.ndim() == 1 && array.shape(0) == 3;
  if (!one && (array.ndim() != 2 || array.shape(1) != 3)) {
    if (array.size() == 0 && array.ndim() == 1) return {array, {}, false};
    refuse_shape(name, array, "(n, 3), or (3,) for one");
  }
  array = in_c_order(array);
  if (!aligned(array)) array = py::array_t<float>(array.attr("copy")());
  const auto count = static_cast<std::size_t>(array.size() / 3);
  return {array, std::span(reinterpret_cast<const Vec3*>(array.data()), count), one};
}

std::vector<Plane> planes_in(const py::object& given, const std::string& name, std::size_t boxes) {
  if (given.is_none()) return {};
  const py::array_t<float> array = in_c_order(floats_in(given, name));
  const py::ssize_t axes = array.ndim();
  const bool for_all = axes == 2;
  if ((axes != 2 && axes != 3) || array.shape(axes - 1) != 4 ||
      (!for_all && static_cast<std::size_t>(array.shape(0)) != boxes)) {
    refuse_shape(name, array,
                 "(" + std::to_string(boxes) +
                     ", k, 4), k planes for each box, or (k, 4) for all: " + "normal x, y, z and offset");
  }
  const auto count = static_cast<std::size_t>(array.size() / 4);
  std::vector<Plane> planes;
  planes.reserve(for_all ? count * boxes : count);
  for (std::size_t box = 0; box != (for_all ? boxes : 1); ++box) {
    for (std::size_t i = 0; i != count; ++i) {
      const float* const plane = array.data() + 4 * i;
      planes.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
    }
  }
  return planes;
}

py::array_t<float> matrix_in(const py::object& given, const std::string& name) {
  py::array_t<float> array = in_c_order(floats_in(given, name));
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) refuse_shape(name, array, "(4, 4)");
  return array;
}

namespace {

/// An array of integers as 64 bits with a sign, in C order.
py::array_t<std::int64_t, py::array::c_style> integers_in(const py::object& given, const std::string& name) {
  const py::object converted = py::module_::import("numpy").attr("asarray")(given);
  const auto array = py::reinterpret_borrow<py::array>(converted);
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() != 0) {
    throw py::type_error(name + " has dtype " + py::str(array.dtype()).cast<std::string>() +
                         "; it must be one of integers");
  }
  return py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(array);
}

}  // namespace

IndicesIn indices_in(const py::object& given, const std::string& name, std::size_t limit, const std::string& things) {
  const auto array = integers_in(given, name);
  IndicesIn in;
  in.indices.resize(static_cast<std::size_t>(array.size()));
  for (std::size_t i = 0; i != in.indices.size(); ++i) {
    const std::int64_t index = array.data()[i];
    if (index < 0 || static_cast<std::uint64_t>(index) >= limit ||
        index > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
      throw py::index_error(name + ": number " + std::to_string(i) + " is " + std::to_string(index) +
                            ", but there are " + std::to_string(limit) + " " + things + ", from 0 on");
    }
    in.indices[i] = static_cast<std::uint32_t>(index);
  }
  in.shape.assign(array.shape(), array.shape() + array.ndim());
  return in;
}

std::vector<std::uint32_t> layers_in(const py::object& given, const std::string& name) {
  const auto array = integers_in(given, name);
  if (array.ndim() > 1) refuse_shape(name, array, "one set of layers, or (n,)");
  std::vector<std::uint32_t> layers(static_cast<std::size_t>(array.size()));
  for (std::size_t i = 0; i != layers.size(); ++i) {
    const std::int64_t set = array.data()[i];
    if (set < 0 || set > std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
      throw py::value_error(name + ": number " + std::to_string(i) + " is " + std::to_string(set) +
                            "; layers are the bits of a number from 0 to 2**32 - 1");
    }
    layers[i] = static_cast<std::uint32_t>(set);
  }
  return layers;
}

std::vector<std::uint64_t> bits_in(const py::object& given, const std::string& name, std::size_t count) {
  const py::object converted = py::module_::import("numpy").attr("asarray")(given);
  const auto array = py::reinterpret_borrow<py::array>(converted);
  if (array.dtype().kind() != 'b') {
    throw py::type_error(name + " has dtype " + py::str(array.dtype()).cast<std::string>() + "; it must be bool");
  }
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != count) {
    refuse_shape(name, array, "(" + std::to_string(count) + ",): one for each bound");
  }
  const py::array_t<bool, py::array::c_style> bools(array);
  std::vector<std::uint64_t> words(bit_words(count));
  for (std::size_t i = 0; i != count; ++i) words[i / 64] |= std::uint64_t{bools.data()[i]} << (i % 64);
  return words;
}

std::optional<std::size_t> number_in(const py::object& given, const std::string& name) {
  if (given.is_none()) return {};
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!number) throw py::error_already_set();
  const Py_ssize_t value = PyNumber_AsSsize_t(number.ptr(), nullptr);  // clipped
  if (value < 0) throw py::value_error(name + " is " + py::str(number).cast<std::string>() + "; it must be 0 or more");
  return static_cast<std::size_t>(value);
}

}  // namespace shaftcull::python
