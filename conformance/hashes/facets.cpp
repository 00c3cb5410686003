// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::hashes {
namespace {

constexpr std::size_t facets_a_set = 20;

/// Convex polygons, as PatchSet and Occluders take them.
struct Facets {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const Vec3> operator[](std::size_t i) const {
    return std::span(corners).subspan(first[i], first[i + 1] - first[i]);
  }
};

Vec3 sum(const Vec3& p, const Vec3& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }

/// Half of a number on each axis, 0 on two of three axes for facets across an axis.
Vec3 side(Numbers& numbers, Number number, bool is_straight) {
  Vec3 to{};
  const auto axis = static_cast<std::size_t>(numbers.below(3));
  for (std::size_t k = 0; k != 3; ++k) to[k] = is_straight && k != axis ? 0.0F : 0.5F * (numbers.*number)();
  return to;
}

/// Adds a parallelogram, or a triangle, or a hexagon with parallel sides: on its own, in the plane of the one before,
/// or that turned round. A corner is off by an ulp or two now and then.
void add_facet(Numbers& numbers, Number number, std::array<Vec3, 2>& sides, Facets& to) {
  if (to.size() == 0 || numbers.below(3) != 0) {
    const bool is_straight = numbers.below(3) == 0;
    for (Vec3& one : sides) one = side(numbers, number, is_straight);
  }
  const bool is_near = to.size() != 0 && numbers.below(2) == 0;
  const Vec3 p = is_near ? sum(to.corners.back(), sides[0]) : point(numbers, number);
  const Vec3 q = sum(p, sides[0]);
  const Vec3 r = sum(q, sides[1]);
  std::vector<Vec3> facet{p, q, r};
  const int kind = numbers.below(3);
  if (kind != 0) facet.push_back(sum(p, sides[1]));
  if (kind == 2) facet = {p, q, sum(r, sides[0]), sum(sum(r, sides[0]), sides[1]), sum(r, sides[1]), sum(p, sides[1])};
  if (numbers.below(3) == 0) std::reverse(facet.begin(), facet.end());
  if (numbers.below(6) == 0) {
    for (float& x : facet[static_cast<std::size_t>(numbers.below(3))]) x = numbers.near(x);
  }
  to.corners.insert(to.corners.end(), facet.begin(), facet.end());
  to.first.push_back(to.corners.size());
}

Facets facets(Numbers& numbers, Number number, std::size_t count) {
  Facets made;
  std::array<Vec3, 2> sides{};
  while (made.size() != count) add_facet(numbers, number, sides, made);
  return made;
}

/// Solid boxes, walls that stand beside patches or in their planes, and triangles in groups.
Occluders occluders(Numbers& numbers, Number number, const Facets& patches) {
  constexpr std::size_t walls = 6;
  Occluders occluders;
  std::vector<Box> solids;
  for (int i = 0; i != 5; ++i) solids.push_back(box(numbers, number));
  occluders.add_solids(solids);
  const Facets some = facets(numbers, number, walls);
  occluders.add_polygons(some.corners, some.first);
  std::vector<Triangle> triangles;
  const Facets others = facets(numbers, number, walls);
  for (std::size_t i = 0; i != walls; ++i) {
    for (const std::span<const Vec3> facet : {patches[i], others[i]}) {
      for (std::size_t c = 2; c < facet.size(); ++c) triangles.push_back({{facet[0], facet[c - 1], facet[c]}});
    }
  }
  const TriangleStream stream{std::span<const Triangle>(triangles)};
  occluders.add_triangles(stream.view());
  return occluders;
}

/// Adds which pairs are clear and which undecided, and the candidates of these, pair by pair: all that follows from the
/// definitions alone, and not from the order of answers.
void add(const Visibility& answers, const PatchSet& a, const PatchSet& b, Digest& digest) {
  std::vector<std::uint8_t> sight(a.size() * b.size());
  for (const PairBlock& block : answers.blocks) {
    for (const std::uint32_t i : a.order().subspan(block.a.first, block.a.count)) {
      for (const std::uint32_t j : b.order().subspan(block.b.first, block.b.count)) {
        sight[i * b.size() + j] = block.sight == Sight::clear ? 1 : 2;
      }
    }
  }
  digest.add_all(std::span<const std::uint8_t>(sight));
  std::vector<std::size_t> order(answers.undecided.size());
  for (std::size_t p = 0; p != order.size(); ++p) order[p] = p;
  const auto place = [&](std::size_t p) { return answers.undecided[p].a * b.size() + answers.undecided[p].b; };
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return place(p) < place(q); });
  for (const std::size_t p : order) {
    digest.add(place(p));
    const std::size_t first = answers.first_candidate[p];
    const std::size_t count = answers.first_candidate[p + 1] - first;
    digest.add_all(std::span(answers.candidates).subspan(first, count));
  }
}

}  // namespace

/// What facets see of each other: across axes and aslant, in one plane and nearly so, with a tolerance in half of the
/// scenes.
std::uint64_t facet_sights(std::uint64_t scenes, Way /*way*/) {
  Numbers numbers;
  Digest digest;
  for (std::uint64_t s = 0; s != scenes; ++s) {
    const Number number = s % 2 == 0 ? &Numbers::grid : &Numbers::fine;
    const Facets of_a = facets(numbers, number, facets_a_set);
    const Facets of_b = facets(numbers, number, facets_a_set);
    const PatchSet a(of_a.corners, of_a.first);
    const PatchSet b(of_b.corners, of_b.first);
    const Occluders between = occluders(numbers, number, of_a);
    VisibilityOptions options;
    options.contact = s % 3 == 0 ? Contact::closed : Contact::open;
    options.solids_around_ends = s % 5 != 0;
    constexpr std::array<float, 4> tolerances{0, 0x1p-20F, 0, 0.125F};
    options.tolerance = tolerances[s / 2 % tolerances.size()];
    add(collect_visibility(a, b, between, options), a, b, digest);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
