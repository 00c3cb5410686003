// SPDX-License-Identifier: MIT
/// Bounds in arrays of the user's own structs, given by the names of their members.
///
///     struct Object { float lo[3]; float hi[3]; int id; };
///     std::vector<Object> objects = …;
///     BoxStream boxes(strided(objects, &Object::lo, &Object::hi));
///
/// Results refer to the array, which must outlive their use. The compiler checks member types. For members of other
/// types, and for records that no C++ type describes, use StridedBoxes and similar structs in streams.hpp, with
/// addresses and a stride in bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <ranges>
#include <type_traits>

#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A type that can be made from x, y and z.
template <class T>
concept FromThreeFloats = requires {
  T{0.0F, 0.0F, 0.0F};
};

/// A type that can hold x, y and z: float[3], std::array<float, 3>, or a class that can be made from three floats and
/// has their size.
template <class T>
concept ThreeFloats = std::same_as<T, float[3]> ||
    (FromThreeFloats<T>&& std::is_class_v<T>&& std::is_standard_layout_v<T> && sizeof(T) == 3 * sizeof(float));

/// An array of objects, as an lvalue or a span: std::vector, std::array, a C array.
template <class T>
concept ObjectArray = std::ranges::contiguous_range<T> && std::ranges::sized_range<T> && std::ranges::borrowed_range<T>;

/// The address of a member of the first object; null if there are no objects.
template <std::ranges::contiguous_range Objects, class T, class Member>
[[nodiscard]] const void* first_member(const Objects& objects, Member T::*member) noexcept {
  const auto* const first = std::ranges::data(objects);
  return first == nullptr || std::ranges::empty(objects) ? nullptr : std::addressof(first->*member);
}

/// Boxes as min and max corners: strided(objects, &T::lo, &T::hi).
template <ObjectArray Objects, class T, ThreeFloats Lo, ThreeFloats Hi>
[[nodiscard]] StridedBoxes strided(Objects&& objects, Lo T::*lo, Hi T::*hi) noexcept {
  return {first_member(objects, lo), first_member(objects, hi), sizeof(std::ranges::range_value_t<Objects>),
          std::ranges::size(objects)};
}

/// Spheres: strided(objects, &T::centre, &T::radius).
template <ObjectArray Objects, class T, ThreeFloats Centre>
[[nodiscard]] StridedSpheres strided(Objects&& objects, Centre T::*centre, float T::*radius) noexcept {
  return {first_member(objects, centre), first_member(objects, radius), sizeof(std::ranges::range_value_t<Objects>),
          std::ranges::size(objects)};
}

/// Boxes as centre and half extent: strided_centre_extents(objects, &T::centre, &T::half_extent).
template <ObjectArray Objects, class T, ThreeFloats Centre, ThreeFloats HalfExtent>
[[nodiscard]] StridedCentreExtents strided_centre_extents(Objects&& objects, Centre T::*centre,
                                                          HalfExtent T::*half_extent) noexcept {
  return {first_member(objects, centre), first_member(objects, half_extent),
          sizeof(std::ranges::range_value_t<Objects>), std::ranges::size(objects)};
}

}  // namespace shaftcull
