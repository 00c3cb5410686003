// SPDX-License-Identifier: MIT
/// A checked question to a tree.
#pragma once

#include <span>

#include "kernels/table.hpp"
#include "shaftcull/query.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "tree/access.hpp"
#include "tree/exclusion.hpp"
#include "tree/visitors.hpp"
#include "tree/walk.hpp"

namespace shaftcull::kernel {

/// Shafts in a task: some ten to hundreds of microseconds.
inline constexpr std::size_t task_shafts = 16;

template <class Bound>
class Query {
 public:
  /// Throws NeedsRefit and InvalidArgument as shaftcull/query.hpp says.
  Query(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, Question question,
        const Excluding& excluding);

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size; }
  [[nodiscard]] std::size_t row_words() const noexcept { return words_for(parts_.size); }
  [[nodiscard]] const Kernels& kernels() const noexcept { return kernels_; }
  [[nodiscard]] LeafIndices indices() const noexcept { return {parts_.order, parts_.is_worth_prefetching(), kernels_}; }

  /// Throws InvalidArgument if `output`, called `name` in the message, is memory that excludes bounds.
  void require_apart(const char* call, const char* name, std::span<const std::byte> output) const;

  /// What is left out for shaft s.
  [[nodiscard]] Exclusion exclusion(std::size_t s) const noexcept {
    return {indices(), own_.subspan(s * own_per_shaft_, own_per_shaft_), mask_, layer_filter(s)};
  }

  /// Returns use(walk) of a walk of another kind that looks for what shaft s keeps: of its class, made of the tree, the
  /// kernels, the shaft and what is left out.
  template <class OtherWalk, class Use>
  auto walk_with(std::size_t s, const Use& use) const {
    return in_float_environment([&] {
      OtherWalk walk(parts_, kernels_, shafts_[s], exclusion(s));
      return use(walk);
    });
  }

  /// Gives the visitor (tree/visitors.hpp) what shaft s keeps.
  template <class Visitor>
  void walk(std::size_t s, Visitor& visitor) const {
    WordByWord<Visitor> words(visitor);
    walk_leaves(s, words, WordByWord<Visitor>::traits);
  }

 private:
  void walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const;

  /// One that is off if shaft s asks for layers that all bounds are in.
  [[nodiscard]] LayerFilter layer_filter(std::size_t s) const noexcept {
    if (only_layers_.empty()) return {};
    const std::uint32_t mask = only_layers_[only_layers_.size() == 1 ? 0 : s];
    if (parts_.layers.are_all_in(mask)) return {};
    return {parts_.layers, parts_.level.data(), mask, kernels_};
  }

  inline static const TreeParts<Bound> empty_{};
  std::span<const ShaftData> shafts_;
  const TreeParts<Bound>& parts_;
  const Kernels& kernels_;
  Question question_;
  std::span<const std::uint32_t> own_;
  std::size_t own_per_shaft_;
  std::span<const std::uint64_t> mask_;
  std::span<const std::uint32_t> only_layers_;
};

extern template class Query<Box>;
extern template class Query<Sphere>;

}  // namespace shaftcull::kernel
