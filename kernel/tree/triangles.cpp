// SPDX-License-Identifier: MIT
/// Trees of triangles: a tree of the boxes around chunks of neighbouring triangles, which lie in its order.
#include "shaftcull/triangles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/tree.hpp"
#include "streams/access.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/index_range.hpp"
#include "support/list_memory.hpp"
#include "tree/outputs.hpp"
#include "tree/query.hpp"
#include "tree/triangle_parts.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::TriangleParts;

constexpr std::size_t chunk_size = TriangleTree::chunk_size;

/// A copy of the triangles, the one at order[i] at i.
TriangleStream in_order(const TriangleView& triangles, std::span<const std::uint32_t> order) {
  auto sorted = StreamAccess::not_written<TriangleStream>(order.size());
  const auto row = StreamAccess::rows(sorted);
  kernel::parallel_for(row.size(), 1, [&](std::size_t s, std::size_t) {
    for (std::size_t i = 0; i != order.size(); ++i) row[s][i] = triangles.stream[s][order[i]];
  });
  return sorted;
}

/// The boxes around each `size` triangles.
BoxStream boxes_around(const TriangleView& triangles, std::size_t size) {
  auto boxes = StreamAccess::not_written<BoxStream>(kernel::chunk_count(triangles.count, size));
  const auto row = StreamAccess::rows(boxes);
  kernel::parallel_for(3, 1, [&](std::size_t k, std::size_t) {
    for (std::size_t c = 0; c != boxes.size(); ++c) {
      const kernel::IndexRange chunk = kernel::chunk_at(triangles.count, size, c);
      float lo = triangles.stream[k][chunk.first];
      float hi = lo;
      for (std::size_t s = k; s < triangles.stream.size(); s += 3) {
        for (std::size_t i = chunk.first; i != chunk.end(); ++i) {
          lo = std::min(lo, triangles.stream[s][i]);
          hi = std::max(hi, triangles.stream[s][i]);
        }
      }
      row[k][c] = lo;
      row[k + 3][c] = hi;
    }
  });
  return boxes;
}

/// Sorts triangles: neighbours together, then chunks of them in the order of the tree of their boxes.
void build(TriangleParts& parts, const TriangleStream& triangles) {
  const std::size_t size = triangles.size();
  std::vector<std::uint32_t> neighbours;
  {
    const BoxTree sorted(boxes_around(triangles, 1).view());
    neighbours.assign(sorted.order().begin(), sorted.order().end());
  }
  parts.chunks = BoxTree(boxes_around(in_order(triangles, neighbours), chunk_size).view());
  const std::span<const std::uint32_t> chunk_order = parts.chunks.order();
  parts.order = kernel::TreeArray<std::uint32_t>(size);
  std::uint32_t* next = parts.order.data();
  for (std::size_t leaf = 0; leaf != chunk_order.size(); ++leaf) {
    const kernel::IndexRange chunk = kernel::chunk_at(size, chunk_size, chunk_order[leaf]);
    next = std::copy_n(neighbours.data() + chunk.first, chunk.size, next);
    if (chunk.size == chunk_size) continue;
    parts.short_chunk = leaf;
    parts.missing = chunk_size - chunk.size;
  }
  parts.triangles = in_order(triangles, parts.order);
}

/// Visitor that tests the triangles of chunks that a walk keeps, in tree order. take(first, bits, words) gets the bits
/// of triangles from `first` on that are kept, and returns whether it wants more.
template <class Take>
class TriangleVisitor {
 public:
  static constexpr bool looks_into_leaves = true;

