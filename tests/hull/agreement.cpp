/// Convex hulls against the oracle: on every instruction set, in views of all sizes, one bound at a time, and in trees.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/refine.hpp"

namespace shaftcull {
namespace {

/// The vertices of a hull, and what coordinates its neighbours have.
struct Vertices {
  std::vector<Vec3> points;
  std::vector<Vec3> directions;
};

std::string text(const Vec3& v) {
  std::string text = "{";
  for (const float x : v) text += std::to_string(x) + " ";
  return text + "}";
}

std::string text(const Vertices& vertices) {
  std::string text = "points";
  for (const Vec3& p : vertices.points) text += " " + shaftcull::text(p);
  text += ", directions";
  for (const Vec3& d : vertices.directions) text += " " + shaftcull::text(d);
  return text;
}

bool bit(const std::vector<std::uint64_t>& words, std::size_t i) { return (words[i / 64] >> i % 64 & 1U) != 0; }

Answer answer_at(const std::vector<std::uint64_t>& kept, const std::vector<std::uint64_t>& inside, std::size_t i) {
  return !bit(kept, i) ? Answer::outside : bit(inside, i) ? Answer::inside : Answer::overlap;
}

/// Answers of classify() for a view, after checking that cull(), contained() and one bound at a time agree.
template <class Bound>
std::vector<Answer> answers(const ConvexHull& hull, const std::vector<Bound>& bounds, Form form) {
  const auto memory = columns(bounds);
  std::vector<std::uint64_t> culled(words_for(bounds.size()), ~std::uint64_t{0});
  std::vector<std::uint64_t> kept = culled;
  std::vector<std::uint64_t> inside = culled;
  std::vector<std::uint64_t> contained_alone = culled;
  cull(hull, memory.view(), culled, form);
  classify(hull, memory.view(), kept, inside, form);
  contained(hull, memory.view(), contained_alone);
  EXPECT_EQ(culled, kept);
  EXPECT_EQ(contained_alone, inside);
  std::vector<Answer> all;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    all.push_back(answer_at(kept, inside, i));
    if (i % 7 == 0) {
      EXPECT_EQ(classify(hull, bounds[i]), all.back());
      EXPECT_EQ(cull(hull, bounds[i]), all.back() != Answer::outside);
    }
  }
  return all;
}

void expect_exact(const Vertices& vertices, const std::vector<Box>& boxes) {
  const oracle::ConvexHull oracle(vertices.points, vertices.directions);
  std::vector<Answer> right;
  right.reserve(boxes.size());
  for (const Box& box : boxes) right.push_back(oracle.answer(box));
  const ConvexHull hull(vertices.points, vertices.directions);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : {Form::slab, Form::planes}) {
      const std::vector<Answer> found = answers(hull, boxes, form);
      for (std::size_t i = 0; i != boxes.size(); ++i) {
        ASSERT_EQ(found[i], right[i]) << name(isa) << ", box " << i << " " << text(boxes[i].lo) << " to "
                                      << text(boxes[i].hi) << ", " << text(vertices);
      }
    }
  }
}

/// Spheres that are outside are beyond a plane, those that are clearly so are outside; likewise inside.
void expect_sound(const Vertices& vertices, const std::vector<Sphere>& spheres) {
  constexpr double slack = 0x1p-24;
  const oracle::ConvexHull oracle(vertices.points, vertices.directions);
  const ConvexHull hull(vertices.points, vertices.directions);
  std::vector<Answer> first;
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : {Form::slab, Form::planes}) {
      const std::vector<Answer> found = answers(hull, spheres, form);
      if (first.empty()) first = found;
      EXPECT_EQ(found, first) << name(isa);
    }
  }
  for (std::size_t i = 0; i != spheres.size(); ++i) {
    const auto which = [&] {
      return "sphere " + text(spheres[i].centre) + std::to_string(spheres[i].radius) + text(vertices);
    };
    if (first[i] == Answer::outside) {
      ASSERT_TRUE(oracle.is_beyond(spheres[i])) << which();
    } else {
      ASSERT_FALSE(oracle.is_beyond(spheres[i], slack)) << which();
    }
    if (first[i] == Answer::inside) {
      ASSERT_TRUE(oracle.is_within(spheres[i])) << which();
    } else {
      ASSERT_FALSE(oracle.is_within(spheres[i], slack)) << which();
    }
  }
}

