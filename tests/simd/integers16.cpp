// SPDX-License-Identifier: MIT
/// Every operation on vectors of 16-bit integers, on each set that has them, against a plain definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simd/sets.hpp"

namespace shaftcull::simd_test {
namespace {

struct alignas(64) Integers {
  std::int16_t of[64] = {};
};

class Integer16Operation : public testing::Test {
 protected:
  template <class Check>
  static void on_each_set(Check check) {
    for (const Isa isa : isas_under_test()) {
      SCOPED_TRACE(name(isa));
      const Integer16Table& table = table_of(isa).integers;
      if (table.width != 0) check(table);
    }
  }

  /// Compares an operation with expected(a, b) for special pairs and a million others.
  template <class Expected>
  static void expect_each(Integer16Table::Binary* const Integer16Table::*operation, Expected expected) {
    on_each_set([&](const Integer16Table& table) {
      constexpr std::int16_t special[] = {0, 1, -1, 2, 16383, -16383, 16384, -16384, 32766, 32767, -32767, -32768};
      Random random(10);
      for (unsigned round = 0; round != 20000; ++round) {
        Integers a;
        Integers b;
        const auto any = [&] {
          return random.one_in(3) ? special[random.below(12)] : static_cast<std::int16_t>(random.below(65536));
        };
        for (unsigned i = 0; i != table.width; ++i) {
          a.of[i] = any();
          b.of[i] = any();
          if (a.of[i] == -32768 && b.of[i] == -32768) a.of[i] = 5;  // not for multiply()
        }
        Integers out;
        (table.*operation)(a.of, b.of, out.of);
        for (unsigned i = 0; i != table.width; ++i) {
          ASSERT_EQ(out.of[i], expected(int{a.of[i]}, int{b.of[i]})) << a.of[i] << " and " << b.of[i];
        }
      }
    });
  }
};

TEST_F(Integer16Operation, AllFillsEveryLane) {
  on_each_set([](const Integer16Table& table) {
    for (const int x : {0, 1, -1, 32767, -32768}) {
      Integers out;
      table.all(static_cast<std::int16_t>(x), out.of);
      for (unsigned i = 0; i != table.width; ++i) ASSERT_EQ(out.of[i], x);
    }
  });
}

TEST_F(Integer16Operation, SumsAndDifferencesWrapAroundOrSaturate) {
  expect_each(&Integer16Table::add, [](int a, int b) { return static_cast<std::int16_t>(a + b); });
  expect_each(&Integer16Table::subtract, [](int a, int b) { return static_cast<std::int16_t>(a - b); });
  expect_each(&Integer16Table::subtract_saturated, [](int a, int b) { return std::clamp(a - b, -32768, 32767); });
}

TEST_F(Integer16Operation, MinimumAndMaximum) {
  expect_each(&Integer16Table::minimum, [](int a, int b) { return std::min(a, b); });
  expect_each(&Integer16Table::maximum, [](int a, int b) { return std::max(a, b); });
}

TEST_F(Integer16Operation, ProductsAreRoundedToNearestAndTiesUpwards) {
  expect_each(&Integer16Table::multiply,
              [](int a, int b) { return static_cast<int>(std::floor(a * static_cast<double>(b) / 32768 + 0.5)); });
}

TEST_F(Integer16Operation, FloatsAreRoundedAndReadInTheirOrder) {
  on_each_set([](const Integer16Table& table) {
    Random random(11);
    constexpr std::int16_t least = -16383;
    for (unsigned round = 0; round != 2000; ++round) {
      const auto limit = static_cast<std::uint8_t>(random.below(127));
      std::vector<float> word(64);
      std::vector<int> expected(64);
      for (unsigned i = 0; i != 64; ++i) {
        float& x = word[i];
        switch (random.below(8)) {
          case 0:
            x = random.integer(-16383, 32767);
            break;
          case 1:
            x = random.integer(-16383, 16383) + 0.5F;
            break;  // ties
          case 2:
            x = random.one_in(2) ? 0.0F : -0.0F;
            break;
          case 3:
            x = random.one_in(2) ? -infinity : -1e30F;
            break;
          case 4:
            x = random.one_in(2) ? not_a_number : -not_a_number;
            break;
          case 5:
            x = static_cast<float>(limit) + random.integer(-1, 1);
            break;
          default:
            x = random.uniform(-20000.0F, 32766.0F);
            break;
        }
        expected[i] = std::isnan(x) || x < least ? least : static_cast<int>(std::nearbyint(x));
      }
      Integers memory;
      const kernel::Outcomes outcomes = table.round_and_read(word.data(), least, limit, memory.of);
      std::uint64_t yes = 0;
      std::uint64_t undecided = 0;
      for (unsigned i = 0; i != 64; ++i) {
        yes |= std::uint64_t{expected[i] < 0} << i;
        undecided |= std::uint64_t{expected[i] >= 0 && expected[i] <= limit} << i;
      }
      ASSERT_EQ(outcomes.yes, yes);
      ASSERT_EQ(outcomes.undecided & undecided, undecided);
      std::vector<int> stored(memory.of, memory.of + 64);  // in an order of the set's own
      std::sort(stored.begin(), stored.end());
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(stored, expected);
    }
  });
}

TEST_F(Integer16Operation, OneUndecidedLaneIsNoticedAndNoneIsNot) {
  on_each_set([](const Integer16Table& table) {
    for (const int limit : {0, 1, 60, 126}) {
      for (unsigned lane = 0; lane <= 64; ++lane) {  // at 64, none
        for (const int inside : {0, limit}) {
          std::vector<float> word(64, static_cast<float>(limit + 1));
          for (unsigned i = 0; i < 64; i += 3) word[i] = i % 2 == 0 ? -1.0F : 32767.0F;
          if (lane != 64) word[lane] = static_cast<float>(inside);
          Integers memory;
          const kernel::Outcomes outcomes =
              table.round_and_read(word.data(), -16383, static_cast<std::uint8_t>(limit), memory.of);
          if (lane == 64) {
            ASSERT_EQ(outcomes.undecided, 0U);
          } else {
            ASSERT_NE(outcomes.undecided >> lane & 1U, 0U) << lane;
          }
        }
      }
    }
  });
}

}  // namespace
}  // namespace shaftcull::simd_test
