// SPDX-License-Identifier: MIT
/// Trees of triangles that move: they stay in their chunks, whose boxes follow.
#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"
#include "streams/stream_access.hpp"
#include "support/arguments.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/index_range.hpp"
#include "support/text.hpp"
#include "tree/parts.hpp"
#include "tree/tree_access.hpp"
#include "tree/triangle_parts.hpp"

namespace shaftcull::kernel {
namespace {

void note_surface(TriangleParts& parts) noexcept {
  if (parts.surface_when_built < 0) parts.surface_when_built = surface(parts.chunks.leaves());
}

/// What has no triangles yet has parts of their own only for the time of a call.
template <class Use>
void use_parts(TriangleTree& tree, Use&& use) {
  TriangleParts nothing;
  TriangleParts* const parts = TriangleTreeAccess::parts(tree);
  in_float_environment([&] { use(parts == nullptr ? nothing : *parts); });
}

void update_all_triangles(TriangleParts& parts, const TriangleStream& triangles) {
  const std::size_t size = parts.order.size();
  if (triangles.size() != size) {
    fail(InvalidArgument("update of a tree of " + counted(size, "triangle") + " got " +
                         std::to_string(triangles.size()) +
                         "; give one for each, or the indices of those that changed"));
  }
  if (size == 0) return;
  note_surface(parts);
  TriangleStream sorted = triangles_in_order(triangles, parts.order);
  auto boxes = StreamAccess::not_written<BoxStream>(parts.chunks.size());
  const auto row = StreamAccess::rows(boxes);
  const std::span<const std::uint32_t> chunk_order = parts.chunks.order();
  constexpr std::size_t in_task = 1024;
  parallel_for(chunk_count(boxes.size(), in_task), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(boxes.size(), in_task, t);
    for (std::size_t leaf = task.first; leaf != task.end(); ++leaf) {
      write_box_around(sorted, parts.triangles_of(leaf, 1), row, chunk_order[leaf]);
    }
  });
  BoxTree chunks(parts.chunks);  // which may be left half updated
  chunks.update(boxes.view());
  std::swap(parts.triangles, sorted);
  std::swap(parts.chunks, chunks);
}

void update_some_triangles(TriangleParts& parts, std::span<const std::uint32_t> indices,
                           const TriangleStream& triangles) {
  if (indices.size() != triangles.size()) {
    fail(InvalidArgument("update got " + counted_indices(indices.size()) + " and " +
                         counted(triangles.size(), "triangle") + "; every index needs one triangle"));
  }
  require_below("update: indices", indices, parts.order.size());
  if (indices.empty()) return;
  note_surface(parts);
  const std::uint32_t* const place = parts.places.of(parts.order);
  std::vector<std::uint32_t> leaves(indices.size());
  std::transform(indices.begin(), indices.end(), leaves.begin(),
                 [&](std::uint32_t index) { return static_cast<std::uint32_t>(parts.leaf_of(place[index])); });
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  std::vector<std::uint32_t> chunk_indices(leaves.size());
  std::transform(leaves.begin(), leaves.end(), chunk_indices.begin(),
                 [&](std::uint32_t leaf) { return parts.chunks.order()[leaf]; });
  auto boxes = StreamAccess::not_written<BoxStream>(leaves.size());
  // The old boxes first: after that the tree of chunks allocates nothing, and nothing throws.
  for (std::size_t k = 0; k != 6; ++k) {
    for (std::size_t i = 0; i != leaves.size(); ++i) {
      StreamAccess::rows(boxes)[k][i] = parts.chunks.leaves().stream[k][leaves[i]];
    }
  }
  parts.chunks.update(std::span<const std::uint32_t>(chunk_indices), boxes.view());
  const auto row = StreamAccess::rows(parts.triangles);
  for (std::size_t s = 0; s != row.size(); ++s) {
    for (std::size_t i = 0; i != indices.size(); ++i) row[s][place[indices[i]]] = triangles.view().stream[s][i];
  }
  for (std::size_t i = 0; i != leaves.size(); ++i) {
    write_box_around(parts.triangles, parts.triangles_of(leaves[i], 1), StreamAccess::rows(boxes), i);
  }
  parts.chunks.update(std::span<const std::uint32_t>(chunk_indices), boxes.view());
}

}  // namespace
}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

void TriangleTree::update(std::span<const Triangle> all) {
  kernel::use_parts(*this, [&](auto& parts) { kernel::update_all_triangles(parts, TriangleStream(all)); });
}
void TriangleTree::update(const TriangleView& all) {
  kernel::use_parts(*this, [&](auto& parts) { kernel::update_all_triangles(parts, TriangleStream(all)); });
}
void TriangleTree::update(const MeshView& all) {
  kernel::use_parts(*this, [&](auto& parts) { kernel::update_all_triangles(parts, TriangleStream(all)); });
}

void TriangleTree::update(std::span<const std::uint32_t> indices, std::span<const Triangle> triangles) {
  kernel::use_parts(*this,
                    [&](auto& parts) { kernel::update_some_triangles(parts, indices, TriangleStream(triangles)); });
}
void TriangleTree::update(std::span<const std::uint32_t> indices, const TriangleView& triangles) {
  kernel::use_parts(*this,
                    [&](auto& parts) { kernel::update_some_triangles(parts, indices, TriangleStream(triangles)); });
}
void TriangleTree::update(std::span<const std::uint32_t> indices, const MeshView& triangles) {
  kernel::use_parts(*this,
                    [&](auto& parts) { kernel::update_some_triangles(parts, indices, TriangleStream(triangles)); });
}

void TriangleTree::refit() {
  if (parts_) parts_->chunks.refit();
}
bool TriangleTree::needs_refit() const noexcept { return parts_ && parts_->chunks.needs_refit(); }

double TriangleTree::sah_ratio() const {
  if (needs_refit()) kernel::fail(NeedsRefit("sah_ratio() of a tree whose bounds were updated; call refit() first"));
  if (!parts_ || parts_->surface_when_built < 0) return 1;
  return kernel::in_float_environment([&] {
    const double before = parts_->surface_when_built;
    const double now = kernel::surface(parts_->chunks.leaves());
    if (now == before) return 1.0;
    return before == 0 ? std::numeric_limits<double>::infinity() : now / before;
  });
}

void TriangleTree::rebuild() {
  if (!parts_) return;
  const std::uint32_t* const place = parts_->places.of(parts_->order);
  const TriangleStream by_index = kernel::triangles_in_order(parts_->triangles, {place, size()});
  auto sorted = std::make_unique<Parts>();
  kernel::in_float_environment([&] { kernel::build(*sorted, by_index); });
  parts_ = std::move(sorted);
}

void TriangleTree::reorder() noexcept {
  if (!parts_) return;
  std::iota(parts_->order.data(), parts_->order.data() + size(), std::uint32_t{0});
  parts_->places.reorder();
}

}  // namespace shaftcull
