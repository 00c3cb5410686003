// SPDX-License-Identifier: MIT
/// First contact of spheres where it is hard to tell: times that are equal though they come from different polynomials,
/// that are equal but for less than a rounding of a double, or where spheres are grazed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "columns.hpp"
#include "exact/wide_integer.hpp"
#include "instruction_sets.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

std::vector<float> times_of(const CompiledShaft& shaft, const std::vector<Sphere>& spheres) {
  std::vector<std::uint32_t> all(spheres.size());
  for (std::size_t i = 0; i != all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
  std::vector<float> times(spheres.size());
  entry_times(shaft, SphereColumns(spheres).view(), std::span<const std::uint32_t>(all), times);
  return times;
}

/// All spheres are reached at one time, so whichever has index 0 is first: each of them in turn.
void expect_ties(const CompiledShaft& shaft, std::vector<Sphere> spheres, float time) {
  on_each_instruction_set([&] {
    for (std::size_t turn = 0; turn != spheres.size(); ++turn) {
      const FirstContact found = first_contact(shaft, SphereColumns(spheres).view());
      EXPECT_EQ(found.index, 0U) << source_text(spheres[0]);
      EXPECT_EQ(found.time, time) << source_text(spheres[0]);
      EXPECT_EQ(first_contact(shaft, BoundsTree<Sphere>{std::span<const Sphere>(spheres)}), found)
          << source_text(spheres[0]);
      EXPECT_EQ(times_of(shaft, spheres), std::vector<float>(spheres.size(), time));
      std::rotate(spheres.begin(), spheres.begin() + 1, spheres.end());
    }
  });
}

/// Its face at x = 0 is at 16 t, and it is in [0, 1] on the other axes.
CompiledShaft cube_along_x() { return swept(Box{{-1, 0, 0}, {0, 1, 1}}, {16, 0, 0}); }
/// Its faces at x = 0 and y = 0 are at 16 t.
CompiledShaft cube_along_diagonal() { return swept(Box{{-1, -1, 0}, {0, 0, 1}}, {16, 16, 0}); }
/// It is in [0, 1] on z.
CompiledShaft slab_along_diagonal() { return swept(Box{{-8, -8, 0}, {0, 0, 1}}, {16, 16, 0}); }

TEST(SphereContact, TiesAtRationalTimesAreSeen) {
  expect_ties(cube_along_x(),
              {{{8, 0.5F, 0.5F}, 4},
               {{7, 0.5F, 1}, 3},
               {{8, 4, 0.5F}, 5},  // 4² + 3² = 5²
               {{8, -3, 0.5F}, 5},
               {{8, 0.5F, 4}, 5},
               {{9, 13, 0.25F}, 13},
               {{12, 16, 0}, 17},
               {{6, 3, 2}, 3},     // 2² + 2² + 1² = 3²
               {{10, -2, 4}, 7}},  // 6² + 2² + 3² = 7²
              0.25F);
}

TEST(SphereContact, TiesAtIrrationalTimesAreSeen) {
  // 16 t = 4 − √8.
  const float time = oracle::rounded_down(oracle::RootTime{mpq_class(1, 4), mpq_class(1, 32)});
  expect_ties(slab_along_diagonal(),
              {{{4, 4, 0.5F}, 4},  // 2 · 8 = 4²
               {{4, 4, 4}, 5},
               {{4, 4, -3}, 5},
               {{4, -1, 2}, 3},  // 8 + 1² = 3²
               {{-1, 4, 2}, 3},
               {{-1, 4, -1}, 3},
               {{4, -1, 4.5F}, 4.5F},  // 8 + 3.5² = 4.5²
               {{-1, 4, 8.75F}, 8.25F}},
              time);
}

TEST(SphereContact, TiesWhereAGapBeginsOrEndsAreSeen) {
  expect_ties(cube_along_diagonal(),
              {{{4, 7, 0.5F}, 3},  // the gap on x is 0 from then on
               {{7, 4, 0.5F}, 3},
               {{8, 3, 0.5F}, 4},  // there is one on y from then on
               {{3, 8, 0.5F}, 4},
               {{8, 3.5F, 0.5F}, 4},
               {{11, -1, 5}, 9},  // and here from the start on
               {{-1, 11, 5}, 9},
               {{7, 8, 0.5F}, 5},
               {{4, 8, 4}, 5}},
              0.25F);
}

TEST(SphereContact, TiesOfSpheresThatAreGrazedAreSeen) {
  // A point goes by at the distance of the radius: it is nearest at (8, 6, 0).
  expect_ties(swept(Box{{0, 0, 0}, {0, 0, 0}}, {16, 12, 0}),
              {{{5, 10, 0}, 5},
               {{11, 2, 0}, 5},
               {{2, 14, 0}, 10},
               {{8, 6, 3}, 3},
               {{8, 6, -7}, 7},
               {{8, 6, 0}, 0},
               {{5, 10, 12}, 13},
               {{8, 6, 0x1p-149F}, 0x1p-149F}},
              0.5F);
}

TEST(SphereContact, AtTheStartIsSeen) {
  expect_ties(cube_along_x(),
              {{{3, 0.5F, 0.5F}, 3},
               {{3, 5, 0.5F}, 5},
               {{3, 5, 13}, 13},
               {{-0.5F, 0.5F, 0.5F}, 0},
               {{-4, 0.5F, 0.5F}, 3},
               {{30, 0.5F, 0.5F}, infinity}},
              0);
}

TEST(SphereContact, FollowsWhatSpecialValuesMean) {
  on_each_instruction_set([] {
    const std::vector<Sphere> spheres = {{{8, nan, 0.5F}, 4},      {{8, 0.5F, 0.5F}, -4},  {{infinity, 0.5F, 0.5F}, 4},
                                         {{30, 30, 30}, infinity}, {{8, 0.5F, 0.5F}, nan}, {{nan, nan, nan}, 1},
                                         {{nan, 3, nan}, 1}};
    EXPECT_EQ(times_of(cube_along_x(), spheres), (std::vector<float>{0.25F, infinity, infinity, 0, 0, 0, infinity}));
    EXPECT_EQ(first_contact(cube_along_x(), SphereColumns(spheres).view()), (FirstContact{3, 0}));
  });
}

TEST(SphereContact, TimesHaveNoEndAsSweepsHaveNone) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = swept_infinite({{0, 0, 0}, {1, 1, 1}}, {0x1p-100F, 0, 0});
    const std::vector<Sphere> spheres = {{{0x1p100F, 0, 0}, 3}, {{0x1p99F, 2, 0}, 1}, {{2, 1.5F, 1}, 0.5F}};
    const std::vector<float> times = times_of(shaft, spheres);
    constexpr float most = std::numeric_limits<float>::max();
    EXPECT_EQ(times, (std::vector<float>{most, most, 0x1p100F}));
    EXPECT_EQ(first_contact(shaft, SphereColumns(spheres).view()), (FirstContact{2, 0x1p100F, {0, -1, 0}}));
  });
}

