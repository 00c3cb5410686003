// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <utility>

#include "arrays.hpp"

namespace shaftcull::python {

namespace {

/// Indices that are the same for all shafts: one, or (k,).
std::vector<std::uint32_t> indices_for_all(const py::object& given, const char* name, std::size_t bounds) {
  IndicesIn in = indices_in(given, name, bounds, "bounds");
  if (in.shape.size() > 1) {
    throw py::value_error(std::string(name) + " must be an index or have shape (k,), the same for all shafts" +
                          (std::string(name) == "exclude" ? "; exclude_each has a row for each" : ""));
  }
  return std::move(in.indices);
}

std::vector<std::uint32_t> indices_for_each(const py::object& given, const Shafts& shafts, std::size_t bounds) {
  if (shafts.one) throw py::value_error("exclude_each has a row for each of many shafts; for one shaft pass exclude");
  IndicesIn in = indices_in(given, "exclude_each", bounds, "bounds");
  if ((in.shape.size() != 1 && in.shape.size() != 2) || in.shape[0] != shafts.count) {
    const std::string count = std::to_string(shafts.count);
    throw py::value_error("exclude_each must have shape (" + count + ", k) or (" + count +
                          ",): a row for each shaft; exclude is for all of them");
  }
  return std::move(in.indices);
}

}  // namespace

Options::Options(const Shafts& shafts, const Holder& bounds, const py::object& exclude, const py::object& exclude_each,
                 const py::object& exclude_mask, const py::object& layer_mask)
    : shafts_(shafts.count), bounds_(bounds.size()) {
  if (!exclude.is_none()) exclude_ = indices_for_all(exclude, "exclude", bounds_);
  if (!exclude_each.is_none()) exclude_each_ = indices_for_each(exclude_each, shafts, bounds_);
  if (!exclude_mask.is_none()) exclude_mask_ = bits_in(exclude_mask, "exclude_mask", bounds_);
  if (layer_mask.is_none()) return;
  layer_mask_ = layers_in(layer_mask, "layer_mask");
  if (layer_mask_.size() != 1 && layer_mask_.size() != shafts_) {
    throw py::value_error("layer_mask has " + std::to_string(layer_mask_.size()) + " sets of layers for " +
                          std::to_string(shafts_) + " shafts; it must be one for all, or one for each");
  }
  if (bounds_ != 0 && !bounds.has_layers()) {
    throw py::value_error("layer_mask chooses among layers, and these bounds have none; set_layers() gives them some");
  }
}

void Options::set_limit(const py::object& limit) { limit_ = number_in(limit, "limit").value_or(Query::no_limit); }

void Options::set_only(const py::object& only) {
  if (!only.is_none()) only_ = indices_for_all(only, "only", bounds_);
}

void Options::set_triangle_test(const std::string& test) {
  if (test != "exact" && test != "vertices") {
    throw py::value_error("triangle_test is '" + test + "'; it must be 'exact' or 'vertices'");
  }
  triangle_test_ = test == "exact" ? TriangleTest::exact : TriangleTest::vertices;
}

Query Options::of(std::size_t first, std::size_t count) const {
  Query query;
  query.exclude = exclude_;
  if (!exclude_each_.empty()) {
    const std::size_t row = exclude_each_.size() / shafts_;
    query.exclude_each = std::span(exclude_each_).subspan(first * row, count * row);
  }
  query.exclude_mask = exclude_mask_;
  query.layer_mask = layer_mask_.size() == shafts_ ? std::span(layer_mask_).subspan(first, count) : layer_mask_;
  query.limit = limit_;
  query.only = only_;
  query.triangle_test = triangle_test_;
  return query;
}

}  // namespace shaftcull::python
