// SPDX-License-Identifier: MIT
/// Every operation on vectors of floats, on each set, against a plain definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "guarded_floats.hpp"
#include "simd/sets.hpp"

namespace shaftcull::simd_test {
namespace {

class FloatOperation : public testing::Test {
 protected:
  /// Runs check(table) for each set.
  template <class Check>
  static void on_each_set(Check check) {
    for (const Isa isa : isas_under_test()) {
      SCOPED_TRACE(name(isa));
      check(table_of(isa).floats);
    }
  }

  /// Compares out[i] with expected(a[i], b[i]) for all pairs of values.
  template <class Expected>
  static void expect_binary(FloatTable::Binary* const FloatTable::*operation, const std::vector<float>& values,
                            Expected expected) {
    on_each_set([&](const FloatTable& table) {
      for_vectors_of(values, table.width, [&](const float* a, const float* b, const float* /*c*/) {
        std::vector<float> out(table.width);
        (table.*operation)(a, b, out.data());
        for (std::size_t i = 0; i != table.width; ++i) {
          ASSERT_TRUE(same(out[i], expected(a[i], b[i]))) << out[i] << " of " << a[i] << " and " << b[i];
        }
      });
    });
  }
  template <class Expected>
  static void expect_unary(FloatTable::Unary* const FloatTable::*operation, const std::vector<float>& values,
                           Expected expected) {
    on_each_set([&](const FloatTable& table) {
      for_vectors_of(values, table.width, [&](const float* a, const float* /*b*/, const float* /*c*/) {
        std::vector<float> out(table.width);
        (table.*operation)(a, out.data());
        for (std::size_t i = 0; i != table.width; ++i) {
          ASSERT_TRUE(same(out[i], expected(a[i]))) << out[i] << " of " << a[i];
        }
      });
    });
  }
};

TEST_F(FloatOperation, LoadAndStoreKeepEveryBitAndTouchNothingElse) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float*, const float*) {
      const GuardedFloats guarded(std::vector<float>(a, a + table.width));
      std::vector<float> out(table.width + 1, 42.0F);
      table.load_and_store(guarded.floats(), out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(bits(out[i]), bits(a[i]));
      ASSERT_EQ(out[table.width], 42.0F);
    });
  });
}

TEST_F(FloatOperation, AllFillsEveryLane) {
  on_each_set([](const FloatTable& table) {
    for (const float x : values()) {
      std::vector<float> out(table.width);
      table.all(x, out.data());
      for (const float lane : out) ASSERT_EQ(bits(lane), bits(x));
    }
  });
}

TEST_F(FloatOperation, ArithmeticIsRoundedOnce) {
  expect_binary(&FloatTable::add, values(), [](float a, float b) { return a + b; });
  expect_binary(&FloatTable::subtract, values(), [](float a, float b) { return a - b; });
  expect_binary(&FloatTable::multiply, values(), [](float a, float b) { return product(a, b); });
  expect_binary(&FloatTable::divide, values(), [](float a, float b) { return a / b; });
  expect_unary(&FloatTable::square_root, values(), [](float a) { return std::sqrt(a); });
}

TEST_F(FloatOperation, MultiplyAddIsRoundedOnceOrTwice) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float* c) {
      std::vector<float> out(table.width);
      table.multiply_add(a, b, c, out.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_TRUE(same(out[i], fused(a[i], b[i], c[i])) || same(out[i], product(a[i], b[i]) + c[i]))
            << out[i] << " of " << a[i] << ", " << b[i] << " and " << c[i];
      }
    });
  });
}

TEST_F(FloatOperation, MinimumAndMaximumOfComputedPassOverNanInTheFirstPlace) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* any, const float*) {
      std::vector<float> b(any, any + table.width);
      for (float& x : b) x = std::isnan(x) ? 1.0F : x;
      std::vector<float> out(table.width);
      table.minimum_of_computed(a, b.data(), out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(out[i], a[i] < b[i] ? a[i] : b[i]) << a[i];
      table.maximum_of_computed(a, b.data(), out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(out[i], a[i] > b[i] ? a[i] : b[i]) << a[i];
    });
  });
}

TEST_F(FloatOperation, MinimumAndMaximumGiveTheSecondOfEqualOnesAndForNan) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float*) {
      std::vector<float> out(table.width);
      table.minimum(a, b, out.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_EQ(bits(out[i]), bits(a[i] < b[i] ? a[i] : b[i])) << a[i] << " and " << b[i];
      }
      table.maximum(a, b, out.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_EQ(bits(out[i]), bits(a[i] > b[i] ? a[i] : b[i])) << a[i] << " and " << b[i];
      }
    });
  });
}

