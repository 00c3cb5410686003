// SPDX-License-Identifier: MIT
#include "queries.hpp"

#include <utility>

#include "arrays.hpp"

namespace shaftcull::python {

std::vector<std::uint32_t> indices_for_all(const py::object& given, const char* name, std::size_t bounds) {
  IndicesIn in = indices_in(given, name, bounds, "bounds");
  if (in.shape.size() > 1) {
    throw py::value_error(std::string(name) + " must be an index or have shape (k,), the same for all shafts" +
                          (std::string(name) == "exclude" ? "; exclude_each has a row for each" : ""));
  }
  return std::move(in.indices);
}

TriangleTest triangle_test_in(const std::string& test) {
  if (test == "exact") return TriangleTest::exact;
  if (test == "vertices") return TriangleTest::vertices;
  throw py::value_error("triangle_test is '" + test + "'; it must be 'exact' or 'vertices'");
}

Options::Options(const Shafts& asked, const Holder& holder, const py::object& to_exclude, const py::object& each,
                 const py::object& mask, const py::object& layers)
    : shafts(asked.count), bounds(holder.size()) {
  if (!to_exclude.is_none()) exclude = indices_for_all(to_exclude, "exclude", bounds);
  if (!each.is_none()) {
    if (asked.one) throw py::value_error("exclude_each has a row for each of many shafts; for one shaft pass exclude");
    IndicesIn in = indices_in(each, "exclude_each", bounds, "bounds");
    if ((in.shape.size() != 1 && in.shape.size() != 2) || in.shape[0] != shafts) {
      const std::string count = std::to_string(shafts);
      throw py::value_error("exclude_each must have shape (" + count + ", k) or (" + count +
                            ",): a row for each shaft; exclude is for all of them");
    }
    exclude_each = std::move(in.indices);
  }
  if (!mask.is_none()) exclude_mask = bits_in(mask, "exclude_mask", bounds);
  if (layers.is_none()) return;
  layer_mask = layers_in(layers, "layer_mask");
  if (layer_mask.size() != 1 && layer_mask.size() != shafts) {
    throw py::value_error("layer_mask has " + std::to_string(layer_mask.size()) + " sets of layers for " +
                          std::to_string(shafts) + " shafts; it must be one for all, or one for each");
  }
  if (bounds != 0 && !holder.has_layers()) {
    throw py::value_error("layer_mask chooses among layers, and these bounds have none; set_layers() gives them some");
  }
}

Query Options::of(std::size_t first, std::size_t count) const {
  Query query;
  query.exclude = exclude;
  if (!exclude_each.empty()) {
    const std::size_t row = exclude_each.size() / shafts;
    query.exclude_each = std::span(exclude_each).subspan(first * row, count * row);
  }
  query.exclude_mask = exclude_mask;
  query.layer_mask = layer_mask.size() == shafts ? std::span(layer_mask).subspan(first, count) : layer_mask;
  query.limit = limit;
  query.only = only;
  query.skip_overlapping = skip_overlapping;
  query.triangle_test = triangle_test;
  return query;
}

}  // namespace shaftcull::python
