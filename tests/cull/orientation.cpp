// SPDX-License-Identifier: MIT
/// Signs of determinants, which all predicates about planes through given points rest on, against rational numbers.
#include "exact/orientation.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

using kernel::Step;

mpq_class exact(const Step& step) { return mpq_class(step.end) - mpq_class(step.start); }

int right_sign(const Step (&u)[3], const Step (&v)[3], const Step (&w)[3]) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    sum += (exact(u[i]) * exact(v[j]) - exact(u[j]) * exact(v[i])) * exact(w[k]);
  }
  return sgn(sum);
}

/// Differences of floats of one axis: of few bits, as many as whole numbers of 128 bits take, or more.
class Axis {
 public:
  explicit Axis(Random& random) : random_(random), exponent_(static_cast<int>(random.integer(-140, 60))) {
    constexpr int widths[] = {2, 12, 24, 40, 41, 42, 60};
    width_ = widths[random.below(7)];
  }

  Step step() {
    if (random_.one_in(8)) return {0, 0};
    // The first float is a multiple of a large power of two, and the second one of a small power.
    const double high = whole(std::min(width_, 24)) * std::ldexp(1.0, width_ - std::min(width_, 24));
    const double low = width_ > 24 && !random_.one_in(4) ? whole(std::min(width_ - 24, 24)) : 0;
    return {std::ldexp(high, exponent_), std::ldexp(low, exponent_)};
  }

 private:
  /// Odd or not, of so many bits; often the largest.
  double whole(int bits) {
    const double most = std::ldexp(1.0, bits) - 1;
    const double x = random_.one_in(3) ? most : std::floor(random_.uniform(0, 1) * most);
    return random_.one_in(2) ? x : -x;
  }

  Random& random_;
  int exponent_;
  int width_;
};

Step sum_of(const Step& a, const Step& b) { return {static_cast<float>(a.rounded() + b.rounded()), 0}; }

TEST(Orientation, IsThatOfRationalNumbers) {
  constexpr std::uint64_t seed = 811;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t behind = 0;
  std::size_t in_plane = 0;
  std::size_t in_front = 0;
  for (std::uint64_t i = 0; i != random_cases(30'000); ++i) {
    Step u[3];
    Step v[3];
    Step w[3];
    const std::uint32_t kind = random.below(4);
    for (std::size_t k = 0; k != 3; ++k) {
      Axis axis(random);
      u[k] = axis.step();
      v[k] = axis.step();
      // Any vector; one in the plane of both, and next to that where sums round; one of them, from the other side.
      w[k] = kind == 0 ? axis.step() : kind == 1 ? Step{u[k].start, u[k].end} : sum_of(u[k], v[k]);
    }
    if (kind == 3) {
      const std::size_t k = random.below(3);
      w[k].end = random.nudge(static_cast<float>(w[k].end));
    }
    constexpr double origin[3] = {0, 0, 0};
    const int right = right_sign(u, v, w);
    ++(right < 0 ? behind : right > 0 ? in_front : in_plane);
    ASSERT_EQ(kernel::SpannedPlane(origin, u, v).sign_along(w), right) << i;
    ASSERT_EQ(kernel::exact_sign(u, v, w), right) << i;
    const int right_in_plane = sgn(mpq_class(exact(u[0]) * exact(v[1]) - exact(u[1]) * exact(v[0])));
    ASSERT_EQ(kernel::determinant_sign(u[0], u[1], v[0], v[1]), right_in_plane) << i;
    ASSERT_EQ(kernel::exact_sign(u[0], u[1], v[0], v[1]), right_in_plane) << i;
  }
  for (const std::size_t count : {behind, in_plane, in_front}) EXPECT_GT(count, random_cases(3000));
}

// (m + k) (m − k) is less than m m, by less than doubles of that size show.
TEST(Orientation, OfProductsThatAreRoundedToTheSameIsThatOfRationalNumbers) {
  Random random(812);
  for (std::uint64_t i = 0; i != random_cases(3000); ++i) {
    const double m = std::ldexp(static_cast<double>(random.integer(1 << 22, (1 << 24) - 1)), 15);
    const auto k = static_cast<double>(random.integer(0, 9));
    const Step more{m, -k};
    const Step less{m, k};
    const Step middle{m, 0};
    const int right = k == 0 ? 0 : -1;
    ASSERT_EQ(kernel::determinant_sign(more, middle, middle, less), right) << m << ", " << k;
    ASSERT_EQ(kernel::determinant_sign(middle, less, more, middle), -right) << m << ", " << k;
  }
}

}  // namespace
}  // namespace shaftcull
