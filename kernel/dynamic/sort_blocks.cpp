// SPDX-License-Identifier: MIT
#include "dynamic/sort_blocks.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"
#include "support/exact_floats.hpp"
#include "tree/entries.hpp"
#include "tree/source.hpp"
#include "tree/split.hpp"

namespace shaftcull::kernel {
namespace {

/// Entries [first, last) of one size class, in a block with those of other classes, or in some blocks of their own.
struct Run {
  std::size_t first;
  std::size_t last;
  std::size_t block;   ///< the first block
  std::size_t blocks;  ///< more than one only if no other class is in them

  [[nodiscard]] std::size_t size() const noexcept { return last - first; }
};

struct Plan {
  std::vector<Run> runs;
  std::size_t blocks = 0;
  std::size_t small_blocks = 0;  ///< the first ones; those of large bounds follow
};

[[nodiscard]] std::size_t words_for(std::size_t bounds, std::size_t in_word) noexcept {
  return (bounds + in_word - 1) / in_word;
}

/// Which classes go to which blocks: class 0 has blocks of its own, and so has each other class that fills half a
/// block; others share. If there are few bounds, all may share one.
Plan plan_blocks(const ClassBounds& class_first, bool keeps_large_apart) {
  constexpr std::size_t most = block_words * sorted_in_word;
  Plan plan;
  const auto size_of = [&](unsigned c) { return class_first[c + 1] - class_first[c]; };
  std::size_t all_words = 0;
  for (unsigned c = 0; c != size_classes; ++c) all_words += words_for(size_of(c), fanout);
  const bool all_share = !keeps_large_apart && class_first[size_classes] <= most && all_words <= block_words;
  std::size_t shared = 0;  // bounds in the block that classes share, and words that they take at least
  std::size_t words = 0;
  for (unsigned c = 0; c != size_classes; ++c) {
    if (size_of(c) == 0) continue;
    if (!all_share && (c == 0 || size_of(c) > sorted_in_block / 2)) {
      // As many as come nearest to that size: rounded up, blocks that are sorted again would be more each time.
      const std::size_t blocks =
          std::max<std::size_t>((size_of(c) + sorted_in_block / 2) / sorted_in_block, words_for(size_of(c), most));
      plan.runs.push_back({class_first[c], class_first[c + 1], plan.blocks, blocks});
      plan.blocks += blocks;
      shared = 0;
    } else {
      const std::size_t more = words_for(size_of(c), fanout);
      if (shared == 0 || shared + size_of(c) > most || words + more > block_words) {
        ++plan.blocks;
        shared = 0;
        words = 0;
      }
      shared += size_of(c);
      words += more;
      plan.runs.push_back({class_first[c], class_first[c + 1], plan.blocks - 1, 1});
    }
    if (c == 0 || all_share) plan.small_blocks = plan.blocks;
  }
  return plan;
}

/// Fills blocks with the bounds of entries.
template <class Bound>
class Filler {
 public:
  Filler(const Members<Bound>& members, const Plan& plan, const Kernels& kernels, Blocks<Bound>& blocks)
      : members_(members), kernels_(kernels), blocks_(blocks), in_block_(plan.blocks), next_word_(plan.blocks) {
    for (const Run& run : plan.runs) {
      if (run.blocks == 1) in_block_[run.block] += words_for(run.size(), sorted_in_word);
    }
  }

  /// Cuts a part of some blocks into words. `nested`: threads may help.
  void fill(const Part& part, std::size_t block, std::size_t blocks, bool nested) {
    if (blocks == 1) {
      // Where classes share a block, words that are not full may be too many.
      const std::size_t in_word = in_block_[block] > block_words ? fanout : sorted_in_word;
      fill_words(part, block, words_for(part.size(), in_word));
      return;
    }
    const std::size_t low = blocks / 2;
    const std::size_t cut = part.first + part.size() * low / blocks;
    const bool in_parallel = nested && part.size() >= fewest_for_parallel_split;
    const Halves halves = in_parallel ? split_in_parallel(part, cut, kernels_) : split(part, cut, kernels_);
    if (!nested) {
      fill(halves.low, block, low, false);
      fill(halves.high, block + low, blocks - low, false);
      return;
    }
    parallel_for_nested(2, 1, [&](std::size_t half, std::size_t) {
      if (half == 0) fill(halves.low, block, low, true);
      if (half == 1) fill(halves.high, block + low, blocks - low, true);
    });
  }

