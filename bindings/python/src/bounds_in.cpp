// SPDX-License-Identifier: MIT
#include "bounds_in.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <type_traits>
#include <utility>

namespace shaftcull::python {

namespace {

/// Floats of one bound.
template <class Bound>
constexpr py::ssize_t numbers_of = sizeof(Bound) / sizeof(float);

/// Whether arguments may be a single one.
template <class Bound>
constexpr bool may_be_one = !std::is_same_v<Bound, Triangle>;

/// The axes of an argument, without that of bounds.
using Shape = std::vector<py::ssize_t>;

/// The numbers of bounds, an array (n,) of each coordinate.
using Columns = std::vector<py::array>;

/// Appends the parts of an array that have one axis.
void flatten(const py::array& array, Columns& to) {
  if (array.ndim() == 1) return to.push_back(array);
  for (const py::handle part : array) flatten(py::reinterpret_borrow<py::array>(part), to);
}

/// Appends the columns of an array of shape (n, *shape), or of shape for one bound. False if it has another shape.
bool split(const py::array& array, const Shape& shape, bool one, Columns& to) {
  const py::ssize_t axes = one ? 0 : 1;
  if (array.ndim() < axes ||
      !std::equal(array.shape() + axes, array.shape() + array.ndim(), shape.begin(), shape.end()))
    return false;
  flatten(py::module_::import("numpy").attr("moveaxis")(one ? array[py::none()] : py::object(array), 0, -1), to);
  return true;
}

/// The arrays of a tuple: one for each number of a bound, (n,), or lo and hi, or centres and radii. None of an argument
/// that is no such tuple. Then it may be an array: only three numbers are a corner or a centre.
template <class Bound>
std::vector<py::array> parts_of(const py::object& given, const std::string& name, const Rounding& rounding) {
  std::vector<py::array> parts;
  if (!py::isinstance<py::tuple>(given)) return parts;
  const bool columns =
      py::len(given) == numbers_of<Bound> && std::all_of(given.begin(), given.end(), [](const py::handle part) {
        return py::isinstance<py::array>(part) && py::reinterpret_borrow<py::array>(part).ndim() == 1;
      });
  if (!columns && (!may_be_one<Bound> || py::len(given) != 2)) return parts;
  for (const py::handle part : given) {
    const std::string its_name = name + "[" + std::to_string(parts.size()) + "]";
    parts.push_back(numbers_in(py::reinterpret_borrow<py::object>(part), its_name, rounding));
    if (!columns && parts[0].ndim() != 0 && parts[0].shape(parts[0].ndim() - 1) != 3) return {};
  }
  return parts;
}

/// The columns of an argument.
template <class Bound>
Columns columns_in(const py::object& given, const std::string& name, const Rounding& rounding, bool& one) {
  Columns columns;
  const std::vector<py::array> parts = parts_of<Bound>(given, name, rounding);
  const bool threes = parts.size() == 2;
  one = threes && parts[0].ndim() == 1;
  for (std::size_t i = 0; i != parts.size(); ++i) {
    const Shape shape = threes && (i == 0 || std::is_same_v<Bound, Box>) ? Shape{3} : Shape{};
    if (!split(parts[i], shape, one, columns) || columns.back().shape(0) != columns.front().shape(0)) {
      refuse_shape(
          name + "[" + std::to_string(i) + "]", parts[i],
          "that of " + name + "[0], " + shape_of(parts[0]) + ", or " + name + " must be " + Kind<Bound>::shapes);
    }
  }
  if (!parts.empty()) return columns;
  const py::array array = numbers_in(given, name, rounding);
  std::vector<Shape> shapes{{numbers_of<Bound>}};
  if (numbers_of<Bound> % 3 == 0) shapes.push_back({numbers_of<Bound> / 3, 3});
  for (const Shape& shape : shapes) {
    one = may_be_one<Bound> && array.ndim() == static_cast<py::ssize_t>(shape.size());
    if (split(array, shape, one, columns)) return columns;
  }
  if (!py::isinstance<py::list>(given) || array.size() != 0) refuse_shape(name, array, Kind<Bound>::shapes);
  one = false;
  return Columns(numbers_of<Bound>, array);  // []
}

const float* at(const Columns& columns, std::size_t i) { return static_cast<const float*>(columns[i].data()); }

bool is_aligned(const py::array& array) { return reinterpret_cast<std::uintptr_t>(array.data()) % alignof(float) == 0; }

/// Whether a column can be read as a stream of floats. An axis of one entry has any stride.
bool is_stream(const py::array& column) {
  return (column.shape(0) <= 1 || column.strides(0) == py::ssize_t{sizeof(float)}) && is_aligned(column);
}

/// Whether columns [first, last) lie side by side in rows of memory, which go forwards, as those of column 0 do.
bool are_rows(const Columns& columns, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i != last; ++i) {
    if (columns[i].strides(0) <= 0 || columns[i].strides(0) != columns[0].strides(0)) return false;
    if (at(columns, i) != at(columns, first) + (i - first)) return false;
  }
  return true;
}

std::size_t stride_of(const Columns& columns) { return static_cast<std::size_t>(columns[0].strides(0)); }

/// Bounds in rows, if they lie so.
template <class Bound>
std::optional<typename Kind<Bound>::Rows> rows_at(const Columns& columns, std::size_t count) {
  if (!are_rows(columns, 0, 3) || !are_rows(columns, 3, columns.size())) return {};
  return typename Kind<Bound>::Rows{at(columns, 0), at(columns, 3), stride_of(columns), count};
}
template <>
std::optional<std::span<const Triangle>> rows_at<Triangle>(const Columns& columns, std::size_t count) {
  if (!are_rows(columns, 0, 9) || stride_of(columns) != sizeof(Triangle) || !is_aligned(columns[0])) return {};
  return std::span(reinterpret_cast<const Triangle*>(at(columns, 0)), count);
}

/// Columns of float32 of bounds that contain those of float64.
template <class World>
Columns rounded_outwards(const Columns& columns) {
  constexpr std::size_t Numbers = sizeof(World) / sizeof(double);
  std::vector<Doubles> from;
  std::vector<py::array_t<float>> to;
  for (const py::array& column : columns) {
    from.emplace_back(column);
    to.emplace_back(column.shape(0));
  }
  {
    const py::gil_scoped_release release;
    std::array<double, Numbers> given;
    std::array<float, Numbers> rounded;
    for (py::ssize_t bound = 0; bound != columns[0].shape(0); ++bound) {
      for (std::size_t i = 0; i != Numbers; ++i) given[i] = from[i].data()[bound];
      rounded = std::bit_cast<std::array<float, Numbers>>(Origin().around(std::bit_cast<World>(given)));
      for (std::size_t i = 0; i != Numbers; ++i) to[i].mutable_data()[bound] = rounded[i];
    }
  }
  return {to.begin(), to.end()};
}

}  // namespace

