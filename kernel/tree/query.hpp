// SPDX-License-Identifier: MIT
/// A checked question to a tree.
#pragma once

#include <span>
#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/query.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
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
        const Excluding& excluding)
      : shafts_(data_of(shafts)),
        parts_(TreeAccess::parts(tree) == nullptr ? empty_ : *TreeAccess::parts(tree)),
        kernels_(active_kernels()),
        question_(question),
        own_(excluding.own),
        own_per_shaft_(shafts.empty() ? 0 : excluding.own.size() / shafts.size()),
        mask_(excluding.mask),
        only_layers_(excluding.only_layers) {
    if (parts_.dirty_words != 0)
      kernel::fail(NeedsRefit("query of a tree whose bounds were updated; call refit() first"));
    require_memory("shafts", shafts, "shafts");
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      if (question == Question::blocking) {
        require_two_ends(shafts_[s], s);
      } else {
        require_answers(shafts_[s], question != Question::inside, question != Question::kept,
                        std::is_same_v<Bound, Sphere>, s);
      }
    }
    if (own_per_shaft_ * shafts.size() != own_.size()) {
      kernel::fail(InvalidArgument("excluding.own has " + counted_indices(own_.size()) +
                                   ", which is not a multiple of the " + counted(shafts.size(), "shaft") +
                                   "; each needs as many"));
    }
    require_below("excluding.own", own_, parts_.size);
    require_memory("excluding.mask", mask_, "words");
    if (!mask_.empty() && mask_.size() != words_for(parts_.size)) {
      kernel::fail(InvalidArgument("excluding.mask has " + counted(mask_.size(), "word") + "; the bits of " +
                                   counted(parts_.size, "bound") + " take " + std::to_string(words_for(parts_.size))));
    }
    require_memory("excluding.only_layers", only_layers_, "sets of layers");
    if (only_layers_.empty()) return;
    if (only_layers_.size() != 1 && only_layers_.size() != shafts.size()) {
      kernel::fail(InvalidArgument("excluding.only_layers has " + counted(only_layers_.size(), "set") +
                                   " of layers for " + counted(shafts.size(), "shaft") +
                                   "; give one for each, or one for all"));
    }
    if (!parts_.layers.exist() && parts_.size != 0) {
      kernel::fail(InvalidArgument(
          "excluding.only_layers asks for layers, and the tree has none; call set_layers() of the tree first"));
    }
  }

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size; }
  [[nodiscard]] std::size_t row_words() const noexcept { return words_for(parts_.size); }
  [[nodiscard]] LeafIndices indices() const noexcept { return {parts_.order, parts_.is_worth_prefetching(), kernels_}; }

  /// Throws InvalidArgument if `output`, called `name` in the message, is memory that excludes bounds.
  void require_apart(const char* call, const char* name, std::span<const std::byte> output) const {
    kernel::require_apart(call, name, output, "excluding.own", bytes_of(own_));
    kernel::require_apart(call, name, output, "excluding.mask", bytes_of(mask_));
    kernel::require_apart(call, name, output, "excluding.only_layers", bytes_of(only_layers_));
  }

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

  /// Gives the visitor what shaft s keeps.
  template <class Visitor>
  void walk(std::size_t s, Visitor& visitor) const {
    in_float_environment([&] {
      if (const Exclusion excluded = exclusion(s); !excluded.is_on()) {
        Walk<Bound, Visitor>(parts_, kernels_, shafts_[s], question_, visitor).run();
      } else {
        Filter<Visitor> filter(excluded, visitor);
        Walk<Bound, Filter<Visitor>>(parts_, kernels_, shafts_[s], question_, filter).run();
      }
    });
  }

 private:
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

}  // namespace shaftcull::kernel
