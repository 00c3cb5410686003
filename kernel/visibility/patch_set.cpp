// SPDX-License-Identifier: MIT
/// Sets of patches: what they are made of is checked, and put in a tree.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "shaftcull/visibility.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull {
namespace {

/// Checks patches before anything is made of them. `boxes` has `count` boxes: a view or a span.
template <class Boxes>
void require_patches(const Boxes& boxes, std::size_t count, std::span<const Plane> planes) {
  kernel::require_memory("planes", planes, "planes");
  if (!planes.empty() && planes.size() != count) {
    kernel::fail(InvalidArgument(kernel::counted(planes.size(), "plane") + " for " + std::to_string(count) +
                                 " patches; there must be one for each, or none"));
  }
  if (count >= std::numeric_limits<std::uint32_t>::max()) {
    kernel::fail(InvalidArgument(std::to_string(count) + " patches; there may be at most 2^32 - 2"));
  }
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

}  // namespace

PatchSet::PatchSet(const BoxView& boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

PatchSet::PatchSet(std::span<const Box> boxes, std::span<const Plane> planes) : PatchSet(patch_tree(boxes, planes)) {}

const kernel::PatchTree& PatchSet::tree() const noexcept {
  static const kernel::PatchTree none;
  return tree_ ? *tree_ : none;
}
std::size_t PatchSet::size() const noexcept { return tree().order().size(); }
bool PatchSet::has_planes() const noexcept { return tree().has_planes(); }
std::span<const std::uint32_t> PatchSet::order() const noexcept { return tree().order(); }

}  // namespace shaftcull