  TriangleVisitor(const TriangleParts& parts, const kernel::ShaftData& shaft, kernel::Test* keep,
                  const Take& take) noexcept
      : parts_(parts), shaft_(shaft), keep_(keep), take_(take) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t /*inside*/) {
    while (kept != 0 && !is_done_) {
      const auto from = static_cast<unsigned>(std::countr_zero(kept));
      const auto leaves = static_cast<unsigned>(std::countr_one(kept >> from));
      const kernel::IndexRange range = parts_.triangles_of(first + from, leaves);
      const TriangleView part = parts_.triangles.view().slice(range.first, range.size);
      std::uint64_t bits[most_words];
      keep_(shaft_, part.stream.data(), part.count, bits, nullptr);
      is_done_ = !take_(range.first, bits, words_for(range.size));
      if (from + leaves == kernel::fanout) return;
      kept &= ~std::uint64_t{0} << (from + leaves);
    }
  }
  /// All of these chunks are inside, so their triangles are kept.
  void range(std::size_t first, std::size_t size) {
    for (std::size_t leaf = first; leaf < first + size && !is_done_; leaf += kernel::fanout) {
      const kernel::IndexRange range = parts_.triangles_of(leaf, kernel::fanout);
      std::uint64_t bits[most_words];
      std::fill_n(bits, words_for(range.size), ~std::uint64_t{0});
      if (range.size % 64 != 0) bits[range.size / 64] = (std::uint64_t{1} << range.size % 64) - 1;
      is_done_ = !take_(range.first, bits, words_for(range.size));
    }
  }
  [[nodiscard]] bool is_done() const noexcept { return is_done_; }

 private:
  static constexpr std::size_t most_words = kernel::fanout * chunk_size / 64;

  const TriangleParts& parts_;
  const kernel::ShaftData& shaft_;
  kernel::Test* keep_;
  const Take& take_;
  bool is_done_ = false;
};

/// A checked question to a tree of triangles.
class TriangleQuery {
 public:
  TriangleQuery(std::span<const CompiledShaft> shafts, const TriangleTree& tree, TriangleTest test)
      : parts_(TriangleTreeAccess::parts(tree)),
        data_(kernel::data_of(shafts)),
        query_(shafts, parts_.chunks, kernel::Question::kept, {}),
        keep_(test == TriangleTest::exact ? kernel::active_kernels().triangles_exactly
                                          : kernel::active_kernels().triangles_by_vertices) {
    kernel::require_triangle_test(test);
    for (std::size_t s = 0; s != data_.size(); ++s) {
      kernel::require_triangle_answers(data_[s], test == TriangleTest::exact, s);
    }
  }

  [[nodiscard]] std::size_t shafts() const noexcept { return data_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.order.size(); }

  /// Calls take(first, bits, words) as TriangleVisitor says.
  template <class Take>
  void walk(std::size_t s, const Take& take) const {
    TriangleVisitor<Take> visitor(parts_, data_[s], keep_, take);
    query_.walk(s, visitor);
  }

  /// Calls use(the user's index) for every triangle that shaft s keeps.
  template <class Use>
  void for_each(std::size_t s, const Use& use) const {
    walk(s, [&](std::size_t first, const std::uint64_t* bits, std::size_t words) {
      for (std::size_t w = 0; w != words; ++w) {
        for (std::uint64_t left = bits[w]; left != 0; left &= left - 1) {
          use(parts_.order[first + 64 * w + static_cast<std::size_t>(std::countr_zero(left))]);
        }
      }
      return true;
    });
  }
  [[nodiscard]] std::size_t count(std::size_t s) const {
    std::size_t count = 0;
    walk(s, [&](std::size_t, const std::uint64_t* bits, std::size_t words) {
      for (std::size_t w = 0; w != words; ++w) count += static_cast<std::size_t>(std::popcount(bits[w]));
      return true;
    });
    return count;
  }
  [[nodiscard]] bool any(std::size_t s) const {
    bool is_any = false;
    walk(s, [&](std::size_t, const std::uint64_t* bits, std::size_t words) {
      is_any = std::any_of(bits, bits + words, [](std::uint64_t word) { return word != 0; });
      return !is_any;
    });
    return is_any;
  }
  void write_bits(std::size_t s, std::uint64_t* kept) const {
    std::fill_n(kept, words_for(size()), 0);
    for_each(s, [&](std::uint32_t index) { kept[index / 64] |= std::uint64_t{1} << index % 64; });
  }

 private:
  const TriangleParts& parts_;
  std::span<const kernel::ShaftData> data_;
  kernel::Query<Box> query_;
  kernel::Test* keep_;
};

/// Calls use(s) for every shaft, in parallel, `each` of them in a task.
template <class Use>
void for_each_shaft_of(std::size_t shafts, std::size_t each, const Use& use) {
  kernel::parallel_for(kernel::chunk_count(shafts, each), 1, [&](std::size_t t, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(shafts, each, t);
    for (std::size_t s = task.first; s != task.end(); ++s) use(s);
  });
}

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
  build(*parts, triangles);
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
  return sizeof *parts_ + parts_->triangles.memory_bytes() + parts_->order.bytes() + parts_->chunks.memory_bytes();
}

TriangleView TriangleTree::triangles() const noexcept { return TriangleTreeAccess::parts(*this).triangles.view(); }

