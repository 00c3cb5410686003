// SPDX-License-Identifier: MIT
/// Checks of what C hands over, and its values as those of C++.
///
/// Small values are copied, not cast: to a compiler that optimises across languages, a `shaftcull_box` and a `Box` are
/// different types, which it may take for different memory. Arrays of numbers and of records go through as they are.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "objects.hpp"
#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"
#include "status.hpp"

namespace shaftcull::binding {

[[noreturn]] inline void refuse(const std::string& what) { fail(InvalidArgument(what)); }

/// What a pointer points to, which must not be NULL.
template <class T>
[[nodiscard]] T& given(T* pointer, const char* name) {
  if (pointer == nullptr) refuse(std::string(name) + " is NULL; it must point to what the call reads or writes");
  return *pointer;
}

/// A number as one of this machine's, which may have 32 bits.
[[nodiscard]] inline std::size_t as_size(std::uint64_t number, const char* name) {
  if constexpr (sizeof(std::size_t) < sizeof number) {
    if (number > std::numeric_limits<std::size_t>::max()) {
      refuse(std::string(name) + " = " + std::to_string(number) + " is more than this machine's memory can hold");
    }
  }
  return static_cast<std::size_t>(number);
}

/// How many elements of some bytes there are.
[[nodiscard]] inline std::size_t as_count(std::uint64_t number, std::size_t bytes, const char* name) {
  if (number > std::numeric_limits<std::size_t>::max() / 2 / bytes) {
    refuse("there cannot be " + std::to_string(number) + " elements of " + name + ": memory cannot hold so many");
  }
  return static_cast<std::size_t>(number);
}

/// An array, which may be NULL if it has no elements.
template <class T>
[[nodiscard]] std::span<T> as_span(T* first, std::uint64_t count, const char* name) {
  const std::size_t size = as_count(count, sizeof(T), name);
  if (first == nullptr && size != 0) {
    refuse(std::string(name) + " is NULL; it must point to the first of " + std::to_string(count) + " elements");
  }
  return {first, size};
}

/// An array that may be NULL for none, whatever `count` is.
template <class T>
[[nodiscard]] std::span<T> as_span_if_given(T* first, std::uint64_t count, const char* name) {
  return first == nullptr ? std::span<T>() : as_span(first, count, name);
}

/// Where the elements of a span are; NULL if there are none.
template <class T>
[[nodiscard]] T* first_of(std::span<T> elements) noexcept {
  return elements.empty() ? nullptr : elements.data();
}

/// An enumerator of type Enum, whose values are 0 to `last` in both languages.
template <class Enum>
[[nodiscard]] Enum as_enumerator(std::uint32_t value, Enum last, const char* name, const char* choices) {
  if (value > static_cast<std::uint32_t>(last)) {
    refuse(std::string(name) + " = " + std::to_string(value) + " is none of " + choices);
  }
  return static_cast<Enum>(value);
}
[[nodiscard]] inline Contact as_contact(shaftcull_contact contact) {
  return as_enumerator(contact, Contact::open, "contact", "SHAFTCULL_CONTACT_CLOSED and SHAFTCULL_CONTACT_OPEN");
}
[[nodiscard]] inline ClipDepth as_depth(shaftcull_clip_depth depth) {
  return as_enumerator(depth, ClipDepth::minus_one_to_one, "depth",
                       "SHAFTCULL_DEPTH_ZERO_TO_ONE and SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE");
}
[[nodiscard]] inline HullTest as_hull_test(shaftcull_hull_test test) {
  return as_enumerator(test, HullTest::conservative, "test", "SHAFTCULL_HULL_EXACT and SHAFTCULL_HULL_CONSERVATIVE");
}
[[nodiscard]] inline PatchSides as_patch_sides(shaftcull_patch_sides sides) {
  return as_enumerator(sides, PatchSides::both, "sides", "SHAFTCULL_PATCH_FRONT and SHAFTCULL_PATCH_BOTH");
}
[[nodiscard]] inline TriangleTest as_triangle_test(shaftcull_triangle_test test) {
  return as_enumerator(test, TriangleTest::vertices, "triangle test",
                       "SHAFTCULL_TRIANGLES_EXACT and SHAFTCULL_TRIANGLES_BY_VERTICES");
}
[[noreturn]] inline void refuse_kind(shaftcull_bound_kind kind) {
  refuse("kind = " + std::to_string(kind) + " is none of SHAFTCULL_BOXES, SHAFTCULL_SPHERES and SHAFTCULL_TRIANGLES");
}
/// A number that means yes or no.
[[nodiscard]] inline bool as_bool(std::uint32_t value, const char* name) {
  if (value > 1) refuse(std::string(name) + " = " + std::to_string(value) + " is neither 0 nor 1");
  return value != 0;
}
/// Refuses what a later version of the header may have set.
inline void require_zero(std::span<const std::uint64_t> reserved, const std::string& of) {
  for (const std::uint64_t number : reserved) {
    if (number != 0)
      refuse(of + ".reserved is not 0; set the whole struct to 0 or to its defaults first, or use a newer library");
  }
}

/// The same bytes as a value of the other language.
template <class To, class From>
[[nodiscard]] To converted(const From& value) noexcept {
  static_assert(std::is_standard_layout_v<To> && std::is_standard_layout_v<From>);
  return std::bit_cast<To>(value);
}
[[nodiscard]] inline Box as_box(const shaftcull_box* box, const char* name) { return converted<Box>(given(box, name)); }
[[nodiscard]] inline Vec3 as_vector(const float* floats, const char* name) {
  (void)given(floats, name);
  return {floats[0], floats[1], floats[2]};
}

/// Copies of an array's elements as those of the other language.
template <class To, class From>
[[nodiscard]] std::vector<To> copied(const From* first, std::uint64_t count, const char* name) {
  static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  static_assert(sizeof(To) % sizeof(From) == 0);
  constexpr std::size_t parts = sizeof(To) / sizeof(From);  // three floats make a vector
  const std::size_t size = as_count(count, sizeof(To), name);
  const std::span<const From> from = as_span(first, std::uint64_t{size} * parts, name);
  std::vector<To> to(size);
  if (size != 0) std::memcpy(to.data(), from.data(), from.size_bytes());
  return to;
}
[[nodiscard]] inline std::vector<Vec3> as_vectors(const float* floats, std::uint64_t count, const char* name) {
  return copied<Vec3>(floats, count, name);
}
[[nodiscard]] inline std::vector<Plane> as_planes(const shaftcull_plane* planes, std::uint64_t count,
                                                  const char* name) {
  return copied<Plane>(planes, count, name);
}

/// One shaft of an array. Shafts is shaftcull_shafts or const shaftcull_shafts.
template <class Shafts>
[[nodiscard]] auto& shaft_at(Shafts* shafts, std::uint64_t shaft) {
  auto& compiled = given(shafts, "shafts").compiled;
  if (shaft >= compiled.size()) {
    refuse("shaft = " + std::to_string(shaft) + " is not below the number of shafts, " +
           std::to_string(compiled.size()));
  }
  return compiled[static_cast<std::size_t>(shaft)];
}

/// A range of an array.
template <class Shafts>
[[nodiscard]] auto shafts_from(Shafts* shafts, std::uint64_t first, std::uint64_t count) {
  std::span compiled(given(shafts, "shafts").compiled);
  if (first > compiled.size() || count > compiled.size() - first) {
    refuse("shafts from " + std::to_string(first) + " on, " + std::to_string(count) +
           " of them, do not lie within the " + std::to_string(compiled.size()) + " shafts of the array");
  }
  return compiled.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

}  // namespace shaftcull::binding