TEST_F(FloatOperation, MaximumOfBitsComparesUnsignedIntegers) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float*) {
      std::vector<float> out(table.width);
      table.maximum_of_bits(a, b, out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(bits(out[i]), std::max(bits(a[i]), bits(b[i])));
    });
  });
}

TEST_F(FloatOperation, MagnitudeClearsTheSignBit) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float*, const float*) {
      std::vector<float> out(table.width);
      table.magnitude(a, out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(bits(out[i]), bits(a[i]) & 0x7fffffffU);
    });
  });
}

TEST_F(FloatOperation, FloorRoundsDown) {
  on_each_set([](const FloatTable& table) {
    std::vector<float> some = numbers();
    Random random(5);
    for (unsigned i = 0; i != 2000; ++i) some.push_back(random.wild(-30, 40));
    for (std::size_t first = 0; first + table.width <= some.size(); ++first) {
      std::vector<float> out(table.width);
      table.floor(&some[first], out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(out[i], std::floor(some[first + i])) << some[first + i];
    }
  });
}

TEST_F(FloatOperation, FlipSignNegatesWhereTheSecondIsMinusZero) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float*) {
      std::vector<float> signs(table.width);
      for (std::size_t i = 0; i != table.width; ++i) signs[i] = is_negative(b[i]) ? -0.0F : 0.0F;
      std::vector<float> out(table.width);
      table.flip_sign(a, signs.data(), out.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_EQ(bits(out[i]), bits(a[i]) ^ (is_negative(b[i]) ? 0x80000000U : 0U));
      }
    });
  });
}

TEST_F(FloatOperation, SmallestAndLargestFindAnyLane) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(numbers(), table.width, [&](const float* a, const float*, const float*) {
      ASSERT_EQ(table.smallest(a), *std::min_element(a, a + table.width));
      ASSERT_EQ(table.largest(a), *std::max_element(a, a + table.width));
    });
    for (std::size_t lane = 0; lane != table.width; ++lane) {
      std::vector<float> one(table.width, 0.0F);
      one[lane] = -3.0F;
      EXPECT_EQ(table.smallest(one.data()), -3.0F);
      one[lane] = 3.0F;
      EXPECT_EQ(table.largest(one.data()), 3.0F);
    }
  });
}

TEST_F(FloatOperation, ComparisonsAreFalseForNanAndZerosAreEqual) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float*) {
      std::uint64_t less = 0;
      std::uint64_t less_equal = 0;
      for (std::size_t i = 0; i != table.width; ++i) {
        less |= std::uint64_t{a[i] < b[i]} << i;
        less_equal |= std::uint64_t{a[i] <= b[i]} << i;
      }
      ASSERT_EQ(table.less(a, b), less);
      ASSERT_EQ(table.less_equal(a, b), less_equal);
    });
  });
}

TEST_F(FloatOperation, EveryMaskIsReadJoinedAndChosenBy) {
  on_each_set([](const FloatTable& table) {
    const std::uint64_t masks = std::uint64_t{1} << table.width;
    const std::vector<float> zero(table.width, 0.0F);
    std::vector<float> a(table.width);
    std::vector<float> b(table.width);
    std::vector<float> chosen(table.width);
    for (std::uint64_t mask = 0; mask != masks; ++mask) {
      const std::uint64_t other = (mask * 0x9e3779b9U >> 7U) % masks;
      for (std::size_t i = 0; i != table.width; ++i) {
        a[i] = (mask >> i & 1U) != 0 ? -1.0F : 1.0F;
        b[i] = (other >> i & 1U) != 0 ? -1.0F : not_a_number;
      }
      ASSERT_EQ(table.less(a.data(), zero.data()), mask);
      ASSERT_EQ(table.both(a.data(), zero.data(), b.data(), zero.data()), mask & other);
      ASSERT_EQ(table.either(a.data(), zero.data(), b.data(), zero.data()), mask | other);
      table.choose(a.data(), zero.data(), b.data(), a.data(), chosen.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_EQ(bits(chosen[i]), bits((mask >> i & 1U) != 0 ? b[i] : a[i]));
      }
    }
  });
}

