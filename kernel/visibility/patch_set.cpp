// SPDX-License-Identifier: MIT
/// Sets of patches: what they are made of is checked, and put in a tree.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shaftcull/visibility.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/padding.hpp"
#include "support/text.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull {
namespace {

void require_number(std::size_t count) {
  if (count >= std::numeric_limits<std::uint32_t>::max()) {
    kernel::fail(InvalidArgument(std::to_string(count) + " patches; there may be at most 2^32 - 2"));
  }
}

/// Checks patches before anything is made of them. `boxes` has `count` boxes: a view or a span.
template <class Boxes>
void require_patches(const Boxes& boxes, std::size_t count, std::span<const Plane> planes) {
  kernel::require_memory("planes", planes, "planes");
  if (!planes.empty() && planes.size() != count) {
    kernel::fail(InvalidArgument(kernel::counted(planes.size(), "plane") + " for " + std::to_string(count) +
                                 " patches; there must be one for each, or none"));
  }
  require_number(count);
  const auto refuse = [](std::size_t i, const char* why) { kernel::refuse_bound("patch", i, why); };
  for (std::size_t i = 0; i != count; ++i) {
    kernel::require_usable_box(boxes[i], "patch", i);
    if (planes.empty()) continue;
    bool is_zero = true;
    for (const float n : planes[i].normal) {
      if (!std::isfinite(n)) refuse(i, "has a plane that is not finite");
      is_zero = is_zero && n == 0;
    }
    if (!std::isfinite(planes[i].offset)) refuse(i, "has a plane that is not finite");
    if (is_zero) refuse(i, "has a plane whose normal is zero");
  }
}

// What is checked are comparisons, of denormals, too, which the caller's modes may take for 0.
std::shared_ptr<const kernel::PatchTree> patch_tree(const BoxView& boxes, std::span<const Plane> planes) {
  kernel::require_view(boxes);
  return kernel::in_float_environment([&] {
    require_patches(boxes, boxes.count, planes);
    return std::make_shared<const kernel::PatchTree>(boxes, planes);
  });
}

std::shared_ptr<const kernel::PatchTree> patch_tree(std::span<const Box> boxes, std::span<const Plane> planes) {
  kernel::require_memory("boxes", boxes, "boxes");
  return kernel::in_float_environment([&] {
    require_patches(boxes, boxes.size(), planes);  // before the stream, which also takes empty boxes
    return std::make_shared<const kernel::PatchTree>(BoxStream(boxes).view(), planes);
  });
}

/// The plane of a patch that is the flat box around it, if it has one plane.
std::optional<Plane> plane_of_box(std::span<const Vec3> corners, const Box& box) noexcept {
  if (!kernel::are_corners_of_box(corners, box)) return std::nullopt;
  const kernel::PatchNormals normals(corners);
  if (normals.all().empty()) return std::nullopt;
  const std::array<double, 3>& n = normals.all().front();
  if (!std::all_of(normals.all().begin(), normals.all().end(), [&](const auto& other) { return other == n; })) {
    return std::nullopt;
  }
  Plane plane{};
  for (std::size_t k = 0; k != 3; ++k) {
    if (n[k] != 0 && box.lo[k] != box.hi[k]) return std::nullopt;
    plane.normal[k] = static_cast<float>(n[k]);
    plane.offset += plane.normal[k] * box.lo[k];
  }
  return plane;
}

// Where every patch is the box around it, and seen from one side, boxes and planes are the same patches, and quicker.
std::shared_ptr<const kernel::PatchTree> patch_tree(std::span<const Vec3> corners,
                                                    std::span<const std::size_t> first_corner, PatchSides sides) {
  if (sides > PatchSides::both) {
    kernel::fail(InvalidArgument("sides = " + std::to_string(static_cast<unsigned>(sides)) +
                                 " is neither PatchSides::front nor PatchSides::both"));
  }
  return kernel::in_float_environment([&] {
    kernel::require_corner_lists(corners, first_corner, "patch", 3, kernel::most_patch_corners);
    const std::size_t count = first_corner.empty() ? 0 : first_corner.size() - 1;
    require_number(count);
    std::vector<Box> boxes;
    std::vector<Plane> planes;
    for (std::size_t i = 0; i != count; ++i) {
      const std::span<const Vec3> of_patch = corners.subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
      const Box box = kernel::box_around_corners(of_patch);
      const std::optional<Plane> plane = sides == PatchSides::front ? plane_of_box(of_patch, box) : std::nullopt;
      if (!plane) return std::make_shared<const kernel::PatchTree>(corners, first_corner, sides);
      boxes.push_back(box);
      planes.push_back(*plane);
    }
    return std::make_shared<const kernel::PatchTree>(BoxStream(boxes).view(), planes);
  });
}

}  // namespace

PatchSet::PatchSet(std::span<const Vec3> corners, std::span<const std::size_t> first_corner, PatchSides sides)
    : PatchSet(patch_tree(corners, first_corner, sides)) {}

PatchSet::PatchSet(const BoxView& boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

PatchSet::PatchSet(std::span<const Box> boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

const kernel::PatchTree& PatchSet::tree() const noexcept {
  static const kernel::PatchTree none;
  return tree_ ? *tree_ : none;
}
std::size_t PatchSet::size() const noexcept { return tree().order().size(); }
bool PatchSet::has_planes() const noexcept { return tree().has_planes(); }
std::span<const std::uint32_t> PatchSet::order() const noexcept { return tree().order(); }
Box PatchSet::box() const noexcept {
  if (size() == 0) return kernel::empty_box;
  const kernel::PatchStreams& groups = tree().group_streams();
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = *groups.stream(k);
    box.hi[k] = *groups.stream(k + 3);
  }
  return box;
}

}  // namespace shaftcull
