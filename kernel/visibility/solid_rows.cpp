// SPDX-License-Identifier: MIT
#include "visibility/solid_rows.hpp"

#include <algorithm>
#include <tuple>

#include "shaftcull/solids.hpp"

namespace shaftcull {
namespace {

/// Whether the relative interior of one box holds that of another one. Then it blocks all that the other one does.
bool blocks_all_of(const Box& larger, const Box& smaller) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    if (smaller.lo[k] < larger.lo[k] || smaller.hi[k] > larger.hi[k]) return false;
    if (smaller.lo[k] < smaller.hi[k] || larger.lo[k] == larger.hi[k]) continue;
    if (smaller.lo[k] == larger.lo[k] || smaller.hi[k] == larger.hi[k]) return false;  // flat, in the other one's face
  }
  return true;
}

bool is_less(const Box& a, const Box& b) noexcept { return std::tie(a.lo, a.hi) < std::tie(b.lo, b.hi); }

/// Erases those of `boxes` that a box of `larger` blocks all of. Both are sorted by lo x.
void erase_needless(std::vector<Box>& boxes, std::span<const Box> larger) {
  std::vector<const Box*> open;  // those that reach as far as the box at hand
  auto next = larger.begin();
  std::erase_if(boxes, [&](const Box& box) {
    for (; next != larger.end() && next->lo[0] <= box.lo[0]; ++next) open.push_back(&*next);
    std::erase_if(open, [&](const Box* other) { return other->hi[0] < box.lo[0]; });
    return std::any_of(open.begin(), open.end(), [&](const Box* other) { return blocks_all_of(*other, box); });
  });
}

kernel::SolidRows rows_of(std::span<const Box> boxes, std::span<const kernel::BoxRow> hull_boxes, bool with_needless) {
  std::vector<Box> together = merged_boxes(boxes);
  std::sort(together.begin(), together.end(), is_less);
  std::vector<Box> alone(boxes.begin(), boxes.end());
  std::sort(alone.begin(), alone.end(), is_less);
  alone.erase(std::unique(alone.begin(), alone.end()), alone.end());
  std::erase_if(alone,
                [&](const Box& box) { return std::binary_search(together.begin(), together.end(), box, is_less); });
  if (!with_needless) erase_needless(alone, together);
  kernel::SolidRows made;
  made.rows.reserve(hull_boxes.size() + together.size() + alone.size());
  made.rows.assign(hull_boxes.begin(), hull_boxes.end());
  made.hulls = hull_boxes.size();
  for (const std::vector<Box>* some : {&together, &alone}) {
    for (const Box& solid : *some) {
      made.rows.push_back({{solid.lo[0], solid.lo[1], solid.lo[2], solid.hi[0], solid.hi[1], solid.hi[2], 0, 0}});
    }
  }
  made.clumps = kernel::box_clumps(made.rows);
  return made;
}

}  // namespace

kernel::SolidRows kernel::solid_rows(std::span<const Box> boxes, std::span<const BoxRow> hull_boxes) {
  return rows_of(boxes, hull_boxes, false);
}

kernel::SolidRows kernel::surface_rows(std::span<const Box> boxes, std::span<const BoxRow> hull_boxes) {
  return rows_of(boxes, hull_boxes, true);
}

}  // namespace shaftcull
