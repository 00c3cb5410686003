// SPDX-License-Identifier: MIT
/// A workload whose answers are on record: every compiler, optimisation level, instruction set and form must give them.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/grid_answers.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/kinds.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {
namespace {

/// What all answers below hash to. Exact answers do not change: if this does, an answer was or is wrong.
constexpr std::uint64_t recorded = 2012080876133702002U;
/// Likewise of shafts of moving boxes.
constexpr std::uint64_t recorded_of_moving = 9822450572968547462U;
constexpr std::uint64_t recorded_blocking = 12822112723749227314U;
/// Likewise with open contact.
constexpr std::uint64_t recorded_of_open = 15062841140550317724U;
constexpr std::uint64_t recorded_of_open_moving = 15332369385780691612U;
/// Of convex hulls.
constexpr std::uint64_t recorded_of_hulls = 6081225321835810116U;
/// Of triangles, by vertices and exactly.
constexpr std::uint64_t recorded_triangles[2] = {11495070151279336606U, 3417442053769072641U};

constexpr std::size_t shafts = 600;
constexpr std::size_t bounds = 131;  // two words and a rest

/// Numbers that do not depend on the compiler: integers, and floats made of them without rounding or in one rounding.
class Numbers {
 public:
  /// SplitMix64 (Steele, Lea and Flood, 2014).
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  int below(int limit) { return static_cast<int>(next() >> 33U) % limit; }
  float grid() { return static_cast<float>(below(9) - 4); }
  float fine() { return static_cast<float>(below(1 << 23) - (1 << 22)) * 0x1p-20F; }
  /// A finite float of any bits.
  float any() {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(next()));
    return std::isfinite(x) ? x : 0.0F;
  }
  /// x, or a float up to two ulps from it.
  float near(float x) {
    const int steps = below(5) - 2;
    for (int i = 0; i != std::abs(steps); ++i) {
      const float next = std::nextafter(x, steps < 0 ? -INFINITY : INFINITY);
      if (std::isfinite(next)) x = next;
    }
    return x;
  }

 private:
  std::uint64_t state_ = 2026;
};

using Number = float (Numbers::*)();

Box sorted(Vec3 p, Vec3 q) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (p[k] > q[k]) std::swap(p[k], q[k]);
  }
  return {p, q};
}

Vec3 point(Numbers& numbers, Number number) {
  Vec3 p{};
  for (float& x : p) x = (numbers.*number)();
  return p;
}

Box box(Numbers& numbers, Number number) {
  const Vec3 p = point(numbers, number);
  return sorted(p, point(numbers, number));
}

/// A point on the path of a corner from a to b, or an ulp or two beside it.
Vec3 edge_point(Numbers& numbers, const Box& a, const Box& b) {
  const double t = numbers.below(17) / 16.0;
  Vec3 p{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = numbers.below(2) == 1;
    const double from = static_cast<double>(hi ? a.hi[k] : a.lo[k]);
    const double to = static_cast<double>(hi ? b.hi[k] : b.lo[k]);
    // Exact in doubles for coordinates from fine() and grid(), so rounded once, with or without fused operations.
    const double on_edge = from + t * (to - from);
    p[k] = numbers.near(static_cast<float>(on_edge));
  }
  return p;
}

