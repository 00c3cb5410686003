// SPDX-License-Identifier: MIT
/// A walk through the largest tree that there can be, in little memory: pages that nobody has written to are all the
/// same one.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "sanitizers.hpp"
#include "shaftcull/isa.hpp"
#include "tree/parts.hpp"
#include "tree/walked.hpp"

namespace {

constexpr std::size_t page = 4096;

/// Whether that much is asked for only by this test, which reads little of it.
bool is_vast(std::size_t bytes) { return bytes > std::size_t{1} << 30U; }

}  // namespace

// Streams are allocated by these. Each piece begins with a page that holds its size.
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  const std::size_t size = bytes + page;
  char* memory = nullptr;
  if (is_vast(bytes)) {
    void* const mapped =
        mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (mapped != MAP_FAILED) memory = static_cast<char*>(mapped);
  } else {
    memory = static_cast<char*>(std::aligned_alloc(page, (size + page - 1) / page * page));
  }
  if (memory == nullptr || static_cast<std::size_t>(alignment) > page) throw std::bad_alloc();
  new (memory) std::size_t(bytes);
  return memory + page;
}
void operator delete[](void* pointer, std::align_val_t) noexcept {
  if (pointer == nullptr) return;
  char* const memory = static_cast<char*>(pointer) - page;
  const std::size_t bytes = *std::launder(reinterpret_cast<std::size_t*>(memory));
  is_vast(bytes) ? static_cast<void>(munmap(memory, bytes + page)) : std::free(memory);
}

namespace shaftcull {
namespace {

using kernel::TreeLevels;

constexpr std::size_t size = std::numeric_limits<std::uint32_t>::max();

/// A tree whose boxes are all the point at the origin: memory that nobody has written to reads as zeros.
TreeLevels<Box> origins() {
  TreeLevels<Box> tree;
  tree.size = size;
  tree.level[0] = {size, 0};
  tree.levels = 1;
  std::size_t nodes = 0;
  while (tree.level[tree.levels - 1].words() > kernel::top_words) {
    const std::size_t entries = tree.level[tree.levels - 1].words();
    tree.level.at(tree.levels) = {entries, nodes};
    nodes += tree.level[tree.levels].words() * 64;
    ++tree.levels;
  }
  tree.leaves = StreamAccess::not_written<BoxStream>(size);
  tree.nodes = StreamAccess::not_written<BoxStream>(nodes);
  tree.gaps = {nodes / 64, 0};
  return tree;
}

/// Makes nodes from level `k` on reach from the origin to (5, 5, 5), those above an entry of the level below.
void reach_far(TreeLevels<Box>& tree, std::size_t entry, std::size_t k) {
  for (; k != tree.levels; ++k) {
    entry /= kernel::fanout;
    for (std::size_t s = 3; s != 6; ++s) tree.node_rows(k, entry)[s][0] = 5;
  }
}

/// Leaves [first, first + size).
struct Leaves {
  std::size_t first;
  std::size_t size;
  friend bool operator==(const Leaves&, const Leaves&) = default;
};

/// Adds leaves behind the others, as one with those that they follow.
void add(std::vector<Leaves>& all, std::size_t first, std::size_t count) {
  if (!all.empty() && all.back().first + all.back().size == first) {
    all.back().size += count;
  } else {
    all.push_back({first, count});
  }
}

/// Visitor that collects what overlaps and what is inside.
struct Collector {
  std::vector<Leaves> overlap;
  std::vector<Leaves> inside;

  void word(std::size_t first, std::uint64_t kept, std::uint64_t inside_bits) {
    for (std::size_t i = 0; i != 64; ++i) {
      if ((kept >> i & 1) != 0) add((inside_bits >> i & 1) != 0 ? inside : overlap, first + i, 1);
    }
  }
  void range(std::size_t first, std::size_t count) { add(inside, first, count); }
};

TEST(WideTree, AWalkReachesAllBounds) {
  if (has_shadow_memory) GTEST_SKIP() << "a sanitizer's shadow of all this does not share pages";
  TreeLevels<Box> tree;
  try {
    tree = origins();
  } catch (const std::bad_alloc&) {
    GTEST_SKIP() << "no room for a hundred gigabytes of addresses";
  }
  const std::vector<Leaves> overlap = {
      {7, 1}, {(std::size_t{1} << 31U) - 1, 2}, {(std::size_t{1} << 31U) + 331, 1}, {size - 1, 1}};
  for (const Leaves& leaves : overlap) {
    for (std::size_t leaf = leaves.first; leaf != leaves.first + leaves.size; ++leaf) {
      for (std::size_t s = 0; s != 6; ++s) tree.leaf_rows()[s][leaf] = s == 0 ? 3 : 5;  // half outside
      reach_far(tree, leaf, 1);
    }
  }
  // A node of level 2 that is inside, beyond 31 bits: its leaves are not looked at.
  const std::size_t inside_node = (std::size_t{3} << 30U) >> 12U;
  for (std::size_t s = 0; s != 6; ++s) tree.node_rows(2, inside_node)[s][0] = 5;
  reach_far(tree, inside_node, 3);
  const std::vector<Leaves> inside = {{std::size_t{3} << 30U, 4096}};

  const CompiledShaft shaft = compile({{4, 4, 4}, {6, 6, 6}}, {{7, 7, 7}, {8, 9, 10}});
  for (const Isa isa : available_isas()) {
    select_isa(isa);
    Collector found;
    walk(tree, kernel::active_kernels(), shaft, kernel::Question::kept_and_inside, found);
    EXPECT_EQ(found.overlap, overlap) << name(isa);
    EXPECT_EQ(found.inside, inside) << name(isa);
  }
}

}  // namespace
}  // namespace shaftcull
