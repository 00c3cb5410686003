// SPDX-License-Identifier: MIT
#include "verbs/asked.hpp"

#include <string>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "shaftcull/error.hpp"
#include "streams/stream_access.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {
namespace {

template <class Tree>
void require_refitted(const Tree& tree) {
  if (tree.needs_refit()) fail(NeedsRefit("query of a tree whose bounds were updated; call refit() first"));
}

/// The streams and layers of bounds, which are checked.
template <class View>
ScannedBounds read(const View& view, std::span<const std::uint32_t> layers) {
  require_view(view);
  if (layers.empty()) [[likely]]
    return {BoundStreams(view), nullptr, {}, {}};
  require_memory("layers", layers, "layers");
  if (layers.size() == view.count) return {BoundStreams(view), layers.data(), {}, {}};
  fail(InvalidArgument("the view has " + std::to_string(view.count) + " bounds, and " + std::to_string(layers.size()) +
                       " layers; give each bound its own, or none"));
}

template <class Bound>
ScannedBounds read(const BoundsTree<Bound>* tree, std::span<const std::uint32_t> /*layers*/) {
  require_refitted(*tree);
  static const ViewOf<Bound> nothing;
  const TreeParts<Bound>* const parts = TreeAccess::parts(*tree);
  if (parts == nullptr) return {BoundStreams(nothing), nullptr, {}, {}};
  return {BoundStreams(StreamAccess::view(parts->leaves)),
          parts->layers.exist() ? parts->layers.leaves.data() : nullptr,
          {},
          {}};
}

template <class Bound>
ScannedBounds read(const TreeSnapshot<Bound>* snapshot, std::span<const std::uint32_t> /*layers*/) {
  static const ViewOf<Bound> nothing;
  ScannedBounds scanned{BoundStreams(nothing), nullptr, {}, {}, DynamicAccess::parts(*snapshot).blocks};
  scanned.streams.count = snapshot->index_end();
  return scanned;
}

ScannedBounds read(const TriangleTree* tree, std::span<const std::uint32_t> /*layers*/) {
  require_refitted(*tree);
  return {BoundStreams(StreamAccess::view(TriangleTreeAccess::parts(*tree).triangles)), nullptr, {}, {}};
}

ScannedBounds read(const Bounds& bounds) {
  const auto& from = BoundsAccess::from(bounds);
  const std::span<const std::uint32_t> layers = BoundsAccess::layers(bounds);
  if (const auto* const boxes = std::get_if<BoxView>(&from)) return read(*boxes, layers);
  return std::visit([&](const auto& each) { return read(each, layers); }, from);
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
template <class Bound>
Positions positions_of(const TreeSnapshot<Bound>* snapshot) {
  return Positions(DynamicAccess::parts(*snapshot).blocks);
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
      scanned_(read(bounds)),
      options_(query, call, takes, shafts.size(), scanned_.streams.count, scanned_.streams.kind,
               scanned_.layers != nullptr || scanned_.blocks.exist()) {
  if (question == Question::blocking) require_boxes();
  require_answers_of(shafts_, question);
  if (options_.only()) {
    scanned_.candidates = options_.only();
    scanned_.position = std::visit([](const auto& from) { return positions_of(from); }, BoundsAccess::from(bounds));
    return;
  }
  if (BoundsAccess::from(bounds).index() < BoundsAccess::first_tree) return;
  std::visit(
      [&]<class From>(const From& from) {
        if constexpr (std::is_pointer_v<From>) {
          using Tree = std::remove_const_t<std::remove_pointer_t<From>>;
          using Walks = std::conditional_t<
              std::is_same_v<Tree, TriangleTree>, TriangleQuery,
              std::conditional_t<std::is_same_v<Tree, BoxTree> || std::is_same_v<Tree, BoxTreeSnapshot>,
                                 BoundsQuery<Box>, BoundsQuery<Sphere>>>;
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
