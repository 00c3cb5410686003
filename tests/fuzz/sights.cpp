// SPDX-License-Identifier: MIT
#include "fuzz/sights.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/check.hpp"
#include "oracle/sight_agreement.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"

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

/// Both corners as lo ≤ hi, if they are numbers.
Box box_around_corners(Box box) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) std::swap(box.lo[k], box.hi[k]);
  }
  return box;
}

TriangleView view_of(const Triangle& triangle) {
  TriangleView view{{}, 1};
  for (std::size_t i = 0; i != 9; ++i) view.stream[i] = &triangle.vertex[i / 3][i % 3];
  return view;
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

/// Boxes and planes of a case that may be used. Throws Fault if the library refuses others than the headers say.
struct Usable {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
};
Usable usable(const Case& it) {
  Usable usable;
  for (const Plane& plane : it.planes) {
    const std::vector<Box> one{Box{}};
    const std::vector<Plane> its{plane};
    if (refuses([&] { PatchSet(std::span<const Box>(one), its); }) == is_usable(plane)) {
      throw Fault("PatchSet and the definition disagree about whether a plane may be used: " + it.text());
    }
    if (is_usable(plane)) usable.planes.push_back(plane);
  }
  std::vector<Box> boxes{it.a, it.b};
  const std::size_t most = std::min(it.boxes.size(), Case::most_boxes);
  boxes.insert(boxes.end(), it.boxes.begin(), it.boxes.begin() + static_cast<std::ptrdiff_t>(most));
  for (const Box& box : boxes) {
    const std::span<const Box> one(&box, 1);
    const std::vector<Vec3> corners{box.lo, box.hi, box.lo, box.hi};
    const std::vector<std::size_t> all{0, corners.size()};
    const std::vector<Triangle> triangle{{{box.lo, box.hi, box.lo}}};
    const bool is_first = &box == boxes.data();  // boxes inside hulls take long to find
    const bool is_legal = is_usable(box);
    const bool has_numbers = is_usable(box_around_corners(box));
    Occluders occluders;
    if (refuses([&] { const PatchSet set(one); }) == is_legal ||
        refuses([&] { occluders.add_boxes(one); }) == is_legal ||
        refuses([&] { occluders.add_solids(one); }) == is_legal ||
        (is_first && refuses([&] { occluders.add_solid_hulls(corners, all); }) == has_numbers) ||
        refuses([&] { occluders.add_polygons(corners, all); }) == has_numbers ||
        refuses([&] { occluders.add_triangles(view_of(triangle[0])); }) == has_numbers) {
      throw Fault("PatchSet, Occluders and the definition disagree about whether a box may be used: " + it.text());
    }
    if (is_legal) usable.boxes.push_back(box);
  }
  return usable;
}

/// One occluder of some kind, of a box and the one after it.
void add_occluder(SightScene& scene, std::size_t kind, const Box& box, const Box& next) {
  const auto add = [](std::vector<Vec3>& corners, std::vector<std::size_t>& first, std::initializer_list<Vec3> more) {
    corners.insert(corners.end(), more);
    first.push_back(corners.size());
  };
  switch (kind) {
    case 0:
      scene.solids.push_back(box);
      break;
    case 1:
      scene.boxes.push_back(box);
      break;
    case 2:
      add(scene.hull_corners, scene.first_hull, {box.lo, box.hi, next.lo, next.hi, {box.lo[0], box.hi[1], next.lo[2]}});
      break;
    case 3:
      add(scene.polygon_corners, scene.first_polygon, {box.lo, box.hi, next.lo});
      break;
    case 4: {  // a side of the box
      const Vec3& lo = box.lo;
      const Vec3& hi = box.hi;
      add(scene.polygon_corners, scene.first_polygon,
          {lo, {hi[0], lo[1], lo[2]}, {hi[0], hi[1], lo[2]}, {lo[0], hi[1], lo[2]}});
      break;
    }
    default:
      scene.triangles.push_back({{box.lo, box.hi, next.hi}});
  }
}

/// All that is usable as patches of one set or two, and as occluders of all kinds.
SightScene scene_of(const Case& it, const Usable& usable) {
  SightScene scene{};
  scene.scenery = SightScenery::wild;
  scene.is_of_one_set = it.options.order == PlaneOrder::unsorted || it.options.order == PlaneOrder::by_volume;
  scene.contact = it.contact;
  scene.solids_around_ends = it.planes.size() % 2 == 0;
  const std::vector<Box>& boxes = usable.boxes;
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    const bool is_of_b = !scene.is_of_one_set && i % 2 != 0;
    (is_of_b ? scene.b : scene.a).push_back(boxes[i]);
    if (!usable.planes.empty()) {
      (is_of_b ? scene.b_planes : scene.a_planes).push_back(usable.planes[i % usable.planes.size()]);
    }
    // Only solids and boxes, or all kinds; one hull, since the box inside it takes long to find.
    const std::size_t kinds = it.options.formation == Formation::search ? 2 : 6;
    const std::size_t kind = (i + static_cast<std::size_t>(it.subject)) % kinds;
    add_occluder(scene, kind == 2 && scene.first_hull.size() > 1 ? 0 : kind, boxes[i], boxes[(i + 1) % boxes.size()]);
  }
  if (it.has_groups && !scene.triangles.empty()) {  // else the library makes the groups
    scene.first_triangle = {0, scene.triangles.size() / 2, scene.triangles.size()};
    if (scene.triangles.size() == 1) scene.first_triangle = {0, 1};
  }
  // In one case of three patches are polygons: facets of these boxes, or turned ones, in their planes now and then.
  const bool has_polygons = it.boxes.size() % 3 == 1 && !scene.a.empty();
  if (!has_polygons) return scene;
  scene = with_corners(std::move(scene), 64 * it.boxes.size() + it.planes.size());
  if (it.boxes.size() % 2 != 0) scene.sides = PatchSides::both;
  return scene;
}

