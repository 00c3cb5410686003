// SPDX-License-Identifier: MIT
/// Scenes for the tests of trees: shapes that could break one, and random ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {

inline constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// Arrangements of bounds.
enum class Shape : std::uint8_t {
  uniform,
  clustered,
  coincident,
  flat,
  line,
  wild_sizes,
  one_giant,
  grid,
  some_infinite,
  some_empty,
  lattice
};
inline constexpr Shape shapes[] = {Shape::uniform,       Shape::clustered,  Shape::coincident, Shape::flat,
                                   Shape::line,          Shape::wild_sizes, Shape::one_giant,  Shape::grid,
                                   Shape::some_infinite, Shape::some_empty, Shape::lattice};

inline const char* text(Shape shape) {
  static constexpr const char* names[] = {"uniform",       "clustered",  "coincident", "flat",
                                          "line",          "wild sizes", "one giant",  "grid",
                                          "some infinite", "some empty", "lattice"};
  return names[static_cast<std::size_t>(shape)];
}

/// Bound `i` of a scene, as a centre and three half extents.
struct Blob {
  Vec3 centre;
  Vec3 half;
};

inline Blob blob(Random& random, Shape shape, std::size_t i) {
  Blob blob{random.vec3(-5, 5), random.vec3(0.01F, 0.2F)};
  switch (shape) {
    case Shape::clustered: {
      const float home = static_cast<float>(random.below(5)) - 2.0F;
      blob = {{home + random.uniform(-0.01F, 0.01F), 2 * home + random.uniform(-0.01F, 0.01F), home},
              random.vec3(0, 0.01F)};
      break;
    }
    case Shape::coincident:
      blob = {{1, 0.5F, -0.25F}, {0.25F, 0.25F, 0.25F}};
      break;
    case Shape::flat:
      blob.centre[2] = 1;
      blob.half[2] = 0;
      break;
    case Shape::line:
      blob = {{blob.centre[0], 0, 1}, {0, 0, 0}};
      break;
    case Shape::wild_sizes: {
      const float scale = std::pow(10.0F, random.uniform(-6, 3));
      for (float& h : blob.half) h *= scale;
      break;
    }
    case Shape::one_giant:
      if (i == 17) blob.half = {1e6F, 1e30F, 40};
      break;
    case Shape::lattice:  // its bounds touch shafts between whole numbers, and half of their extents are 0
      blob.centre = {random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)};
      for (float& h : blob.half) h = random.integer(0, 1);
      break;
    case Shape::grid:
      blob = {{random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)}, {0.5F, 0.5F, 0.5F}};
      break;
    default:
      break;
  }
  return blob;
}

inline Box box_of(Random& random, Shape shape, std::size_t i) {
  const Blob b = blob(random, shape, i);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = b.centre[k] - b.half[k];
    box.hi[k] = b.centre[k] + b.half[k];
  }
  if (shape == Shape::some_empty && random.one_in(3)) return empty_box;
  if (shape == Shape::some_infinite && random.one_in(5)) {
    box.lo[random.below(3)] = -infinity;
    if (random.one_in(2)) box.hi[random.below(3)] = infinity;
  }
  return box;
}

inline Sphere sphere_of(Random& random, Shape shape, std::size_t i) {
  const Blob b = blob(random, shape, i);
  if (shape == Shape::some_infinite && random.one_in(5)) return {b.centre, infinity};
  return {b.centre, b.half[0]};
}

template <class Bound>
std::vector<Bound> scene(Random& random, Shape shape, std::size_t count) {
  std::vector<Bound> bounds;
  for (std::size_t i = 0; i != count; ++i) {
    if constexpr (std::is_same_v<Bound, Box>) {
      bounds.push_back(box_of(random, shape, i));
    } else {
      bounds.push_back(sphere_of(random, shape, i));
    }
  }
  return bounds;
}

/// Shafts thin and thick, of all kinds that compile differently; every third has open contact.
inline std::vector<CompiledShaft> shafts_for(Random& random, std::size_t count) {
  std::vector<CompiledShaft> shafts;
  while (shafts.size() != count) {
    Box a{};
    Box b{};
    if (random.one_in(4)) {  // moving boxes
      a = random.one_in(2) ? random.grid_box(-5, 5) : random.box(-5, 5, 0, 0.5F);
      const Vec3 d{random.integer(-4, 4), random.uniform(-4, 4), random.integer(1, 3)};
      b = a;
      b.lo[0] = b.hi[0] = a.hi[0] + random.uniform(0.5F, 2.0F);
      const unsigned kind = random.below(4);
      shafts.push_back(kind == 0   ? swept(a, d)
                       : kind == 1 ? swept_infinite(a, d)
                       : kind == 2 ? shadow(b, a, 3.0F)
                                   : shadow(a, b));
      continue;
    }
    switch (random.below(5)) {
      case 0:
        a = random.box(-5, 5, 0.2F, 1.0F), b = random.box(-5, 5, 0.2F, 1.0F);
        break;
      case 1:
        a = random.box(-4, 4, 3.0F, 5.0F), b = random.box(-4, 4, 3.0F, 5.0F);
        break;  // most bounds are inside
      case 2:
        a = random.grid_box(-5, 5), b = random.grid_box(-5, 5);
        break;  // touching, purple faces
      case 3:
        a = b = random.grid_box(-5, 5);
        break;
      default:
        a = random.box(-5, 5, 0, 0.01F), b = random.box(-5, 5, 0, 0.01F);
        break;
    }
    std::vector<Plane> planes;
    if (random.one_in(4)) planes.push_back({random.vec3(-1, 1), random.uniform(-1, 1)});
    shafts.push_back(compile(a, b, planes));
    if (!random.one_in(3)) complete(shafts.back());
  }
  for (std::size_t s = 1; s < count; s += 3) set_contact(shafts[s], Contact::open);
  return shafts;
}

}  // namespace shaftcull
