// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parallel/parallel.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/volumes.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/light_rays.hpp"
#include "visibility/patch_outline.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/visibility_arguments.hpp"

namespace shaftcull {
namespace {

/// A vector of length 1, of one that a caller gave at this position.
Vec3 unit_vector(const Vec3& direction, std::size_t position) {
  double square = 0;
  for (const float x : direction) square += double{x} * x;
  if (!(square > 0) || !std::isfinite(square)) {
    kernel::fail(InvalidArgument("directions[" + std::to_string(position) + "] is (" + kernel::text(direction[0]) +
                                 ", " + kernel::text(direction[1]) + ", " + kernel::text(direction[2]) +
                                 "); it is finite and not 0"));
  }
  Vec3 unit{};
  for (std::size_t k = 0; k != 3; ++k) unit[k] = static_cast<float>(direction[k] / std::sqrt(square));
  return unit;
}

/// The boxes around occluders.
BoxTree tree_of(const kernel::OccluderData& occluders) {
  if (occluders.boxes.empty()) return {};
  const float* const face = occluders.boxes[0].face;
  return BoxTree(StridedBoxes{face, face + 3, sizeof(kernel::BoxRow), occluders.size()});
}

void write_lit(const PatchSet& patches, const Occluders& occluders, std::span<const Vec3> directions,
               std::span<float> fractions, const RayOptions& options) {
  kernel::require_rays(options.rays, options.error, options.tolerance);
  // No product of such numbers overflows where there are 64-bit sizes; elsewhere no span has so many elements.
  const std::uint64_t needed = std::uint64_t{patches.size()} * directions.size();
  if (directions.size() > std::numeric_limits<std::uint32_t>::max() || fractions.size() != needed) {
    kernel::fail(InvalidArgument("fractions has " + kernel::counted(fractions.size(), "element") +
                                 "; one for each patch and direction are " + std::to_string(patches.size()) + " · " +
                                 std::to_string(directions.size()) + " = " + std::to_string(needed)));
  }
  std::vector<Vec3> lights;
  lights.reserve(directions.size());
  for (std::size_t i = 0; i != directions.size(); ++i) lights.push_back(unit_vector(directions[i], i));
  if (fractions.empty()) return;

  const kernel::PatchTree& tree = patches.tree();
  const kernel::LightRays rays(tree, occluders.data(), options.tolerance, options.rays, options.seed);
  const BoxTree boxes = tree_of(occluders.data());
  constexpr std::size_t chunk = 16;
  const auto cast = [&](std::size_t part, std::size_t) {
    std::vector<std::uint32_t> candidates;
    kernel::in_float_environment([&] {
      for (std::size_t p = part * chunk; p != std::min((part + 1) * chunk, patches.size()); ++p) {
        const std::uint32_t patch = tree.order()[p];
        const Box box = kernel::box_around_corners(kernel::outline_of(tree, p).all());
        for (std::size_t i = 0; i != lights.size(); ++i) {
          float& fraction = fractions[patch * lights.size() + i];
          fraction = 0;
          if (!rays.faces(patch, lights[i])) continue;
          list(swept_infinite(box, lights[i]), boxes, candidates);
          fraction = candidates.empty()
                         ? 1
                         : rays.cast(patch, lights[i], static_cast<std::uint32_t>(i), candidates,
                                     [&](const kernel::RayTally& so_far) { return so_far.is_within(options.error); })
                               .fraction();
        }
      }
    });
  };
  kernel::parallel_for((patches.size() + chunk - 1) / chunk, 1, cast);
}

}  // namespace

void lit_fractions(const PatchSet& patches, const Occluders& occluders, std::span<const Vec3> directions,
                   std::span<float> fractions, const RayOptions& options) {
  kernel::in_float_environment([&] { write_lit(patches, occluders, directions, fractions, options); });
}

}  // namespace shaftcull
