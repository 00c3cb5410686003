// SPDX-License-Identifier: MIT
// The structs of the C interface, for js/structs.js, and the constants that JavaScript has by hand.
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "shaftcull.h"

namespace {

struct Entry {
  const char* structure;
  const char* field;
  std::uint32_t place;  // of the field
  std::uint32_t type;   // of the field
  std::uint32_t bytes;  // of the struct
};
static_assert(sizeof(Entry) == 20);

// The position of a type in js/structs.js.
template <class T>
constexpr std::uint32_t type_of() {
  if (std::is_pointer_v<T> || std::is_same_v<T, std::uint32_t>) return 1;
  if (std::is_same_v<T, std::uint64_t>) return 2;
  if (std::is_same_v<T, float>) return 3;
  return std::is_same_v<T, double> ? 4 : 0;
}

#define FIELD(structure, field)                                                                                   \
  {#structure, #field, offsetof(shaftcull_##structure, field), type_of<decltype(shaftcull_##structure::field)>(), \
   sizeof(shaftcull_##structure)},
constexpr Entry entries[] = {
#include "fields.inc"  // which CMakeLists.txt makes of shaftcull.h
    {}};

// JavaScript writes and reads arrays of these.
static_assert(sizeof(shaftcull_box) == 24 && offsetof(shaftcull_box, hi) == 12);
static_assert(sizeof(shaftcull_sphere) == 16 && offsetof(shaftcull_sphere, radius) == 12);
static_assert(sizeof(shaftcull_kept_counts) == 16 && offsetof(shaftcull_kept_counts, inside) == 8);
static_assert(sizeof(shaftcull_pair_block) == 20 && offsetof(shaftcull_pair_block, sight) == 16);

static_assert(SHAFTCULL_BOXES == 1 && SHAFTCULL_SPHERES == 2 && SHAFTCULL_TRIANGLES == 3);
static_assert(SHAFTCULL_SOURCE_BOXES == 1 && SHAFTCULL_SOURCE_SPHERES == 3 && SHAFTCULL_SOURCE_TRIANGLES == 4);
static_assert(SHAFTCULL_SOURCE_MESH == 5);
static_assert(SHAFTCULL_OUTSIDE == 0 && SHAFTCULL_OVERLAP == 1 && SHAFTCULL_INSIDE == 2);
static_assert(SHAFTCULL_CONTACT_CLOSED == 0 && SHAFTCULL_CONTACT_OPEN == 1);
static_assert(SHAFTCULL_SWEPT == 0 && SHAFTCULL_SWEPT_INFINITE == 1);
static_assert(SHAFTCULL_TRIANGLES_EXACT == 0 && SHAFTCULL_TRIANGLES_BY_VERTICES == 1);
static_assert(SHAFTCULL_OK == 0 && SHAFTCULL_INTERNAL_ERROR == 6);
static_assert(SHAFTCULL_DEPTH_ZERO_TO_ONE == 0 && SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE == 1);
static_assert(SHAFTCULL_SIGHT_UNDECIDED == 0 && SHAFTCULL_SIGHT_CLEAR == 1 && SHAFTCULL_SIGHT_OCCLUDED == 2 &&
              SHAFTCULL_SIGHT_FACING_AWAY == 3);

}  // namespace

// Returns all entries. The last one has no struct.
extern "C" [[clang::export_name("structs")]] const void* structs() { return entries; }
