// SPDX-License-Identifier: MIT
/// Compiled shafts that must be the same to the bit.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "compiled/shaft_data.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull {

/// The bits of a range of plain members, so that −0 and 0 differ and a difference can be shown.
template <class T, std::size_t N>
std::vector<std::uint32_t> bits(const T (&values)[N], std::size_t count = N) {
  std::vector<std::uint32_t> bits;
  for (std::size_t i = 0; i != count; ++i) {
    if constexpr (std::is_same_v<T, float>) {
      bits.push_back(std::bit_cast<std::uint32_t>(values[i]));
    } else {
      bits.push_back(values[i]);
    }
  }
  return bits;
}

/// Both have their joining planes.
inline void expect_equal(const CompiledShaft& one, const CompiledShaft& other) {
  const kernel::ShaftData& shaft = kernel::data_of(one);
  const kernel::ShaftData& expected = kernel::data_of(other);
  EXPECT_EQ(bits(shaft.slab_scale), bits(expected.slab_scale));
  EXPECT_EQ(bits(shaft.slab_shift), bits(expected.slab_shift));
  EXPECT_EQ(shaft.slab_margin, expected.slab_margin);
  EXPECT_EQ(bits(shaft.slab_near), bits(expected.slab_near));
  EXPECT_EQ(shaft.slab_uppers, expected.slab_uppers);
  EXPECT_EQ(shaft.slab_form, expected.slab_form);
  EXPECT_EQ(bits(shaft.a), bits(expected.a));
  EXPECT_EQ(bits(shaft.b), bits(expected.b));
  EXPECT_EQ(shaft.largest_coordinate, expected.largest_coordinate);
  ASSERT_EQ(shaft.added_count, expected.added_count);
  for (std::size_t i = 0; i != expected.added_count; ++i) {
    using Words = std::array<std::uint32_t, sizeof(kernel::ShaftData::AddedPlane) / sizeof(std::uint32_t)>;
    EXPECT_EQ(std::bit_cast<Words>(shaft.added[i]), std::bit_cast<Words>(expected.added[i])) << "added plane " << i;
  }
  EXPECT_EQ(shaft.formed, expected.formed);
  EXPECT_EQ(shaft.contact, expected.contact);
  EXPECT_EQ(shaft.still_faces, expected.still_faces);
  EXPECT_EQ(bits(shaft.face), bits(expected.face));
  ASSERT_EQ(shaft.joining_count, expected.joining_count);
  const std::size_t planes = expected.joining_count;
  EXPECT_EQ(bits(shaft.joining_normal0, planes), bits(expected.joining_normal0, planes));
  EXPECT_EQ(bits(shaft.joining_normal1, planes), bits(expected.joining_normal1, planes));
  EXPECT_EQ(bits(shaft.joining_minus_offset, planes), bits(expected.joining_minus_offset, planes));
  EXPECT_EQ(shaft.joining_margin, expected.joining_margin);
  EXPECT_EQ(bits(shaft.joining_near0, planes), bits(expected.joining_near0, planes));
  EXPECT_EQ(bits(shaft.joining_near1, planes), bits(expected.joining_near1, planes));
  EXPECT_EQ(bits(shaft.joining_far0, planes), bits(expected.joining_far0, planes));
  EXPECT_EQ(bits(shaft.joining_far1, planes), bits(expected.joining_far1, planes));
}

}  // namespace shaftcull
