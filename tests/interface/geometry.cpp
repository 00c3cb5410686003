// SPDX-License-Identifier: MIT
/// The helpers that make boxes and planes: exact, or off to the safe side and by as little as can be.
#include "shaftcull/geometry.hpp"
#include "caught.hpp"
#include "shaftcull/hull.hpp"

#include <gmock/gmock.h>

#include <cfenv>
#include <cfloat>
#include <cmath>
#include <vector>

#include "message_of.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

const Box empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

float next_up(float x) { return std::nextafter(x, infinity); }
float next_down(float x) { return std::nextafter(x, -infinity); }

TEST(BoxAround, IsTheSmallestBoxOfThePoints) {
  EXPECT_EQ(box_around(std::vector<Vec3>{{1, 5, -3}, {-2, 4, 0}, {0, 6, -infinity}}),
            (Box{{-2, 4, -infinity}, {1, 6, 0}}));
  EXPECT_EQ(box_around(std::vector<Vec3>{{1, 2, 3}}), (Box{{1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(box_around({}), empty);
}

TEST(BoxAround, NamesThePointWithANan) {
  const auto error = caught<BadBound>([] { (void)box_around(std::vector<Vec3>{{0, 0, 0}, {0, nan, 0}}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->index(), 1U);
  EXPECT_THAT(error->what(), HasSubstr("point 1: y is not a number"));
  const std::span<const Vec3> null(static_cast<const Vec3*>(nullptr), 2);
  EXPECT_THAT(message_of([&] { (void)box_around(null); }), HasSubstr("points is null"));
}

TEST(Joined, IsTheSmallestBoxAroundBoth) {
  const Box a{{0, 1, 2}, {3, 4, 5}};
  const Box b{{-1, 2, 1}, {2, 9, 5}};
  EXPECT_EQ(joined(a, b), (Box{{-1, 1, 1}, {3, 9, 5}}));
  EXPECT_EQ(joined(a, empty), a);
  EXPECT_EQ(joined(empty, a), a);
  EXPECT_EQ(joined(empty, empty), empty);
}

/// lo is the largest float that is not above x + y, and hi the smallest that is not below; sums of doubles are exact.
void expect_tight(float lo, float hi, double exact_lo, double exact_hi) {
  EXPECT_LE(lo, exact_lo);
  EXPECT_GT(next_up(lo), exact_lo);
  EXPECT_GE(hi, exact_hi);
  EXPECT_LT(next_down(hi), exact_hi);
}

#if defined(FE_UPWARD)
constexpr int rounding_modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD};
#else
constexpr int rounding_modes[] = {FE_TONEAREST};  // WebAssembly has no others
#endif

TEST(Translated, ContainsTheExactBoxAndIsTheSmallestThatDoes) {
  Random random(301);
  for (int i = 0; i != 2000; ++i) {
    const Box box = random.box(-1000, 1000, 0.001F, 10);
    const Vec3 by = random.vec3(-0.01F, 0.01F);
    for (const int rounding : rounding_modes) {
      std::fesetround(rounding);
      const Box moved = translated(box, by);
      std::fesetround(FE_TONEAREST);
      for (std::size_t k = 0; k != 3; ++k) {
        expect_tight(moved.lo[k], moved.hi[k], double{box.lo[k]} + by[k], double{box.hi[k]} + by[k]);
      }
    }
  }
}

TEST(Translated, RoundsOutwardsHoweverSmallTheRest) {
  const float tiny = FLT_TRUE_MIN;
  const Box moved = translated({{1, 1, -1}, {1, 1, -1}}, {tiny, -tiny, tiny});
  EXPECT_EQ(moved, (Box{{1, next_down(1), -1}, {next_up(1), 1, next_up(-1)}}));
}

TEST(Translated, StaysWithinFloats) {
  const Box moved = translated({{-FLT_MAX, 0, -infinity}, {FLT_MAX, 0, infinity}}, {FLT_MAX, 0, 5});
  EXPECT_EQ(moved, (Box{{0, 0, -infinity}, {infinity, 0, infinity}}));
  EXPECT_EQ(translated({{FLT_MAX, 0, 0}, {FLT_MAX, 0, 0}}, {FLT_MAX, 0, 0}).lo[0], FLT_MAX);
  EXPECT_EQ(translated(empty, {1, 2, 3}), empty);
}

TEST(Translated, RefusesAMoveThatIsNotFinite) {
  EXPECT_THAT(message_of([] {
                (void)translated({}, {0, infinity, 0});
              }),
              HasSubstr("translated: by.y = inf is not finite"));
  EXPECT_THAT(message_of([] { (void)translated({}, {0, 0, nan}); }), HasSubstr("by.z = nan"));
}

TEST(Inflated, MovesEveryFaceOutAndRoundsOutwards) {
  EXPECT_EQ(inflated({{0, 1, 2}, {3, 4, 5}}, 0.5F), (Box{{-0.5F, 0.5F, 1.5F}, {3.5F, 4.5F, 5.5F}}));
  const Box box{{-1, 1, 0}, {-1, 1, 0}};
  EXPECT_EQ(inflated(box, 0), box);
  EXPECT_EQ(inflated(box, 1e-30F), (Box{{next_down(-1), next_down(1), -1e-30F}, {next_up(-1), next_up(1), 1e-30F}}));
  EXPECT_EQ(inflated(empty, 7), empty);
  Random random(302);
  for (int i = 0; i != 2000; ++i) {
    const Box some = random.box(-1000, 1000, 0.001F, 10);
    const float by = random.uniform(0, 0.01F);
    const Box larger = inflated(some, by);
    for (std::size_t k = 0; k != 3; ++k) {
      expect_tight(larger.lo[k], larger.hi[k], double{some.lo[k]} - by, double{some.hi[k]} + by);
    }
  }
}

TEST(Inflated, RefusesADistanceThatIsNegativeOrNotFinite) {
  EXPECT_THAT(message_of([] { (void)inflated({}, -1); }), HasSubstr("inflated: by = -1 is negative"));
  EXPECT_THAT(message_of([] { (void)inflated({}, infinity); }), HasSubstr("by = inf is not finite"));
  EXPECT_THAT(message_of([] { (void)inflated({}, nan); }), HasSubstr("by = nan is not finite"));
}

/// Whether a point is in view, by the definition of clip space.
bool in_view(const float (&m)[16], ClipDepth depth, const Vec3& p) {
  double clip[4];
  for (std::size_t r = 0; r != 4; ++r) {
    clip[r] = m[4 * r + 3];
    for (std::size_t k = 0; k != 3; ++k) clip[r] += double{m[4 * r + k]} * p[k];
  }
  const double w = clip[3];
  const double least_depth = depth == ClipDepth::zero_to_one ? 0 : -w;
  return -w <= clip[0] && clip[0] <= w && -w <= clip[1] && clip[1] <= w && least_depth <= clip[2] && clip[2] <= w;
}

void expect_frustum(const float (&matrix)[16], ClipDepth depth, std::size_t count) {
  const ViewPlanes planes = view_planes(matrix, depth);
  EXPECT_EQ(planes.count, count);
  Random random(303);
  int seen = 0;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 p = {random.integer(-40, 40) / 4, random.integer(-40, 40) / 4, random.integer(-60, 10) / 4};
    bool inside = true;
    for (const Plane& plane : planes) {
      const double beyond = double{plane.normal[0]} * p[0] + double{plane.normal[1]} * p[1] +
                            double{plane.normal[2]} * p[2] - plane.offset;
      inside = inside && beyond <= 0;
    }
    EXPECT_EQ(inside, in_view(matrix, depth, p)) << p[0] << ", " << p[1] << ", " << p[2];
    seen += inside ? 1 : 0;
  }
  EXPECT_GT(seen, 100);
}

// Cameras that look down −z; coefficients of few bits, so that all of the above is exact.
constexpr float perspective_gl[16] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.5F, -2.5F, 0, 0, -1, 0};
constexpr float perspective_d3d[16] = {1, 0, 0, 0.5F, 0, 2, 0, 0, 0, 0, -1.25F, -1.25F, 0, 0, -1, 0};
constexpr float infinite_d3d[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -0.5F, 0, 0, -1, 0};
constexpr float infinite_reversed[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0.5F, 0, 0, -1, 0};
constexpr float parallel[16] = {0.25F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, -0.125F, 0, 0, 0, 0, 1};

TEST(ViewPlanes, BoundWhatIsInView) {
  expect_frustum(perspective_gl, ClipDepth::minus_one_to_one, 6);
  expect_frustum(perspective_d3d, ClipDepth::zero_to_one, 6);
  expect_frustum(parallel, ClipDepth::zero_to_one, 6);
}

TEST(ViewPlanes, LeaveOutWhatCutsNothingOff) {
  expect_frustum(infinite_d3d, ClipDepth::zero_to_one, 5);
  expect_frustum(infinite_reversed, ClipDepth::zero_to_one, 5);
}

TEST(ViewPlanes, FitAShaft) {
  const Box world{{-50, -50, -50}, {50, 50, 50}};
  const CompiledShaft shaft = compile(world, world, view_planes(perspective_gl, ClipDepth::minus_one_to_one));
  EXPECT_TRUE(keeps(shaft, Box{{-0.5F, -0.5F, -4}, {0.5F, 0.5F, -3}}));
  EXPECT_FALSE(keeps(shaft, Box{{-0.5F, -0.5F, 3}, {0.5F, 0.5F, 4}})) << "behind the camera";
  EXPECT_FALSE(keeps(shaft, Box{{8, -0.5F, -4}, {9, 0.5F, -3}})) << "to the right of what is in view";
}

TEST(ViewPlanes, RefuseMatricesStoredColumnByColumn) {
  // The camera is at (2, −1, 7), and looks down −z.
  constexpr float placed[16] = {1, 0, 0, -2, 0, 2, 0, 2, 0, 0, -1.5F, 8, 0, 0, -1, 7};
  constexpr float moved_box[16] = {0.25F, 0, 0, 3, 0, 0.5F, 0, 1, 0, 0, -0.125F, 2, 0, 0, 0, 1};
  for (const auto& matrix : {std::to_array(perspective_gl), std::to_array(infinite_reversed), std::to_array(placed),
                             std::to_array(moved_box)}) {
    EXPECT_NO_THROW((void)view_planes(matrix, ClipDepth::minus_one_to_one));
    std::array<float, 16> columns;
    for (std::size_t i = 0; i != 16; ++i) columns[i] = matrix[i % 4 * 4 + i / 4];
    EXPECT_THAT(message_of([&] { (void)view_planes(columns, ClipDepth::minus_one_to_one); }),
                HasSubstr("view_planes: the matrix seems to be stored column by column"));
    EXPECT_THAT(message_of([&] { (void)frustum(columns, ClipDepth::minus_one_to_one); }),
                HasSubstr("frustum: the matrix seems to be stored column by column"));
    // Multiples of a matrix show the same.
    std::array<float, 16> multiple = matrix;
    for (float& coefficient : multiple) coefficient *= 3;
    EXPECT_NO_THROW((void)view_planes(multiple, ClipDepth::minus_one_to_one));
  }
}

TEST(ViewPlanes, RefuseWhatIsNoMatrixOfAView) {
  float matrix[16] = {};
  std::copy(std::begin(parallel), std::end(parallel), matrix);
  matrix[6] = nan;
  EXPECT_THAT(message_of([&] { (void)view_planes(matrix, ClipDepth::zero_to_one); }),
              HasSubstr("view_planes: matrix[6] = nan is not finite"));
  matrix[6] = 0;
  EXPECT_THAT(message_of([&] { (void)view_planes(matrix, static_cast<ClipDepth>(2)); }), HasSubstr("depth = 2"));
  matrix[0] = FLT_MAX;
  matrix[3] = 2;
  matrix[12] = FLT_MAX;
  EXPECT_THAT(message_of([&] { (void)view_planes(matrix, ClipDepth::zero_to_one); }),
              HasSubstr("the left plane is beyond the largest float"));
  const float nothing[16] = {0, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_THAT(message_of([&] { (void)view_planes(nothing, ClipDepth::zero_to_one); }),
              HasSubstr("the right plane leaves nothing in view"));
}

}  // namespace
}  // namespace shaftcull
