// SPDX-License-Identifier: MIT
/// The table of verbs in the README: every cell of it compiles with the arguments and the result that it promises, and
/// what is marked as missing does not.
#include <gtest/gtest.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/shaftcull.hpp"
#include "text_of.hpp"

namespace shaftcull {
namespace {

/// The rows of the README's table, which the assertions below go through: the question, then the verbs of one shaft and
/// of many on views and on trees.
constexpr std::array<std::array<const char*, 5>, 19> table = {{
    {"which are kept: bits", "cull", "cull_many", "cull", "cull_many"},
    {"which are kept, which are inside: bits of both", "classify", "classify_many", "classify", "classify_many"},
    {"which are inside: bits", "contained", "contained_many", "contained", "contained_many"},
    {"how many are kept", "count", "count_many", "count", "count_many"},
    {"how many overlap, how many are inside", "count_classified", "count_classified_many", "count_classified",
     "count_classified_many"},
    {"which are kept: indices", "list", "list_many", "list", "list_many"},
    {"which overlap, which are inside: indices", "list_classified", "list_classified_many", "list_classified",
     "list_classified_many"},
    {"is any kept", "any", "any_many", "any", "any_many"},
    {"does a box block every segment", "blocked", "blocked_many", "blocked", "blocked_many"},
    {"one box that does: its index", "blocked_by", "", "blocked_by", ""},
    {"which boxes do: indices", "list_blocking", "list_blocking_many", "list_blocking", "list_blocking_many"},
    {"which is reached first, and when", "first_contact", "first_contact_many", "first_contact", "first_contact_many"},
    {"when each of a list is reached", "entry_times", "", "entry_times", ""},
    {"how many are kept, up to so many", "count_at_most", "count_at_most_many", "count_at_most", "count_at_most_many"},
    {"which are kept, up to so many: indices", "list_at_most", "list_at_most_many", "list_at_most",
     "list_at_most_many"},
    {"which of these candidates are kept: indices", "refine", "refine_many", "refine", "refine_many"},
    {"which are kept: ranges of leaves", "", "", "list", "list_many"},
    {"which are kept: a callback", "", "for_each_tile", "", "for_each_kept"},
    {"which overlap, which are inside: a callback", "", "for_each_classified_tile", "", "for_each_classified"},
}};

/// All that a user may hold, which the calls below are made with.
struct Given {
  const CompiledShaft& shaft;
  const std::vector<CompiledShaft>& shafts;
  std::vector<std::uint64_t>& words;
  std::vector<std::uint32_t>& indices;
  std::vector<KeptCounts>& counts;
  IndexLists& lists;
};

/// Callbacks.
struct SeeTile {
  void operator()(const TileAnswers& /*tile*/) const {}
};
struct SeeShaft {
  template <class Answers>
  void operator()(const Answers& /*answers*/) const {}
};

// One cell each: whether the call compiles for such bounds, and gives what it should.

template <class Bounds>
concept GivesBits = requires(const Bounds& bounds, Given given) {
  { cull(given.shaft, bounds, given.words) } -> std::same_as<void>;
  { classify(given.shaft, bounds, given.words, given.words) } -> std::same_as<void>;
  { contained(given.shaft, bounds, given.words) } -> std::same_as<void>;
  { cull_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { classify_many(given.shafts, bounds, given.words, given.words) } -> std::same_as<void>;
  { contained_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
};

template <class Bounds>
concept GivesNumbers = requires(const Bounds& bounds, Given given) {
  { count(given.shaft, bounds) } -> std::same_as<std::size_t>;
  { count_classified(given.shaft, bounds) } -> std::same_as<KeptCounts>;
  { count_at_most(given.shaft, bounds, std::size_t{3}) } -> std::same_as<std::size_t>;
  { count_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { count_at_most_many(given.shafts, bounds, std::size_t{3}, given.words) } -> std::same_as<void>;
  { count_classified_many(given.shafts, bounds, given.counts) } -> std::same_as<void>;
};

template <class Bounds>
concept GivesLists = requires(const Bounds& bounds, Given given) {
  { list(given.shaft, bounds, given.indices) } -> std::same_as<std::size_t>;
  { list_at_most(given.shaft, bounds, given.indices) } -> std::same_as<std::size_t>;
  { list_classified(given.shaft, bounds, given.indices, given.indices) } -> std::same_as<KeptCounts>;
  { list_many(given.shafts, bounds, given.lists) } -> std::same_as<void>;
  { list_at_most_many(given.shafts, bounds, std::size_t{3}, given.indices, given.words) } -> std::same_as<void>;
  { list_classified_many(given.shafts, bounds, given.lists, given.lists) } -> std::same_as<void>;
};

template <class Bounds>
concept TellsWhetherAny = requires(const Bounds& bounds, Given given) {
  { any(given.shaft, bounds) } -> std::same_as<bool>;
  { any_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
};

/// A matter of boxes.
template <class Bounds>
concept TellsWhetherBlocked = requires(const Bounds& bounds, Given given) {
  { blocked(given.shaft, bounds) } -> std::same_as<bool>;
  { blocked_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { blocked_by(given.shaft, bounds).has_value() } -> std::same_as<bool>;
};

template <class Bounds>
concept ListsWhatBlocks = requires(const Bounds& bounds, Given given) {
  { list_blocking(given.shaft, bounds, given.indices) } -> std::same_as<std::size_t>;
  { list_blocking_many(given.shafts, bounds, given.lists) } -> std::same_as<void>;
};

/// As positions, or as the user's indices in a tree.
template <class Bounds>
concept TellsFirstContact = requires(const Bounds& bounds, Given given, std::vector<FirstContact>& contacts,
                                     std::vector<std::uint32_t>& indices, std::vector<float>& times) {
  { entry_times(given.shaft, bounds, indices, times) } -> std::same_as<void>;
  { first_contact(given.shaft, bounds) } -> std::same_as<FirstContact>;
  { first_contact_many(given.shafts, bounds, contacts) } -> std::same_as<void>;
};
static_assert(TellsFirstContact<BoxView> && TellsFirstContact<BoxStream> && TellsFirstContact<BoxTree>);
static_assert(TellsFirstContact<SphereView> && TellsFirstContact<SphereStream> && TellsFirstContact<SphereTree>);
static_assert(!TellsFirstContact<TriangleView>);

template <class Bounds>
concept CallsBackForTiles = requires(const Bounds& bounds, Given given) {
  { for_each_tile(given.shafts, bounds, SeeTile()) } -> std::same_as<void>;
  { for_each_classified_tile(given.shafts, bounds, SeeTile()) } -> std::same_as<void>;
};

template <class Bounds>
concept CallsBackForShafts = requires(const Bounds& bounds, Given given) {
  { for_each_kept(given.shafts, bounds, SeeShaft()) } -> std::same_as<void>;
  { for_each_classified(given.shafts, bounds, SeeShaft()) } -> std::same_as<void>;
};

template <class Bounds>
concept AnswersAsAView = GivesBits<Bounds> && GivesNumbers<Bounds> && GivesLists<Bounds> && TellsWhetherAny<Bounds> &&
    CallsBackForTiles<Bounds> && !CallsBackForShafts<Bounds>;

static_assert(AnswersAsAView<BoxView>);
static_assert(AnswersAsAView<SphereView>);
static_assert(AnswersAsAView<BoxStream>, "a stream goes where a view goes");
static_assert(AnswersAsAView<SphereStream>);

static_assert(TellsWhetherBlocked<BoxView> && TellsWhetherBlocked<BoxStream>);
static_assert(TellsWhetherBlocked<BoxTree>);
static_assert(!TellsWhetherBlocked<SphereView> && !TellsWhetherBlocked<SphereTree>);
static_assert(ListsWhatBlocks<BoxView> && ListsWhatBlocks<BoxStream> && !ListsWhatBlocks<SphereView>);
static_assert(ListsWhatBlocks<BoxTree> && !ListsWhatBlocks<SphereTree>);

template <class Tree>
concept AnswersAsATree = GivesBits<Tree> && GivesNumbers<Tree> && GivesLists<Tree> && TellsWhetherAny<Tree> &&
    CallsBackForShafts<Tree> && !CallsBackForTiles<Tree>;

static_assert(AnswersAsATree<BoxTree>);
static_assert(AnswersAsATree<SphereTree>);

/// Triangles are asked which are kept, by vertices or exactly.
template <class Triangles>
concept AnswersAsTriangles = requires(const Triangles& triangles, Given given) {
  { cull(given.shaft, triangles, given.words) } -> std::same_as<void>;
  { count(given.shaft, triangles) } -> std::same_as<std::size_t>;
  { any(given.shaft, triangles) } -> std::same_as<bool>;
  { list(given.shaft, triangles, given.indices) } -> std::same_as<std::size_t>;
  { cull_many(given.shafts, triangles, given.words) } -> std::same_as<void>;
  { count_many(given.shafts, triangles, given.words) } -> std::same_as<void>;
  { any_many(given.shafts, triangles, given.words) } -> std::same_as<void>;
  { list_many(given.shafts, triangles, given.lists) } -> std::same_as<void>;
  cull(given.shaft, triangles, given.words, TriangleTest::vertices);
  list_many(given.shafts, triangles, given.lists, TriangleTest::vertices);
};
static_assert(AnswersAsTriangles<TriangleView> && AnswersAsTriangles<TriangleStream>);
static_assert(AnswersAsTriangles<TriangleTree>);
static_assert(!TellsWhetherBlocked<TriangleView> && !CallsBackForTiles<TriangleView>);
static_assert(std::constructible_from<TriangleStream, MeshView> && std::constructible_from<TriangleTree, MeshView>);
static_assert(std::constructible_from<TriangleTree, TriangleStream> && !std::convertible_to<MeshView, TriangleTree>);
static_assert(!std::constructible_from<BoxStream, TriangleView> && !std::constructible_from<BoxTree, TriangleView>);

/// One bound at a time.
template <class Bound>
concept IsAnsweredAlone = requires(const Bound& bound, const CompiledShaft& shaft) {
  { cull(shaft, bound) } -> std::same_as<bool>;
  { classify(shaft, bound) } -> std::same_as<Answer>;
};
static_assert(IsAnsweredAlone<Box> && IsAnsweredAlone<Sphere>);

template <class Bound>
concept BlocksAlone = requires(const Bound& bound, const CompiledShaft& shaft) {
  { blocked(shaft, bound) } -> std::same_as<bool>;
};
static_assert(BlocksAlone<Box> && BlocksAlone<std::vector<Vec3>> && !BlocksAlone<Sphere>);

/// Streams and trees are made of whatever holds bounds.
static_assert(std::constructible_from<BoxStream, BoxView> && std::constructible_from<SphereStream, SphereView>);
static_assert(std::constructible_from<BoxTree, BoxView> && std::constructible_from<BoxTree, BoxStream>);
static_assert(std::constructible_from<SphereTree, SphereStream>);
static_assert(!std::convertible_to<BoxView, BoxStream>, "nothing is copied unseen");
static_assert(!std::constructible_from<BoxStream, SphereView> && !std::convertible_to<BoxStream, SphereView>);

std::string row_text(const std::array<const char*, 5>& row) {
  std::string text = "| " + std::string(row[0]);
  for (std::size_t cell = 1; cell != row.size(); ++cell) {
    const std::string verb = row[cell];
    text += verb.empty() ? " | –" : " | `" + verb + "`";
  }
  return text + " |";
}

TEST(Verbs, AreThoseOfTheTableInTheReadme) {
  const std::string readme = text_of(SHAFTCULL_README);
  ASSERT_FALSE(readme.empty()) << "cannot read " << SHAFTCULL_README;
  for (const auto& row : table) {
    EXPECT_NE(readme.find(row_text(row) + "\n"), std::string::npos) << "the README lacks the row\n" << row_text(row);
  }
}

}  // namespace
}  // namespace shaftcull
