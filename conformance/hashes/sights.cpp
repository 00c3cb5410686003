// SPDX-License-Identifier: MIT
/// What sees what: every answer, and the candidates of pairs that are undecided.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::hashes {
namespace {

constexpr std::size_t patches_a_set = 40;

/// A box up to two units large, flat on an axis now and then.
Box small_box(Numbers& numbers, Number number) {
  const Vec3 p = point(numbers, number);
  Vec3 q{};
  for (std::size_t k = 0; k != 3; ++k) q[k] = numbers.below(3) == 0 ? p[k] : p[k] + (numbers.*number)() * 0.25F;
  return sorted(p, q);
}

PatchSet patches(Numbers& numbers, Number number, bool with_planes) {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  for (std::size_t i = 0; i != patches_a_set; ++i) {
    boxes.push_back(small_box(numbers, number));
    Plane plane{{0, 0, 0}, 0};
    plane.normal[static_cast<std::size_t>(numbers.below(3))] = numbers.below(2) == 0 ? 1.0F : -1.0F;
    for (std::size_t k = 0; k != 3; ++k) plane.offset += plane.normal[k] * boxes.back().lo[k];
    planes.push_back(plane);
  }
  return with_planes ? PatchSet(boxes, planes) : PatchSet(boxes);
}

Occluders occluders(Numbers& numbers, Number number) {
  Occluders occluders;
  std::vector<Box> boxes;
  std::vector<Box> solids;
  std::vector<Vec3> corners;
  std::vector<Triangle> triangles;
  for (int i = 0; i != 8; ++i) boxes.push_back(small_box(numbers, number));
  for (int i = 0; i != 8; ++i) solids.push_back(box(numbers, number));
  for (int i = 0; i != 8; ++i) corners.push_back(point(numbers, number));
  for (int i = 0; i != 40; ++i) {
    const Box around = small_box(numbers, number);
    triangles.push_back({{around.lo, around.hi, {around.lo[0], around.hi[1], around.lo[2]}}});
  }
  const Box wall = box(numbers, number);
  const std::array<Vec3, 4> polygon{Vec3{wall.lo[0], wall.lo[1], wall.lo[2]}, Vec3{wall.hi[0], wall.lo[1], wall.lo[2]},
                                    Vec3{wall.hi[0], wall.hi[1], wall.lo[2]}, Vec3{wall.lo[0], wall.hi[1], wall.lo[2]}};
  occluders.add_boxes(boxes);
  occluders.add_solids(solids);
  occluders.add_solid_hulls(corners, std::array<std::size_t, 2>{0, corners.size()});
  occluders.add_polygons(polygon, std::array<std::size_t, 2>{0, polygon.size()});
  occluders.add_triangles(TriangleColumns(triangles).view());
  return occluders;
}

void add(const Visibility& answers, Digest& digest) {
  for (const PairBlock& block : answers.blocks) {
    for (const PatchRun& run : {block.a, block.b}) {
      digest.add(run.first);
      digest.add(run.count);
    }
    digest.add(static_cast<std::uint64_t>(block.sight));
  }
  for (const PatchPair& pair : answers.undecided) {
    digest.add(pair.a);
    digest.add(pair.b);
  }
  for (const std::size_t first : answers.first_candidate) digest.add(std::uint64_t{first});
  digest.add_all(std::span<const std::uint32_t>(answers.candidates));
}

}  // namespace

std::uint64_t sights(std::uint64_t scenes, Way /*way*/) {
  Numbers numbers;
  Digest digest;
  for (std::uint64_t s = 0; s != scenes; ++s) {
    const Number number = s % 2 == 0 ? &Numbers::grid : &Numbers::fine;
    const PatchSet a = patches(numbers, number, s % 4 < 2);
    const PatchSet b = patches(numbers, number, s % 8 < 4);
    const Occluders between = occluders(numbers, number);
    VisibilityOptions options;
    options.contact = s % 3 == 0 ? Contact::closed : Contact::open;
    options.solids_around_ends = s % 5 != 0;
    digest.add_all(a.order());
    digest.add_all(b.order());
    add(collect_visibility(a, b, between, options), digest);
    add(collect_visibility(a, between, options), digest);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