/// Where a face is at the times 0 and 1.
struct Travel {
  double from;
  double to;
};

/// When the face reaches a sphere whose centre is so far beside what it meets of the sphere, in 256 bits.
mpf_class time_beside(const Travel& x, double centre, double radius, double beside) {
  const mpf_class square(radius * radius - beside * beside, 256);
  const mpf_class reach = sqrt(square);
  return (mpf_class(centre, 256) - reach - x.from) / (mpf_class(x.to, 256) - x.from);
}

TEST(SphereContact, TellsTimesApartThatDoublesCannotTellApart) {
  // Sphere 0 is reached by the face on x and lies beside the box on z, so that its time is irrational. Sphere 1 is
  // reached by the face on y at a time that differs by about the rounding of a double.
  constexpr float far = 0x1p60F;
  Random random(805);
  std::size_t misled = 0;
  for (std::size_t i = 0; i != random_cases(60) && !testing::Test::HasFailure(); ++i) {
    const Travel x{-static_cast<double>(random.integer(1, 0xffffff)), 0x1p24 * random.integer(0x700000, 0x7fffff)};
    const double beside = 0x1p24 * random.integer(2, 400);
    const double radius = beside + 0x1p24 * random.integer(1, 600);
    const double centre = 0x1p24 * std::round(random.uniform(0.1F, 0.4F) * x.to * 0x1p-24);
    const mpf_class t = time_beside(x, centre, radius, beside);
    // (place + low) / (to + low) = t where low = (t to − place) / (1 − t).
    Travel nearest{};
    double place = 0;
    mpf_class least(1, 256);
    for (int tries = 0; tries != 400; ++tries) {
      const double to = 0x1p24 * random.integer(0x700000, 0x7fffff);
      const double at = 0x1p24 * std::round(t.get_d() * to * 0x1p-24);
      const auto low = static_cast<double>(static_cast<float>(mpf_class((t * to - at) / (1 - t)).get_d()));
      const mpf_class difference = abs(mpf_class(mpf_class(at + low, 256) / mpf_class(to + low, 256) - t));
      if (difference >= least) continue;
      least = difference;
      nearest = {-low, to};
      place = at;
    }
    const auto f = [](double value) { return static_cast<float>(value); };
    const ShaftInput input{{{-far, -far, 0}, {f(x.from), f(nearest.from), 1}},
                           {{-far, -far, 0}, {f(x.to), f(nearest.to), 1}}};
    const float radius_y = 0x1p24F * random.integer(1, 100);
    const std::vector<Sphere> spheres = {{{f(centre), -0x1p50F, f(-beside)}, f(radius)},
                                         {{-0x1p50F, f(place + radius_y), 0.5F}, radius_y}};
    const auto of_x = oracle::entry_time(input.a, input.b, spheres[0]);
    const auto of_y = oracle::entry_time(input.a, input.b, spheres[1]);
    ASSERT_TRUE(of_x && of_y);
    const std::uint32_t first = *of_x <= *of_y ? 0 : 1;
    on_each_instruction_set([&] {
      const CompiledShaft shaft = compile(input.a, input.b);
      const FirstContact expected{first, oracle::rounded_down(first == 0 ? *of_x : *of_y),
                                  oracle::contact_normal(input.a, input.b, spheres[first])};
      EXPECT_EQ(first_contact(shaft, SphereColumns(spheres).view()), expected) << source_text(input);
      const std::vector<Sphere> swapped(spheres.rbegin(), spheres.rend());
      EXPECT_EQ(first_contact(shaft, SphereColumns(swapped).view()).index, 1 - first) << source_text(input);
    });
    const double rounded_x = (centre - std::sqrt(radius * radius - beside * beside) - x.from) / (x.to - x.from);
    const double rounded_y = (place - nearest.from) / (nearest.to - nearest.from);
    if ((rounded_x <= rounded_y) != (first == 0)) ++misled;
  }
  EXPECT_GT(misled, 0U) << "the cases are too easy";
}

