// SPDX-License-Identifier: MIT
/// What calls that form many shafts check: index pairs, and planes of the boxes of views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "formation/usable_plane.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/compiled.hpp"
#include "support/fail.hpp"
#include "support/telling_instead.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {

/// Does what may find that shaft `index` of many cannot be formed, and fails with a BadBound then, which says so.
template <class Work>
void check_shaft(std::size_t index, const Work& work) {
  const auto bad_shaft = [index](const InvalidArgument& error) {
    return BadBound(index, "shaft " + std::to_string(index) + ": " + error.what());
  };
#if defined(__cpp_exceptions)
  try {
    work();
  } catch (const InvalidArgument& error) {
    throw bad_shaft(error);
  }
#else
  const TellingInstead::Other other = bad_shaft;
  const TellingInstead telling(other);
  work();
#endif
}

/// Throws InvalidArgument for the first pair with an index that is not below the number of boxes.
inline void require_indices(std::span<const IndexPair> pairs, std::size_t a_count, std::size_t b_count) {
  // A difference below 0 leaves the sign in what all differences have, which takes no comparison a pair.
  const auto last_a = static_cast<std::int64_t>(a_count) - 1;
  const auto last_b = static_cast<std::int64_t>(b_count) - 1;
  std::int64_t differences = 0;
  for (const IndexPair& pair : pairs) differences |= (last_a - pair.a) | (last_b - pair.b);
  if (differences >= 0) return;
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    const auto require = [&](const char* name, std::size_t index, std::size_t count) {
      if (index < count) return;
      kernel::fail(InvalidArgument("pairs[" + std::to_string(i) + "]." + name + " = " + std::to_string(index) +
                                   ", and there are " + std::to_string(count) + " boxes " + name));
    };
    require("a", pairs[i].a, a_count);
    require("b", pairs[i].b, b_count);
  }
}

/// Planes of the boxes of one view, equally many for each.
class PlanesOfBoxes {
 public:
  /// Throws InvalidArgument if they cannot be. `name` is "a" or "b".
  PlanesOfBoxes(const Kernels& kernels, std::span<const Plane> planes, std::size_t boxes, const char* name)
      : planes_(planes.data()) {
    if (planes.empty()) return;
    if (boxes == 0 || planes.size() % boxes != 0) {
      kernel::fail(InvalidArgument("planes." + std::string(name) + " has " + counted(planes.size(), "plane") +
                                   ", not equally many for each of " + std::to_string(boxes) + " boxes " + name));
    }
    each_ = planes.size() / boxes;
    if (kernels.all_planes_usable(planes.data(), planes.size())) return;
    const std::string before = "planes." + std::string(name) + "[";
    for (std::size_t i = 0; i != planes.size(); ++i) require_usable(planes[i], {before.c_str(), i, "]"});
  }

  [[nodiscard]] std::size_t each() const noexcept { return each_; }
  /// The first one of a box.
  [[nodiscard]] const Plane* of(std::size_t box) const noexcept { return planes_ + box * each_; }

 private:
  const Plane* planes_;
  std::size_t each_ = 0;
};

/// The planes of both boxes.
struct PlanesOfPairs {
  PlanesOfBoxes a;
  PlanesOfBoxes b;

  PlanesOfPairs(const Kernels& kernels, const BatchPlanes& planes, std::size_t a_count, std::size_t b_count)
      : a(kernels, planes.a, a_count, "a"), b(kernels, planes.b, b_count, "b") {
    if (a.each() <= max_added_planes && a.each() + b.each() <= max_added_planes) return;
    kernel::fail(InvalidArgument("a shaft has room for " + std::to_string(max_added_planes) +
                                 " added planes, not for " + std::to_string(a.each()) + " of box a and " +
                                 std::to_string(b.each()) + " of box b"));
  }
  [[nodiscard]] bool empty() const noexcept { return a.each() == 0 && b.each() == 0; }
};

}  // namespace shaftcull::kernel
