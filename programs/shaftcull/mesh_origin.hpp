// SPDX-License-Identifier: MIT
/// Mesh files in map coordinates: their vertices in doubles, relative to an origin near them. assimp reads floats.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "mesh.hpp"

namespace shaftcull::cli {

/// Where the coordinates are in a file that may have more digits of them than floats: an OBJ file, an STL or PLY file
/// of text, or a binary PLY file of doubles.
struct VertexPlaces {
  bool is_text = true;
  std::string_view keyword;            ///< text: how lines of vertices begin; empty in PLY files
  std::size_t first = 0;               ///< PLY: the line, from 0, or the byte at which vertices begin
  std::size_t count = 0;               ///< PLY: of vertices
  std::size_t stride = 0;              ///< binary: bytes from one vertex to the next
  bool is_big_endian = false;          ///< binary
  std::array<std::size_t, 3> place{};  ///< of x, y and z: the word in a line, or the byte in a vertex
};

/// Returns nothing if the coordinates are floats already, or if only assimp reads the file. `ending` says which format
/// the file has: "obj", "stl", "ply" or another. assimp divides text in more ways than into lines: files in which that
/// matters are left to it.
[[nodiscard]] std::optional<VertexPlaces> vertex_places(std::string_view bytes, std::string_view ending);

/// The box around the vertices; nothing if one of them cannot be read here.
struct VertexExtent {
  WorldPoint lo;
  WorldPoint hi;
};
[[nodiscard]] std::optional<VertexExtent> extent_of(std::string_view bytes, const VertexPlaces& places);

/// A whole number on each axis near the middle of the vertices, if they are so far from 0 that floats near the middle
/// are eight times as fine. Otherwise nothing.
[[nodiscard]] std::optional<WorldPoint> origin_of(const VertexExtent& extent);

/// The same file with its vertices relative to an origin: coordinates are read and subtracted in doubles, and written
/// with all digits. Throws InvalidArgument, naming the line of the file that is called `name`, for a vertex that is not
/// three finite numbers, or that has a weight.
[[nodiscard]] std::string relative_to(const WorldPoint& origin, std::string_view bytes, const VertexPlaces& places,
                                      const std::string& name);

}  // namespace shaftcull::cli