/// Answers of one instruction set and form for all shafts, as one number (FNV-1a, word by word).
class Digest {
 public:
  void add(const std::vector<std::uint64_t>& words) {
    for (const std::uint64_t word : words) value_ = (value_ ^ word) * 0x100000001b3U;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// How answers are asked for: alone in either form, or among many; or what blocks.
enum class Way { slab, planes, grid, blocking };

template <class View>
void add_answers(const CompiledShaft& shaft, const View& view, Way way, Digest& digest) {
  if (way == Way::grid) {
    const GridAnswers on_grid = grid_answers(shaft, view, 3);
    digest.add(on_grid.kept);
    digest.add(on_grid.kept);
    digest.add(on_grid.inside);
    return;
  }
  const Form form = way == Way::slab ? Form::slab : Form::planes;
  std::vector<std::uint64_t> kept(words_for(view.count));
  std::vector<std::uint64_t> inside(kept.size());
  cull(shaft, view, kept, form);
  digest.add(kept);
  classify(shaft, view, kept, inside, form);
  digest.add(kept);
  digest.add(inside);
}

void add_blocking(const CompiledShaft& shaft, const BoxView& view, Digest& digest) {
  std::vector<std::uint64_t> listed(view.count);
  listed.resize(list_blocking(shaft, view, listed));
  listed.push_back(view.count);
  digest.add(listed);
}

/// A box around the moving box half-way from a to b, or an ulp or two beside it; now and then one face is far away.
Box around_middle(Numbers& numbers, const Box& a, const Box& b) {
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    // Exact in doubles for coordinates from fine() and grid(), so rounded once; halves of floats do not overflow.
    const auto middle = [&](float from, float to) {
      return numbers.near(static_cast<float>(0.5 * static_cast<double>(from) + 0.5 * static_cast<double>(to)));
    };
    box.lo[k] = numbers.below(4) == 0 ? -3e38F : middle(a.lo[k], b.lo[k]);
    box.hi[k] = numbers.below(4) == 0 ? 3e38F : middle(a.hi[k], b.hi[k]);
  }
  return sorted(box.lo, box.hi);
}

std::uint64_t answers(Way way, Contact contact = Contact::closed) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != shafts; ++s) {
    const bool is_wild = s % 4 == 3;
    const Number number = is_wild ? &Numbers::any : s % 4 == 0 ? &Numbers::grid : &Numbers::fine;
    const Box a = box(numbers, number);
    Box b = box(numbers, number);
    if (s % 4 == 2) {  // faces that nearly coincide
      const auto axis = static_cast<std::size_t>(numbers.below(3));
      b.lo[axis] = numbers.near(a.lo[axis]);
      b.hi[axis] = numbers.near(a.hi[axis]);
      b = sorted(b.lo, b.hi);
    }
    Shaft shaft(a, b);
    for (int planes = s % 8 < 4 ? 0 : 1 + numbers.below(2); planes != 0; --planes) {
      const Vec3 normal = point(numbers, number);
      if (normal != Vec3{}) shaft.add_plane({normal, (numbers.*number)()});
    }

    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != bounds; ++i) {
      const bool touches = !is_wild && numbers.below(2) == 0;
      const Vec3 p = touches ? edge_point(numbers, a, b) : point(numbers, number);
      boxes.push_back(numbers.below(4) == 0 ? Box{p, p} : sorted(p, point(numbers, number)));
      spheres.push_back({p, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
    }
    boxes[s % bounds].hi[s % 3] = nan;
    spheres[s % bounds].centre[s % 3] = nan;

    CompiledShaft compiled = compile(shaft);
    set_contact(compiled, contact);
    if (way == Way::blocking) {
      for (Box& box : boxes) {
        if (numbers.below(2) == 0) box = around_middle(numbers, a, b);
      }
      add_blocking(compiled, BoxColumns(boxes).view(), digest);
      continue;
    }
    add_answers(compiled, BoxColumns(boxes).view(), way, digest);
    add_answers(compiled, SphereColumns(spheres).view(), way, digest);
  }
  return digest.value();
}

/// The shaft of a moving box, or that between both boxes where light and occluder are not apart.
CompiledShaft moving_shaft(int kind, const Box& a, const Box& b, const Vec3& way) {
  bool apart = false;
  for (std::size_t k = 0; k != 3; ++k) apart = apart || a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k];
  if (kind >= 2 && !apart) return compile(a, b);
  return kind == 0                    ? swept(a, way)
         : kind == 1 && way != Vec3{} ? swept_without_end(a, way)
         : kind == 2                  ? shadow(b, a, 1.75F)
         : kind == 3                  ? shadow(b, a)
                                      : compile(a, b);
}

std::uint64_t moving_answers(Way way, Contact contact = Contact::closed) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != shafts; ++s) {
    const bool is_wild = s % 5 == 4;
    const Number number = is_wild ? &Numbers::any : s % 2 == 0 ? &Numbers::grid : &Numbers::fine;
    const Box a = box(numbers, number);
    const Box b = box(numbers, number);
    const int kind = numbers.below(4);
    CompiledShaft shaft = moving_shaft(kind, a, b, point(numbers, number));
    set_contact(shaft, contact);
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != bounds; ++i) {
      const bool touches = !is_wild && numbers.below(2) == 0;
      const Vec3 p = touches ? edge_point(numbers, shaft.a(), shaft.b()) : point(numbers, number);
      boxes.push_back(numbers.below(4) == 0 ? Box{p, p} : sorted(p, point(numbers, number)));
      spheres.push_back({p, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
    }
    add_answers(shaft, BoxColumns(boxes).view(), way, digest);
    add_answers(shaft, SphereColumns(spheres).view(), way, digest);
  }
  return digest.value();
}

