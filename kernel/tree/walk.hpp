// SPDX-License-Identifier: MIT
/// The walk of one shaft through a tree: word by word of answers, from the top down, in tree order.
///
/// Entries that are not outside name words to test one level down. A word is prefetched when it is named, and tested a
/// little later with others, because most of the time of a walk is that of reading memory. An entry that is inside, and
/// has nothing empty below, accepts its leaves as one range.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "compiled/contact.hpp"
#include "compiled/with_planes.hpp"
#include "exact/predicates.hpp"
#include "kernels/table.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// What a walk is asked. For Question::inside alone a visitor is told, all the same, what is kept. For
/// Question::blocking, of boxes only, *kept* are those that block the shaft.
enum class Question : std::uint8_t { kept, kept_and_inside, inside, blocking };

[[nodiscard]] constexpr bool asks_for_inside(Question question) noexcept {
  return question == Question::kept_and_inside || question == Question::inside;
}

/// Gives a visitor everything that the shaft keeps, in tree order:
///
///     visitor.prefetch(first)            leaves first … first + 63 will be tested
///     visitor.word(first, kept, inside)  leaves first … first + 63, some of which are kept; inside is 0 for
///                                        Question::kept and Question::blocking
///     visitor.range(first, size)         leaves that are all inside, whole words
///
/// A visitor may also have
///
///     visitor.is_done()                  says that it has seen enough: the walk ends there
///     visitor.nodes(k, first, kept)      of a word of entries of level k, those that it wants to see below of
///     visitor.looks_into_leaves          true if leaves are boxes around what it looks for: tested as nodes are
template <class Bound, class Visitor>
class Walk {
 public:
  Walk(const TreeLevels<Bound>& parts, const Kernels& kernels, const ShaftData& shaft, Question question,
       Visitor& visitor) noexcept
      : parts_(parts),
        test_leaves_(question == Question::blocking ? kernels.blocking.listed_boxes : kernels.listed(ViewOf<Bound>{})),
        test_nodes_(question == Question::blocking ? kernels.blocking.listed_nodes : kernels.listed_boxes),
        prefetches_(parts.is_worth_prefetching()),
        question_(question),
        visitor_(visitor),
        leaf_(parts.leaves.view().stream),
        with_planes_(shaft, asks_for_inside(question) ||
                                (question == Question::kept &&
                                 outside_needs_planes(shaft, std::is_same_v<Bound, Sphere>, Form::fastest))),
        shaft_(with_planes_.shaft()),
        of_nodes_(shaft_),
        tests_inside_(question != Question::blocking && shaft_.answers_inside && shaft_.has_planes()) {}
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  void run() {
    if (parts_.levels == 0) return;
    std::uint32_t top[top_words];
    const std::size_t words = parts_.level[parts_.levels - 1].words();
    for (std::uint32_t w = 0; w != words; ++w) top[w] = w;
    visit(parts_.levels - 1, top, words);
  }

 private:
  static constexpr bool may_end_early = requires(const Visitor& visitor) { visitor.is_done(); };
  static constexpr bool picks_nodes = requires(const Visitor& visitor) { visitor.nodes(1, 0, 0); };
  static constexpr bool looks_into_leaves = requires { Visitor::looks_into_leaves; };

  /// Words tested at once: of leaves they fill the first-level cache and not much of the second. A walk that may end
  /// early tests few: those tested in vain cost more than a call of the kernel for each.
  static constexpr std::size_t batch = may_end_early ? 4 : 32;

  /// For Question::kept a range only saves time, so only nodes with many kept children are tested for inside.
  static constexpr unsigned many_kept = 48;

  /// Prefetches a word of entries of level `k`.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t k, std::size_t word) const noexcept {
    if (!prefetches_) return;
    const std::size_t first = word * fanout;
    if (k == 0) {
      for (const float* const row : leaf_) prefetch_to_second_level(row + first, fanout);
      visitor_.prefetch(first);
    } else {
      for (const float* const row : parts_.node_words(k, first, 1).stream) prefetch_to_second_level(row, fanout);
    }
  }

  [[nodiscard]] bool is_done() const noexcept {
    if constexpr (may_end_early) return visitor_.is_done();
    return false;
  }

  void visit(std::size_t k, const std::uint32_t* word, std::size_t words) {
    if (words == 0) return;
    if (k == 0) return visit_leaves(word, words);
    std::uint64_t kept[batch];
    std::uint64_t inside[batch];
    const bool tests_inside = tests_inside_;  // which no call changes
    const auto nodes = parts_.node_words(k, 0, parts_.level[k].words());
    test_nodes_(of_nodes_.shaft(), nodes.stream.data(), word, words, kept, tests_inside ? inside : nullptr,
                question_ == Question::kept ? many_kept : 1);
    std::uint32_t below[batch];
    std::size_t belows = 0;
    const std::uint64_t* const gaps = parts_.gap_words(k);
    for (std::size_t i = 0; i != words; ++i) {
      const std::uint32_t first = word[i] * static_cast<std::uint32_t>(fanout);
      std::uint64_t whole = tests_inside ? inside[i] & ~gaps[word[i]] : 0;
      if (whole != 0 && shaft_.contact == Contact::open) whole = touching_nothing(nodes, first, whole);
      std::uint64_t left = kept[i];
      if constexpr (picks_nodes) left = visitor_.nodes(k, first, left);
      for (; left != 0; left &= left - 1) {
        const std::uint64_t lowest = left & -left;
        const std::uint32_t entry = first + static_cast<std::uint32_t>(std::countr_zero(left));
        if ((whole & lowest) == 0) {
          prefetch(k - 1, entry);
          below[belows++] = entry;
          if (belows < batch) continue;
          visit(k - 1, below, belows);
          belows = 0;
          if (is_done()) return;
        } else {
          visit(k - 1, below, belows);
          belows = 0;
          if (is_done()) return;
          const std::size_t leaves = std::size_t{1} << 6 * k;
          visitor_.range(entry * leaves, leaves);
          if (is_done()) return;
        }
      }
    }
    visit(k - 1, below, belows);
  }

  /// Of the nodes from `first` on that are inside, those that do not touch the shaft's surface: flat leaves that lie in
  /// it are outside of a shaft with open contact.
  SHAFTCULL_COLD std::uint64_t touching_nothing(const BoxView& nodes, std::size_t first,
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

  void visit_leaves(const std::uint32_t* word, std::size_t words) {
    std::uint64_t kept[batch];
    std::uint64_t inside[batch];
    const bool both = asks_for_inside(question_);
    const ShaftData& shaft = looks_into_leaves ? of_nodes_.shaft() : shaft_;
    test_leaves_(shaft, leaf_.data(), word, words, kept, both ? inside : nullptr, 1);
    for (std::size_t i = 0; i != words; ++i) {
      if (kept[i] == 0) continue;
      visitor_.word(std::size_t{word[i]} * fanout, kept[i], both ? inside[i] : 0);
      if (is_done()) return;
    }
  }

  const TreeLevels<Bound>& parts_;
  TestListedWords* test_leaves_;
  TestListedWords* test_nodes_;
  bool prefetches_;
  Question question_;
  Visitor& visitor_;
  std::array<const float*, rows_of<Bound>> leaf_;
  WithPlanes with_planes_;
  const ShaftData& shaft_;
  WithClosedContact of_nodes_;
  bool tests_inside_;
};

}  // namespace shaftcull::kernel
