// SPDX-License-Identifier: MIT
/// Convex hulls against the oracle: on every instruction set, in views of all sizes, one bound at a time, and in trees.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

bool bit(const std::vector<std::uint64_t>& words, std::size_t i) { return (words[i / 64] >> i % 64 & 1U) != 0; }

Answer answer_at(const std::vector<std::uint64_t>& kept, const std::vector<std::uint64_t>& inside, std::size_t i) {
  return !bit(kept, i) ? Answer::outside : bit(inside, i) ? Answer::inside : Answer::overlap;
}

/// Answers of classify() for a view, after checking that cull(), classify() of bounds inside alone, and one bound at a
/// time agree.
template <class Bound>
std::vector<Answer> answers(const ConvexHull& hull, const std::vector<Bound>& bounds) {
  const auto memory = columns(bounds);
  std::vector<std::uint64_t> culled(bit_words(bounds.size()), ~std::uint64_t{0});
  std::vector<std::uint64_t> kept = culled;
  std::vector<std::uint64_t> inside = culled;
  std::vector<std::uint64_t> inside_alone = culled;
  cull(hull, memory.view(), culled);
  classify(hull, memory.view(), kept, inside);
  classify(hull, memory.view(), {}, inside_alone);
  EXPECT_EQ(culled, kept);
  EXPECT_EQ(inside_alone, inside);
  for (const std::size_t few : {2U, 7U, 16U, 31U}) {  // other stages than of many
    if (few > bounds.size()) break;
    const std::size_t first = bounds.size() - few;
    std::uint64_t word = 0;
    cull(hull, memory.view().slice(first, few), {&word, 1});
    for (std::size_t i = 0; i != few; ++i) EXPECT_EQ((word >> i & 1U) != 0, bit(kept, first + i)) << few;
  }
  std::vector<Answer> all;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    all.push_back(answer_at(kept, inside, i));
    EXPECT_EQ(classify(hull, bounds[i]), all.back());
    EXPECT_EQ(keeps(hull, bounds[i]), all.back() != Answer::outside);
  }
  return all;
}

/// Fails, with a reproducer for the first wrong one, unless all answers are right: `correct` is given each with its
/// bound, and returns what it should be.
template <class Bound, class Correct>
void expect_right(const HullInput& input, const std::vector<Bound>& bounds, const char* form, const Correct& correct,
                  HullTest test = HullTest::exact) {
  const ConvexHull hull(input.points, input.directions, test);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const std::vector<Answer> found = answers(hull, bounds);
    for (std::size_t i = 0; i != bounds.size(); ++i) {
      const Answer right = correct(i, found[i]);
      ASSERT_EQ(found[i], right) << "on " << name(isa) << ", form " << form << "; bound " << i << ":\n  "
                                 << source_text(input) << "\n  " << source_text(bounds[i]) << "\n  is " << text(right)
                                 << ", answered " << text(found[i]);
    }
  }
}

void expect_exact(const HullInput& input, const std::vector<Box>& boxes) {
  const oracle::ConvexHull oracle(input);
  std::vector<Answer> right;
  right.reserve(boxes.size());
  for (const Box& box : boxes) right.push_back(oracle.answer(box));
  expect_right(input, boxes, "boxes of a hull", [&](std::size_t i, Answer) { return right[i]; });
  // A conservative hull may keep a box that is outside, on all instruction sets alike.
  std::vector<Answer> conservative;
  const auto may_be = [&](std::size_t i, Answer found) {
    if (conservative.size() == i) {
      conservative.push_back(right[i] == Answer::outside && found == Answer::overlap ? found : right[i]);
    }
    return conservative[i];
  };
  expect_right(input, boxes, "boxes of a conservative hull", may_be, HullTest::conservative);
}

/// Spheres that are outside are beyond a plane, those that are clearly so are outside; likewise inside. All instruction
/// sets give the same answers.
void expect_sound(const HullInput& input, const std::vector<Sphere>& spheres) {
  const oracle::ConvexHull oracle(input);
  std::vector<Answer> right;
  expect_right(input, spheres, "spheres of a hull", [&](std::size_t i, Answer found) {
    if (right.size() == i) right.push_back(oracle.corrected(spheres[i], found));
    return right[i];
  });
  const auto same = [&](std::size_t i, Answer) { return right[i]; };
  expect_right(input, spheres, "spheres of a conservative hull", same, HullTest::conservative);
}