/// Hulls of one to eight points and up to two directions, in one plane or on one line now and then; boxes and spheres
/// of which many touch a point, or a line or a plane through some of them.
std::uint64_t hull_answers(Way way) {
  constexpr std::size_t hulls = 200;
  Numbers numbers;
  Digest digest;
  for (std::size_t h = 0; h != hulls; ++h) {
    const bool is_wild = h % 5 == 4;
    const Number number = is_wild ? &Numbers::any : h % 2 == 0 ? &Numbers::grid : &Numbers::fine;
    std::vector<Vec3> points;
    for (int left = 1 + numbers.below(8); left != 0; --left) points.push_back(point(numbers, number));
    if (numbers.below(6) == 0) {
      for (Vec3& p : points) p[h % 3] = points[0][h % 3];
    }
    std::vector<Vec3> directions;
    for (int left = numbers.below(6) - 3; left > 0; --left) {
      const Vec3 direction = point(numbers, number);
      if (direction != Vec3{}) directions.push_back(direction);
    }
    const ConvexHull hull(points, directions);
    const auto any_point = [&] {
      return points[static_cast<std::size_t>(numbers.below(static_cast<int>(points.size())))];
    };
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != bounds; ++i) {
      const bool touches = !is_wild && numbers.below(2) == 0;
      const Vec3 p = any_point();
      const Vec3 on = touches ? edge_point(numbers, {p, p}, {any_point(), p}) : point(numbers, number);
      boxes.push_back(numbers.below(4) == 0 ? Box{on, on} : sorted(on, point(numbers, number)));
      spheres.push_back({on, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
    }
    add_answers(hull, BoxColumns(boxes).view(), way, digest);
    add_answers(hull, SphereColumns(spheres).view(), way, digest);
  }
  return digest.value();
}

std::uint64_t triangle_answers(TriangleTest test) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != shafts; ++s) {
    const bool is_wild = s % 5 == 4;
    const Number number = is_wild ? &Numbers::any : s % 2 == 0 ? &Numbers::grid : &Numbers::fine;
    const Box a = box(numbers, number);
    const Box b = box(numbers, number);
    const Vec3 movement = point(numbers, number);  // first: compilers may draw arguments in any order
    CompiledShaft shaft = moving_shaft(numbers.below(4), a, b, movement);
    if (s % 3 == 0) {
      Shaft with_plane(a, b);
      with_plane.add_plane({{1, -2, 3}, numbers.grid()});
      shaft = compile(with_plane);
    }
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i != bounds; ++i) {
      Triangle triangle{};
      for (Vec3& vertex : triangle.vertex) {
        const bool touches = !is_wild && numbers.below(3) == 0;
        vertex = touches ? edge_point(numbers, shaft.a(), shaft.b()) : point(numbers, number);
      }
      if (numbers.below(8) == 0) triangle.vertex[2] = triangle.vertex[numbers.below(2) == 0 ? 0 : 1];
      triangles.push_back(triangle);
    }
    triangles[s % bounds].vertex[s % 2][s % 3] = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::uint64_t> kept(words_for(bounds));
    cull(shaft, TriangleColumns(triangles).view(), kept, test);
    digest.add(kept);
  }
  return digest.value();
}

TEST(SameBits, EveryBuildAndInstructionSetGivesTheAnswersOnRecordOfTriangles) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(triangle_answers(TriangleTest::vertices), recorded_triangles[0]) << name(isa) << ", by vertices";
    EXPECT_EQ(triangle_answers(TriangleTest::exact), recorded_triangles[1]) << name(isa) << ", exactly";
  }
}

TEST(SameBits, EveryBuildGivesTheAnswersOnRecordOfShaftsOfMovingBoxes) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(moving_answers(Way::slab), recorded_of_moving) << name(isa) << ", slab form";
    EXPECT_EQ(moving_answers(Way::planes), recorded_of_moving) << name(isa) << ", plane form";
    EXPECT_EQ(moving_answers(Way::grid), recorded_of_moving) << name(isa) << ", on a grid";
  }
}

TEST(SameBits, EveryBuildGivesTheAnswersOnRecordOfConvexHulls) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(hull_answers(Way::slab), recorded_of_hulls) << name(isa) << ", slab form";
    EXPECT_EQ(hull_answers(Way::planes), recorded_of_hulls) << name(isa) << ", plane form";
    EXPECT_EQ(hull_answers(Way::grid), recorded_of_hulls) << name(isa) << ", among many";
  }
}

TEST(SameBits, EveryBuildGivesTheAnswersOnRecordOfShaftsWithOpenContact) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Way way : {Way::slab, Way::planes, Way::grid}) {
      const char* const text = way == Way::slab ? ", slab form" : way == Way::planes ? ", plane form" : ", on a grid";
      EXPECT_EQ(answers(way, Contact::open), recorded_of_open) << name(isa) << text;
      EXPECT_EQ(moving_answers(way, Contact::open), recorded_of_open_moving) << name(isa) << text << ", moving boxes";
    }
  }
}

TEST(SameBits, EveryBuildInstructionSetAndFormGivesTheAnswersOnRecord) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(answers(Way::slab), recorded) << name(isa) << ", slab form";
    EXPECT_EQ(answers(Way::planes), recorded) << name(isa) << ", plane form";
    EXPECT_EQ(answers(Way::grid), recorded) << name(isa) << ", on a grid";
    EXPECT_EQ(answers(Way::blocking), recorded_blocking) << name(isa) << ", what blocks";
  }
}

}  // namespace
}  // namespace shaftcull
