// SPDX-License-Identifier: MIT
#include "fuzz/trees.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "columns.hpp"
#include "fuzz/check.hpp"
#include "fuzz/packing.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/tree.hpp"
#include "tree/flat.hpp"

namespace shaftcull::fuzz {
namespace {

/// Enough copies of eight bounds for a level of nodes.
constexpr std::size_t copies = 17;

/// Whether a scan and a tree agree about what blocks the shaft, and about first contact, where it answers that.
template <class Bound>
bool asks_alike(const Case& it, const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                const std::vector<Bound>& bounds) {
  if (it.is_hull()) return true;
  const auto memory = columns(bounds);
  if constexpr (std::is_same_v<Bound, Box>) {
    if (!it.is_moving()) {
      Indices in_view(bounds.size());
      in_view.resize(list_occluders(shaft, memory.view(), in_view));
      Indices in_tree(bounds.size());
      in_tree.resize(list_occluders(shaft, tree, in_tree));
      if (sorted(in_tree) != in_view) return false;
    }
  }
  const auto of_scan = first_contact(shaft, memory.view());
  const auto of_tree = first_contact(shaft, tree);
  return of_tree.index == of_scan.index && of_tree.time == of_scan.time;
}

template <class Bound>
void require_flat_answers(const Case& it, const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                          const std::vector<Bound>& bounds, const char* when) {
  const FlatAnswers flat(shaft, bounds);
  Indices kept(bounds.size());
  kept.resize(list(shaft, tree, std::span(kept)));
  Indices overlap(bounds.size());
  Indices inside(bounds.size());
  const KeptCounts counts = list_classified(shaft, tree, overlap, inside);
  overlap.resize(counts.overlap);
  inside.resize(counts.inside);
  if (sorted(kept) == flat.kept() && sorted(overlap) == flat.overlap && sorted(inside) == flat.inside &&
      asks_alike(it, shaft, tree, bounds)) {
    return;
  }
  std::string message = std::string("a tree ") + when + " on " + std::string(name(active_isa())) +
                        " differs from a flat scan\n  " + it.text();
  for (const Bound& bound : bounds) message += "\n  " + source_text(bound);
  throw Fault(message);
}

template <class Bound>
void check_tree(const Case& it, const CompiledShaft& shaft, const std::vector<Bound>& all) {
  std::vector<Bound> bounds;
  for (std::size_t copy = 0; copy != copies; ++copy) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(bounds),
                 [](const Bound& bound) { return is_legal(bound); });
  }
  if (bounds.empty()) return;
  for (const Isa isa : available_isas()) {
    select_isa(isa);
    BoundsTree<Bound> tree{std::span<const Bound>(bounds)};
    require_flat_answers(it, shaft, tree, bounds, "as built");
    std::vector<Bound> moved = bounds;
    const std::vector<std::uint32_t> first = {0};
    moved[0] = bounds.back();
    tree.update(first, std::span<const Bound>(moved).first(1));
    tree.refit();
    require_flat_answers(it, shaft, tree, moved, "with one bound moved");
  }
}

}  // namespace

void check_trees(const Case& it) {
  std::optional<ConvexHull> hull;
  std::optional<CompiledShaft> shaft;
  try {
    const Case::Input input = it.input();
    if (const auto* const moving = std::get_if<MovingInput>(&input)) {
      shaft = shaft_of(*moving);
    } else if (const auto* const vertices = std::get_if<HullInput>(&input)) {
      hull.emplace(vertices->points, vertices->directions);
      shaft = *hull;
    } else {
      shaft = shaft_of(std::get<ShaftInput>(input));
    }
  } catch (const InvalidArgument&) {
    return;
  }
  const Isa before = active_isa();
  check_tree(it, *shaft, it.boxes);
  check_tree(it, *shaft, it.spheres);
  select_isa(before);
}

}  // namespace shaftcull::fuzz