template <class Bound>
BoundsIn<Bound> bounds_in(const py::object& given, const std::string& name, const Rounding& rounding) {
  BoundsIn<Bound> in;
  Columns columns = columns_in<Bound>(given, name, rounding, in.one);
  in.count = static_cast<std::size_t>(columns[0].shape(0));
  if constexpr (!std::is_same_v<Bound, Triangle>) {
    const auto is_double = [](const py::array& column) { return column.itemsize() == sizeof(double); };
    if (std::any_of(columns.begin(), columns.end(), is_double)) {
      using World = std::conditional_t<std::is_same_v<Bound, Box>, WorldBox, WorldSphere>;
      columns = rounded_outwards<World>(columns);
    }
  }
  const bool streams = std::all_of(columns.begin(), columns.end(), is_stream);
  const auto rows = streams ? std::nullopt : rows_at<Bound>(columns, in.count);
  if (rows) {
    in.where = *rows;
  } else {
    in.copied = !streams;
    typename Kind<Bound>::View view;
    view.count = in.count;
    for (std::size_t i = 0; i != columns.size(); ++i) {
      if (in.copied) columns[i] = columns[i].attr("copy")();
      view.stream[i] = at(columns, i);
    }
    in.where = view;
  }
  in.kept.assign(columns.begin(), columns.end());
  return in;
}

template BoundsIn<Box> bounds_in<Box>(const py::object& given, const std::string& name, const Rounding& rounding);
template BoundsIn<Sphere> bounds_in<Sphere>(const py::object& given, const std::string& name, const Rounding& rounding);

template <>
BoundsIn<Triangle> bounds_in<Triangle>(const py::object& given, const py::object& option) {
  const std::string name = Kind<Triangle>::plural;
  if (option.is_none()) return bounds_in<Triangle>(given, name, no_rounding);
  py::array vertices = numbers_in(given, name, no_rounding);
  Columns columns;
  if (!split(vertices, {3}, false, columns)) refuse_shape(name, vertices, "vertices (v, 3), as there are faces");
  if (!are_rows(columns, 0, 3)) {
    columns.clear();
    vertices = floats_in(vertices, name);
    split(vertices, {3}, false, columns);
  }
  BoundsIn<Triangle> in;
  const auto count = static_cast<std::size_t>(vertices.shape(0));
  IndicesIn faces = indices_in(option, "faces", count, "vertices");
  if (!faces.indices.empty() && (faces.shape.size() != 2 || faces.shape[1] != 3)) {
    throw py::value_error("faces must have shape (f, 3)");
  }
  in.count = faces.indices.size() / 3;
  in.kept = {vertices};
  in.indices = std::move(faces.indices);
  in.where = MeshView{vertices.data(), static_cast<std::size_t>(vertices.strides(0)), count, in.indices};
  return in;
}

BoxStream packed(const StridedBoxes& boxes, const std::string& name) {
  try {
    return BoxStream(boxes);
  } catch (const BadBound& bad) {
    const std::string what = bad.what();
    // Streams also take the empty box, which is no end of a shaft, no patch and no occluder.
    throw BadBound(bad.index(), name + ": " + what.substr(0, what.find(", or the box empty")));
  }
}

BoxesInStreams::BoxesInStreams(const py::object& given, const std::string& name, const Rounding& rounding)
    : in_(bounds_in<Box>(given, name, rounding)) {
  if (const auto* const rows = std::get_if<StridedBoxes>(&in_.where)) {
    const py::gil_scoped_release release;
    packed_ = packed(*rows, name);
    in_.where = packed_.view();
  }
  view_ = std::get<BoxView>(in_.where);
}

float rounded_down(double number) noexcept { return Origin().around(WorldBox{{number, 0, 0}, {}}).lo[0]; }

float rounded_up(double number) noexcept { return Origin().around(WorldBox{{}, {number, 0, 0}}).hi[0]; }

}  // namespace shaftcull::python
