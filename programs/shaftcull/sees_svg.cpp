// SPDX-License-Identifier: MIT
/// The picture of `shaftcull sees`.
#include <algorithm>

#include "patch_picture.hpp"
#include "sees_run.hpp"
#include "share_colours.hpp"

namespace shaftcull::cli {

std::string svg_of_shares(const SeesScene& scene, const SeenShares& shares, std::size_t up) {
  PictureFaces faces;
  faces.both_sides = scene.planes.empty();
  faces.objects = scene.mesh.boxes;
  for (const MeshPatch& patch : scene.patches) {
    faces.corners.insert(faces.corners.end(), patch.corner.begin(), patch.corner.end());
    faces.first.push_back(faces.corners.size());
  }
  const std::string title = "Share of the other patches that each patch sees";
  const std::span<const double> undecided = shares.undecided();
  const ShareMap all{shares.seen(), ramp_of_seen, "shares", "of the other patches are seen"};
  if (std::all_of(undecided.begin(), undecided.end(), [](double share) { return share == 0; })) {
    return picture_of(faces, {&all, 1}, up, title);
  }
  const ShareMap maps[] = {{shares.seen(), ramp_of_seen, "shares", "proven to be seen"},
                           {undecided, ramp_of_undecided, "undecided", "undecided"}};
  return picture_of(faces, maps, up, title + " for certain, and share that is undecided");
}

}  // namespace shaftcull::cli
