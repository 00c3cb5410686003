// SPDX-License-Identifier: MIT
#include "verbs/asked.hpp"

#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {
namespace {

/// The layers of bounds, by position.
struct Layers {
  const std::uint32_t* first;
  bool exist;
};

/// What a query reads of its bounds, which are checked.
struct Read {
  BoundStreams streams;
  Layers layers;
};

template <class View>
Read read(const View& view, std::span<const std::uint32_t> layers) {
  require_view(view);
  require_memory("layers", layers, "layers");
  if (!layers.empty() && layers.size() != view.count) {
    fail(InvalidArgument("the view has " + std::to_string(view.count) + " bounds, and " +
                         std::to_string(layers.size()) + " layers; give each bound its own, or none"));
  }
  return {view, {layers.data(), !layers.empty()}};
}

template <class Bound>
Read read(const BoundsTree<Bound>* tree, std::span<const std::uint32_t> /*layers*/) {
  if (tree->needs_refit()) fail(NeedsRefit("query of a tree whose bounds were updated; call refit() first"));
  const TreeParts<Bound>* const parts = TreeAccess::parts(*tree);
  if (parts == nullptr) return {ViewOf<Bound>(), {nullptr, false}};
  return {parts->leaves.view(), {parts->layers.leaves.data(), parts->layers.exist()}};
}

Read read(const TriangleTree* tree, std::span<const std::uint32_t> /*layers*/) {
  return {tree->triangles(), {nullptr, false}};
}

Read read(const Bounds& bounds) {
  return std::visit([&](const auto& from) { return read(from, BoundsAccess::layers(bounds)); },
                    BoundsAccess::from(bounds));
}

/// Where the bounds of an index are in streams.
template <class View>
Positions positions_of(const View& /*view*/) {
  return {};
}
template <class Bound>
Positions positions_of(const BoundsTree<Bound>* tree) {
  const TreeParts<Bound>* const parts = TreeAccess::parts(*tree);
  return parts == nullptr ? Positions() : Positions(parts->places.of(parts->order));
}
Positions positions_of(const TriangleTree* tree) {
  const TriangleParts& parts = TriangleTreeAccess::parts(*tree);
  return parts.order.empty() ? Positions() : Positions(parts.places.of(parts.order));
}

}  // namespace

Asked::Asked(const char* call, std::span<const CompiledShaft> shafts, const Bounds& bounds, Question question,
             const Query& query, const Takes& takes)
    : shafts_(data_of(shafts)),
      kernels_(active_kernels()),
      question_(question),
      scanned_([&]() -> ScannedBounds {
        const Read its = read(bounds);
        return {its.streams, its.layers.exist ? its.layers.first : nullptr, query.only, {}};
      }()),
      options_(query, call, takes, shafts.size(), scanned_.streams.count, scanned_.streams.kind,
               scanned_.layers != nullptr) {
  if (question == Question::blocking) require_boxes();
  require_answers_of(shafts_, question, kind(), options_.triangle_test());
  if (options_.only()) {
    scanned_.position = std::visit([](const auto& from) { return positions_of(from); }, BoundsAccess::from(bounds));
    return;
  }
  std::visit(
      [&]<class From>(const From& from) {
        if constexpr (std::is_pointer_v<From>) {
          using Tree = std::remove_const_t<std::remove_pointer_t<From>>;
          using Walks = std::conditional_t<
              std::is_same_v<Tree, TriangleTree>, TriangleQuery,
              std::conditional_t<std::is_same_v<Tree, BoxTree>, BoundsQuery<Box>, BoundsQuery<Sphere>>>;
          walks_ = &query_.template emplace<Walks>(shafts_, *from, question, options_, kernels_);
        }
      },
      BoundsAccess::from(bounds));
}

void Asked::require_index_width() const { kernel::require_index_width(options_.call(), size()); }

void Asked::require_boxes() const {
  if (kind() == BoundKind::boxes) return;
  fail(InvalidArgument(std::string(options_.call()) + "() takes boxes; these are " + noun_of(kind())));
}

void Asked::require_no_triangles() const {
  if (kind() != BoundKind::triangles) return;
  fail(InvalidArgument(std::string(options_.call()) + "() takes boxes and spheres; these are triangles"));
}

}  // namespace shaftcull::kernel
