// SPDX-License-Identifier: MIT
/// A mesh file, or what arrives on standard input, as assimp reads it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mesh.hpp"

struct aiScene;
namespace Assimp {
class Importer;
}  // namespace Assimp

namespace shaftcull::cli {

/// The contents of a file, as triangles, lines and points in a hierarchy of nodes.
class MeshImport {
 public:
  /// Reads a file; "-" is standard input. The ending of its name says which format a file has. Standard input and other
  /// files that are read only once, such as a pipe, have the format that their first bytes show. IFC files keep their
  /// axes: z points up. Throws InvalidArgument, naming the file, if it is missing, empty, broken or of an unknown
  /// format.
  ///
  /// Files that have more digits than floats are read relative to `origin`, in doubles, or to one that is chosen if it
  /// is not given (mesh_origin.hpp).
  MeshImport(const std::string& path, const std::optional<WorldPoint>& origin);
  MeshImport(const MeshImport&) = delete;
  MeshImport& operator=(const MeshImport&) = delete;
  ~MeshImport();

  /// What was subtracted from the coordinates of such a file; 0 for others.
  [[nodiscard]] const WorldPoint& subtracted() const noexcept { return subtracted_; }
  /// The file as messages call it.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// It has a root node, and belongs to this object.
  [[nodiscard]] const aiScene& scene() const noexcept { return *scene_; }

 private:
  std::string name_;
  WorldPoint subtracted_{};
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;
};

}  // namespace shaftcull::cli