  void finish(std::size_t block) noexcept {
    LeafBlock<Bound>& made = *blocks_[block];
    made.fit(~std::uint64_t{0}, kernels_);
    made.begin_growth();
  }

 private:
  void fill_words(const Part& part, std::size_t block, std::size_t words) noexcept {
    if (words == 1) return write_word(part, block);
    const std::size_t low = words / 2;
    const Halves halves = split(part, part.first + part.size() * low / words, kernels_);
    fill_words(halves.low, block, low);
    fill_words(halves.high, block, words - low);
  }

  void write_word(const Part& part, std::size_t block) noexcept {
    LeafBlock<Bound>& to = *blocks_[block];
    const std::size_t first = next_word_[block]++ * fanout;
    for (std::size_t i = 0; i != part.size(); ++i) {
      const std::uint32_t member = index_of(*part.entries, part.first - part.origin + i);
      to.write(first + i, members_.bound(member), members_.index(member), members_.layers(member));
    }
    to.count += part.size();
  }

  const Members<Bound>& members_;
  const Kernels& kernels_;
  Blocks<Bound>& blocks_;
  std::vector<std::size_t> in_block_;   ///< words that classes would have if none were full
  std::vector<std::size_t> next_word_;  ///< of each block
};

template <class Bound>
Blocks<Bound> sort(const Members<Bound>& members, const ClassBounds& class_first, const EntryStreams& entries,
                   const EntryStreams& spare, const BlockSorting& how, bool in_parallel, const Kernels& kernels) {
  const Plan plan = plan_blocks(class_first, how.keeps_large_apart);
  Blocks<Bound> blocks(plan.blocks);
  const auto make = [&](std::size_t b, std::size_t) {
    blocks[b] = Shared<LeafBlock<Bound>>(new LeafBlock<Bound>(how.has_layers));
    blocks[b]->is_large = how.node_size > 0 && b >= plan.small_blocks;
  };
  Filler<Bound> filler(members, plan, kernels, blocks);
  const auto fill = [&](const Run& run) {
    filler.fill({run.first, run.last, &entries, &spare}, run.block, run.blocks, in_parallel);
  };
  const auto finish = [&](std::size_t b, std::size_t) { filler.finish(b); };
  if (!in_parallel) {
    for (std::size_t b = 0; b != blocks.size(); ++b) make(b, 0);
    for (const Run& run : plan.runs) fill(run);
    for (std::size_t b = 0; b != blocks.size(); ++b) finish(b, 0);
    return blocks;
  }
  parallel_for(blocks.size(), 1, make);
  // Classes that share a block are filled one after the other.
  parallel_for(2, 1, [&](std::size_t own, std::size_t) {
    for (const Run& run : plan.runs) {
      if ((run.blocks > 1) == (own == 1)) fill(run);
    }
  });
  parallel_for(blocks.size(), 1, finish);
  return blocks;
}

}  // namespace

template <class Bound>
Blocks<Bound> sorted_blocks(const Members<Bound>& members, const BlockSorting& how, const Kernels& kernels) {
  const BuildScratch<Bound> scratch(members.count());
  const ClassBounds class_first =
      write_entries_in_task<Bound>(members.records(), members.count(), how.node_size, scratch.entries());
  return sort(members, class_first, scratch.entries(), scratch.spare(), how, false, kernels);
}

template <class Bound>
Blocks<Bound> sorted_blocks_in_parallel(const Members<Bound>& members, const BlockSorting& how,
                                        const Kernels& kernels) {
  const BuildScratch<Bound> scratch(members.count());
  const RecordSource<Bound> source(records_in<Bound>(members.records(), members.count()));
  EntryPlace place = scratch.place();
  place.records = nullptr;
  const ClassBounds class_first = write_entries<Bound>(source, place);
  return sort(members, class_first, scratch.entries(), scratch.spare(), how, true, kernels);
}

#define SHAFTCULL_SORT_BLOCKS(Bound)                                                                \
  template Blocks<Bound> sorted_blocks(const Members<Bound>&, const BlockSorting&, const Kernels&); \
  template Blocks<Bound> sorted_blocks_in_parallel(const Members<Bound>&, const BlockSorting&, const Kernels&);
SHAFTCULL_SORT_BLOCKS(Box)
SHAFTCULL_SORT_BLOCKS(Sphere)
#undef SHAFTCULL_SORT_BLOCKS

}  // namespace shaftcull::kernel
