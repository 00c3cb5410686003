// SPDX-License-Identifier: MIT
#include "fuzz/sights.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "fuzz/check.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"
#include "visibility/agreement.hpp"

namespace shaftcull::fuzz {
namespace {

bool is_usable(const Box& box) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k]) || box.lo[k] > box.hi[k]) return false;
  }
  return true;
}

bool is_usable(const Plane& plane) {
  bool is_zero = true;
  for (const float n : plane.normal) {
    if (!std::isfinite(n)) return false;
    is_zero = is_zero && n == 0;
  }
  return std::isfinite(plane.offset) && !is_zero;
}

/// Whether a call refuses a bound.
template <class Call>
bool refuses(const Call& call) {
  try {
    call();
  } catch (const BadBound&) {
    return true;
  }
  return false;
}

}  // namespace

void check_sights(const Case& it) {
  SightScene scene{};
  scene.scenery = SightScenery::wild;
  scene.is_of_one_set = true;
  scene.contact = it.options.contact;
  scene.solids_around_ends = it.planes.size() % 2 == 0;
  std::vector<Plane> planes;
  for (const Plane& plane : it.planes) {
    const std::vector<Box> one{Box{}};
    const std::vector<Plane> its{plane};
    if (refuses([&] { PatchSet(std::span<const Box>(one), its); }) == is_usable(plane)) {
      throw Fault("PatchSet and the definition disagree about whether a plane may be used: " + it.text());
    }
    if (is_usable(plane)) planes.push_back(plane);
  }
  std::vector<Box> boxes{it.a, it.b};
  const std::size_t most = std::min(it.boxes.size(), Case::most_boxes);
  boxes.insert(boxes.end(), it.boxes.begin(), it.boxes.begin() + static_cast<std::ptrdiff_t>(most));
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    const std::span<const Box> one(&boxes[i], 1);
    const bool is_legal = is_usable(boxes[i]);
    Blockers blockers;
    if (refuses([&] { const PatchSet set(one); }) == is_legal ||
        refuses([&] { blockers.add_boxes(one); }) == is_legal ||
        refuses([&] { blockers.add_solids(one); }) == is_legal) {
      throw Fault("PatchSet, Blockers and the definition disagree about whether a box may be used: " + it.text());
    }
    if (!is_legal) continue;
    scene.a.push_back(boxes[i]);
    if (!planes.empty()) scene.a_planes.push_back(planes[i % planes.size()]);
    (i % 3 == 0 ? scene.solids : scene.boxes).push_back(boxes[i]);
  }
  const SightCase of(scene);
  const SightTruths truths(of);
  const Isa before = active_isa();
  std::string fault;
  for (const Isa isa : available_isas()) {
    select_isa(isa);
    if (fault.empty()) fault = truths.fault_of(of.collect(of.options));
  }
  select_isa(before);
  if (!fault.empty()) throw Fault(fault + ": " + it.text());
}

}  // namespace shaftcull::fuzz
