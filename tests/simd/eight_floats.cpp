// SPDX-License-Identifier: MIT
/// Every operation on eight floats of one thing, on each set, against a plain definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "guarded_floats.hpp"
#include "simd/sets.hpp"

namespace shaftcull::simd_test {
namespace {

using Eight = std::array<float, 8>;

class EightFloatOperation : public testing::Test {
 protected:
  template <class Check>
  static void on_each_set(Check check) {
    for (const Isa isa : isas_under_test()) {
      SCOPED_TRACE(name(isa));
      check(table_of(isa).eight);
    }
  }
  /// Compares lane i of each operation's result with expected(a, b, i).
  template <class Expected>
  static void expect_lanes(EightFloatTable::Binary* const EightFloatTable::*operation, Expected expected) {
    on_each_set([&](const EightFloatTable& table) {
      for_vectors_of(values(), 8, [&](const float* a, const float* b, const float*) {
        Eight out;
        (table.*operation)(a, b, out.data());
        for (unsigned i = 0; i != 8; ++i) {
          ASSERT_TRUE(same(out[i], expected(a, b, i))) << out[i] << " of " << a[i] << " and " << b[i];
        }
      });
    });
  }
  template <class Expected>
  static void expect_lanes(EightFloatTable::Unary* const EightFloatTable::*operation, Expected expected) {
    on_each_set([&](const EightFloatTable& table) {
      for_vectors_of(values(), 8, [&](const float* a, const float*, const float*) {
        Eight out;
        (table.*operation)(a, out.data());
        for (unsigned i = 0; i != 8; ++i) ASSERT_EQ(bits(out[i]), bits(expected(a, i))) << a[i];
      });
    });
  }
};

TEST_F(EightFloatOperation, FloatsAreLoadedAndStoredBitByBit) {
  expect_lanes(&EightFloatTable::load_and_store, [](const float* a, unsigned i) { return a[i]; });
  expect_lanes(&EightFloatTable::load_faces, [](const float* a, unsigned i) { return a[i < 6 ? i : i - 2]; });
  expect_lanes(&EightFloatTable::first_in_all, [](const float* a, unsigned) { return a[0]; });
  on_each_set([](const EightFloatTable& table) {
    const GuardedFloats six({1, 2, 3, 4, 5, 6});
    Eight out;
    table.load_faces(six.floats(), out.data());
    EXPECT_EQ(out, (Eight{1, 2, 3, 4, 5, 6, 5, 6}));
    table.load_six(six.floats(), -9, out.data());
    EXPECT_EQ(out, (Eight{1, 2, 3, 4, 5, 6, -9, -9}));
    table.pair_in_all(3, 4, out.data());
    EXPECT_EQ(out, (Eight{3, 4, 3, 4, 3, 4, 3, 4}));
    for (const float x : values()) {
      table.all(x, out.data());
      for (const float lane : out) ASSERT_EQ(bits(lane), bits(x));
      ASSERT_EQ(bits(table.first(out.data())), bits(x));
    }
  });
}

TEST_F(EightFloatOperation, GatherReadsOneElementOfSixStreams) {
  on_each_set([](const EightFloatTable& table) {
    std::array<std::array<float, 5>, 6> streams;
    std::array<const float*, 6> at;
    for (unsigned s = 0; s != 6; ++s) {
      for (unsigned i = 0; i != 5; ++i) streams[s][i] = static_cast<float>(10 * s + i);
      at[s] = streams[s].data();
    }
    for (unsigned i = 0; i != 5; ++i) {
      const auto x = static_cast<float>(i);
      Eight out;
      table.gather(at.data(), i, out.data());
      EXPECT_EQ(out, (Eight{x, 10 + x, 20 + x, 30 + x, 40 + x, 50 + x, 30 + x, x}));
    }
  });
}

TEST_F(EightFloatOperation, TheLastTwoLanesAreSorted) {
  on_each_set([](const EightFloatTable& table) {
    for (const float a : numbers()) {
      for (const float b : numbers()) {
        Eight out;
        table.sorted_last_two(a, b, out.data());
        ASSERT_EQ(out[6], std::max(a, b));
        ASSERT_EQ(out[7], std::min(a, b));
      }
    }
  });
}

TEST_F(EightFloatOperation, MasksOfCountsAndComparisons) {
  on_each_set([](const EightFloatTable& table) {
    for (unsigned count = 0; count <= 8; ++count) EXPECT_EQ(table.first_lanes(count), (1U << count) - 1);
    for (unsigned count = 0; count <= 6; ++count) EXPECT_EQ(table.first_and_seventh(count), ((1U << count) - 1) | 64U);
    for_vectors_of(values(), 8, [&](const float* a, const float* b, const float*) {
      unsigned less_equal = 0;
      unsigned both = 0;
      unsigned signs = 0;
      for (unsigned i = 0; i != 8; ++i) {
        less_equal |= unsigned{a[i] <= b[i]} << i;
        signs |= unsigned{is_negative(a[i])} << i;
        both |= unsigned{is_negative(a[i]) && is_negative(b[i])} << i;
      }
      ASSERT_EQ(table.less_equal(a, b), less_equal);
      ASSERT_EQ(table.signs(a), signs);
      ASSERT_EQ(table.both(a, b), both);
    });
  });
}

TEST_F(EightFloatOperation, EveryMaskChoosesBySigns) {
  on_each_set([](const EightFloatTable& table) {
    const Eight a{1, 2, 3, 4, 5, 6, 7, not_a_number};
    const Eight b{-1, -0.0F, -3, not_a_number, -5, -6, -7, -8};
    for (unsigned mask = 0; mask != 256; ++mask) {
      Eight by;
      for (unsigned i = 0; i != 8; ++i) by[i] = (mask >> i & 1U) != 0 ? (i % 2 == 0 ? -0.0F : -not_a_number) : 1.0F;
      Eight out;
      table.choose(by.data(), a.data(), b.data(), out.data());
      for (unsigned i = 0; i != 8; ++i) ASSERT_EQ(bits(out[i]), bits((mask >> i & 1U) != 0 ? a[i] : b[i])) << mask;
      table.negate_unless(by.data(), a.data(), out.data());
      for (unsigned i = 0; i != 8; ++i) {
        ASSERT_EQ(bits(out[i]), bits(a[i]) ^ ((mask >> i & 1U) != 0 ? 0U : 0x80000000U)) << mask;
      }
    }
  });
}

TEST_F(EightFloatOperation, LanesAreReplacedAndPermuted) {
  expect_lanes(&EightFloatTable::with_seventh,
               [](const float* a, const float* b, unsigned i) { return i == 6 ? b[i] : a[i]; });
  expect_lanes(&EightFloatTable::with_last_two,
               [](const float* a, const float* b, unsigned i) { return i >= 6 ? b[i] : a[i]; });
  on_each_set([](const EightFloatTable& table) {
    Random random(9);
    const Eight a{0, 1, not_a_number, 3, 4, 5, 6, -infinity};
    for (unsigned round = 0; round != 200; ++round) {
      std::uint8_t bytes[8];
      std::uint32_t lanes[8];
      for (unsigned i = 0; i != 8; ++i) lanes[i] = bytes[i] = static_cast<std::uint8_t>(random.below(8));
      Eight by_order;
      Eight by_lanes;
      table.permuted_by_order(a.data(), bytes, by_order.data());
      table.permuted(a.data(), lanes, by_lanes.data());
      for (unsigned i = 0; i != 8; ++i) {
        ASSERT_EQ(bits(by_order[i]), bits(a[lanes[i]]));
        ASSERT_EQ(bits(by_lanes[i]), bits(a[lanes[i]]));
      }
    }
  });
}

TEST_F(EightFloatOperation, ArithmeticIsRoundedOnce) {
  expect_lanes(&EightFloatTable::add, [](const float* a, const float* b, unsigned i) { return a[i] + b[i]; });
  expect_lanes(&EightFloatTable::subtract, [](const float* a, const float* b, unsigned i) { return a[i] - b[i]; });
  expect_lanes(&EightFloatTable::multiply,
               [](const float* a, const float* b, unsigned i) { return product(a[i], b[i]); });
  expect_lanes(&EightFloatTable::divide, [](const float* a, const float* b, unsigned i) { return a[i] / b[i]; });
  expect_lanes(&EightFloatTable::maximum,
               [](const float* a, const float* b, unsigned i) { return a[i] > b[i] ? a[i] : b[i]; });
  on_each_set([](const EightFloatTable& table) {
    for_vectors_of(values(), 8, [&](const float* a, const float* b, const float* c) {
      Eight out;
      table.multiply_add(a, b, c, out.data());
      for (unsigned i = 0; i != 8; ++i) {
        ASSERT_TRUE(same(out[i], fused(a[i], b[i], c[i])) || same(out[i], product(a[i], b[i]) + c[i]));
      }
    });
  });
}

TEST_F(EightFloatOperation, SignsChangeAndNothingElse) {
  const auto with_bits = [](std::uint32_t x) { return std::bit_cast<float>(x); };
  expect_lanes(&EightFloatTable::magnitude,
               [&](const float* a, unsigned i) { return with_bits(bits(a[i]) & 0x7fffffffU); });
  expect_lanes(&EightFloatTable::minus_magnitude,
               [&](const float* a, unsigned i) { return with_bits(bits(a[i]) | 0x80000000U); });
  expect_lanes(&EightFloatTable::negate_hi, [&](const float* a, unsigned i) {
    return with_bits(bits(a[i]) ^ (i >= 3 && i <= 5 ? 0x80000000U : 0U));
  });
  expect_lanes(&EightFloatTable::infinite_if_nan,
               [](const float* a, unsigned i) { return std::isnan(a[i]) ? infinity : a[i]; });
}

TEST_F(EightFloatOperation, MinimumOfBitsComparesUnsignedIntegers) {
  on_each_set([](const EightFloatTable& table) {
    for_vectors_of(values(), 8, [&](const float* a, const float* b, const float*) {
      Eight out;
      table.minimum_of_bits(a, b, out.data());
      for (unsigned i = 0; i != 8; ++i) ASSERT_EQ(bits(out[i]), std::min(bits(a[i]), bits(b[i])));
    });
  });
}

TEST_F(EightFloatOperation, ExtremesAreFoundInAnyLane) {
  on_each_set([](const EightFloatTable& table) {
    for_vectors_of(numbers(), 8, [&](const float* a, const float* b, const float* c) {
      const float sum = table.sum_of_smallest(a, b);
      const float expected = *std::min_element(a, a + 8) + *std::min_element(b, b + 8);
      ASSERT_TRUE(sum == expected || (std::isnan(sum) && std::isnan(expected))) << sum;
      float largest[3];
      table.largest_of_three(a, b, c, largest);
      ASSERT_EQ(largest[0], *std::max_element(a, a + 8));
      ASSERT_EQ(largest[1], *std::max_element(b, b + 8));
      ASSERT_EQ(largest[2], *std::max_element(c, c + 8));
    });
    for (unsigned lane = 0; lane != 8; ++lane) {
      Eight a{};
      Eight b{};
      a[lane] = -3;
      b[(lane + 3) % 8] = -4;
      EXPECT_EQ(table.sum_of_smallest(a.data(), b.data()), -7);
    }
  });
}

TEST_F(EightFloatOperation, BoxesAreOrderedUnlessAnAxisIsInvertedOrNan) {
  on_each_set([](const EightFloatTable& table) {
    for (const float lo : values()) {
      for (const float hi : values()) {
        for (unsigned axis = 0; axis != 3; ++axis) {
          std::array<float, 6> box{-1, -1, -1, 1, 1, 1};
          box[axis] = lo;
          box[axis + 3] = hi;
          ASSERT_EQ(table.is_ordered(box.data()), lo <= hi) << lo << " to " << hi << " on axis " << axis;
        }
      }
    }
  });
}

}  // namespace
}  // namespace shaftcull::simd_test