/// Up to `most` points, and sometimes a few directions, with what `coordinate` draws.
template <class Coordinate>
Vertices vertices_of(Random& random, unsigned most, Coordinate coordinate) {
  Vertices vertices;
  const unsigned count = 1 + random.below(most);
  for (unsigned i = 0; i != count; ++i) vertices.points.push_back({coordinate(), coordinate(), coordinate()});
  if (random.one_in(3)) {
    const unsigned directions = 1 + random.below(3);
    while (vertices.directions.size() != directions) {
      const Vec3 direction = {coordinate(), coordinate(), coordinate()};
      if (direction != Vec3{0, 0, 0}) vertices.directions.push_back(direction);
    }
  }
  return vertices;
}

/// A box that is put next to the hull: a corner, or a point of an edge or a face between two of the points.
Box near_box(Random& random, const Vertices& vertices, float size) {
  const Vec3& p = vertices.points[random.below(static_cast<unsigned>(vertices.points.size()))];
  const Vec3& q = vertices.points[random.below(static_cast<unsigned>(vertices.points.size()))];
  const float share = random.uniform(0, 1);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float x = random.one_in(3) ? p[k] : random.nudge(p[k] + share * (q[k] - p[k]));
    const float far = x + (random.one_in(2) ? 1.0F : -1.0F) * (random.one_in(4) ? 0 : random.uniform(0, size));
    box.lo[k] = std::min(x, far);
    box.hi[k] = std::max(x, far);
  }
  return box;
}

