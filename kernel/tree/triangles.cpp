// SPDX-License-Identifier: MIT
/// Trees of triangles: a tree of the boxes around chunks of neighbouring triangles, which lie in its order.
#include "shaftcull/triangles.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/tree.hpp"
#include "streams/stream_access.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/index_range.hpp"
#include "tree/triangle_parts.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::size_t chunk_size = TriangleTree::chunk_size;

/// The boxes around each `size` triangles.
BoxStream boxes_around(const TriangleView& triangles, std::size_t size) {
  auto boxes = StreamAccess::not_written<BoxStream>(chunk_count(triangles.count, size));
  const auto row = StreamAccess::rows(boxes);
  constexpr std::size_t in_task = 1024;
  parallel_for(chunk_count(boxes.size(), in_task), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(boxes.size(), in_task, t);
    for (std::size_t c = task.first; c != task.end(); ++c) {
      write_box_around(triangles, chunk_at(triangles.count, size, c), row, c);
    }
  });
  return boxes;
}

}  // namespace

TriangleStream triangles_in_order(const TriangleView& triangles, std::span<const std::uint32_t> order) {
  auto sorted = StreamAccess::not_written<TriangleStream>(order.size());
  const auto row = StreamAccess::rows(sorted);
  parallel_for(row.size(), 1, [&](std::size_t s, std::size_t) {
    for (std::size_t i = 0; i != order.size(); ++i) row[s][i] = triangles.stream[s][order[i]];
  });
  return sorted;
}

void build(TriangleParts& parts, const TriangleStream& triangles) {
  const std::size_t size = triangles.size();
  std::vector<std::uint32_t> neighbours;
  {
    const BoxTree sorted(boxes_around(triangles, 1).view());
    neighbours.assign(sorted.order().begin(), sorted.order().end());
  }
  parts.chunks = BoxTree(boxes_around(triangles_in_order(triangles, neighbours), chunk_size).view());
  const std::span<const std::uint32_t> chunk_order = parts.chunks.order();
  parts.order = TreeArray<std::uint32_t>(size);
  std::uint32_t* next = parts.order.data();
  for (std::size_t leaf = 0; leaf != chunk_order.size(); ++leaf) {
    const IndexRange chunk = chunk_at(size, chunk_size, chunk_order[leaf]);
    next = std::copy_n(neighbours.data() + chunk.first, chunk.size, next);
    if (chunk.size == chunk_size) continue;
    parts.short_chunk = leaf;
    parts.missing = chunk_size - chunk.size;
  }
  parts.triangles = triangles_in_order(triangles, parts.order);
}

}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// The triangles, packed and checked.
template <class Source>
TriangleStream packed(const Source& source, std::size_t count) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (count <= most) return TriangleStream(source);
  kernel::fail(InvalidArgument("a tree of " + std::to_string(count) + " triangles: with 32-bit indices it can hold " +
                               std::to_string(most) + "; build several"));
}

template <class Parts>
std::unique_ptr<Parts> built_of(const TriangleStream& triangles) {
  if (triangles.size() == 0) return nullptr;
  auto parts = std::make_unique<Parts>();
  kernel::in_float_environment([&] { kernel::build(*parts, triangles); });
  return parts;
}

}  // namespace

TriangleTree::TriangleTree() noexcept = default;
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&& other) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&& other) noexcept = default;

TriangleTree::TriangleTree(std::span<const Triangle> triangles)
    : parts_(built_of<Parts>(packed(triangles, triangles.size()))) {}
TriangleTree::TriangleTree(const TriangleView& triangles)
    : parts_(built_of<Parts>(packed(triangles, triangles.count))) {}
TriangleTree::TriangleTree(const MeshView& mesh) : parts_(built_of<Parts>(packed(mesh, mesh.size()))) {}
TriangleTree::TriangleTree(const TriangleTree& other)
    : parts_(other.parts_ ? std::make_unique<Parts>(*other.parts_) : nullptr) {}
TriangleTree& TriangleTree::operator=(const TriangleTree& other) {
  if (this != &other) parts_ = other.parts_ ? std::make_unique<Parts>(*other.parts_) : nullptr;
  return *this;
}

std::size_t TriangleTree::size() const noexcept { return TriangleTreeAccess::parts(*this).order.size(); }

std::size_t TriangleTree::memory_bytes() const noexcept {
  if (!parts_) return 0;
  return sizeof *parts_ + parts_->triangles.memory_bytes() + parts_->order.bytes() + parts_->places.bytes() +
         parts_->chunks.memory_bytes();
}

TriangleView TriangleTree::triangles() const noexcept { return TriangleTreeAccess::parts(*this).triangles.view(); }

std::span<const std::uint32_t> TriangleTree::order() const noexcept { return TriangleTreeAccess::parts(*this).order; }

Box TriangleTree::box() const { return TriangleTreeAccess::parts(*this).chunks.box(); }

}  // namespace shaftcull
