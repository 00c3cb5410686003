// SPDX-License-Identifier: MIT
#include "peers/bullet.hpp"

#include <cstddef>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

namespace shaftcull::bench {
namespace {

btVector3 vector_of(const Vec3& v) { return {v[0], v[1], v[2]}; }
btDbvtVolume volume_of(const Box& box) { return btDbvtVolume::FromMM(vector_of(box.lo), vector_of(box.hi)); }

struct Collector final : btDbvt::ICollide {
  explicit Collector(std::vector<std::uint32_t>& list) : hits(list) {}
  void Process(const btDbvtNode* leaf) override { hits.push_back(static_cast<std::uint32_t>(leaf->dataAsInt)); }
  std::vector<std::uint32_t>& hits;
};

}  // namespace

struct BulletTree::Tree {
  btDbvt boxes;
  std::vector<btDbvtNode*> leaf_of;
  btAlignedObjectArray<const btDbvtNode*> stack;

  btDbvtNode* insert(const Box& box, int index) {
    btDbvtNode* const leaf = boxes.insert(volume_of(box), nullptr);
    leaf->dataAsInt = index;
    return leaf;
  }
};

BulletTree::BulletTree(std::span<const Box> boxes) : tree_(std::make_unique<Tree>()) {
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    tree_->leaf_of.push_back(tree_->insert(boxes[i], static_cast<int>(i)));
  }
}

BulletTree::~BulletTree() = default;

void BulletTree::replace(std::uint32_t index, const Box& box) {
  tree_->boxes.remove(tree_->leaf_of[index]);
  tree_->leaf_of[index] = tree_->insert(box, static_cast<int>(index));
}
void BulletTree::move(std::uint32_t index, const Box& box) {
  btDbvtVolume volume = volume_of(box);
  tree_->boxes.update(tree_->leaf_of[index], volume);
}
void BulletTree::end_frame() { tree_->boxes.optimizeIncremental(1); }

void BulletTree::sweep(const Box& from, const Box& to, std::vector<std::uint32_t>& hits) {
  hits.clear();
  const btVector3 start = (vector_of(from.lo) + vector_of(from.hi)) * 0.5F;
  const btVector3 end = (vector_of(to.lo) + vector_of(to.hi)) * 0.5F;
  const btVector3 half = (vector_of(from.hi) - vector_of(from.lo)) * 0.5F;
  // As btCollisionWorld::rayTest() prepares a ray.
  btVector3 direction = end - start;
  const btScalar length = direction.length();
  direction.normalize();
  btVector3 inverse;
  unsigned int signs[3];
  for (int k = 0; k != 3; ++k) {
    inverse[k] = direction[k] == 0.0F ? btScalar(BT_LARGE_FLOAT) : 1.0F / direction[k];
    signs[k] = inverse[k] < 0.0F ? 1U : 0U;
  }
  Collector collector(hits);
  tree_->boxes.rayTestInternal(tree_->boxes.m_root, start, end, inverse, signs, length, -half, half, tree_->stack,
                               collector);
}

}  // namespace shaftcull::bench
