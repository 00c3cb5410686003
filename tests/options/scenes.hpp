// SPDX-License-Identifier: MIT
/// Scenes for the tests of options: bounds of every kind, in a view, a stream and a tree, and shafts of every kind.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "oracle/random.hpp"
#include "shaftcull/shaftcull.hpp"
#include "special_floats.hpp"

namespace shaftcull {

using Indices = std::vector<std::uint32_t>;

/// One bound of a scene: most are small, some lie on a lattice and touch, and a few are points, empty or infinite.
template <class Bound>
Bound bound_of(Random& random);

template <>
inline Box bound_of<Box>(Random& random) {
  switch (random.below(16)) {
    case 0:
      return random.grid_box(-5, 5);
    case 1:
    case 2:
    case 3: {
      Box box{{random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)}, {}};
      for (std::size_t k = 0; k != 3; ++k) box.hi[k] = box.lo[k] + random.integer(0, 1);
      return box;
    }
    case 4: {
      const Vec3 point = random.vec3(-5, 5);
      return {point, point};
    }
    case 5: {
      if (random.one_in(8)) return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
      Box box = random.box(-5, 5, 0.01F, 0.3F);
      if (random.one_in(8)) box.hi[random.below(3)] = infinity;
      return box;
    }
    default:
      return random.box(-5, 5, 0.01F, 0.3F);
  }
}

template <>
inline Sphere bound_of<Sphere>(Random& random) {
  switch (random.below(16)) {
    case 0:
      return {random.vec3(-5, 5), random.uniform(1.0F, 3.0F)};
    case 1:
    case 2:
    case 3:
      return {{random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)}, random.integer(0, 2)};
    case 4:
      return {random.vec3(-5, 5), 0.0F};
    case 5:
      return {random.vec3(-5, 5), random.one_in(16) ? std::numeric_limits<float>::infinity() : 0.1F};
    default:
      return {random.vec3(-5, 5), random.uniform(0.01F, 0.3F)};
  }
}

template <>
inline Triangle bound_of<Triangle>(Random& random) {
  Triangle triangle{};
  auto& [v0, v1, v2] = triangle.vertex;
  if (random.one_in(4)) {
    for (Vec3& vertex : triangle.vertex) {
      vertex = {random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)};
    }
  } else {
    const Vec3 centre = random.vec3(-5, 5);
    const float size = random.one_in(6) ? 2.0F : 0.3F;
    for (Vec3& vertex : triangle.vertex) {
      for (std::size_t k = 0; k != 3; ++k) vertex[k] = centre[k] + random.uniform(-size, size);
    }
  }
  switch (random.below(12)) {
    case 0:
      v2 = v1;  // a segment
      break;
    case 1:
      v1 = v2 = v0;  // a point
      break;
    case 2: {  // a wall or a floor
      const std::size_t k = random.below(3);
      v1[k] = v2[k] = v0[k];
      break;
    }
    default:
      break;
  }
  return triangle;
}

template <class Bound>
std::vector<Bound> bounds_of(Random& random, std::size_t count) {
  std::vector<Bound> bounds;
  bounds.reserve(count);
  while (bounds.size() != count) bounds.push_back(bound_of<Bound>(random));
  return bounds;
}

/// Layers of which a bound has none, one or many.
inline Indices layers_of(Random& random, std::size_t count) {
  Indices layers(count);
  for (std::uint32_t& each : layers) {
    each = random.one_in(5) ? 0 : random.one_in(3) ? random.below(0xffffffff) : 1U << random.below(32);
  }
  return layers;
}

/// The containers of bounds of a kind.
template <class Bound>
struct HoldersOf;
template <>
struct HoldersOf<Box> {
  using Columns = BoxColumns;
  using Stream = BoxStream;
  using Tree = BoxTree;
};
template <>
struct HoldersOf<Sphere> {
  using Columns = SphereColumns;
  using Stream = SphereStream;
  using Tree = SphereTree;
};
template <>
struct HoldersOf<Triangle> {
  using Columns = TriangleColumns;
  using Stream = TriangleStream;
  using Tree = TriangleTree;
};
using BoundKinds = testing::Types<Box, Sphere, Triangle>;

/// A container of a scene, as a query gets it.
struct Holder {
  const char* name;
  Bounds bounds;
  bool has_layers;
  std::span<const std::uint32_t> order;  ///< in which it lists
};

/// The same bounds in a view, a stream and a tree.
template <class Bound>
class Scene {
  using Of = HoldersOf<Bound>;
  static constexpr bool tree_takes_layers = !std::is_same_v<Bound, Triangle>;

