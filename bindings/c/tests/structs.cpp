// SPDX-License-Identifier: MIT
/// The layout of structs and the values of constants: other languages read them from the header, and programs that were
/// built before rely on them.
#include <gmock/gmock.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

// C and C++ have the same values in the same places.
static_assert(sizeof(shaftcull_box) == sizeof(Box) && offsetof(shaftcull_box, hi) == offsetof(Box, hi));
static_assert(sizeof(shaftcull_sphere) == sizeof(Sphere) &&
              offsetof(shaftcull_sphere, radius) == offsetof(Sphere, radius));
static_assert(sizeof(shaftcull_plane) == sizeof(Plane) && offsetof(shaftcull_plane, offset) == offsetof(Plane, offset));
static_assert(sizeof(shaftcull_triangle) == sizeof(Triangle));
static_assert(sizeof(shaftcull_index_pair) == sizeof(IndexPair));

// No struct has bytes that belong to no field, so that no language sees other fields.
template <class Struct>
constexpr bool has_no_padding = std::has_unique_object_representations_v<Struct>;
static_assert(has_no_padding<shaftcull_index_pair> && has_no_padding<shaftcull_kept_counts> &&
              has_no_padding<shaftcull_bound_id> && has_no_padding<shaftcull_pair_block> &&
              has_no_padding<shaftcull_sight_counts>);
static_assert(sizeof(shaftcull_contact_found) == 8 + 4 + 4 + 12 + 4);  // floats have no unique representation
static_assert(sizeof(shaftcull_shafts_info) == 2 * 24 + 4 * 4);
static_assert(sizeof(void*) != 8 || sizeof(shaftcull_bounds_info) == 2 * 8 + 11 * 8 + 24 + 4 * 4);
static_assert(sizeof(shaftcull_tree_info) == 8 + 4 * 8);
static_assert(sizeof(void*) != 8 || sizeof(shaftcull_hull_info) == 2 * 8 + 2 * 8 + 24);
static_assert(sizeof(void*) != 8 || sizeof(shaftcull_occluder_info) == 8 + 8 + 24);
static_assert(sizeof(void*) != 8 || (has_no_padding<shaftcull_lists_info> && has_no_padding<shaftcull_patches_info>));
static_assert(sizeof(void*) != 8 || (has_no_padding<shaftcull_source> && sizeof(shaftcull_source) == 64));
static_assert(sizeof(void*) != 8 || (has_no_padding<shaftcull_query> && sizeof(shaftcull_query) == 128));
static_assert(sizeof(void*) != 8 || has_no_padding<shaftcull_batch_planes>);
static_assert(sizeof(void*) != 8 ||
              (has_no_padding<shaftcull_undecided_pairs> && has_no_padding<shaftcull_sight_batch>));
// Of each of these, one or two are floats.
static_assert(sizeof(void*) != 8 || sizeof(shaftcull_visibility_options) == 8 + 6 * 4 + 3 * 8 + 4 * 8);
static_assert(sizeof(shaftcull_ray_options) == 8 + 8 + 2 * 4 + 4 * 8);
static_assert(sizeof(void*) != 8 || sizeof(shaftcull_view_factor_options) == 4 * 8 + 6 * 4 + 2 * 8 + 4 * 8);

// Enumerators are the same numbers in both languages, where calls rely on it.
template <class Enum>
constexpr bool same(std::uint32_t c, Enum cpp) {
  return c == static_cast<std::uint32_t>(cpp);
}
static_assert(same(SHAFTCULL_CONTACT_CLOSED, Contact::closed) && same(SHAFTCULL_CONTACT_OPEN, Contact::open));
static_assert(same(SHAFTCULL_OUTSIDE, Answer::outside) && same(SHAFTCULL_OVERLAP, Answer::overlap) &&
              same(SHAFTCULL_INSIDE, Answer::inside));
static_assert(same(SHAFTCULL_DEPTH_ZERO_TO_ONE, ClipDepth::zero_to_one) &&
              same(SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE, ClipDepth::minus_one_to_one));
static_assert(same(SHAFTCULL_TRIANGLES_EXACT, TriangleTest::exact) &&
              same(SHAFTCULL_TRIANGLES_BY_VERTICES, TriangleTest::vertices));
static_assert(same(SHAFTCULL_SIGHT_UNDECIDED, Sight::undecided) && same(SHAFTCULL_SIGHT_CLEAR, Sight::clear) &&
              same(SHAFTCULL_SIGHT_OCCLUDED, Sight::occluded) && same(SHAFTCULL_SIGHT_FACING_AWAY, Sight::facing_away));

TEST(CStructs, HeaderAndLibraryAreOfOneVersion) {
  EXPECT_EQ(SHAFTCULL_HEADER_VERSION, SHAFTCULL_VERSION);
  EXPECT_EQ(shaftcull_version(), std::uint32_t{SHAFTCULL_VERSION});
}

TEST(CStructs, WordsAreAsInCpp) {
  for (const std::size_t bounds : {0U, 1U, 63U, 64U, 65U, 1000U})
    EXPECT_EQ(shaftcull_bit_words(bounds), bit_words(bounds));
}

}  // namespace
}  // namespace shaftcull
