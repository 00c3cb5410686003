/// A mesh file as bounds in world space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// What gets a bound of its own.
enum class Grain : std::uint8_t { object, triangle };

/// One bound of a mesh: of a whole object, or of one of its triangles.
struct MeshBound {
  Box box;
  std::uint32_t object;    ///< which object
  std::uint32_t triangle;  ///< position within the object; 0 for a whole object
};

/// The objects of a mesh file and their bounds.
///
/// An object is a node of the file's hierarchy that has meshes, placed in world space, under its node's name; in a file
/// with a single such node, each of its meshes is an object. Nameless objects are called "object 1", …; a name
/// that comes again gets a suffix, "wheel #2". Triangles include points, lines and parts of larger faces.
struct MeshScene {
  std::vector<std::string> names;  ///< one for each object, all different
  std::vector<Box> boxes;          ///< one for each object
  std::vector<MeshBound> bounds;   ///< by object, then by triangle
};

/// Reads any format that assimp knows. Throws InvalidArgument, naming the file, if it is missing, empty, broken, has
/// no face in it, or has a vertex that is not finite.
[[nodiscard]] MeshScene load_mesh(const std::string& path, Grain grain);

}  // namespace shaftcull::cli
