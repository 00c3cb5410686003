/// All families of shafts and bounds that long runs draw their cases from, in one table.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cases/bounds.hpp"
#include "cases/shafts.hpp"
#include "dice.hpp"
#include "quick_oracle.hpp"
#include "subject.hpp"

namespace shaftcull {

/// A kind of shaft, and the bounds that are asked of it.
struct Family {
  const char* name;
  Subject (*subject)(Dice& dice, unsigned index);  ///< `index` counts the shafts of the family
  Box (*box)(Dice& dice, const Subject& subject);
  Sphere (*sphere)(Dice& dice, const Subject& subject, const oracle::QuickHull& hull);
};

/// Binary exponent of the largest coordinate of the shaft, at least that of a denormal.
inline int exponent_of(const Subject& subject) {
  float largest = 0x1p-149F;
  for (const Box* box : {&subject.a, &subject.b}) {
    for (std::size_t k = 0; k != 3; ++k) largest = std::max({largest, std::abs(box->lo[k]), std::abs(box->hi[k])});
  }
  return std::ilogb(largest);
}

inline constexpr Family families[] = {
    {"random", [](Dice& dice, unsigned) { return random_subject(dice); },
     [](Dice& dice, const Subject&) { return random_box(dice); },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull&) { return random_sphere(dice, subject); }},
    {"touching", [](Dice& dice, unsigned) { return random_subject(dice); }, touching_box,
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       return touching_sphere(dice, hull, random_centre(dice, subject));
     }},
    {"grid", [](Dice& dice, unsigned) { return grid_subject(dice, dice.one_in(2) ? 8 : 32); },
     [](Dice& dice, const Subject& subject) { return dice.grid_box(0, exponent_of(subject) < 4 ? 8 : 32); },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull&) {
       const int size = exponent_of(subject) < 4 ? 8 : 32;
       const Vec3 centre{dice.integer(-4, size + 4), dice.integer(-4, size + 4), dice.integer(-4, size + 4)};
       return Sphere{centre, dice.integer(0, 6)};
     }},
    {"degenerate", [](Dice& dice, unsigned) { return degenerate_subject(dice); },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(3) ? dice.box(-3, 3, 0.01F, 1.0F) : touching_box(dice, subject);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       if (dice.one_in(4)) return Sphere{dice.one_in(2) ? subject.a.lo : subject.b.hi, dice.uniform(0.0F, 1.0F)};
       return touching_sphere(dice, hull, random_centre(dice, subject));
     }},
    {"far from origin",
     [](Dice& dice, unsigned) { return distant_subject(dice, std::pow(10.0F, dice.uniform(1.0F, 7.0F))); },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(2) ? nearby_box(dice, subject) : touching_box(dice, subject);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       return dice.one_in(2) ? random_sphere(dice, subject) : touching_sphere(dice, hull, random_centre(dice, subject));
     }},
    {"a few ulps", [](Dice& dice, unsigned) { return long_subject(dice, dice.one_in(2)); }, touching_box, tiny_sphere},
    {"on joining planes",
     [](Dice& dice, unsigned) { return dice.one_in(2) ? long_subject(dice, dice.one_in(2)) : random_subject(dice); },
     touching_box, resting_sphere},
    {"faces nearly equal", [](Dice& dice, unsigned) { return nearly_equal_subject(dice); }, touching_box,
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       return touching_sphere(dice, hull, random_centre(dice, subject));
     }},
    {"one magnitude",
     [](Dice& dice, unsigned) {
       const int exponent = static_cast<int>(dice.integer(-149, 124));
       return wild_subject(dice, exponent, std::min(exponent + 4, 127));
     },
     [](Dice& dice, const Subject& subject) {
       const int exponent = exponent_of(subject);
       return dice.one_in(2) ? wild_box(dice, std::max(exponent - 5, -149), exponent) : touching_box(dice, subject);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       const int exponent = exponent_of(subject);
       const int low = std::max(exponent - 5, -149);
       const Vec3 centre = wild_point(dice, low, exponent);
       return dice.one_in(2) ? Sphere{centre, std::abs(dice.wild(low, exponent))} : touching_sphere(dice, hull, centre);
     }},
    {"mixed magnitudes", [](Dice& dice, unsigned) { return wild_subject(dice); },
     [](Dice& dice, const Subject& subject) { return dice.one_in(2) ? wild_box(dice) : touching_box(dice, subject); },
     [](Dice& dice, const Subject&, const oracle::QuickHull& hull) {
       const Vec3 centre = wild_point(dice);
       return dice.one_in(2) ? Sphere{centre, std::abs(dice.wild())} : touching_sphere(dice, hull, centre);
     }},
    {"huge shafts", [](Dice& dice, unsigned) { return huge_subject(dice); }, touching_box, sphere_beside_huge},
    {"all 729 colourings", [](Dice&, unsigned index) { return coloured_subject(index % colourings); },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(3)   ? dice.grid_box(-1, 5)
              : dice.one_in(2) ? dice.box(-1, 5, 0.0F, 0.3F)
                               : touching_box(dice, subject);
     },
     [](Dice& dice, const Subject&, const oracle::QuickHull& hull) {
       if (dice.one_in(2)) return touching_sphere(dice, hull, dice.vec3(-2, 6));
       return Sphere{{dice.integer(-2, 6), dice.integer(-2, 6), dice.integer(-2, 6)}, dice.integer(0, 3)};
     }},
    {"added planes", [](Dice& dice, unsigned) { return with_planes(dice, random_subject(dice), false); },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(3) ? nearby_box(dice, subject) : box_at_plane(dice, subject);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull&) {
       return dice.one_in(3) ? random_sphere(dice, subject) : sphere_at_plane(dice, subject);
     }},
    {"added planes, grid", [](Dice& dice, unsigned) { return with_planes(dice, grid_subject(dice), true); },
     [](Dice& dice, const Subject&) { return dice.grid_box(0, 8); },
     [](Dice& dice, const Subject&, const oracle::QuickHull&) {
       return Sphere{{dice.integer(0, 8), dice.integer(0, 8), dice.integer(0, 8)}, dice.integer(0, 4)};
     }},
    {"added planes, far",
     [](Dice& dice, unsigned) {
       return with_planes(dice, distant_subject(dice, std::pow(10.0F, dice.uniform(1.0F, 6.0F))), false);
     },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(3) ? nearby_box(dice, subject) : box_at_plane(dice, subject);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull&) {
       return dice.one_in(3) ? random_sphere(dice, subject) : sphere_at_plane(dice, subject);
     }},
    {"bounds of any size", [](Dice& dice, unsigned) { return random_subject(dice); },
     [](Dice& dice, const Subject&) { return boundless_box(dice); }, boundless_sphere},
    {"added planes, wild", [](Dice& dice, unsigned) { return with_wild_planes(dice, random_subject(dice)); },
     [](Dice& dice, const Subject& subject) {
       return dice.one_in(2) ? nearby_box(dice, subject) : boundless_box(dice);
     },
     [](Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
       return dice.one_in(2) ? random_sphere(dice, subject) : boundless_sphere(dice, subject, hull);
     }},
    {"touching on a grid", [](Dice& dice, unsigned) { return pythagorean_subject(dice); },
     [](Dice& dice, const Subject&) { return dice.grid_box(-12, 24); },
     [](Dice& dice, const Subject&, const oracle::QuickHull& hull) {
       return dice.one_in(2) ? whole_sphere(dice) : whole_touching_sphere(dice, hull);
     }},
};

}  // namespace shaftcull