 public:
  /// Layers are drawn if it is to have some. A tree of triangles has none.
  Scene(Random& random, std::vector<Bound> bounds, bool has_layers)
      : bounds_(std::move(bounds)),
        layers_(has_layers ? layers_of(random, bounds_.size()) : Indices()),
        columns_(bounds_),
        stream_(std::span<const Bound>(bounds_)),
        tree_(std::span<const Bound>(bounds_)),
        ascending_(bounds_.size()) {
    std::iota(ascending_.begin(), ascending_.end(), 0U);
    if constexpr (tree_takes_layers) {
      if (has_layers) tree_.set_layers(layers_);
      if (!bounds_.empty() && random.one_in(3)) {  // now it knows the leaf of every index
        const Indices index = {random.below(static_cast<unsigned>(bounds_.size()))};
        tree_.update(index, std::span<const Bound>(bounds_).subspan(index[0], 1));
        tree_.refit();
      }
    }
    holders_.push_back({"view", Bounds(columns_.view(), layers_), has_layers, ascending_});
    holders_.push_back({"stream", Bounds(stream_, layers_), has_layers, ascending_});
    holders_.push_back({"tree", Bounds(tree_), has_layers && tree_takes_layers, tree_.order()});
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] const std::vector<Bound>& bounds() const { return bounds_; }
  [[nodiscard]] const Indices& layers() const { return layers_; }
  [[nodiscard]] const std::vector<Holder>& holders() const { return holders_; }

 private:
  std::vector<Bound> bounds_;
  Indices layers_;
  typename Of::Columns columns_;
  typename Of::Stream stream_;
  typename Of::Tree tree_;
  Indices ascending_;
  std::vector<Holder> holders_;
};

/// Shafts of all kinds, one kind after the other, and the hulls that some of them refer to.
class ShaftSet {
 public:
  ShaftSet(Random& random, std::size_t count, bool has_hulls) {
    const std::size_t first_kind = random.below(kinds);
    for (std::size_t s = 0; s != count; ++s) add(random, (first_kind + s) % kinds, has_hulls);
  }

  [[nodiscard]] std::span<const CompiledShaft> all() const { return shafts_; }

 private:
  static constexpr std::size_t kinds = 9;

  void add(Random& random, std::size_t kind, bool has_hulls) {
    if (kind == 5 && has_hulls) {
      std::vector<Vec3> points;
      const Vec3 centre = random.vec3(-3, 3);
      points.resize(4 + random.below(5));
      for (Vec3& point : points) {
        for (std::size_t k = 0; k != 3; ++k) point[k] = centre[k] + random.uniform(-3, 3);
      }
      hulls_.push_back(std::make_unique<ConvexHull>(points));
      shafts_.push_back(hulls_.back()->compiled());
      if (random.one_in(3)) set_contact(shafts_.back(), Contact::open);
      return;
    }
    shafts_.push_back(drawn(random, kind));
    if (random.one_in(3)) set_contact(shafts_.back(), Contact::open);
    if (random.one_in(4)) set_form(shafts_.back(), Form::planes);
  }

  static CompiledShaft drawn(Random& random, std::size_t kind) {
    const Box a = random.box(-5, 5, 0.2F, 1.5F);
    const Box b = random.box(-5, 5, 0.2F, 1.5F);
    const Box on_lattice = random.grid_box(-5, 5);
    Box beside = a;  // apart from a
    beside.lo[0] = beside.hi[0] = a.hi[0] + random.uniform(0.5F, 2.0F);
    const Vec3 way{random.integer(-4, 4), random.uniform(-4, 4), random.integer(1, 3)};
    switch (kind) {
      case 0:
        return compile(a, b);  // joining planes are pending
      case 1: {
        std::vector<Plane> planes(1 + random.below(3));
        for (Plane& plane : planes) plane = {random.vec3(-1, 1), random.uniform(-1, 3)};
        CompiledShaft shaft = compile(a, b, planes);
        complete(shaft);
        return shaft;
      }
      case 2:
        return random.one_in(2) ? swept(a, way) : swept_infinite(a, way);
      case 3:
        return random.one_in(2) ? shadow(beside, a, 3.0F) : shadow(a, beside);
      case 4:  // of boxes on the lattice
        return compile(on_lattice, random.grid_box(-5, 5));
      case 6:  // most bounds are inside
        return compile({{-9, -9, -9}, {9, 9, 9}}, {{-9, -9, -9}, {9, 9, random.uniform(0, 9)}});
      case 7:  // all bounds but infinite ones are outside
        return compile({{50, 50, 50}, {51, 51, 51}}, {{60, 50, 50}, {61, 51, 51}});
      default:
        return compile(a, b);
    }
  }

  std::vector<std::unique_ptr<ConvexHull>> hulls_;
  std::vector<CompiledShaft> shafts_;
};

}  // namespace shaftcull
