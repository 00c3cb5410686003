// SPDX-License-Identifier: MIT
/// What holds bounds in Python: views and streams, trees. Each knows who uses it (usage.hpp), and gives what the
/// questions of the C++ interface are asked of.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "results.hpp"
#include "shaftcull/shaftcull.hpp"
#include "shafts.hpp"
#include "usage.hpp"

namespace shaftcull::python {

/// A view, of the caller's arrays or of a stream.
template <class View>
struct Flat {
  View view;
  std::vector<py::object> kept;  ///< the arrays
  Usage usage;

  [[nodiscard]] const View& set() const noexcept { return view; }
  [[nodiscard]] std::size_t size() const noexcept { return view.count; }
};

/// A stream of the library's, with its view.
template <class View, class Stream>
struct Streamed : Flat<View> {
  Stream stream;

  explicit Streamed(Stream&& made) : stream(std::move(made)) { this->view = stream.view(); }
};

/// A view of the caller's arrays: a class of its own, so that Python tells it from a stream.
template <class View>
struct Viewed : Flat<View> {};

/// A tree of the library's.
template <class Made>
struct Planted {
  Made tree;
  Usage usage;

  [[nodiscard]] const Made& set() const noexcept { return tree; }
  [[nodiscard]] std::size_t size() const noexcept { return tree.size(); }
};

using Boxes = Flat<BoxView>;
using Spheres = Flat<SphereView>;
using Triangles = Flat<TriangleView>;
template <class Bound>
using TreeOf = Planted<BoundsTree<Bound>>;

/// Bounds that a query of a tree leaves out, for `shafts` shafts.
class LeftOut {
 public:
  LeftOut() = default;
  LeftOut(const py::object& own, const py::object& mask, const py::object& only_layers, const Shafts& shafts,
          std::size_t bounds)
      : shafts_(shafts.count) {
    if (!own.is_none()) {
      IndicesIn in = indices_in(own, "own", bounds, "bounds");
      const bool fits = shafts.one ? in.shape.size() <= 1
                                   : (in.shape.size() == 1 || in.shape.size() == 2) && in.shape[0] == shafts.count;
      if (!fits) {
        throw py::value_error(shafts.one ? "own must be an index or have shape (k,), for one shaft"
                                         : "own must have shape (" + std::to_string(shafts.count) + ", k) or (" +
                                               std::to_string(shafts.count) + ",): a row for each shaft");
      }
      own_ = std::move(in.indices);
    }
    if (!mask.is_none()) mask_ = bits_in(mask, "mask", bounds);
    if (!only_layers.is_none()) {
      layers_ = layers_in(only_layers, "only_layers");
      if (layers_.size() != 1 && layers_.size() != shafts.count) {
        throw py::value_error("only_layers has " + std::to_string(layers_.size()) + " sets of layers for " +
                              std::to_string(shafts.count) + " shafts; it must be one for all, or one for each");
      }
    }
  }

  /// Those for a range of the shafts.
  [[nodiscard]] std::tuple<Excluding> of(std::size_t first, std::size_t count) const {
    Excluding excluding;
    if (!own_.empty()) {
      const std::size_t row = own_.size() / shafts_;
      excluding.own = std::span(own_).subspan(first * row, count * row);
    }
    excluding.mask = mask_;
    if (!layers_.empty()) {
      excluding.only_layers = layers_.size() == 1 ? std::span(layers_) : std::span(layers_).subspan(first, count);
    }
    return excluding;
  }

 private:
  std::size_t shafts_ = 0;
  std::vector<std::uint32_t> own_;
  std::vector<std::uint64_t> mask_;
  std::vector<std::uint32_t> layers_;
};

/// What a view is asked with: nothing that Python chooses.
struct FlatOption {
  [[nodiscard]] std::tuple<> of(std::size_t /*first*/, std::size_t /*count*/) const { return {}; }
};

/// How triangles are tested.
struct TestOption {
  TriangleTest test = TriangleTest::exact;
  [[nodiscard]] std::tuple<TriangleTest> of(std::size_t /*first*/, std::size_t /*count*/) const { return test; }
};
[[nodiscard]] inline TestOption test_in(const std::string& test) {
  if (test == "exact") return {TriangleTest::exact};
  if (test == "vertices") return {TriangleTest::vertices};
  throw py::value_error("test is '" + test + "'; it must be 'exact' or 'vertices'");
}

template <class Holder>
struct OptionOfHolder {
  using Type = FlatOption;
};
template <class Bound>
struct OptionOfHolder<TreeOf<Bound>> {
  using Type = LeftOut;
};
template <>
struct OptionOfHolder<Triangles> {
  using Type = TestOption;
};
template <>
struct OptionOfHolder<Planted<TriangleTree>> {
  using Type = TestOption;
};
template <class Holder>
using OptionOf = typename OptionOfHolder<Holder>::Type;

}  // namespace shaftcull::python