TEST_F(FloatOperation, LowestBitIsFoundAndNoneIsTheLastOrBehindIt) {
  on_each_set([](const FloatTable& table) {
    for (unsigned bit = 0; bit != 64; ++bit) {
      EXPECT_EQ(table.lowest_bit(~std::uint64_t{0} << bit), bit);
      EXPECT_EQ(table.lowest_bit(std::uint64_t{1} << bit), bit);
    }
    EXPECT_GE(table.lowest_bit(0), 63U);
    EXPECT_LE(table.lowest_bit(0), 64U);
  });
}

TEST_F(FloatOperation, GatherReadsWhereIndicesSay) {
  on_each_set([](const FloatTable& table) {
    Random random(6);
    std::vector<float> from(65536);
    for (std::size_t i = 0; i != from.size(); ++i) from[i] = static_cast<float>(i);
    for (unsigned round = 0; round != 200; ++round) {
      std::vector<std::uint16_t> index(table.width);
      for (std::uint16_t& i : index) i = static_cast<std::uint16_t>(random.one_in(4) ? 65535 : random.below(65536));
      std::vector<float> out(table.width);
      table.gather(from.data(), index.data(), out.data());
      for (std::size_t i = 0; i != table.width; ++i) ASSERT_EQ(out[i], from[index[i]]);
    }
  });
}

TEST_F(FloatOperation, RowsBecomeColumnsAndColumnsRows) {
  on_each_set([](const FloatTable& table) {
    std::vector<float> fours(4 * table.width);
    std::vector<float> eights(8 * table.width);
    for (std::size_t i = 0; i != fours.size(); ++i) fours[i] = static_cast<float>(i + 1);
    for (std::size_t i = 0; i != eights.size(); ++i) eights[i] = static_cast<float>(i + 1);
    fours[2] = eights[3] = not_a_number;
    const GuardedFloats rows(fours);
    std::vector<float> columns(4 * table.width);
    table.load_columns(rows.floats(), columns.data());
    std::vector<float> things(8 * table.width);
    table.transpose(eights.data(), things.data());
    for (std::size_t i = 0; i != table.width; ++i) {
      for (std::size_t c = 0; c != 4; ++c) EXPECT_EQ(bits(columns[c * table.width + i]), bits(fours[4 * i + c]));
      for (std::size_t c = 0; c != 8; ++c) EXPECT_EQ(bits(things[8 * i + c]), bits(eights[c * table.width + i]));
    }
  });
}

TEST_F(FloatOperation, FirstLanesReadNothingBehindThem) {
  on_each_set([](const FloatTable& table) {
    const int width = static_cast<int>(table.width);
    for (int count = -2; count <= width + 2; ++count) {
      const int there = std::clamp(count, 0, width);
      std::vector<float> floats(static_cast<std::size_t>(there));
      for (int i = 0; i != there; ++i)
        floats[static_cast<std::size_t>(i)] = i % 3 == 1 ? not_a_number : 1.0F + static_cast<float>(i);
      const GuardedFloats guarded(floats);
      const std::vector<float> b(table.width, -7.0F);
      std::vector<float> a(table.width, 9.0F);
      std::vector<float> out(table.width, 42.0F);
      // Where no lane is read, the address is still one that might be (kernels/shared/word.hpp).
      table.load_first(count, there == 0 ? b.data() : guarded.floats(), out.data());
      for (int i = 0; i != width; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        ASSERT_EQ(bits(out[lane]), i < there ? bits(floats[lane]) : 0U) << count;
      }
      table.choose_first(count, a.data(), b.data(), out.data());
      for (int i = 0; i != width; ++i) ASSERT_EQ(out[static_cast<std::size_t>(i)], i < there ? 9.0F : -7.0F) << count;
    }
  });
}

TEST_F(FloatOperation, EveryMaskIsCompressed) {
  on_each_set([](const FloatTable& table) {
    std::vector<float> a(table.width);
    for (std::size_t i = 0; i != table.width; ++i) a[i] = static_cast<float>(i);
    a[table.width / 2] = std::bit_cast<float>(0x7f800001U);  // an integer that would be a signalling NaN
    for (std::uint64_t mask = 0; mask != std::uint64_t{1} << table.width; ++mask) {
      std::vector<float> packed;
      for (std::size_t i = 0; i != table.width; ++i) {
        if ((mask >> i & 1U) != 0) packed.push_back(a[i]);
      }
      std::vector<float> out(table.width + 1, 42.0F);
      table.compress(mask, a.data(), out.data());
      for (std::size_t i = 0; i != packed.size(); ++i) ASSERT_EQ(bits(out[i]), bits(packed[i])) << mask;
      ASSERT_EQ(out[table.width], 42.0F);
      const std::size_t count = packed.size();
      if (count == table.width) continue;
      std::fill(out.begin(), out.end(), 42.0F);
      table.compress_some(mask, a.data(), count, out.data());
      for (std::size_t i = 0; i != count; ++i) ASSERT_EQ(bits(out[i]), bits(packed[i])) << mask;
      for (std::size_t i = count; i != out.size(); ++i) ASSERT_EQ(out[i], 42.0F) << mask;
    }
  });
}

