// SPDX-License-Identifier: MIT
#include "mesh_files.hpp"

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "file_path.hpp"
#include "isolated_mesh.hpp"

namespace shaftcull::cli {
namespace {

/// Adds the objects of a file, which is called so. `taken` are names of others.
void append(MeshScene& scene, MeshScene more, const std::string& file, std::set<std::string>& taken) {
  const auto first_object = static_cast<std::uint32_t>(scene.names.size());
  const auto first_part = static_cast<std::uint32_t>(scene.parts.size());
  for (const std::string& name : more.names) {
    const std::string wanted = more.names.size() == 1 ? file : fmt::format("{}/{}", file, name);
    std::string unique = wanted;
    for (int copy = 2; !taken.insert(unique).second; ++copy) unique = fmt::format("{} #{}", wanted, copy);
    scene.names.push_back(unique);
  }
  for (MeshPart& part : more.parts) part.object += first_object;
  for (MeshTriangle& triangle : more.triangles) {
    triangle.object += first_object;
    triangle.part += first_part;
  }
  scene.boxes.insert(scene.boxes.end(), more.boxes.begin(), more.boxes.end());
  scene.parts.insert(scene.parts.end(), more.parts.begin(), more.parts.end());
  scene.triangles.insert(scene.triangles.end(), more.triangles.begin(), more.triangles.end());
}

}  // namespace

MeshScene load_mesh_files(std::span<const std::string> paths, const MeshReading& reading) {
  if (paths.size() == 1) return load_mesh_isolated(paths.front(), reading);
  MeshScene scene;
  std::set<std::string> taken;
  MeshReading same_origin = reading;
  for (const std::string& path : paths) {
    MeshScene more = load_mesh_isolated(path, same_origin);
    same_origin.origin = scene.origin = more.origin;
    append(scene, std::move(more), file_name(file_path(path).stem()), taken);
  }
  return scene;
}

}  // namespace shaftcull::cli