TEST(SphereContact, OfHugeSpheresIsExact) {
  // Their surfaces are nearly flat where they are reached, and doubles that know their squares know the times to some
  // seven digits only.
  Random random(807);
  for (std::size_t i = 0; i != random_cases(100) && !testing::Test::HasFailure(); ++i) {
    const float face = random.uniform(-0.3F, -0.05F);
    const MovingInput input{MovingInput::Kind::swept, {{-2, 0, 0}, {face, 1, 1}}, {1, 0, 0}};
    const float radius[2] = {random.uniform(0x1p28F, 0x1p29F), random.uniform(0x1p28F, 0x1p29F)};
    std::vector<Sphere> spheres;
    std::vector<float> expected;
    std::uint64_t first = 0;
    std::optional<oracle::RootTime> least;
    for (std::uint64_t n = 0; n != 24; ++n) {
      const float r = radius[random.below(2)];
      float beside = random.uniform(2, random.one_in(2) ? 3.0F : 0x1p14F);
      if (random.one_in(4)) beside = random.nudge(1);                                  // or not beside the box
      if (n > 0 && random.one_in(2)) beside = random.nudge(spheres.back().centre[1]);  // nearly the time of the last
      spheres.push_back({{r, beside, 0.5F}, r});
      const oracle::RootTime time = oracle::entry_time(input, spheres.back()).value();
      expected.push_back(oracle::rounded_down(time));
      if (!least || time < *least) least = time, first = n;
    }
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      const CompiledShaft shaft = swept(input.box, input.displacement);
      const std::vector<float> times = times_of(shaft, spheres);
      for (std::size_t n = 0; n != spheres.size(); ++n) {
        if (times[n] == expected[n]) continue;
        ADD_FAILURE() << "on " << name(isa) << ", form times; " << source_text(spheres[n]) << " is reached at "
                      << expected[n] << ", answered " << times[n] << "; " << source_text(input);
      }
      EXPECT_EQ(first_contact(shaft, SphereColumns(spheres).view()).index, first) << source_text(input);
    }
  }
}

