// SPDX-License-Identifier: MIT
/// The handles of the C interface for C++ tests, and what makes them of C++ values.
#pragma once

#include <gmock/gmock.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

template <auto free_handle>
struct FreeHandle {
  template <class T>
  void operator()(T* handle) const noexcept {
    free_handle(handle);
  }
};
using BoundsHandle = std::unique_ptr<shaftcull_bounds, FreeHandle<shaftcull_bounds_free>>;
using ShaftsHandle = std::unique_ptr<shaftcull_shafts, FreeHandle<shaftcull_shafts_free>>;
using HullHandle = std::unique_ptr<shaftcull_hull, FreeHandle<shaftcull_hull_free>>;
using ListsHandle = std::unique_ptr<shaftcull_lists, FreeHandle<shaftcull_lists_free>>;
using PatchesHandle = std::unique_ptr<shaftcull_patches, FreeHandle<shaftcull_patches_free>>;
using OccludersHandle = std::unique_ptr<shaftcull_occluders, FreeHandle<shaftcull_occluders_free>>;
using FactorMatrixHandle = std::unique_ptr<shaftcull_factor_matrix, FreeHandle<shaftcull_factor_matrix_free>>;
using VisibilityHandle = std::unique_ptr<shaftcull_visibility_result, FreeHandle<shaftcull_visibility_result_free>>;

/// The call must have succeeded.
inline void ok(shaftcull_status status) {
  ASSERT_EQ(status, SHAFTCULL_OK) << shaftcull_status_name(status) << ": " << shaftcull_error_message();
}

/// What a call makes whose last argument is a pointer to a handle.
template <class Handle, class Make, class... Arguments>
Handle made(Make* make, const Arguments&... arguments) {
  typename Handle::pointer handle = nullptr;
  ok(make(arguments..., &handle));
  return Handle(handle);
}

/// Values of C.
inline shaftcull_box as_c(const Box& box) { return std::bit_cast<shaftcull_box>(box); }
inline shaftcull_sphere as_c(const Sphere& sphere) { return std::bit_cast<shaftcull_sphere>(sphere); }
inline shaftcull_triangle as_c(const Triangle& triangle) { return std::bit_cast<shaftcull_triangle>(triangle); }
inline shaftcull_plane as_c(const Plane& plane) { return std::bit_cast<shaftcull_plane>(plane); }
template <class T>
auto as_c(const std::vector<T>& values) {
  std::vector<decltype(as_c(std::declval<const T&>()))> out;
  for (const T& value : values) out.push_back(as_c(value));
  return out;
}

/// Their source. The values must live as long as it is used.
inline shaftcull_source source_of(const std::vector<shaftcull_box>& boxes) {
  return shaftcull_boxes(boxes.data(), boxes.size());
}
inline shaftcull_source source_of(const std::vector<shaftcull_sphere>& spheres) {
  return shaftcull_spheres(spheres.data(), spheres.size());
}
inline shaftcull_source source_of(const std::vector<shaftcull_triangle>& triangles) {
  return shaftcull_triangles(triangles.data(), triangles.size());
}

/// Values of C++.
inline SightCounts as_cpp(const shaftcull_sight_counts& counts) {
  return {counts.undecided, counts.clear, counts.occluded, counts.facing_away};
}

/// The state of an object: describe() writes it.
template <class Info, class Handle>
Info described(shaftcull_status (*describe)(const Handle*, Info*), const Handle* handle) {
  Info info{};
  ok(describe(handle, &info));
  return info;
}
inline shaftcull_bounds_info described(const shaftcull_bounds* bounds) {
  return described(shaftcull_bounds_describe, bounds);
}

/// A shaft between two boxes, at a position of an array.
inline shaftcull_status set_between(shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_box& a,
                                    const shaftcull_box& b, shaftcull_contact contact = SHAFTCULL_CONTACT_CLOSED) {
  const shaftcull_source from = shaftcull_boxes(&a, 1);
  const shaftcull_source to = shaftcull_boxes(&b, 1);
  return shaftcull_shafts_set_between(shafts, shaft, 1, &from, &to, nullptr, nullptr, contact);
}

}  // namespace shaftcull