/// Empty, or for which pair two answers differ; `expected` may change the first.
template <class Expected>
std::string difference(const SightCase& of, const Visibility& first, const Visibility& second,
                       const Expected& expected) {
  const SightTable one(of, first);
  const SightTable other(of, second);
  if (!other.fault().empty()) return other.fault();
  for (std::size_t i = 0; i != of.a.size(); ++i) {
    for (std::size_t j = 0; j != of.b.size(); ++j) {
      const std::optional<Sight> sight = expected(i, j, one.at(i, j).sight);
      const bool is_undecided = sight == Sight::undecided;
      if (sight != other.at(i, j).sight || (is_undecided && one.at(i, j).candidates != other.at(i, j).candidates)) {
        return "pair " + std::to_string(i) + ", " + std::to_string(j) + " has another answer";
      }
    }
  }
  return {};
}

/// What resolve() says of a pair, and stays undecided for one in four.
Sight verdict_on(std::size_t i, std::size_t j) { return static_cast<Sight>((i + j) % 4); }

std::string fault_of_resolving(const SightCase& of, const Visibility& plain) {
  VisibilityOptions options = of.options;
  options.resolve = [](const UndecidedPairs& undecided, std::span<Sight> verdict) {
    for (std::size_t p = 0; p != verdict.size(); ++p)
      verdict[p] = verdict_on(undecided.pairs[p].a, undecided.pairs[p].b);
  };
  const std::string fault =
      difference(of, plain, of.collect(options), [](std::size_t i, std::size_t j, std::optional<Sight> sight) {
        return sight == Sight::undecided ? verdict_on(i, j) : sight;
      });
  return fault.empty() ? fault : "with resolve(), " + fault;
}

