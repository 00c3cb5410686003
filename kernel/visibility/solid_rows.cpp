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

/// Puts those of `boxes` first that no box of `larger` blocks all of, and returns how many there are. Both are sorted
/// by lo x.
std::size_t put_needed_first(std::vector<Box>& boxes, std::span<const Box> larger) {
  std::vector<const Box*> open;  // those that reach as far as the box at hand
  auto next = larger.begin();
  const auto middle = std::stable_partition(boxes.begin(), boxes.end(), [&](const Box& box) {
    for (; next != larger.end() && next->lo[0] <= box.lo[0]; ++next) open.push_back(&*next);
    std::erase_if(open, [&](const Box* other) { return other->hi[0] < box.lo[0]; });
    return std::none_of(open.begin(), open.end(), [&](const Box* other) { return blocks_all_of(*other, box); });
  });
  return static_cast<std::size_t>(middle - boxes.begin());
}

}  // namespace

kernel::SolidRows kernel::made_solid_rows(std::span<const Box> solids, std::span<const BoxRow> hull_boxes) {
  std::vector<Box> together = merged_boxes(solids);
  std::sort(together.begin(), together.end(), is_less);
  std::vector<Box> alone(solids.begin(), solids.end());
  std::sort(alone.begin(), alone.end(), is_less);
  alone.erase(std::unique(alone.begin(), alone.end()), alone.end());
  std::erase_if(alone,
                [&](const Box& box) { return std::binary_search(together.begin(), together.end(), box, is_less); });
  SolidRows made;
  made.rows.reserve(hull_boxes.size() + together.size() + alone.size());
  made.rows.assign(hull_boxes.begin(), hull_boxes.end());
  made.hulls = hull_boxes.size();
  made.largest = made.hulls + together.size() + put_needed_first(alone, together);
  for (const std::vector<Box>* some : {&together, &alone}) {
    for (const Box& solid : *some) {
      made.rows.push_back({{solid.lo[0], solid.lo[1], solid.lo[2], solid.hi[0], solid.hi[1], solid.hi[2], 0, 0}});
    }
  }
  made.clumps = box_clumps(made.rows);
  return made;
}

}  // namespace shaftcull
