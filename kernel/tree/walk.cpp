// SPDX-License-Identifier: MIT
#include "tree/walk.hpp"

#include <bit>
#include <type_traits>

#include "exact/predicates.hpp"

namespace shaftcull::kernel {

template <class Bound>
Walk<Bound>::Walk(const TreeLevels<Bound>& parts, const Kernels& kernels, const ShaftData& shaft, Question question,
                  const Exclusion& exclusion, LeafVisitor& visitor, const VisitorTraits& traits) noexcept
    : parts_(parts),
      test_leaves_(question == Question::blocking ? kernels.blocking.listed_boxes : kernels.listed(ViewOf<Bound>{})),
      test_nodes_(question == Question::blocking ? kernels.blocking.listed_nodes : kernels.listed_boxes),
      prefetches_(parts.is_worth_prefetching()),
      question_(question),
      traits_(traits),
      visitor_(visitor),
      exclusion_(exclusion),
      excludes_(exclusion.is_on()),
      with_planes_(shaft, asks_for_inside(question) || (question == Question::kept &&
                                                        outside_needs_planes(shaft, std::is_same_v<Bound, Sphere>))),
      shaft_(with_planes_.shaft()),
      of_nodes_(shaft_),
      tests_inside_(question != Question::blocking && shaft_.has_planes()) {}

template <class Bound>
void Walk<Bound>::run() {
  if (parts_.levels == 0) return;
  std::uint32_t top[top_words];
  const std::size_t words = parts_.level[parts_.levels - 1].words();
  for (std::uint32_t w = 0; w != words; ++w) top[w] = w;
  visit(parts_.levels - 1, top, words);
}

template <class Bound>
void Walk<Bound>::visit(std::size_t k, const std::uint32_t* word, std::size_t words) {
  if (words == 0) return;
  if (k == 0) return visit_leaves(word, words);
  std::uint64_t kept[most_in_batch];
  std::uint64_t inside[most_in_batch];
  const bool tests_inside = tests_inside_;  // which no call changes
  const std::size_t batch = traits_.may_end_early ? few_in_batch : most_in_batch;
  const auto nodes = parts_.node_words(k, 0, parts_.level[k].words());
  test_nodes_(of_nodes_.shaft(), nodes.stream.data(), word, words, kept, tests_inside ? inside : nullptr,
              question_ == Question::kept ? many_kept : 1);
  std::uint32_t below[most_in_batch];
  std::size_t belows = 0;
  const std::uint64_t* const gaps = parts_.gap_words(k);
  for (std::size_t i = 0; i != words; ++i) {
    const std::uint32_t first = word[i] * static_cast<std::uint32_t>(fanout);
    std::uint64_t whole = tests_inside ? inside[i] & ~gaps[word[i]] : 0;
    if (whole != 0 && shaft_.contact == Contact::open) whole = touching_nothing(nodes, first, whole);
    std::uint64_t left = excludes_ ? exclusion_.nodes(k, first, kept[i]) : kept[i];
    for (; left != 0; left &= left - 1) {
      const std::uint64_t lowest = left & -left;
      const std::uint32_t entry = first + static_cast<std::uint32_t>(std::countr_zero(left));
      const bool is_whole = (whole & lowest) != 0;
      if (!is_whole) {
        prefetch(k - 1, entry);
        below[belows++] = entry;
        if (belows < batch) continue;
      }
      visit(k - 1, below, belows);
      belows = 0;
      if (is_done_) return;
      if (!is_whole) continue;
      const std::size_t leaves = std::size_t{1} << 6 * k;
      visit_range(entry * leaves, leaves);
      if (is_done_) return;
    }
  }
  visit(k - 1, below, belows);
}

/// Of the nodes from `first` on that are inside, those that do not touch the shaft's surface: flat leaves that lie in
/// it are outside of a shaft with open contact.
template <class Bound>
SHAFTCULL_COLD std::uint64_t Walk<Bound>::touching_nothing(const BoxView& nodes, std::size_t first,
                                                           std::uint64_t inside) const noexcept {
  std::uint64_t strictly = 0;
  for (; inside != 0; inside &= inside - 1) {
    const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(inside));
    const float node[6] = {nodes.stream[0][i], nodes.stream[1][i], nodes.stream[2][i],
                           nodes.stream[3][i], nodes.stream[4][i], nodes.stream[5][i]};
    if (box_strictly_inside(shaft_, node)) strictly |= inside & -inside;
  }
  return strictly;
}

