// SPDX-License-Identifier: MIT
/// A checked question to a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/kernel_table.hpp"
#include "query/options.hpp"
#include "query/question.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/float_environment.hpp"
#include "tree/dynamic_access.hpp"
#include "tree/exclusion.hpp"
#include "tree/tree_access.hpp"
#include "tree/triangle_parts.hpp"
#include "tree/visitors.hpp"
#include "tree/walk.hpp"

namespace shaftcull::kernel {

/// Of any tree. Everything is checked by who makes it.
class TreeQuery {
 public:
  TreeQuery(const TreeQuery&) = delete;
  TreeQuery& operator=(const TreeQuery&) = delete;

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] std::size_t row_words() const noexcept { return bit_words(bounds_); }
  [[nodiscard]] const Kernels& kernels() const noexcept { return kernels_; }
  [[nodiscard]] Question question() const noexcept { return question_; }
  [[nodiscard]] const LeafIndices& indices() const noexcept { return indices_; }

  /// Gives the visitor (tree/visitors.hpp) the bounds that shaft s keeps and that are not left out.
  template <class Visitor>
  void walk(std::size_t s, Visitor& visitor) const {
    WordByWord<Visitor> words(visitor);
    walk_leaves(s, words, WordByWord<Visitor>::traits);
  }

 protected:
  TreeQuery(std::span<const ShaftData> shafts, std::size_t bounds, const LeafIndices& indices, Question question,
            const Options& options, const Kernels& kernels) noexcept
      : shafts_(shafts),
        bounds_(bounds),
        indices_(indices),
        kernels_(kernels),
        options_(options),
        question_(question) {}
  ~TreeQuery() = default;

  [[nodiscard]] const ShaftData& shaft(std::size_t s) const noexcept { return shafts_[s]; }
  [[nodiscard]] const Options& options() const noexcept { return options_; }

 private:
  virtual void walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const = 0;

  std::span<const ShaftData> shafts_;
  std::size_t bounds_;
  LeafIndices indices_;
  const Kernels& kernels_;
  const Options& options_;
  Question question_;
};

/// Of a tree of boxes or spheres.
template <class Bound>
class BoundsQuery final : public TreeQuery {
 public:
  BoundsQuery(std::span<const ShaftData> shafts, const BoundsTree<Bound>& tree, Question question,
              const Options& options, const Kernels& kernels) noexcept
      : BoundsQuery(shafts, TreeAccess::parts(tree) == nullptr ? empty_ : *TreeAccess::parts(tree), question, options,
                    kernels) {}
  /// Of a dynamic tree.
  BoundsQuery(std::span<const ShaftData> shafts, const TreeSnapshot<Bound>& tree, Question question,
              const Options& options, const Kernels& kernels) noexcept
      : BoundsQuery(shafts, tree.index_end(), DynamicAccess::parts(tree), question, options, kernels) {}

  [[nodiscard]] FirstContact first_contact(std::size_t s) const noexcept;

 private:
  BoundsQuery(std::span<const ShaftData> shafts, const TreeParts<Bound>& parts, Question question,
              const Options& options, const Kernels& kernels) noexcept
      : TreeQuery(shafts, parts.order.size(), {parts.order, parts.is_worth_prefetching(), kernels}, question, options,
                  kernels),
        parts_(parts) {}
  BoundsQuery(std::span<const ShaftData> shafts, std::size_t bounds, const TreeParts<Bound>& parts, Question question,
              const Options& options, const Kernels& kernels) noexcept
      : TreeQuery(shafts, bounds, {parts.blocks, parts.level[0].entries, parts.is_worth_prefetching(), kernels},
                  question, options, kernels),
        parts_(parts) {}

  void walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const override;

  /// The bounds that shaft s does not ask about.
  [[nodiscard]] Exclusion exclusion(std::size_t s) const noexcept {
    return {indices(), options().excluded(s), layer_filter(s)};
  }
  /// One that is off if shaft s asks for layers that all bounds are in.
  [[nodiscard]] LayerFilter layer_filter(std::size_t s) const noexcept {
    const std::optional<std::uint32_t> mask = options().layers(s);
    if (!mask || parts_.layers.are_all_in(*mask)) return {};
    return {parts_.layers, parts_.level.data(), *mask, kernels()};
  }

  inline static const TreeParts<Bound> empty_{};
  const TreeParts<Bound>& parts_;
};

extern template class BoundsQuery<Box>;
extern template class BoundsQuery<Sphere>;

/// Of a tree of triangles: of the tree of boxes around chunks of them, and then of the triangles of a chunk.
class TriangleQuery final : public TreeQuery {
 public:
  TriangleQuery(std::span<const ShaftData> shafts, const TriangleTree& tree, Question question, const Options& options,
                const Kernels& kernels) noexcept
      : TreeQuery(shafts, TriangleTreeAccess::parts(tree).order.size(),
                  {TriangleTreeAccess::parts(tree).order, false, kernels}, question, options, kernels),
        parts_(TriangleTreeAccess::parts(tree)) {}

 private:
  void walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const override;

  const TriangleParts& parts_;
};

}  // namespace shaftcull::kernel
