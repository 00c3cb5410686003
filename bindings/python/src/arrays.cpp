// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace shaftcull::python {

namespace {

constexpr std::uint64_t two_to_32 = std::uint64_t{1} << 32;

py::array as_array(const py::object& given) {
  return py::reinterpret_borrow<py::array>(py::module_::import("numpy").attr("asarray")(given));
}

[[noreturn]] void refuse_dtype(const std::string& name, const py::array& array, const std::string& right) {
  throw py::type_error(name + " has dtype " + py::str(array.dtype()).cast<std::string>() + "; it must be " + right);
}

/// Integers from 0 on below a limit; refuse(position, number) throws for another one.
template <class Refuse>
IndicesIn integers_in(const py::object& given, const std::string& name, std::uint64_t limit, Refuse&& refuse) {
  const py::array array = as_array(given);
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() != 0) refuse_dtype(name, array, "one of integers");
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> numbers(array);
  IndicesIn in{{}, {array.shape(), array.shape() + array.ndim()}};
  for (py::ssize_t i = 0; i != numbers.size(); ++i) {
    const std::int64_t number = numbers.data()[i];
    if (number < 0 || static_cast<std::uint64_t>(number) >= limit) refuse(std::to_string(i), std::to_string(number));
    in.indices.push_back(static_cast<std::uint32_t>(number));
  }
  return in;
}

}  // namespace

std::string shape_of(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

void refuse_shape(const std::string& name, const py::array& array, const std::string& right) {
  throw py::value_error(name + " has shape " + shape_of(array) + "; it must be " + right);
}

Rounding rounding_in(const py::object& rounding) {
  const bool outwards = !rounding.is_none();
  if (outwards && !(py::isinstance<py::str>(rounding) && rounding.cast<std::string>() == "outwards")) {
    throw py::value_error("rounding is " + py::repr(rounding).cast<std::string>() + "; it must be 'outwards' or None");
  }
  return {outwards,
          "rounding='outwards' makes bounds that contain these; array.astype(numpy.float32) rounds to nearest"};
}

py::array numbers_in(const py::object& given, const std::string& name, const Rounding& rounding) {
  py::array array = as_array(given);
  if (py::isinstance<py::array_t<float>>(array)) return array;
  const bool literal = py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given) ||
                       py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given);
  const char kind = array.dtype().kind();
  if ((!literal && !rounding.outwards) || std::strchr("fiu", kind) == nullptr || array.itemsize() > 8) {
    refuse_dtype(name, array, std::string("float32: ") + rounding.advice);
  }
  Doubles doubles(array);
  if (kind != 'f' && !doubles.attr("astype")(array.dtype()).attr("__eq__")(array).attr("all")().cast<bool>()) {
    throw py::type_error(name + " holds integers that are no float64");
  }
  if (rounding.outwards) return doubles;
  py::array_t<float> floats(std::vector<py::ssize_t>(doubles.shape(), doubles.shape() + doubles.ndim()));
  for (py::ssize_t i = 0; i != doubles.size(); ++i) {
    const double number = doubles.data()[i];
    const auto rounded = static_cast<float>(number);
    if (static_cast<double>(rounded) != number && !std::isnan(number)) {
      throw py::type_error(name + ": number " + std::to_string(i) + " is " +
                           py::str(py::float_(number)).cast<std::string>() +
                           ", which is no float32: " + rounding.advice);
    }
    floats.mutable_data()[i] = rounded;
  }
  return floats;
}

py::array_t<float> floats_in(const py::object& given, const std::string& name) {
  return py::module_::import("numpy").attr("require")(numbers_in(given, name, no_rounding), py::none(), "CA");
}

bool is_one_vector(const py::array& array, const std::string& name) {
  const bool one = array.ndim() == 1 && array.shape(0) == 3;
  const bool many = array.ndim() == 2 && array.shape(1) == 3;
  const bool none = array.ndim() == 1 && array.size() == 0;
  if (!one && !many && !none) refuse_shape(name, array, "(n, 3), or (3,) for one");
  return one;
}

VectorsIn vectors_in(const py::object& given, const std::string& name) {
  const py::array_t<float> array = floats_in(given, name);
  const bool one = is_one_vector(array, name);
  return {array, {reinterpret_cast<const Vec3*>(array.data()), static_cast<std::size_t>(array.size() / 3)}, one};
}

std::vector<Plane> planes_in(const py::object& given, const std::string& name, std::size_t count, py::ssize_t axes) {
  if (given.is_none()) return {};
  const py::array_t<float> array = floats_in(given, name);
  const bool for_all = array.ndim() == axes - 1;
  const bool for_each = array.ndim() == axes && static_cast<std::size_t>(array.shape(0)) == count;
  if ((!for_all && !for_each) || array.shape(array.ndim() - 1) != 4) {
    const std::string k = axes == 3 ? "k, " : "";
    refuse_shape(name, array,
                 "(" + std::to_string(count) + ", " + k + "4), or (" + (axes == 3 ? "k, 4" : "4,") +
                     ") for all: normal x, y, z and offset");
  }
  const auto given_planes = static_cast<std::size_t>(array.size() / 4);
  std::vector<Plane> planes(for_all ? given_planes * count : given_planes);
  for (std::size_t i = 0; i != planes.size(); ++i) {
    const float* const plane = array.data() + 4 * (i % given_planes);
    planes[i] = {{plane[0], plane[1], plane[2]}, plane[3]};
  }
  return planes;
}

IndicesIn indices_in(const py::object& given, const std::string& name, std::size_t limit, const std::string& things) {
  const auto refuse = [&](const std::string& position, const std::string& number) {
    throw py::index_error(name + ": number " + position + " is " + number + ", but there are " + std::to_string(limit) +
                          " " + things + ", from 0 on");
  };
  return integers_in(given, name, std::min<std::uint64_t>(limit, two_to_32), refuse);
}

std::vector<std::uint32_t> layers_in(const py::object& given, const std::string& name) {
  IndicesIn in = integers_in(given, name, two_to_32, [&](const std::string& position, const std::string& number) {
    throw py::value_error(name + ": number " + position + " is " + number +
                          "; layers are the bits of a number from 0 to 2**32 - 1");
  });
  if (in.shape.size() > 1) throw py::value_error(name + " must be one set of layers, or have shape (n,)");
  return std::move(in.indices);
}

std::vector<std::uint64_t> bits_in(const py::object& given, const std::string& name, std::size_t count) {
  const py::array array = as_array(given);
  if (array.dtype().kind() != 'b') refuse_dtype(name, array, "bool");
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