template <class Bound>
void Walk<Bound>::visit_leaves(const std::uint32_t* word, std::size_t words) {
  std::uint64_t kept[most_in_batch];
  std::uint64_t inside[most_in_batch];
  const bool both = asks_for_inside(question_);
  const ShaftData& shaft = traits_.looks_into_leaves ? of_nodes_.shaft() : shaft_;
  if (!parts_.blocks.exist()) [[likely]] {
    test_leaves_(shaft, parts_.streams_at(0), word, words, kept, both ? inside : nullptr, 1);
  } else {
    test_blocks(shaft, word, words, kept, both ? inside : nullptr);
  }
  if (excludes_) {
    for (std::size_t i = 0; i != words; ++i) {
      if (kept[i] == 0) continue;
      kept[i] = exclusion_.leaves(std::size_t{word[i]} * fanout, kept[i]);
      if (both) inside[i] &= kept[i];
    }
  }
  is_done_ = !visitor_.words({word, kept, both ? inside : nullptr, words});
}

/// Tests words of leaves that are in blocks: those of one block at a time.
template <class Bound>
void Walk<Bound>::test_blocks(const ShaftData& shaft, const std::uint32_t* word, std::size_t words, std::uint64_t* kept,
                              std::uint64_t* inside) const noexcept {
  constexpr std::uint32_t block_words = block_leaves / fanout;
  std::uint32_t in_block[most_in_batch];
  for (std::size_t i = 0; i != words;) {
    const std::uint32_t block = word[i] / block_words;
    std::size_t end = i;
    for (; end != words && word[end] / block_words == block; ++end) {
      in_block[end - i] = word[end] % block_words * rows_of<Bound>;
    }
    test_leaves_(shaft, parts_.streams_at(block * block_leaves), in_block, end - i, kept + i,
                 inside != nullptr ? inside + i : nullptr, 1);
    i = end;
  }
}

template <class Bound>
void Walk<Bound>::visit_range(std::size_t first, std::size_t size) {
  if (parts_.blocks.exist()) return visit_range_of_blocks(first, size);
  if (excludes_) return visit_range_in_part(first, size);
  is_done_ = !visitor_.range(first, size);
}

/// The same, without what is left out.
template <class Bound>
void Walk<Bound>::visit_range_in_part(std::size_t first, std::size_t size) {
  for (std::size_t at = first; at != first + size && !is_done_; at += fanout) {
    const std::uint64_t left = exclusion_.leaves(at, ~std::uint64_t{0});
    if (left == ~std::uint64_t{0}) {
      is_done_ = !visitor_.range(at, fanout);
    } else if (left != 0) {
      const auto word = static_cast<std::uint32_t>(at / fanout);
      is_done_ = !visitor_.words({&word, &left, asks_for_inside(question_) ? &left : nullptr, 1});
    }
  }
}

/// The same of blocks, without the leaves that are free.
template <class Bound>
void Walk<Bound>::visit_range_of_blocks(std::size_t first, std::size_t size) {
  std::uint32_t word[most_in_batch];
  std::uint64_t kept[most_in_batch];
  for (std::size_t at = first; at != first + size && !is_done_;) {
    std::size_t words = 0;
    for (; at != first + size && words != most_in_batch; at += fanout) {
      std::uint64_t taken = parts_.blocks.taken[at / block_leaves][at % block_leaves / fanout];
      if (excludes_ && taken != 0) taken = exclusion_.leaves(at, taken);
      if (taken == 0) continue;
      word[words] = static_cast<std::uint32_t>(at / fanout);
      kept[words++] = taken;
    }
    if (words != 0) is_done_ = !visitor_.words({word, kept, asks_for_inside(question_) ? kept : nullptr, words});
  }
}

template class Walk<Box>;
template class Walk<Sphere>;

}  // namespace shaftcull::kernel
