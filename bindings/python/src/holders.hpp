// SPDX-License-Identifier: MIT
/// What holds bounds in Python: views and streams, trees. Each knows who uses it (usage.hpp), and gives the Bounds that
/// questions are about.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

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
  /// The layers of all bounds; or of those at `indices`, which are below size(). InvalidArgument if there are more or
  /// fewer, and for some bounds if there are no layers yet.
  virtual void set_layers(std::span<const std::uint32_t> layers) = 0;
  virtual void set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers) = 0;
  virtual void clear_layers() = 0;

  Usage usage;
};

/// Boxes, spheres or triangles: shaftcull.Boxes, Spheres, Triangles.
template <class Bound>
class HolderOf : public Holder {};

/// The layers of bounds that are looked at one by one.
class FlatLayers {
 public:
  [[nodiscard]] std::span<const std::uint32_t> all() const noexcept { return all_; }
  /// As Holder says, of so many bounds.
  void set(std::size_t bounds, std::span<const std::uint32_t> layers);
  void set_some(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers);
  void clear() noexcept { all_ = {}; }

 private:
  std::vector<std::uint32_t> all_;
};

/// The bound that a view or a stream is of.
template <class View>
using BoundOf = std::remove_cvref_t<decltype(std::declval<const View&>()[0])>;

/// A view, of the caller's arrays or of a stream.
template <class View>
class Flat : public HolderOf<BoundOf<View>> {
 public:
  [[nodiscard]] Bounds bounds() const override { return {view, layers_.all()}; }
  [[nodiscard]] bool has_layers() const override { return !layers_.all().empty(); }
  void set_layers(std::span<const std::uint32_t> layers) override { layers_.set(view.count, layers); }
  void set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers) override {
    layers_.set_some(indices, layers);
  }
  void clear_layers() override { layers_.clear(); }

  View view;

 private:
  FlatLayers layers_;
};

/// A stream of the library's, with its view.
template <class Stream>
class Streamed : public Flat<decltype(std::declval<const Stream&>().view())> {
 public:
  explicit Streamed(Stream&& made) : stream(std::move(made)) { this->view = stream.view(); }

  Stream stream;
};

/// A view of the caller's arrays: a class of its own, so that Python tells it from a stream.
template <class View>
class Viewed : public Flat<View> {
 public:
  std::vector<py::object> kept;  ///< the arrays
};

/// A tree of the library's.
template <class Bound, class Tree>
class Planted : public HolderOf<Bound> {
 public:
  [[nodiscard]] Bounds bounds() const override { return tree; }
  [[nodiscard]] bool has_layers() const override {
    if constexpr (have_layers) return tree.has_layers();
    return false;
  }
  void set_layers(std::span<const std::uint32_t> layers) override {
    require_layers();
    if constexpr (have_layers) tree.set_layers(layers);
  }
  void set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers) override {
    require_layers();
    if constexpr (have_layers) tree.set_layers(indices, layers);
  }
  void clear_layers() override {
    if constexpr (have_layers) tree.clear_layers();
  }

  Tree tree;

 private:
  static constexpr bool have_layers = requires(Tree & some) { some.clear_layers(); };

  /// In a child of fork() that has no threads it throws, as all parallel calls.
  static void require_layers() {
    if (!have_layers) throw InvalidArgument("a tree of triangles has no layers; a stream or a view may have some");
    begin_parallel();
  }
};

template <class Bound>
using TreeOf = Planted<Bound, BoundsTree<Bound>>;
using TriangleTreeHolder = Planted<Triangle, TriangleTree>;

}  // namespace shaftcull::python
