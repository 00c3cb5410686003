// SPDX-License-Identifier: MIT
#include "peers/fcl.hpp"

#include <cstddef>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace shaftcull::bench {
namespace {

using Object = fcl::CollisionObjectf;

fcl::Vector3f middle(const Box& box) {
  return {(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2, (box.lo[2] + box.hi[2]) / 2};
}
std::unique_ptr<Object> object_of(const Box& box) {
  auto object = std::make_unique<Object>(
      std::make_shared<fcl::Boxf>(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]));
  object->setTranslation(middle(box));
  object->computeAABB();
  return object;
}

}  // namespace

struct FclTree::Tree {
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<Object*> moved;
  fcl::DynamicAABBTreeCollisionManagerf manager;  // destroyed first
};

FclTree::FclTree(std::span<const Box> boxes) : tree_(std::make_unique<Tree>()) {
  std::vector<Object*> all;
  for (const Box& box : boxes) all.push_back(tree_->objects.emplace_back(object_of(box)).get());
  tree_->manager.registerObjects(all);
  tree_->manager.setup();
}

FclTree::~FclTree() = default;

void FclTree::replace(std::uint32_t index, const Box& box) {
  std::unique_ptr<Object>& object = tree_->objects[index];
  tree_->manager.unregisterObject(object.get());
  object = object_of(box);
  tree_->manager.registerObject(object.get());
}

void FclTree::move(std::uint32_t index, const Box& box) {
  Object* const object = tree_->objects[index].get();
  object->setTranslation(middle(box));
  object->computeAABB();
  tree_->moved.push_back(object);
}

void FclTree::end_frame() {
  tree_->manager.update(tree_->moved);
  tree_->moved.clear();
}

}  // namespace shaftcull::bench