TEST(Hull, BoxesAnywhereAreAnsweredExactly) {
  Random random(1);
  for (std::uint64_t i = 0; i != random_cases(120); ++i) {
    const Vertices vertices = vertices_of(random, 9, [&] { return random.uniform(-10, 10); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 90 + i % 7; ++b) boxes.push_back(random.box(-15, 15, 0, 4));
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, BoxesThatTouchAreAnsweredExactly) {
  Random random(2);
  for (std::uint64_t i = 0; i != random_cases(200); ++i) {
    const float at = random.one_in(3) ? 1e5F : 0;
    const Vertices vertices = vertices_of(random, 8, [&] { return random.uniform(-3, 3) + at; });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 70; ++b) boxes.push_back(near_box(random, vertices, 2));
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OnAGridWherePointsAreFlatStraightAndRepeated) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(400); ++i) {
    const int side = 1 + static_cast<int>(random.below(3));
    const Vertices vertices = vertices_of(random, 8, [&] { return random.integer(-side, side); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 70; ++b) boxes.push_back(random.grid_box(-side - 2, side + 2));
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, OfAnyMagnitude) {
  Random random(4);
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const int high = static_cast<int>(random.integer(-140, 127));
    const int low = std::max(-149, high - static_cast<int>(random.below(40)));
    const Vertices vertices = vertices_of(random, 7, [&] { return random.wild(low, high); });
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 66; ++b) {
      const auto corner = [&] { return Vec3{random.wild(low, high), random.wild(low, high), random.wild(low, high)}; };
      boxes.push_back(Random::sorted(corner(), corner()));
    }
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, UnboundedAndEmptyBoxes) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Random random(5);
  for (std::uint64_t i = 0; i != random_cases(100); ++i) {
    const Vertices vertices = vertices_of(random, 6, [&] { return random.integer(-3, 3); });
    std::vector<Box> boxes = {{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    for (unsigned b = 0; b != 70; ++b) {
      Box box = random.grid_box(-5, 5);
      for (std::size_t k = 0; k != 3; ++k) {
        if (random.one_in(3)) box.lo[k] = -infinity;
        if (random.one_in(3)) box.hi[k] = infinity;
      }
      boxes.push_back(box);
    }
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(Hull, AsManyVerticesAsThereMayBe) {
  Random random(6);
  for (const std::size_t directions : {std::size_t{0}, std::size_t{5}}) {
    Vertices vertices;
    while (vertices.points.size() + directions != ConvexHull::max_vertices) {
      Vec3 p = random.vec3(-1, 1);  // on a sphere, so that all are corners
      const float length = std::hypot(p[0], p[1], p[2]);
      for (float& x : p) x *= 4 / length;
      vertices.points.push_back(p);
    }
    while (vertices.directions.size() != directions) vertices.directions.push_back(random.vec3(0.5F, 1));
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 40; ++b) boxes.push_back(near_box(random, vertices, 1));
    for (unsigned b = 0; b != 40; ++b) boxes.push_back(random.box(-5, 5, 0, 1));
    expect_exact(vertices, boxes);
  }
}

TEST(Hull, SpheresAreOutsideOnlyBeyondAPlane) {
  Random random(7);
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const bool on_grid = random.one_in(3);
    const Vertices vertices =
        vertices_of(random, 8, [&] { return on_grid ? random.integer(-3, 3) : random.uniform(-5, 5); });
    std::vector<Sphere> spheres;
    for (unsigned s = 0; s != 70; ++s) {
      const Vec3 centre =
          on_grid ? Vec3{random.integer(-6, 6), random.integer(-6, 6), random.integer(-6, 6)} : random.vec3(-8, 8);
      spheres.push_back({centre, on_grid ? random.integer(0, 4) : random.uniform(0, 4)});
    }
    expect_sound(vertices, spheres);
    if (HasFatalFailure()) return;
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
        EXPECT_EQ(cull(view, Box{at, at}), most < 0) << most;
      }
    }
    const Vertices vertices{{view.points().begin(), view.points().end()},
                            {view.directions().begin(), view.directions().end()}};
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 100; ++b) boxes.push_back(random.box(-70, 70, 0, 12));
    expect_exact(vertices, boxes);
    if (HasFatalFailure()) return;
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
      Vertices vertices{corners, {}};
      vertices.points.push_back(light);
      std::vector<Box> boxes;
      for (unsigned b = 0; b != 65; ++b) {
        const float at = 2 + static_cast<float>(b) / 8;
        boxes.push_back({{at / 2, -1, at}, {at / 2 + 1, 7, at + 0.25F}});
        boxes.push_back({{std::nextafter(at / 2, 10.0F), -1, at}, {at / 2 + 1, 7, at}});
      }
      boxes.push_back({light, light});
      expect_exact(vertices, boxes);
      if (HasFatalFailure()) return;
      EXPECT_TRUE(cull(hull, Box{light, light}));
    }
  }
}

TEST(Hull, OfCastersTowardsASunHasNoEnd) {
  on_each_instruction_set([] {
    const std::vector<Vec3> corners = {{-1, -1, 2}, {1, -1, 2}, {-1, 1, 2}, {1, 1, 2},
                                       {-4, -4, 8}, {4, -4, 8}, {-4, 4, 8}, {4, 4, 8}};
    const ConvexHull hull = casters_towards(ConvexHull(corners), {0, 1, 0});
    EXPECT_TRUE(cull(hull, Box{{0, 1e20F, 5}, {1, 1e21F, 6}}));
    EXPECT_FALSE(cull(hull, Box{{0, -1e20F, 5}, {1, -10, 6}}));
    EXPECT_EQ(classify(hull, Box{{0, 1e20F, 5}, {1, 1e21F, 6}}), Answer::inside);
    EXPECT_EQ(hull.box().hi[1], std::numeric_limits<float>::infinity());
  });
}

/// Among shafts, in trees and in lists of candidates a hull answers what it answers alone.
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
    const Vertices vertices = vertices_of(random, 8, [&] { return random.uniform(-25, 25); });
    hulls.emplace_back(vertices.points, vertices.directions);
  }
  for (const ConvexHull& hull : hulls) {
    shafts.push_back(hull);
    shafts.push_back(compile(random.box(-30, 30, 0, 2), random.box(-30, 30, 0, 2)));
  }
  const auto expect_same = [&](const auto& stream, const auto& tree) {
    const std::size_t words = words_for(stream.size());
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
