// SPDX-License-Identifier: MIT
#include "peers/boost_tree.hpp"

#include <cstddef>
#include <utility>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace shaftcull::bench {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::point<float, 3, geometry::cs::cartesian>;
using Entry = std::pair<geometry::model::box<Point>, std::uint32_t>;

Entry entry_of(const Box& box, std::uint32_t index) {
  return {{Point(box.lo[0], box.lo[1], box.lo[2]), Point(box.hi[0], box.hi[1], box.hi[2])}, index};
}

std::vector<Entry> entries_of(std::span<const Box> boxes) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    entries.push_back(entry_of(boxes[i], static_cast<std::uint32_t>(i)));
  }
  return entries;
}

}  // namespace

struct BoostTree::Tree {
  explicit Tree(const std::vector<Entry>& entries) : boxes(entries) {}
  geometry::index::rtree<Entry, geometry::index::rstar<16>> boxes;
};

BoostTree::BoostTree(std::span<const Box> boxes) : tree_(std::make_unique<Tree>(entries_of(boxes))) {}
BoostTree::~BoostTree() = default;

void BoostTree::replace(std::uint32_t index, const Box& before, const Box& after) {
  tree_->boxes.remove(entry_of(before, index));
  tree_->boxes.insert(entry_of(after, index));
}

}  // namespace shaftcull::bench
