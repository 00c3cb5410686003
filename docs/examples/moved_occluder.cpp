// An object has moved. Which stored shafts does it touch, and which pairs of patches must be
// queried again?
#include <algorithm>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

#include "by_hand.hpp"

namespace sc = shaftcull;

namespace {

// [[shafts]]
// Shafts in a tree of the boxes around them. A box touches few of the shafts that it is near,
// so each of these is tested itself.
class ShaftTree {
 public:
  explicit ShaftTree(std::vector<sc::CompiledShaft> shafts) : shafts_(std::move(shafts)) {
    std::vector<sc::Box> boxes;
    for (const sc::CompiledShaft& shaft : shafts_)
      boxes.push_back(sc::joined(shaft.a(), shaft.b()));
    tree_ = sc::BoxTree(boxes);
  }
  // The shafts that a box touches, ascending.
  std::vector<std::uint32_t> touched_by(const sc::Box& box) const {
    std::vector<std::uint32_t> indices;
    list(sc::compile(box, box), tree_, indices);  // the shaft from a box to itself is the box
    std::erase_if(indices, [&](std::uint32_t i) { return !keeps(shafts_[i], box); });
    std::ranges::sort(indices);
    return indices;
  }

 private:
  std::vector<sc::CompiledShaft> shafts_;
  sc::BoxTree tree_;
};
// [[end]]

// [[pairs]]
// The pairs of patches whose answer may change when an object moves: those that it stood
// between before, or stands between now. All other pairs are clear of both boxes.
std::vector<sc::PatchPair> pairs_to_ask_again(const sc::PatchSet& patches,
                                              const sc::Box& before, const sc::Box& now) {
  sc::Occluders moved;
  moved.add_boxes(std::vector<sc::Box>{before, now});
  std::vector<sc::PatchPair> pairs;
  visibility(patches, moved, [&](const sc::SightBatch& batch) {
    const std::span<const sc::PatchPair> undecided = batch.undecided.pairs;
    pairs.insert(pairs.end(), undecided.begin(), undecided.end());
  });
  return pairs;
}
// [[end]]

}  // namespace

int main() {
  // A hundred thousand lines of sight in a town of 1,000 × 1,000 × 20.
  by_hand::Random random;
  std::vector<sc::CompiledShaft> sights;
  for (int i = 0; i != 100000; ++i) {
    const sc::Vec3 a{random(0, 1000), random(0, 1000), random(0, 20)};
    const sc::Vec3 b{a[0] + random(-60, 60), a[1] + random(-60, 60), random(0, 20)};
    sights.push_back(sc::compile({a, a}, {b, b}));
  }
  const ShaftTree tree(sights);
  const sc::Box before{{500, 500, 0}, {512, 505, 4}};
  const sc::Box now{{503, 500, 0}, {515, 505, 4}};
  const std::vector<std::uint32_t> touched = tree.touched_by(sc::joined(before, now));
  std::size_t by_asking_all = 0;
  for (const sc::CompiledShaft& shaft : sights) {
    by_asking_all += keeps(shaft, sc::joined(before, now)) ? 1 : 0;
  }
  std::printf("%zu of 100000 shafts touched; asking all finds %zu\n", touched.size(),
              by_asking_all);

  // Patches of a floor and a ceiling, 20 × 20 each, and a cupboard that is moved.
  std::vector<sc::Box> boxes;
  std::vector<sc::Plane> planes;
  for (int i = 0; i != 800; ++i) {
    const auto x = static_cast<float>(i % 20);
    const auto y = static_cast<float>(i / 20 % 20);
    const float z = i < 400 ? 0.0F : 10.0F;
    boxes.push_back({{x, y, z}, {x + 1, y + 1, z}});
    planes.push_back({{0, 0, i < 400 ? 1.0F : -1.0F}, i < 400 ? 0.0F : -10.0F});
  }
  const sc::PatchSet patches(boxes, planes);
  const std::vector<sc::PatchPair> again =
      pairs_to_ask_again(patches, {{5, 5, 0}, {6, 6, 3}}, {{7, 5, 0}, {8, 6, 3}});
  std::printf("%zu of %d pairs to ask again\n", again.size(), 400 * 400);
}
