// SPDX-License-Identifier: MIT
/// The coloured mesh of `shaftcull sees`.
#include <algorithm>

#include "printable.hpp"
#include "sees_run.hpp"
#include "share_colours.hpp"
#include "text_lines.hpp"

namespace shaftcull::cli {
void write_ply(const SeesScene& scene, const SeenShares& shares, OutputFile& file) {
  const std::span<const double> seen = shares.seen();
  const double most = *std::max_element(seen.begin(), seen.end());
  const WorldPoint& origin = scene.mesh.origin;
  TextLines lines(file);
  lines.add("ply\nformat ascii 1.0\n");
  for (std::size_t i = 0; i < scene.mesh.names.size(); ++i) {
    lines.add("comment object {} {}\n", i, printable(scene.mesh.names[i]));
  }
  // Many programs show colours of vertices only.
  lines.add(
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty uint object\nproperty float seen\n"
      "property float undecided\nend_header\n",
      3 * scene.patches.size(), scene.patches.size());
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const auto [red, green, blue] = colour_at(ramp_of_seen, most > 0 ? seen[i] / most : 0);
    for (const Point3& corner : scene.patches[i].corner) {
      lines.add("{} {} {} {} {} {}\n", corner[0] + origin[0], corner[1] + origin[1], corner[2] + origin[2], red, green,
                blue);
    }
  }
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    lines.add("3 {} {} {} {} {:.6g} {:.6g}\n", 3 * i, 3 * i + 1, 3 * i + 2,
              scene.mesh.triangles[scene.patches[i].triangle].object, seen[i], shares.undecided()[i]);
  }
  lines.write();
}

}  // namespace shaftcull::cli
