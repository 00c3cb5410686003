// SPDX-License-Identifier: MIT
#include "scene_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mesh_files.hpp"
#include "number.hpp"
#include "rooms.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

void SceneOptions::add(CLI::App& subcommand, const std::string& patches) {
  subcommand
      .add_option("scene,--scene", paths,
                  "Mesh files of one scene, in any format that assimp reads; - is standard input")
      ->type_name("FILE");
  CLI::Option* made = add_number(subcommand, "--rooms", rooms, 1, most_rooms,
                                 "Instead of a file: N rooms with doors and furniture, made from --seed")
                          ->type_name("N");
  subcommand.add_flag("--by-material", by_material, "Take the materials of the file as objects, not its nodes")
      ->excludes(made);
  add_number(subcommand, "--scale", choice.scale, 1e-9, 1e9,
             "Multiply coordinates by this, for example 0.001 for a file in millimetres")
      ->type_name("FACTOR");
  origin.add_option(subcommand, origin_of_meshes)->excludes(made);
  add_number(subcommand, "--patches", choice.patch_size, 1e-30, 1e30, patches)->type_name("SIZE");
  subcommand.add_flag("--flip", choice.flip,
                      "Patches see on their back side, for files with normals that point the wrong way");
  subcommand
      .add_option("--solid", choice.solid,
                  "Names or patterns ('wall*') of solid objects; those that are not closed and convex are skipped")
      ->type_name("NAME");
  subcommand.add_flag(
      "!--no-solids", choice.finds_solids,
      "Do not search for solids; by default, bodies and flat faces that hide pairs are found in the triangles");
}

void SceneOptions::require_scene(const std::string& verb) const {
  if (paths.empty() && rooms == 0) {
    throw InvalidArgument(
        fmt::format("{0}: no file is given; use shaftcull {0} FILE, or shaftcull {0} --rooms 6", verb));
  }
  if (!paths.empty() && rooms != 0) {
    throw InvalidArgument(fmt::format("{}: the file {} and --rooms {} do not go together; give one of them", verb,
                                      fmt::join(paths, ", "), rooms));
  }
}

std::string SceneOptions::source() const {
  if (rooms != 0) return fmt::format("{} room{}", rooms, rooms == 1 ? "" : "s");
  const std::size_t more = paths.size() - 1;
  const std::string& first = paths.front();
  return (first == "-" ? "standard input" : first) +
         (more == 0 ? "" : fmt::format(" and {} more file{}", more, more == 1 ? "" : "s"));
}

MeshScene SceneOptions::load() const {
  if (rooms != 0) return make_rooms(rooms, seed);
  return load_mesh_files(paths, {.by_material = by_material, .origin = origin.value()});
}

std::string SceneOptions::hint_about_normals(const SightCounts& counts) const {
  constexpr double most = 0.9;
  const double share =
      static_cast<double>(counts.facing_away) / static_cast<double>(std::max<std::uint64_t>(counts.total(), 1));
  if (choice.two_sided || share <= most) return {};
  return fmt::format("{:.1f} % of the pairs face away. If normals point the wrong way, {}{}\n", 100 * share,
                     choice.flip ? "leave out --flip" : "use --flip",
                     may_be_two_sided ? "; with --two-sided, patches see on both sides" : "");
}

}  // namespace shaftcull::cli
