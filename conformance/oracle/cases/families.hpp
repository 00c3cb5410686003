// SPDX-License-Identifier: MIT
/// All families of shafts and bounds that long runs draw their cases from, in one table.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracle/cases/bounds.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"

namespace shaftcull {

/// A kind of shaft, and the bounds that are asked of it.
struct Family {
  const char* name;
  ShaftInput (*shaft)(Random& random, unsigned index);  ///< `index` counts the shafts of the family
  Box (*box)(Random& random, const ShaftInput& input);
  Sphere (*sphere)(Random& random, const ShaftInput& input, const oracle::QuickHull& hull);
};

/// Binary exponent of the largest coordinate of the shaft, at least that of a denormal.
inline int exponent_of(const ShaftInput& input) {
  float largest = 0x1p-149F;
  for (const Box* box : {&input.a, &input.b}) {
    for (std::size_t k = 0; k != 3; ++k) largest = std::max({largest, std::abs(box->lo[k]), std::abs(box->hi[k])});
  }
  return std::ilogb(largest);
}

inline constexpr Family families[] = {
    {"random", [](Random& random, unsigned) { return random_shaft(random); },
     [](Random& random, const ShaftInput&) { return random_box(random); },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull&) { return random_sphere(random, input); }},
    {"touching", [](Random& random, unsigned) { return random_shaft(random); }, touching_box,
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       return touching_sphere(random, hull, random_centre(random, input));
     }},
    {"grid", [](Random& random, unsigned) { return grid_shaft(random, random.one_in(2) ? 8 : 32); },
     [](Random& random, const ShaftInput& input) { return random.grid_box(0, exponent_of(input) < 4 ? 8 : 32); },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull&) {
       const int size = exponent_of(input) < 4 ? 8 : 32;
       const Vec3 centre{random.integer(-4, size + 4), random.integer(-4, size + 4), random.integer(-4, size + 4)};
       return Sphere{centre, random.integer(0, 6)};
     }},
    {"degenerate", [](Random& random, unsigned) { return degenerate_shaft(random); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(3) ? random.box(-3, 3, 0.01F, 1.0F) : touching_box(random, input);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       if (random.one_in(4)) return Sphere{random.one_in(2) ? input.a.lo : input.b.hi, random.uniform(0.0F, 1.0F)};
       return touching_sphere(random, hull, random_centre(random, input));
     }},
    {"far from origin",
     [](Random& random, unsigned) { return distant_shaft(random, std::pow(10.0F, random.uniform(1.0F, 7.0F))); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(2) ? nearby_box(random, input) : touching_box(random, input);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       return random.one_in(2) ? random_sphere(random, input)
                               : touching_sphere(random, hull, random_centre(random, input));
     }},
    {"a few ulps", [](Random& random, unsigned) { return long_shaft(random, random.one_in(2)); }, touching_box,
     tiny_sphere},
    {"on joining planes",
     [](Random& random, unsigned) {
       return random.one_in(2) ? long_shaft(random, random.one_in(2)) : random_shaft(random);
     },
     touching_box, resting_sphere},
    {"faces nearly equal", [](Random& random, unsigned) { return nearly_equal_shaft(random); }, touching_box,
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       return touching_sphere(random, hull, random_centre(random, input));
     }},
    {"one magnitude",
     [](Random& random, unsigned) {
       const int exponent = static_cast<int>(random.integer(-149, 124));
       return wild_shaft(random, exponent, std::min(exponent + 4, 127));
     },
     [](Random& random, const ShaftInput& input) {
       const int exponent = exponent_of(input);
       return random.one_in(2) ? wild_box(random, std::max(exponent - 5, -149), exponent) : touching_box(random, input);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       const int exponent = exponent_of(input);
       const int low = std::max(exponent - 5, -149);
       const Vec3 centre = wild_point(random, low, exponent);
       return random.one_in(2) ? Sphere{centre, std::abs(random.wild(low, exponent))}
                               : touching_sphere(random, hull, centre);
     }},
    {"mixed magnitudes", [](Random& random, unsigned) { return wild_shaft(random); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(2) ? wild_box(random) : touching_box(random, input);
     },
     [](Random& random, const ShaftInput&, const oracle::QuickHull& hull) {
       const Vec3 centre = wild_point(random);
       return random.one_in(2) ? Sphere{centre, std::abs(random.wild())} : touching_sphere(random, hull, centre);
     }},
    {"huge shafts", [](Random& random, unsigned) { return huge_shaft(random); }, touching_box, sphere_beside_huge},
    {"all 729 colourings", [](Random&, unsigned index) { return coloured_shaft(index % colourings); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(3)   ? random.grid_box(-1, 5)
              : random.one_in(2) ? random.box(-1, 5, 0.0F, 0.3F)
                                 : touching_box(random, input);
     },
     [](Random& random, const ShaftInput&, const oracle::QuickHull& hull) {
       if (random.one_in(2)) return touching_sphere(random, hull, random.vec3(-2, 6));
       return Sphere{{random.integer(-2, 6), random.integer(-2, 6), random.integer(-2, 6)}, random.integer(0, 3)};
     }},
    {"added planes", [](Random& random, unsigned) { return with_planes(random, random_shaft(random), false); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(3) ? nearby_box(random, input) : box_at_plane(random, input);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull&) {
       return random.one_in(3) ? random_sphere(random, input) : sphere_at_plane(random, input);
     }},
    {"added planes, grid", [](Random& random, unsigned) { return with_planes(random, grid_shaft(random), true); },
     [](Random& random, const ShaftInput&) { return random.grid_box(0, 8); },
     [](Random& random, const ShaftInput&, const oracle::QuickHull&) {
       return Sphere{{random.integer(0, 8), random.integer(0, 8), random.integer(0, 8)}, random.integer(0, 4)};
     }},
    {"added planes, far",
     [](Random& random, unsigned) {
       return with_planes(random, distant_shaft(random, std::pow(10.0F, random.uniform(1.0F, 6.0F))), false);
     },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(3) ? nearby_box(random, input) : box_at_plane(random, input);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull&) {
       return random.one_in(3) ? random_sphere(random, input) : sphere_at_plane(random, input);
     }},
    {"bounds of any size", [](Random& random, unsigned) { return random_shaft(random); },
     [](Random& random, const ShaftInput&) { return boundless_box(random); }, boundless_sphere},
    {"added planes, wild", [](Random& random, unsigned) { return with_wild_planes(random, random_shaft(random)); },
     [](Random& random, const ShaftInput& input) {
       return random.one_in(2) ? nearby_box(random, input) : boundless_box(random);
     },
     [](Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
       return random.one_in(2) ? random_sphere(random, input) : boundless_sphere(random, input, hull);
     }},
    {"touching on a grid", [](Random& random, unsigned) { return pythagorean_shaft(random); },
     [](Random& random, const ShaftInput&) { return random.grid_box(-12, 24); },
     [](Random& random, const ShaftInput&, const oracle::QuickHull& hull) {
       return random.one_in(2) ? whole_sphere(random) : whole_touching_sphere(random, hull);
     }},
    {"lattice", [](Random& random, unsigned) { return lattice_shaft(random); },
     [](Random& random, const ShaftInput&) { return lattice_box(random, 4); },
     [](Random& random, const ShaftInput&, const oracle::QuickHull&) {
       return Sphere{{random.integer(-1, 5), random.integer(-1, 5), random.integer(-1, 5)}, random.integer(0, 2)};
     }},
};

}  // namespace shaftcull