TEST(WideInteger, HasTheSignsOfPolynomialsOfDegreeTen) {
  using kernel::WideInteger;
  Random random(806);
  for (std::size_t i = 0; i != random_cases(2000) && !testing::Test::HasFailure(); ++i) {
    const bool is_small = random.one_in(2);
    const auto next = [&] { return is_small ? random.integer(-9, 9) : random.wild(); };
    const float x[5] = {next(), next(), next(), next(), next()};
    const int scale = is_small ? 0 : 149;
    const auto w = [&](std::size_t k) { return WideInteger::scaled(x[k], scale); };
    const auto q = [&](std::size_t k) { return mpq_class(x[k]); };
    // ((x0 − x1) x2 + x3²)⁵ against a product of as many, both of them nearly as large.
    const auto value = [](const auto& a, const auto& b, const auto& c, const auto& d, const auto& e, auto zero) {
      using Number = decltype(zero);
      const Number u = (a - b) * c + d * d;
      const Number v = (a - b) * c + d * e;
      return Number(u * u * u * u * u - u * u * v * v * u);
    };
    const int sign = value(w(0), w(1), w(2), w(3), w(4), WideInteger()).sign();
    EXPECT_EQ(sign, sgn(value(q(0), q(1), q(2), q(3), q(4), mpq_class())));
    const WideInteger sum = w(0) + w(1);
    const WideInteger none = sum * sum - w(0) * w(0) - w(1) * w(1) - (w(0) + w(0)) * w(1);
    EXPECT_EQ(none.sign(), 0);
    EXPECT_EQ((none * sum).sign(), 0);
    EXPECT_EQ((w(0) - w(1)).sign(), x[0] < x[1] ? -1 : x[0] > x[1] ? 1 : 0);
  }
}

TEST(WideInteger, HoldsTheLargestPolynomialsOfEntryTimes) {
  using kernel::WideInteger;
  // Slopes and starts of 2¹²⁹, and sums of three products of them: 8,748 · 2²⁷⁸⁰ is what the proof allows for.
  constexpr float most = std::numeric_limits<float>::max();
  const WideInteger difference = WideInteger::scaled(most, 149) - WideInteger::scaled(-most, 149);
  WideInteger product = WideInteger::scaled(8748, 0);
  for (int degree = 0; degree != 10; ++degree) product = product * difference;
  EXPECT_EQ(product.sign(), 1);
  EXPECT_EQ((product - (product - WideInteger::scaled(1, 0))).sign(), 1);
  EXPECT_EQ((product - product).sign(), 0);
}

}  // namespace
}  // namespace shaftcull
