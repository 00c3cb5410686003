// SPDX-License-Identifier: MIT
/// Patches of a mesh: its triangles, split until they are small enough.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh.hpp"
#include "region.hpp"

namespace shaftcull::cli {

/// More would be pairs for weeks.
inline constexpr std::size_t most_patches = 4'000'000;
/// What triangles are split into at most if the user does not say: 500 million pairs, a matter of seconds.
inline constexpr std::size_t most_usual_patches = 31'623;

/// A triangle of the mesh, or a part of one. It lies in the plane of its triangle but for the rounding of doubles.
struct MeshPatch {
  std::array<Point3, 3> corner;
  std::uint32_t triangle;  ///< position in MeshScene::triangles
};

/// What patches are split to if the user does not say: a 32nd of the longest side of the scene, or more where that
/// would be more than most_usual_patches; rounded up to a short number.
[[nodiscard]] double usual_patch_size(const MeshScene& scene);

/// How many patches split_into_patches() would make, but `most` if these are more.
[[nodiscard]] std::size_t count_patches(std::span<const MeshTriangle> triangles, double size, std::size_t most);

/// Halves triangles across their longest edge until no edge is longer than `size`, which is above 0. Triangles without
/// an area give no patches. Throws InvalidArgument if there would be more
/// than most_patches.
[[nodiscard]] std::vector<MeshPatch> split_into_patches(std::span<const MeshTriangle> triangles, double size);

/// The least box of floats around a patch.
[[nodiscard]] Box box_of(const MeshPatch& patch);

/// Normal to a triangle of the mesh, of length 1, by the right hand; zero if it has no area.
[[nodiscard]] Point3 normal_of(const MeshTriangle& triangle);

/// The plane that patches of a triangle face from. Exact if it is across an axis; otherwise all vertices are on it or
/// behind it, by no more than rounding needs.
[[nodiscard]] Plane plane_of(const MeshTriangle& triangle);

}  // namespace shaftcull::cli
