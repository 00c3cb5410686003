// SPDX-License-Identifier: MIT
#include "mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "mesh_import.hpp"
#include "mesh_parts.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::cli {
namespace {

/// Walks a file's nodes and collects what has faces.
class Collector {
 public:
  /// `origin` is what is subtracted yet.
  Collector(const std::string& path, const aiScene& file, const MeshReading& reading, const WorldPoint& origin)
      : path_(path), file_(file), reading_(reading), origin_(origin) {}

  MeshScene collect() {
    split_meshes_ = count_nodes_with_meshes(*file_.mRootNode) == 1;
    visit(*file_.mRootNode, aiMatrix4x4{}, {});
    for (const Object& object : objects_) add_object(object);
    if (triangles_.empty())
      throw InvalidArgument(fmt::format("{}: the file has no faces, so there is nothing to test", path_));
    scene_.parts = divide_into_parts(triangles_, (triangles_.size() + usual_parts - 1) / usual_parts);
    if (reading_.triangles) scene_.triangles = std::move(triangles_);
    return std::move(scene_);
  }

 private:
  struct PlacedMesh {
    const aiMesh* mesh;
    aiMatrix4x4 to_world;
  };
  struct Object {
    std::string name;
    std::vector<PlacedMesh> meshes;
  };

  static std::size_t count_nodes_with_meshes(const aiNode& node) {
    std::size_t count = node.mNumMeshes > 0 ? 1 : 0;
    for (unsigned i = 0; i < node.mNumChildren; ++i) count += count_nodes_with_meshes(*node.mChildren[i]);
    return count;
  }

  /// `family` is the name of the nearest node above that has one.
  void visit(const aiNode& node, const aiMatrix4x4& parent_to_world, const std::string& family) {
    const aiMatrix4x4 to_world = parent_to_world * node.mTransformation;
    const std::string own = given_name(node.mName);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *file_.mMeshes[node.mMeshes[i]];
      if (reading_.by_material) {
        object_of_material(mesh.mMaterialIndex).meshes.push_back({&mesh, to_world});
        continue;
      }
      if (i == 0 || split_meshes_) objects_.push_back({name_of(node, mesh, family), {}});
      objects_.back().meshes.push_back({&mesh, to_world});
    }
    const std::string& below = own.empty() ? family : own;
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], to_world, below);
  }

  /// Materials are objects in the order in which they are used.
  Object& object_of_material(unsigned material) {
    const auto [object, is_new] = object_of_material_.try_emplace(material, objects_.size());
    if (is_new) {
      aiString name;
      file_.mMaterials[material]->Get(AI_MATKEY_NAME, name);
      objects_.push_back({name.C_Str(), {}});
    }
    return objects_[object->second];
  }

  /// The name of a node's object that begins with this mesh, which may be empty.
  [[nodiscard]] std::string name_of(const aiNode& node, const aiMesh& mesh, const std::string& family) const {
    const std::string of_node = given_name(node.mName);
    std::string of_mesh = given_name(mesh.mName);
    if (split_meshes_ && node.mNumMeshes > 1) return of_mesh.empty() ? of_node : of_mesh;
    // The reader of glTF numbers meshes that it made of one: "lamp-0".
    if (node.mNumMeshes > 1 && of_mesh.ends_with("-0")) of_mesh.resize(of_mesh.size() - 2);
    return !of_node.empty() ? of_node : !of_mesh.empty() ? of_mesh : family;
  }

  /// Empty for names that readers make up: "ROOT", "nodes[0]" and "meshes[1]-0" of glTF, "$RelAggregates" of IFC.
  static std::string given_name(const aiString& name) {
    const std::string_view text = name.C_Str();
    const bool is_made_up =
        text.starts_with("nodes[") || text.starts_with("meshes[") || text.starts_with('$') || text == "ROOT";
    return is_made_up ? std::string() : std::string(text);
  }

  void add_object(const Object& object_in_file) {
    const auto object = static_cast<std::uint32_t>(scene_.boxes.size());
    const std::string unique = unique_name(object_in_file.name);
    Box whole = box_around({});
    std::uint32_t triangle = 0;
    for (const auto& [placed, to_world] : object_in_file.meshes) {
      const aiMesh& mesh = *placed;
      // A reflection turns the order of vertices round, and with it the side that a triangle faces.
      const bool reflects = aiMatrix3x3(to_world).Determinant() < 0;
      for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        if (mesh.mFaces[f].mNumIndices == 0) continue;
        std::array<Vec3, 3> vertices = face_vertices(mesh, mesh.mFaces[f], to_world, unique);
        if (reflects) std::swap(vertices[1], vertices[2]);
        const Box box = box_around(vertices);
        whole = joined(whole, box);
        triangles_.push_back({box, object, 0, triangle++, vertices});
      }
    }
    if (triangle == 0) return;
    taken_.insert(unique);
    scene_.boxes.push_back(whole);
    scene_.names.push_back(unique);
  }

  std::array<Vec3, 3> face_vertices(const aiMesh& mesh, const aiFace& face, const aiMatrix4x4& to_world,
                                    const std::string& object) const {
    std::array<Vec3, 3> vertices{};
    for (unsigned i = 0; i < vertices.size(); ++i) {
      // Of points and lines the last vertex is repeated; the reader has made triangles of larger faces.
      const unsigned index = face.mIndices[std::min(i, face.mNumIndices - 1)];
      // Checked before it is moved, which makes one NaN three.
      const aiVector3D& in_file = mesh.mVertices[index];
      require_finite({in_file.x, in_file.y, in_file.z}, index, object, "in the file");
      const aiVector3D vertex = to_world * in_file;
      vertices[i] = {vertex.x, vertex.y, vertex.z};
      for (std::size_t k = 0; k != 3; ++k) vertices[i][k] = static_cast<float>(double{vertices[i][k]} - origin_[k]);
      require_finite(vertices[i], index, object, "in world space");
    }
    return vertices;
  }

  void require_finite(const Vec3& p, unsigned vertex, const std::string& object, const char* where) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::isfinite(p[axis])) continue;
      throw InvalidArgument(fmt::format("{}: {} of vertex {} of '{}' is {} {}; coordinates must be finite", path_,
                                        "xyz"[axis], vertex, object, p[axis], where));
    }
  }

  std::string unique_name(std::string name) const {
    if (name.empty()) name = fmt::format("object {}", scene_.boxes.size() + 1);
    std::string unique = name;
    for (int copy = 2; taken_.contains(unique); ++copy) unique = fmt::format("{} #{}", name, copy);
    return unique;
  }

  const std::string& path_;
  const aiScene& file_;
  MeshReading reading_;
  WorldPoint origin_;
  bool split_meshes_ = false;
  std::vector<Object> objects_;
  std::map<unsigned, std::size_t> object_of_material_;
  std::set<std::string> taken_;  ///< names given
  std::vector<MeshTriangle> triangles_;
  MeshScene scene_;
};

}  // namespace

MeshScene load_mesh(const std::string& path, const MeshReading& reading) {
  const MeshImport import(path, reading.origin);
  // Where nothing was subtracted yet, coordinates are floats already.
  const WorldPoint origin = reading.origin.value_or(import.subtracted());
  WorldPoint left{};
  for (std::size_t k = 0; k != 3; ++k) left[k] = origin[k] - import.subtracted()[k];
  MeshScene scene = Collector(import.name(), import.scene(), reading, left).collect();
  scene.origin = origin;
  return scene;
}

}  // namespace shaftcull::cli