TEST_F(FloatOperation, IntegersOfEveryMaskAreCompressed) {
  on_each_set([](const FloatTable& table) {
    Random random(19);
    std::vector<std::uint32_t> a(table.width);
    for (std::uint64_t mask = 0; mask != std::uint64_t{1} << table.width; ++mask) {
      std::vector<std::uint32_t> packed;
      for (std::size_t i = 0; i != table.width; ++i) {
        a[i] = random.one_in(4) ? 0xffffffffU : random.below(1U << 31);  // some would be NaN as floats
        if ((mask >> i & 1U) != 0) packed.push_back(a[i]);
      }
      std::vector<std::uint32_t> out(table.width + 1, 42);
      table.compress_integers(mask, a.data(), out.data());
      for (std::size_t i = 0; i != packed.size(); ++i) ASSERT_EQ(out[i], packed[i]) << mask;
      ASSERT_EQ(out[table.width], 42U);
    }
  });
}

TEST_F(FloatOperation, EitherNegativeIsNegativeWhereTheFirstIsOrTheSecondIsBelowZero) {
  on_each_set([](const FloatTable& table) {
    for_vectors_of(values(), table.width, [&](const float* a, const float* b, const float*) {
      std::vector<float> first(a, a + table.width);
      for (float& x : first) x = std::isnan(x) || x == 0 ? 1.0F : x;
      std::vector<float> out(table.width);
      table.either_negative(first.data(), b, out.data());
      for (std::size_t i = 0; i != table.width; ++i) {
        ASSERT_EQ(is_negative(out[i]), first[i] < 0 || b[i] < 0) << first[i] << " and " << b[i];
      }
    });
  });
}

TEST_F(FloatOperation, SignsOfEveryLaneAreReadInOrder) {
  on_each_set([](const FloatTable& table) {
    const unsigned lanes = 4 * table.width;
    std::vector<float> kinds = numbers();
    std::erase_if(kinds, [](float x) { return x == 0 && std::signbit(x); });
    Random random(7);
    std::vector<float> four(lanes);
    for (unsigned round = 0; round != 3000; ++round) {
      std::uint64_t expected = 0;
      const unsigned only = random.below(2 * lanes);  // half of the rounds have one negative lane, or all but one
      for (unsigned i = 0; i != lanes; ++i) {
        float x = kinds[random.below(static_cast<unsigned>(kinds.size()))];
        if (only < lanes) x = x == 0 || (x < 0) == ((i == only) != (round % 2 == 0)) ? x : -x;
        four[i] = x;
        expected |= std::uint64_t{x < 0} << i;
      }
      ASSERT_EQ(table.signs(four.data()), expected);
    }
  });
}

TEST_F(FloatOperation, TheSignCollectorNoticesEveryUndecidedLane) {
  on_each_set([](const FloatTable& table) {
    const unsigned lanes = 8 * table.width;
    Random random(8);
    for (const float limit : {0x1p-149F, 0x1p-126F, 1e-6F, 1.0F, 1e30F}) {
      const std::vector<float> decided = {-limit,    -infinity, -1e-38F, -0x1p-149F, std::nextafter(limit, infinity),
                                          2 * limit, infinity};
      for (unsigned round = 0; round != 4 * lanes; ++round) {
        std::vector<float> eight(lanes);
        for (float& x : eight) x = decided[random.below(static_cast<unsigned>(decided.size()))];
        const bool is_any_undecided = round % 2 == 0;
        if (is_any_undecided) eight[round / 2 % lanes] = random.one_in(3) ? 0.0F : random.one_in(2) ? limit : limit / 2;
        std::uint64_t yes[2];
        ASSERT_EQ(table.collect(limit, eight.data(), yes), is_any_undecided) << limit << ", lane " << round / 2 % lanes;
        for (unsigned i = 0; i != lanes; ++i) {
          ASSERT_EQ((yes[i / (lanes / 2)] >> i % (lanes / 2) & 1U) != 0, eight[i] < 0) << limit;
        }
      }
    }
  });
}

}  // namespace
}  // namespace shaftcull::simd_test
