// SPDX-License-Identifier: MIT
/// A mesh file as bounds in world space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// A point of a large world.
using WorldPoint = std::array<double, 3>;

/// A triangle of an object, which faces where its right-hand normal points: as in the file, also if its node reflects
/// it. Points and lines are triangles with vertices repeated.
struct MeshTriangle {
  Box box;
  std::uint32_t object;
  std::uint32_t part;      ///< position in MeshScene::parts
  std::uint32_t triangle;  ///< position within the object
  std::array<Vec3, 3> vertex{};
};

/// Triangles of one object that lie close together (mesh_parts.hpp).
struct MeshPart {
  Box box;
  std::uint32_t object;
  std::uint32_t number;  ///< within the object, from 1
};

/// The objects of a mesh file, what they are made of, and the boxes of all that.
///
/// An object is a node of the file's hierarchy that has meshes, placed in world space. It has the name of its node, or
/// that of its mesh if the node has none, or that of the nearest node above that has one. In a file with a single such
/// node, each of its meshes is an object. An object by material is all that has it. Nameless objects are called
/// "object 1", …; a name that comes again gets a suffix, "wheel #2". Triangles include points, lines and parts of
/// larger faces.
struct MeshScene {
  WorldPoint origin{};                  ///< what was subtracted from coordinates of the file; times --scale afterwards
  std::vector<std::string> names;       ///< one for each object, all different
  std::vector<Box> boxes;               ///< one for each object
  std::vector<MeshPart> parts;          ///< at least one of each object, by object
  std::vector<MeshTriangle> triangles;  ///< by object; empty if they were not asked for
};

/// What is read of a file.
struct MeshReading {
  bool triangles = true;
  bool by_material = false;  ///< objects are materials, not nodes
  /// What is subtracted from coordinates before they are rounded to floats. If it is not given, and the file has digits
  /// that floats lose (mesh_origin.hpp), it is chosen.
  std::optional<WorldPoint> origin = WorldPoint{};
};

/// Reads any format that assimp knows. Throws InvalidArgument, naming the file, if it is missing, empty, broken, of an
/// unknown format, has no face in it, or has a vertex that is not finite.
[[nodiscard]] MeshScene load_mesh(const std::string& path, const MeshReading& reading);

}  // namespace shaftcull::cli
