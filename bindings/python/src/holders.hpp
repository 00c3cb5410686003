// SPDX-License-Identifier: MIT
/// What holds bounds in Python: views, streams and trees. Each knows who uses it (usage.hpp), and gives the Bounds that
/// queries are about.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bounds_in.hpp"
#include "interrupts.hpp"
#include "shaftcull/shaftcull.hpp"
#include "usage.hpp"

namespace shaftcull::python {

namespace py = pybind11;

/// What Python knows as shaftcull.Bounds.
class Holder {
 public:
  Holder() = default;
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  virtual ~Holder() = default;

  /// All bounds, with their layers. Valid until the holder changes.
  [[nodiscard]] virtual Bounds bounds() const = 0;
  [[nodiscard]] std::size_t size() const { return bounds().size(); }

  [[nodiscard]] virtual bool has_layers() const = 0;
  /// The layers of all bounds, size() of them; or of the bounds at `indices`, as many, where there are layers already.
  virtual void set_layers(std::span<const std::uint32_t> layers, const std::vector<std::uint32_t>* indices) = 0;
  virtual void clear_layers() = 0;

  Usage usage;
};

/// Boxes, spheres or triangles: shaftcull.Boxes, Spheres, Triangles.
template <class Bound>
class HolderOf : public Holder {};

/// A view, of the caller's arrays or of a stream.
template <class Bound>
class Flat : public HolderOf<Bound> {
 public:
  [[nodiscard]] Bounds bounds() const override { return {view, layers_}; }
  [[nodiscard]] bool has_layers() const override { return !layers_.empty(); }
  void set_layers(std::span<const std::uint32_t> layers, const std::vector<std::uint32_t>* indices) override {
    if (indices == nullptr) layers_.resize(layers.size());
    for (std::size_t i = 0; i != layers.size(); ++i) layers_[indices == nullptr ? i : (*indices)[i]] = layers[i];
  }
  void clear_layers() override { layers_ = {}; }

  typename Kind<Bound>::View view;

 private:
  std::vector<std::uint32_t> layers_;
};

/// Arrays of the caller's, which are kept.
template <class Bound>
class Viewed : public Flat<Bound> {
 public:
  std::vector<py::object> kept;
};

/// A stream of the library's.
template <class Bound>
class Streamed : public Flat<Bound> {
 public:
  using Owner = typename Kind<Bound>::Stream;

  explicit Streamed(Owner&& made) : owner(std::move(made)) { this->view = owner.view(); }

  Owner owner;
};

/// A tree of the library's.
template <class Bound>
class Planted : public HolderOf<Bound> {
 public:
  using Owner = typename Kind<Bound>::Tree;

  explicit Planted(Owner&& made) : owner(std::move(made)) {}
  [[nodiscard]] Bounds bounds() const override { return owner; }
  [[nodiscard]] bool has_layers() const override {
    if constexpr (have_layers) return owner.has_layers();
    return false;
  }
  void set_layers(std::span<const std::uint32_t> layers, const std::vector<std::uint32_t>* indices) override {
    if constexpr (have_layers) {
      begin_parallel();
      indices == nullptr ? owner.set_layers(layers) : owner.set_layers(*indices, layers);
    } else {
      throw InvalidArgument("a tree of triangles has no layers; a stream or a view may have some");
    }
  }
  void clear_layers() override {
    if constexpr (have_layers) owner.clear_layers();
  }

  Owner owner;

 private:
  static constexpr bool have_layers = requires(Owner & tree) { tree.clear_layers(); };
};

}  // namespace shaftcull::python
