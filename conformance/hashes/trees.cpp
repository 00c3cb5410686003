// SPDX-License-Identifier: MIT
/// Trees: their order, and what shafts list in them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "hashes/moving_shaft.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::hashes {
namespace {

constexpr std::size_t bounds_a_tree = 1500;  // two levels of nodes
constexpr std::size_t shafts_a_tree = 32;

/// A small box, now and then a large one or a point; on a lattice, or not.
Box small_box(Numbers& numbers, bool on_lattice) {
  const Vec3 p = point(numbers, on_lattice ? &Numbers::grid : &Numbers::fine);
  const int kind = numbers.below(16);
  if (kind == 0) return {p, p};
  Vec3 q{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float step = on_lattice ? static_cast<float>(numbers.below(2)) : numbers.fine() * 0x1p-4F;
    q[k] = p[k] + (kind == 1 ? 8 : 1) * step;
  }
  return sorted(p, q);
}

template <class Bound>
Bound small_bound(Numbers& numbers, bool on_lattice) {
  const Box box = small_box(numbers, on_lattice);
  if constexpr (std::is_same_v<Bound, Box>) {
    return box;
  } else if constexpr (std::is_same_v<Bound, Sphere>) {
    return {box.lo, box.hi[0] - box.lo[0]};
  } else {
    return {{box.lo, box.hi, point(numbers, on_lattice ? &Numbers::grid : &Numbers::fine)}};
  }
}

std::vector<CompiledShaft> some_shafts(Numbers& numbers, bool on_lattice) {
  std::vector<CompiledShaft> shafts;
  for (std::size_t s = 0; s != shafts_a_tree; ++s) {
    const Box a = small_box(numbers, on_lattice);
    const Box b = small_box(numbers, on_lattice);
    const Vec3 movement = point(numbers, on_lattice ? &Numbers::grid : &Numbers::fine);
    shafts.push_back(moving_shaft(numbers.below(5), a, b, movement));
    if (numbers.below(2) == 0) set_contact(shafts.back(), Contact::open);
  }
  return shafts;
}

void add_lists(std::span<const CompiledShaft> shafts, const Bounds& tree, Way way, Digest& digest) {
  IndexLists lists;
  if (way == Way::many) {
    list_many(shafts, tree, lists);
  } else {
    std::vector<std::uint32_t> kept;
    lists.offsets.push_back(0);
    for (const CompiledShaft& shaft : shafts) {
      list(shaft, tree, kept);
      lists.indices.insert(lists.indices.end(), kept.begin(), kept.end());
      lists.offsets.push_back(lists.indices.size());
    }
  }
  digest.add_all(std::span<const std::uint64_t>(lists.offsets));
  digest.add_all(std::span<const std::uint32_t>(lists.indices));
}

template <class Bound, class Tree>
std::uint64_t of_trees(std::uint64_t scenes, Way way) {
  Numbers numbers;
  Digest digest;
  for (std::uint64_t s = 0; s != scenes; ++s) {
    const bool on_lattice = s % 3 == 0;
    std::vector<Bound> bounds;
    for (std::size_t i = 0; i != bounds_a_tree; ++i) bounds.push_back(small_bound<Bound>(numbers, on_lattice));
    const Tree tree{std::span<const Bound>(bounds)};
    digest.add_all(std::span<const std::uint32_t>(tree.order()));
    const std::vector<CompiledShaft> shafts = some_shafts(numbers, on_lattice);
    add_lists(shafts, tree, way, digest);
    if constexpr (!std::is_same_v<Tree, TriangleTree>) {
      std::vector<FirstContact> contacts(shafts.size());
      std::vector<KeptCounts> counts(shafts.size());
      if (way == Way::many) {
        first_contact_many(shafts, tree, contacts);
        count_classified_many(shafts, tree, counts);
      } else {
        for (std::size_t i = 0; i != shafts.size(); ++i) {
          contacts[i] = first_contact(shafts[i], tree);
          counts[i] = count_classified(shafts[i], tree);
        }
      }
      for (std::size_t i = 0; i != shafts.size(); ++i) {
        digest.add(contacts[i].index);
        digest.add_float(contacts[i].time);
        digest.add(counts[i].overlap);
        digest.add(counts[i].inside);
      }
    }
  }
  return digest.value();
}

}  // namespace

std::uint64_t box_trees(std::uint64_t scenes, Way way) { return of_trees<Box, BoxTree>(scenes, way); }
std::uint64_t sphere_trees(std::uint64_t scenes, Way way) { return of_trees<Sphere, SphereTree>(scenes, way); }
std::uint64_t triangle_trees(std::uint64_t scenes, Way way) { return of_trees<Triangle, TriangleTree>(scenes, way); }

}  // namespace shaftcull::hashes