TEST(Hull, BoxesAnywhereAreAnsweredExactly) {
  Random random(1);
  for (std::uint64_t i = 0; i != random_cases(120); ++i) {
    const HullInput input = hull_of(random, 9, [&] { return random.uniform(-10, 10); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 90 + i % 7; ++b) boxes.push_back(random.box(-15, 15, 0, 4));
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, BoxesThatTouchAreAnsweredExactly) {
  Random random(2);
  for (std::uint64_t i = 0; i != random_cases(200); ++i) {
    const float at = random.one_in(3) ? 1e5F : 0;
    const HullInput input = hull_of(random, 8, [&] { return random.uniform(-3, 3) + at; });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 70; ++b) boxes.push_back(near_box(random, input, 2));
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OnAGridWherePointsAreFlatStraightAndRepeated) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(400); ++i) {
    const int side = 1 + static_cast<int>(random.below(3));
    const HullInput input = hull_of(random, 8, [&] { return random.integer(-side, side); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 70; ++b) boxes.push_back(random.grid_box(-side - 2, side + 2));
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OfAnyMagnitude) {
  Random random(4);
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const int high = static_cast<int>(random.integer(-140, 127));
    const int low = std::max(-149, high - static_cast<int>(random.below(40)));
    const HullInput input = hull_of(random, 7, [&] { return random.wild(low, high); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 66; ++b) {
      const auto corner = [&] { return Vec3{random.wild(low, high), random.wild(low, high), random.wild(low, high)}; };
      boxes.push_back(Random::sorted(corner(), corner()));
    }
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OfAllMagnitudesAtOnce) {
  // A normal's small component is 0 as a float, beside a large one; its sign still says which corner is near.
  Random random(5);
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const auto coordinate = [&] { return random.wild(-149, 127); };
    const HullInput input = hull_of(random, 7, coordinate);
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 66; ++b) {
      const auto corner = [&] { return Vec3{coordinate(), coordinate(), coordinate()}; };
      boxes.push_back(Random::sorted(corner(), corner()));
    }
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, WithoutEndAndBoundsWhereFloatsEnd) {
  // What a plane's terms amount to overflows there, with either sign.
  Random random(6);
  constexpr float largest = std::numeric_limits<float>::max();
  const auto far = [&] {
    const float x = random.one_in(2) ? largest : random.wild(120, 127);
    return random.one_in(2) ? x : -x;
  };
  for (std::uint64_t i = 0; i != random_cases(300); ++i) {
    const int high = static_cast<int>(random.integer(-10, 58));
    HullInput input;
    while (input.directions.empty()) {
      input = hull_of(random, 7, [&] { return random.wild(high - 6, high); });
    }
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (unsigned b = 0; b != 66; ++b) {
      const auto coordinate = [&] { return random.one_in(4) ? random.wild(high - 6, high) : far(); };
      const Vec3 corner = {coordinate(), coordinate(), coordinate()};
      boxes.push_back(random.one_in(2) ? Box{corner, corner}
                                       : Random::sorted(corner, {coordinate(), coordinate(), coordinate()}));
      spheres.push_back({corner, random.one_in(2) ? 0 : std::fabs(coordinate())});
    }
    expect_exact(input, boxes);
    expect_sound(input, spheres);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OfSmallPointsAndSpheresFarAwayThatReachThem) {
  // Of such a centre two terms of a plane overflow with opposite signs.
  Random random(8);
  for (std::uint64_t i = 0; i != random_cases(300); ++i) {
    const int high = static_cast<int>(random.integer(-60, 30));
    const HullInput input = hull_of(random, 7, [&] { return random.wild(high - 10, high); });
    const int far = static_cast<int>(random.integer(60, 126));
    std::vector<Sphere> spheres;
    for (unsigned b = 0; b != 66; ++b) {
      const auto coordinate = [&] { return random.one_in(4) ? random.wild(-30, 30) : random.wild(far - 12, far); };
      const Vec3 centre = {coordinate(), coordinate(), coordinate()};
      const double distance = std::hypot(double{centre[0]}, double{centre[1]}, double{centre[2]});
      const double radius = distance * (1 + random.integer(-3, 3) * (random.one_in(2) ? 0x1p-22 : 0.2));
      spheres.push_back({centre, static_cast<float>(std::min(radius, double{std::numeric_limits<float>::max()}))});
    }
    expect_sound(input, spheres);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, UnboundedAndEmptyBoxes) {
  Random random(5);
  for (std::uint64_t i = 0; i != random_cases(100); ++i) {
    const HullInput input = hull_of(random, 6, [&] { return random.integer(-3, 3); });
    std::vector<Box> boxes = {{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    for (unsigned b = 0; b != 70; ++b) {
      Box box = random.grid_box(-5, 5);
      for (std::size_t k = 0; k != 3; ++k) {
        if (random.one_in(3)) box.lo[k] = -infinity;
        if (random.one_in(3)) box.hi[k] = infinity;
      }
      boxes.push_back(box);
    }
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, AsManyVerticesAsThereMayBe) {
  Random random(6);
  for (const std::size_t directions : {std::size_t{0}, std::size_t{5}}) {
    HullInput input;
    while (input.points.size() + directions != ConvexHull::max_vertices) {
      Vec3 p = random.vec3(-1, 1);  // on a sphere, so that all are corners
      const float length = std::hypot(p[0], p[1], p[2]);
      for (float& x : p) x *= 4 / length;
      input.points.push_back(p);
    }
    while (input.directions.size() != directions) input.directions.push_back(random.vec3(0.5F, 1));
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 40; ++b) boxes.push_back(near_box(random, input, 1));
    for (unsigned b = 0; b != 40; ++b) boxes.push_back(random.box(-5, 5, 0, 1));
    expect_exact(input, boxes);
  }
}

TEST(Hull, SpheresAreOutsideOnlyBeyondAPlane) {
  Random random(7);
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const bool on_grid = random.one_in(3);
    const HullInput input = hull_of(random, 8, [&] { return on_grid ? random.integer(-3, 3) : random.uniform(-5, 5); });
    std::vector<Sphere> spheres;
    for (unsigned s = 0; s != 70; ++s) {
      const Vec3 centre =
          on_grid ? Vec3{random.integer(-6, 6), random.integer(-6, 6), random.integer(-6, 6)} : random.vec3(-8, 8);
      spheres.push_back({centre, on_grid ? random.integer(0, 4) : random.uniform(0, 4)});
    }
    expect_sound(input, spheres);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, SpheresThatTouchAPlaneButForAnUlpAreOutsideOnlyBeyondIt) {
  for (const HullFamily& family : hull_families) {
    SCOPED_TRACE(family.name);
    Random random(10);
    for (std::uint64_t i = 0; i != random_cases(40); ++i) {
      const HullInput input = family.input(random);
      const oracle::ConvexHull hull(input);
      std::vector<Sphere> spheres;
      while (spheres.size() != 40) spheres.push_back(family.sphere(random, input, hull));
      expect_sound(input, spheres);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Hull, BoxesOfEveryFamilyAreAnsweredExactly) {
  for (const HullFamily& family : hull_families) {
    SCOPED_TRACE(family.name);
    Random random(11);
    for (std::uint64_t i = 0; i != random_cases(40); ++i) {
      const HullInput input = family.input(random);
      std::vector<Box> boxes;
      while (boxes.size() != 66) boxes.push_back(family.box(random, input));
      expect_exact(input, boxes);
      if (HasFatalFailure()) return;
    }
  }
}

/// A camera at `eye`, slightly turned, as a perspective view-projection matrix of four rows.
std::array<float, 16> camera(Random& random, const Vec3& eye, bool open, bool reversed) {
  const double turn = random.uniform(-3, 3);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const double n = 0.5;
  const double f = 60;
  const double sx = 1.2;
  const double sy = 1.6;
  // Depth from z of the eye's space, z < 0 in front: (a z + b) / −z.
  const double a = reversed ? (open ? 0 : n / (f - n)) : (open ? -1 : -f / (f - n));
  const double b = reversed ? (open ? n : f * n / (f - n)) : (open ? -n : -f * n / (f - n));
  const double view[3][4] = {
      {c, 0, -s, -(c * eye[0] - s * eye[2])}, {0, 1, 0, -eye[1]}, {s, 0, c, -(s * eye[0] + c * eye[2])}};
  std::array<float, 16> matrix{};
  for (std::size_t k = 0; k != 4; ++k) {
    matrix[k] = static_cast<float>(sx * view[0][k]);
    matrix[4 + k] = static_cast<float>(sy * view[1][k]);
    matrix[8 + k] = static_cast<float>(a * view[2][k] + (k == 3 ? b : 0));
    matrix[12 + k] = static_cast<float>(-view[2][k]);
  }
  return matrix;
}

TEST(Hull, OfAViewIsWhatItsPlanesShowAndNoMore) {
  Random random(8);
  for (unsigned i = 0; i != 40; ++i) {
    const bool open = i % 2 == 1;
    const bool reversed = i / 2 % 2 == 1;
    const std::array<float, 16> matrix = camera(random, random.vec3(-20, 20), open, reversed);
    const ConvexHull view = frustum(matrix, ClipDepth::zero_to_one);
    EXPECT_EQ(view.points().size(), open ? 4U : 8U);
    EXPECT_EQ(view.directions().size(), open ? 4U : 0U);
    // Points well within all planes are kept, points well beyond one are not.
    for (unsigned p = 0; p != 400; ++p) {
      const Vec3 at = random.vec3(-60, 60);
      double most = -1e30;
      for (const Plane& plane : view_planes(matrix, ClipDepth::zero_to_one)) {
        double value = -static_cast<double>(plane.offset);
        double length = 0;
        for (std::size_t k = 0; k != 3; ++k) {
          value += static_cast<double>(plane.normal[k]) * at[k];
          length += static_cast<double>(plane.normal[k]) * plane.normal[k];
        }
        most = std::max(most, value / std::sqrt(length));
      }
      if (std::abs(most) > 1e-2) {
        EXPECT_EQ(keeps(view, Box{at, at}), most < 0) << most;
      }
    }
    const HullInput input{{view.points().begin(), view.points().end()},
                          {view.directions().begin(), view.directions().end()}};
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 100; ++b) boxes.push_back(random.box(-70, 70, 0, 12));
    expect_exact(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, AConservativeViewIsTheUsualTestByPlanes) {
  Random random(12);
  std::size_t kept_in_vain = 0;
  for (unsigned i = 0; i != 40; ++i) {
    const std::array<float, 16> matrix = camera(random, random.vec3(-20, 20), i % 2 == 1, i / 2 % 2 == 1);
    const ConvexHull exact = frustum(matrix, ClipDepth::zero_to_one);
    const ConvexHull view = frustum(matrix, ClipDepth::zero_to_one, HullTest::conservative);
    const ViewPlanes planes = view_planes(matrix, ClipDepth::zero_to_one);
    for (unsigned b = 0; b != 400; ++b) {
      const Box box = random.box(-70, 70, 0, 40);
      double most = -1e30;  // of the near corner, in front of any plane
      for (const Plane& plane : planes) {
        double value = -static_cast<double>(plane.offset);
        double square = 0;
        for (std::size_t k = 0; k != 3; ++k) {
          const double n = plane.normal[k];
          value += n * static_cast<double>(n > 0 ? box.lo[k] : box.hi[k]);
          square += n * n;
        }
        most = std::max(most, value / std::sqrt(square));
      }
      if (std::abs(most) < 1e-2) continue;
      EXPECT_EQ(keeps(view, box), most < 0) << most;
      kept_in_vain += keeps(view, box) && !keeps(exact, box) ? 1 : 0;
    }
  }
  EXPECT_GT(kept_in_vain, 40U);
}

TEST(Hull, AConservativeHullAnswersAlikeInTreesAndAmongMany) {
  Random random(13);
  for (std::uint64_t i = 0; i != random_cases(40); ++i) {
    const HullInput input = hull_of(random, 9, [&] { return random.uniform(-10, 10); });
    const ConvexHull hull(input.points, input.directions, HullTest::conservative);
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 700 + i % 7; ++b) boxes.push_back(random.box(-25, 25, 0, 6));
    boxes.push_back({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
    const BoxStream stream{std::span<const Box>(boxes)};
    const BoxTree tree{std::span<const Box>(boxes)};
    const std::vector<CompiledShaft> two{hull.compiled(), compile(random.box(-5, 5, 0, 2), random.box(-5, 5, 0, 2))};
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      std::vector<std::uint64_t> kept(bit_words(boxes.size()));
      std::vector<std::uint64_t> inside(kept.size());
      std::vector<std::uint64_t> tree_kept(kept.size());
      std::vector<std::uint64_t> tree_inside(kept.size());
      std::vector<std::uint64_t> many_kept(2 * kept.size());
      classify(hull, stream, kept, inside);
      classify(hull, tree, tree_kept, tree_inside);
      cull_many(two, stream, many_kept);
      ASSERT_EQ(tree_kept, kept) << source_text(input) << " on " << name(isa);
      ASSERT_EQ(tree_inside, inside) << source_text(input) << " on " << name(isa);
      many_kept.resize(kept.size());
      ASSERT_EQ(many_kept, kept) << source_text(input) << " on " << name(isa);
      cull_many(two, tree, many_kept = std::vector<std::uint64_t>(2 * kept.size()));
      many_kept.resize(kept.size());
      ASSERT_EQ(many_kept, kept) << source_text(input) << " on " << name(isa);
    }
  }
}

/// A light that crosses the plane of a frustum's face, one float after the other.
TEST(Hull, OfCastersDoesNotFlickerWhereTheLightCrossesTheViewsPlane) {
  const std::vector<Vec3> corners = {{-1, -1, 2}, {1, -1, 2}, {-1, 1, 2}, {1, 1, 2},
                                     {-4, -4, 8}, {4, -4, 8}, {-4, 4, 8}, {4, 4, 8}};
  const ConvexHull view(corners);
  // x = z / 2 is the plane of its right face; the light is in it at z = 6.
  for (const float y : {0.0F, 5.0F, 12.0F}) {
    float x = 3;
    for (unsigned i = 0; i != 4; ++i) x = std::nextafter(x, 0.0F);
    for (unsigned i = 0; i != 9; ++i, x = std::nextafter(x, 10.0F)) {
      const Vec3 light = {x, y, 6};
      const ConvexHull hull = casters(view, light);
      HullInput input{corners, {}};
      input.points.push_back(light);
      std::vector<Box> boxes;
      for (unsigned b = 0; b != 65; ++b) {
        const float at = 2 + static_cast<float>(b) / 8;
        boxes.push_back({{at / 2, -1, at}, {at / 2 + 1, 7, at + 0.25F}});
        boxes.push_back({{std::nextafter(at / 2, 10.0F), -1, at}, {at / 2 + 1, 7, at}});
      }
      boxes.push_back({light, light});
      expect_exact(input, boxes);
      if (HasFatalFailure()) return;
      EXPECT_TRUE(keeps(hull, Box{light, light}));
    }
  }
}

TEST(Hull, OfCastersTowardsASunHasNoEnd) {
  on_each_instruction_set([] {
    const std::vector<Vec3> corners = {{-1, -1, 2}, {1, -1, 2}, {-1, 1, 2}, {1, 1, 2},
                                       {-4, -4, 8}, {4, -4, 8}, {-4, 4, 8}, {4, 4, 8}};
    const ConvexHull hull = casters_towards(ConvexHull(corners), {0, 1, 0});
    EXPECT_TRUE(keeps(hull, Box{{0, 1e20F, 5}, {1, 1e21F, 6}}));
    EXPECT_FALSE(keeps(hull, Box{{0, -1e20F, 5}, {1, -10, 6}}));
    EXPECT_EQ(classify(hull, Box{{0, 1e20F, 5}, {1, 1e21F, 6}}), Answer::inside);
    EXPECT_EQ(hull.box().hi[1], std::numeric_limits<float>::infinity());
  });
}

/// Among shafts, in trees and in lists of candidates a hull answers what it answers alone.
TEST(Hull, SpheresInTreesAreAnsweredAsAloneWhereTheyTouch) {
  // A node of a tree is a box, which is compared exactly.
  Random random(9);
  for (std::uint64_t i = 0; i != random_cases(60); ++i) {
    const int high = static_cast<int>(random.integer(-20, 58));
    const int low = random.one_in(2) ? -149 : high - 6;
    const HullInput input = hull_of(random, 7, [&] { return random.wild(low, high); });
    const ConvexHull hull(input.points, input.directions);
    const oracle::ConvexHull oracle(input);
    std::vector<Sphere> spheres;
    for (unsigned b = 0; b != 70; ++b) {
      const Box near = near_box(random, input, std::ldexp(1.0F, high));
      Sphere sphere = sphere_around(random, oracle, near.lo, std::ldexp(1.0F, high - 24));
      if (random.one_in(3)) sphere.radius = 0;
      spheres.insert(spheres.end(), 64, sphere);  // a node of its own
    }
    const SphereStream stream{std::span<const Sphere>(spheres)};
    const SphereTree tree{std::span<const Sphere>(spheres)};
    std::vector<std::uint64_t> kept(bit_words(spheres.size()));
    std::vector<std::uint64_t> inside(kept.size());
    std::vector<std::uint64_t> tree_kept(kept.size());
    std::vector<std::uint64_t> tree_inside(kept.size());
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      classify(hull, stream, kept, inside);
      classify(hull, tree, tree_kept, tree_inside);
      for (std::size_t s = 0; s < spheres.size(); s += 64) {
        const Answer alone = answer_at(kept, inside, s);
        const Answer in_tree = answer_at(tree_kept, tree_inside, s);
        ASSERT_EQ(in_tree, alone) << "on " << name(isa) << ":\n  " << source_text(input) << "\n  "
                                  << source_text(spheres[s]) << "\n  is " << text(alone) << ", in a tree "
                                  << text(in_tree);
      }
    }
  }
}

TEST(Hull, GoesWhereShaftsGo) {
  Random random(9);
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
  for (unsigned b = 0; b != 5000; ++b) {
    boxes.push_back(random.box(-30, 30, 0, 1));
    spheres.push_back({random.vec3(-30, 30), random.uniform(0, 1)});
  }
  const BoxTree box_tree{std::span<const Box>(boxes)};
  const SphereTree sphere_tree{std::span<const Sphere>(spheres)};
  const BoxStream box_stream{std::span<const Box>(boxes)};
  const SphereStream sphere_stream{std::span<const Sphere>(spheres)};
  std::vector<ConvexHull> hulls;
  std::vector<CompiledShaft> shafts;
  for (unsigned h = 0; h != 24; ++h) {
    const HullInput input = hull_of(random, 8, [&] { return random.uniform(-25, 25); });
    hulls.emplace_back(input.points, input.directions);
  }
  for (const ConvexHull& hull : hulls) {
    shafts.push_back(hull);
    shafts.push_back(compile(random.box(-30, 30, 0, 2), random.box(-30, 30, 0, 2)));
  }
  const auto expect_same = [&](const auto& stream, const auto& tree) {
    const std::size_t words = bit_words(stream.size());
    std::vector<std::uint64_t> kept(shafts.size() * words);
    std::vector<std::uint64_t> inside(kept.size());
    std::vector<std::uint64_t> tree_kept(kept.size());
    std::vector<std::uint64_t> tree_inside(kept.size());
    classify_many(shafts, stream, kept, inside);
    classify_many(shafts, tree, tree_kept, tree_inside);
    EXPECT_EQ(kept, tree_kept);
    EXPECT_EQ(inside, tree_inside);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      std::vector<std::uint64_t> alone(words);
      std::vector<std::uint64_t> alone_inside(words);
      classify(shafts[s], stream, alone, alone_inside);
      EXPECT_TRUE(std::equal(alone.begin(), alone.end(), kept.begin() + static_cast<std::ptrdiff_t>(s * words)));
      EXPECT_TRUE(std::equal(alone_inside.begin(), alone_inside.end(),
                             inside.begin() + static_cast<std::ptrdiff_t>(s * words)));
      std::vector<std::uint32_t> listed(stream.size());
      EXPECT_EQ(list(shafts[s], tree, std::span(listed)), count(shafts[s], stream));
      EXPECT_EQ(any(shafts[s], tree), count(shafts[s], stream) != 0);
    }
  };
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    expect_same(box_stream, box_tree);
    expect_same(sphere_stream, sphere_tree);
  }
}

}  // namespace
}  // namespace shaftcull
