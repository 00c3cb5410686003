// SPDX-License-Identifier: MIT
/// Where the faces of a moving box end, in floats: against exact sums, at coordinates that are far apart, equal, on a
/// grid or denormal.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "exact/end_face.hpp"
#include "oracle/random.hpp"

namespace shaftcull::kernel {
namespace {

constexpr float most = std::numeric_limits<float>::max();

/// A body, where it goes, and when it stops: t ends at reach − 1.
struct Body {
  float start[8] = {};
  float minuend[8] = {};
  float subtrahend[8] = {};
  float reach = 2;

  [[nodiscard]] MovingFaces faces() const noexcept {
    MovingFaces moving(start, start);
    moving.minuend = minuend;
    moving.subtrahend = subtrahend;
    moving.end_minuend = reach;
    moving.end_subtrahend = 1;
    return moving;
  }
};

float some_float(Random& random) {
  switch (random.below(4)) {
    case 0:
      return random.integer(-32, 32);  // many sums are floats
    case 1:
      return random.uniform(-100, 100);
    case 2:
      return random.wild();
    default:
      return random.wild(-149, -120);
  }
}

/// Expects that `within` is the last float that is not further out than the end of face f.
void expect_last_within(const MovingFaces& faces, unsigned f, float within) {
  const Expansion<9> end = exact_end_face(faces, f);
  const auto is_within = [&](float x) {
    const int sign = difference_sign(end, x);
    return f < 3 ? sign <= 0 : sign >= 0;
  };
  const float outwards = std::nextafter(within, f < 3 ? -HUGE_VALF : HUGE_VALF);
  EXPECT_TRUE(is_within(within)) << within;
  EXPECT_TRUE(std::isinf(outwards) || !is_within(outwards)) << within;
}

/// Expects that `nearest` is a float next to the end.
void expect_near(const MovingFaces& faces, unsigned f, float nearest) {
  const Expansion<9> end = exact_end_face(faces, f);
  EXPECT_LE(std::fabs(nearest), most);
  const auto is_beyond = [&](float way) { return difference_sign(end, std::nextafter(nearest, way)); };
  EXPECT_TRUE(nearest == -most || is_beyond(-HUGE_VALF) > 0) << nearest;
  EXPECT_TRUE(nearest == most || is_beyond(HUGE_VALF) < 0) << nearest;
}

TEST(EndFaces, AreTheLastFloatsWithin) {
  Random random(3901);
  for (int i = 0; i != 20'000; ++i) {
    Body body;
    for (unsigned f = 0; f != 6; ++f) {
      body.start[f] = some_float(random);
      body.minuend[f] = some_float(random);
      body.subtrahend[f] = some_float(random);
    }
    body.reach = 1 + std::fabs(some_float(random));
    const MovingFaces faces = body.faces();
    const EndFaces ends(faces);
    for (unsigned f = 0; f != 6; ++f) {
      expect_near(faces, f, ends.nearest[f]);
      if (faces.is_blue(f)) expect_last_within(faces, f, ends.within[f]);
    }
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(EndFaces, BeyondTheLargestFloatAreTheLargestFloat) {
  Body body;
  for (unsigned f = 0; f != 6; ++f) body.start[f] = body.minuend[f] = f < 3 ? -most : most;
  const EndFaces ends(body.faces());
  for (unsigned f = 0; f != 6; ++f) {
    EXPECT_EQ(ends.nearest[f], body.start[f]);
    EXPECT_EQ(ends.within[f], body.start[f]);
  }
}

}  // namespace
}  // namespace shaftcull::kernel