std::span<const std::uint32_t> TriangleTree::order() const noexcept { return TriangleTreeAccess::parts(*this).order; }

Box TriangleTree::box() const { return TriangleTreeAccess::parts(*this).chunks.box(); }

void cull(const CompiledShaft& shaft, const TriangleTree& tree, std::span<std::uint64_t> kept, TriangleTest test) {
  const TriangleQuery query({&shaft, 1}, tree, test);
  kernel::require_words("kept", kept, query.size());
  query.write_bits(0, kept.data());
}

std::size_t count(const CompiledShaft& shaft, const TriangleTree& tree, TriangleTest test) {
  return TriangleQuery({&shaft, 1}, tree, test).count(0);
}

bool any(const CompiledShaft& shaft, const TriangleTree& tree, TriangleTest test) {
  return TriangleQuery({&shaft, 1}, tree, test).any(0);
}

std::size_t list(const CompiledShaft& shaft, const TriangleTree& tree, std::span<std::uint32_t> kept,
                 TriangleTest test) {
  const TriangleQuery query({&shaft, 1}, tree, test);
  kernel::require_memory("kept", kept, "indices");
  kernel::SpanOutput<std::uint32_t> output(kept);
  query.for_each(0, [&](std::uint32_t index) { output.push(index); });
  return output.count();
}

void cull_many(std::span<const CompiledShaft> shafts, const TriangleTree& tree, std::span<std::uint64_t> kept_rows,
               TriangleTest test) {
  const TriangleQuery query(shafts, tree, test);
  const std::size_t row = words_for(query.size());
  kernel::require_rows("kept_rows", kept_rows, shafts.size(), row);
  if (row == 0) return;
  for_each_shaft_of(shafts.size(), 1, [&](std::size_t s) { query.write_bits(s, kept_rows.data() + s * row); });
}

void count_many(std::span<const CompiledShaft> shafts, const TriangleTree& tree, std::span<std::uint64_t> kept_counts,
                TriangleTest test) {
  const TriangleQuery query(shafts, tree, test);
  kernel::require_counts("kept_counts", kept_counts, shafts.size());
  for_each_shaft_of(shafts.size(), kernel::task_shafts, [&](std::size_t s) { kept_counts[s] = query.count(s); });
}

void any_many(std::span<const CompiledShaft> shafts, const TriangleTree& tree, std::span<std::uint64_t> any,
              TriangleTest test) {
  const TriangleQuery query(shafts, tree, test);
  kernel::require_shaft_bits("any", any, shafts.size());
  for_each_shaft_of(any.size(), 1, [&](std::size_t w) {  // no two tasks share a word
    std::uint64_t bits = 0;
    for (std::size_t s = 64 * w; s != std::min(shafts.size(), 64 * (w + 1)); ++s) {
      bits |= std::uint64_t{query.any(s)} << s % 64;
    }
    any[w] = bits;
  });
}

void list_many(std::span<const CompiledShaft> shafts, const TriangleTree& tree, IndexLists& lists, TriangleTest test) {
  const TriangleQuery query(shafts, tree, test);
  const std::size_t tasks = kernel::chunk_count(shafts.size(), kernel::task_shafts);
  std::vector<kernel::GrowingOutput<std::uint32_t>> listed(tasks);
  kernel::IncompleteLists<std::uint32_t> in_progress(lists.offsets, lists.indices);
  lists.offsets.assign(shafts.size() + 1, 0);
  for_each_shaft_of(shafts.size(), kernel::task_shafts, [&](std::size_t s) {
    auto& output = listed[s / kernel::task_shafts];
    query.for_each(s, [&](std::uint32_t index) { output.push(index); });
    lists.offsets[s + 1] = output.count();  // from the task's first list on
  });
  std::uint64_t before = 0;
  for (std::size_t t = 0; t != tasks; ++t) {
    const kernel::IndexRange task = kernel::chunk_at(shafts.size(), kernel::task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) lists.offsets[s + 1] += before;
    before = lists.offsets[task.end()];
  }
  in_progress.resize_items(before);
  kernel::parallel_for(tasks, 1, [&](std::size_t t, std::size_t) {
    const auto done = std::move(listed[t]);
    std::copy_n(done.data(), done.count(), lists.indices.data() + lists.offsets[t * kernel::task_shafts]);
  });
  in_progress.complete();
}

}  // namespace shaftcull