/// So many copies of all patches that answers do not fit in the least memory at once.
std::string fault_of_little_memory(const SightScene& scene) {
  constexpr std::size_t most_patches = 96;
  SightScene many = scene;
  const auto repeat = [](auto& list, const auto& once, std::size_t times) {
    for (std::size_t n = 1; n < times; ++n) list.insert(list.end(), once.begin(), once.end());
  };
  const std::size_t times = most_patches / std::max<std::size_t>(scene.a.size() + scene.b.size(), 1);
  repeat(many.a, scene.a, times);
  repeat(many.a_planes, scene.a_planes, times);
  repeat(many.a_corners, scene.a_corners, times);
  repeat(many.b, scene.b, times);
  repeat(many.b_planes, scene.b_planes, times);
  repeat(many.b_corners, scene.b_corners, times);
  const SightCase of(many);
  VisibilityOptions little = of.options;
  little.memory = std::size_t{1} << 20;
  const std::string fault =
      difference(of, of.collect(of.options), of.collect(little),
                 [](std::size_t /*i*/, std::size_t /*j*/, std::optional<Sight> sight) { return sight; });
  return fault.empty() ? fault : "in little memory, " + fault;
}

/// The surfaces of boxes as triangles that look outwards.
std::vector<Triangle> surfaces_of(const std::vector<Box>& boxes) {
  std::vector<Triangle> triangles;
  for (const Box& box : boxes) {
    const auto corner = [&](std::size_t axis, bool above, bool first, bool second) {
      Vec3 p{};
      p[axis] = above ? box.hi[axis] : box.lo[axis];
      p[(axis + 1) % 3] = first ? box.hi[(axis + 1) % 3] : box.lo[(axis + 1) % 3];
      p[(axis + 2) % 3] = second ? box.hi[(axis + 2) % 3] : box.lo[(axis + 2) % 3];
      return p;
    };
    for (std::size_t axis = 0; axis != 3; ++axis) {
      for (const bool above : {false, true}) {
        const Vec3 low = corner(axis, above, false, false);
        const Vec3 high = corner(axis, above, true, true);
        triangles.push_back({{low, corner(axis, above, above, !above), high}});
        triangles.push_back({{low, high, corner(axis, above, !above, above)}});
      }
    }
  }
  return triangles;
}

/// Solids found in the surfaces of all boxes make pairs occluded, and change nothing else.
std::string fault_of_found(const SightCase& of, const Visibility& plain, const FoundSolids& found) {
  SightCase with_found(of.scene);
  with_found.occluders.add_found(found);
  const SightTable without(of, plain);
  const SightTable with(with_found, with_found.collect(of.options));
  if (!with.fault().empty()) return "with found solids, " + with.fault();
  for (std::size_t i = 0; i != of.a.size(); ++i) {
    for (std::size_t j = 0; j != of.b.size(); ++j) {
      const SightTable::Entry& before = without.at(i, j);
      const SightTable::Entry& now = with.at(i, j);
      if (now.sight == Sight::occluded && before.sight) continue;
      if (now.sight == Sight::facing_away && before.sight == Sight::occluded) continue;
      if (now.sight != before.sight || (now.sight == Sight::undecided && now.candidates != before.candidates)) {
        return "pair " + std::to_string(i) + ", " + std::to_string(j) + " has another answer with found solids";
      }
    }
  }
  return {};
}

}  // namespace

void check_sights(const Case& it) {
  const Usable of_case = usable(it);
  const SightScene scene = scene_of(it, of_case);
  const SightCase of(scene);
  const SightTruths truths(of);
  const std::vector<Triangle> surfaces = surfaces_of(of_case.boxes);
  const TriangleStream stream{std::span<const Triangle>(surfaces)};
  std::optional<FoundSolids> first_found;
  const Isa before = active_isa();
  std::string fault;
  for (const Isa isa : available_isas()) {
    select_isa(isa);
    if (!fault.empty()) continue;
    const Visibility all = of.collect(of.options);
    fault = truths.fault_of(all);
    if (fault.empty()) fault = fault_of_resolving(of, all);
    const FoundSolids found = find_solids(stream);
    if (!first_found) first_found = found;
    if (fault.empty() && found != *first_found) fault = "instruction sets find other solids";
    if (fault.empty()) fault = fault_of_found(of, all, found);
  }
  select_isa(before);
  constexpr std::size_t one_in = 16;
  if (fault.empty() && (it.boxes.size() + it.planes.size()) % one_in == 1) fault = fault_of_little_memory(scene);
  if (!fault.empty()) throw Fault(fault + ": " + it.text());
}

}  // namespace shaftcull::fuzz
