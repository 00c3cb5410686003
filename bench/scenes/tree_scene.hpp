// SPDX-License-Identifier: MIT
/// What trees are measured on: the same boxes as records, in streams, in a tree, and in Bullet's if it is there.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "scenes/swept_boxes.hpp"
#include "shaftcull/tree.hpp"

#ifdef SHAFTCULL_BENCH_WITH_BULLET
#include "peers/bullet.hpp"
#endif

namespace shaftcull::bench {

/// What is made at the first benchmark that needs it: seconds would be lost where a filter leaves all out.
template <class Thing>
class Lazy {
 public:
  template <class Make>
  Thing& get(const Make& make) {
    if (!thing_) thing_ = std::make_unique<Thing>(make());
    return *thing_;
  }

 private:
  std::unique_ptr<Thing> thing_;
};

struct TreeScene {
  explicit TreeScene(std::size_t bounds) : count(bounds) {}

  const std::vector<Box>& boxes() {
    return boxes_.get([&] { return small_boxes(count); });
  }
  const BoxStream& stream() {
    return stream_.get([&] { return BoxStream(std::span<const Box>(boxes())); });
  }
  BoxTree& tree() {
    return tree_.get([&] { return BoxTree(stream().view()); });
  }
  /// Spheres as wide as the boxes on x, with the same centres.
  const SphereTree& sphere_tree() {
    return sphere_tree_.get([&] {
      std::vector<Sphere> spheres(count);
      for (std::size_t i = 0; i != count; ++i) {
        const Box& box = boxes()[i];
        for (std::size_t k = 0; k != 3; ++k) spheres[i].centre[k] = 0.5F * (box.lo[k] + box.hi[k]);
        spheres[i].radius = 0.5F * (box.hi[0] - box.lo[0]);
      }
      return SphereTree(std::span<const Sphere>(spheres));
    });
  }
#ifdef SHAFTCULL_BENCH_WITH_BULLET
  BulletTree& bullet() {
    if (!bullet_) bullet_ = std::make_unique<BulletTree>(boxes());
    return *bullet_;
  }
#endif
  std::size_t count;

 private:
  Lazy<std::vector<Box>> boxes_;
  Lazy<BoxStream> stream_;
  Lazy<BoxTree> tree_;
  Lazy<SphereTree> sphere_tree_;
#ifdef SHAFTCULL_BENCH_WITH_BULLET
  std::unique_ptr<BulletTree> bullet_;
#endif
};

}  // namespace shaftcull::bench
