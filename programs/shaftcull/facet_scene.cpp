// SPDX-License-Identifier: MIT
#include "facet_scene.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "output_file.hpp"
#include "patch_picture.hpp"
#include "printable.hpp"
#include "sees_objects.hpp"
#include "shaftcull/error.hpp"
#include "share_colours.hpp"
#include "table.hpp"
#include "text_lines.hpp"

namespace shaftcull::cli {
namespace {

double place_in(const FacetMap& map, std::size_t patch) {
  return map.full > 0 ? std::clamp(map.values[patch] / map.full, 0.0, 1.0) : 0;
}

}  // namespace

std::string FacetScene::described() const {
  return fmt::format("{}: {}, {}, {}{}\n", printable(source), counted(scene.mesh.names.size(), "object"),
                     counted(scene.mesh.triangles.size(), "triangle"), counted(patches.size(), "patch", "patches"),
                     patch_size == 0 ? "" : fmt::format(" of at most {}", patch_size));
}

FacetScene make_facet_scene(const SceneOptions& options, bool reports_objects) {
  std::string source = options.source();
  SeesChoice choice = options.choice;
  if (choice.patch_size == 0) choice.patch_size = 1e30;  // facets are whole
  SeesScene scene = make_sees_scene(options.load(), choice, source);
  if (reports_objects && scene.mesh.names.size() > most_objects_in_pairs) {
    throw InvalidArgument(fmt::format("--objects: a table of {} objects is too large; at most {} can be shown",
                                      grouped(scene.mesh.names.size()), grouped(most_objects_in_pairs)));
  }
  FactorPatches patches = factor_patches(scene.mesh.triangles, options.choice.patch_size);
  return {std::move(source), std::move(scene), std::move(patches), options.choice.patch_size};
}

void add_patches(NpzFile& file, const FacetScene& scene) {
  const WorldPoint& origin = scene.scene.mesh.origin;
  if (origin != WorldPoint{}) file.add({"origin", "<f8"}).append(std::span<const double>(origin));
  file.add({"patch_corners", "<f4", {3}}).append(std::span<const Vec3>(scene.patches.corners));
  const std::vector<std::int64_t> first(scene.patches.first.begin(), scene.patches.first.end());
  file.add({"first_corner", "<i8"}).append(std::span<const std::int64_t>(first));
  std::vector<std::uint32_t> objects;
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i != scene.patches.size(); ++i) {
    objects.push_back(scene.object_of(i));
    triangles.push_back(scene.triangle_of(i));
  }
  file.add({"patch_objects", "<u4"}).append(std::span<const std::uint32_t>(objects));
  file.add({"patch_triangles", "<u4"}).append(std::span<const std::uint32_t>(triangles));
}

void write_map_svg(const FacetScene& scene, const FacetMap& map, const std::string& path, std::size_t up) {
  PictureFaces faces;
  faces.objects = scene.scene.mesh.boxes;
  faces.first = scene.patches.first;
  for (const Vec3& corner : scene.patches.corners) faces.corners.push_back(in_doubles(corner));
  std::vector<double> shares(map.values.size());
  for (std::size_t i = 0; i != shares.size(); ++i) shares[i] = place_in(map, i);
  const ShareMap of_shares{shares, ramp_of_seen, map.name, map.words};
  OutputFile file(path);
  file.write(picture_of(faces, {&of_shares, 1}, up, map.title));
  file.finish();
}

void write_map_ply(const FacetScene& scene, const FacetMap& map, const std::string& path) {
  const FactorPatches& patches = scene.patches;
  const WorldPoint& origin = scene.scene.mesh.origin;
  OutputFile file(path);
  TextLines lines(file);
  lines.add("ply\nformat ascii 1.0\n");
  for (std::size_t i = 0; i != scene.scene.mesh.names.size(); ++i) {
    lines.add("comment object {} {}\n", i, printable(scene.scene.mesh.names[i]));
  }
  // Many programs show colours of vertices only.
  lines.add(
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty uint object\nproperty float {}\nend_header\n",
      patches.corners.size(), patches.size(), map.name);
  for (std::size_t i = 0; i != patches.size(); ++i) {
    const auto [red, green, blue] = colour_at(ramp_of_seen, place_in(map, i));
    for (const Vec3& corner : patches.of(i)) {
      // With an origin, all digits of the sum are those of doubles.
      if (origin == WorldPoint{}) {
        lines.add("{} {} {} {} {} {}\n", corner[0], corner[1], corner[2], red, green, blue);
      } else {
        lines.add("{} {} {} {} {} {}\n", double{corner[0]} + origin[0], double{corner[1]} + origin[1],
                  double{corner[2]} + origin[2], red, green, blue);
      }
    }
  }
  for (std::size_t i = 0; i != patches.size(); ++i) {
    const std::size_t count = patches.of(i).size();
    lines.add("{}", count);
    for (std::size_t c = 0; c != count; ++c) lines.add(" {}", patches.first[i] + c);
    lines.add(" {} {:.6g}\n", scene.object_of(i), map.values[i]);
  }
  lines.write();
  file.finish();
}

}  // namespace shaftcull::cli
