// SPDX-License-Identifier: MIT
/// The table of verbs in docs/questions.md: every cell of it compiles with the arguments and the result that it
/// promises, for every kind of bounds and whatever holds them. What a verb does not take is refused when it is asked.
#include <gtest/gtest.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "caught.hpp"
#include "shaftcull/shaftcull.hpp"
#include "text_of.hpp"

namespace shaftcull {
namespace {

/// The rows of that table, which the assertions below go through: the question, then the verbs of one shaft and
/// of many.
constexpr std::array<std::array<const char*, 3>, 12> verbs = {{
    {"which are kept: bits", "cull", "cull_many"},
    {"which are kept, which are inside: bits of both", "classify", "classify_many"},
    {"how many are kept", "count", "count_many"},
    {"how many overlap, how many are inside", "count_classified", "count_classified_many"},
    {"which are kept: indices", "list", "list_many"},
    {"which overlap, which are inside: indices", "list_classified", "list_classified_many"},
    {"is any kept", "any", "any_many"},
    {"which is reached first, when, and the normal", "first_contact", "first_contact_many"},
    {"when each of a list is reached", "entry_times", ""},
    {"does a box block every segment", "occluded", "occluded_many"},
    {"one box that does: its index", "find_occluder", ""},
    {"which boxes do: indices", "list_occluders", "list_occluders_many"},
}};

/// All that a user may hold, which the calls below are made with.
struct Given {
  const CompiledShaft& shaft;
  const std::vector<CompiledShaft>& shafts;
  std::vector<std::uint64_t>& words;
  std::vector<std::uint32_t>& indices;
  std::span<std::uint32_t> room;
  std::vector<KeptCounts>& counts;
  std::vector<FirstContact>& contacts;
  std::vector<float>& times;
  IndexLists& lists;
  const Query& query;
};

// One cell each: whether the call compiles for such bounds, without a query and with one, and gives what it should.

template <class Of>
concept GivesBits = requires(const Of& bounds, Given given) {
  { cull(given.shaft, bounds, given.words) } -> std::same_as<void>;
  { cull(given.shaft, bounds, given.words, given.query) } -> std::same_as<void>;
  { classify(given.shaft, bounds, given.words, given.words) } -> std::same_as<void>;
  { classify(given.shaft, bounds, {}, given.words, given.query) } -> std::same_as<void>;
  { cull_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { cull_many(given.shafts, bounds, given.words, given.query) } -> std::same_as<void>;
  { classify_many(given.shafts, bounds, given.words, given.words) } -> std::same_as<void>;
  { classify_many(given.shafts, bounds, {}, given.words, given.query) } -> std::same_as<void>;
};

template <class Of>
concept GivesNumbers = requires(const Of& bounds, Given given) {
  { count(given.shaft, bounds) } -> std::same_as<std::size_t>;
  { count(given.shaft, bounds, given.query) } -> std::same_as<std::size_t>;
  { count_classified(given.shaft, bounds) } -> std::same_as<KeptCounts>;
  { count_classified(given.shaft, bounds, given.query) } -> std::same_as<KeptCounts>;
  { count_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { count_many(given.shafts, bounds, given.words, given.query) } -> std::same_as<void>;
  { count_classified_many(given.shafts, bounds, given.counts) } -> std::same_as<void>;
  { count_classified_many(given.shafts, bounds, given.counts, given.query) } -> std::same_as<void>;
};

template <class Of>
concept GivesLists = requires(const Of& bounds, Given given) {
  { list(given.shaft, bounds, given.room) } -> std::same_as<std::size_t>;
  { list(given.shaft, bounds, given.room, given.query) } -> std::same_as<std::size_t>;
  { list(given.shaft, bounds, given.indices) } -> std::same_as<std::size_t>;
  { list(given.shaft, bounds, given.indices, given.query) } -> std::same_as<std::size_t>;
  { list_classified(given.shaft, bounds, given.room, given.room) } -> std::same_as<KeptCounts>;
  { list_classified(given.shaft, bounds, given.indices, given.indices, given.query) } -> std::same_as<KeptCounts>;
  { list_many(given.shafts, bounds, given.lists) } -> std::same_as<void>;
  { list_many(given.shafts, bounds, given.lists, given.query) } -> std::same_as<void>;
  { list_classified_many(given.shafts, bounds, given.lists, given.lists) } -> std::same_as<void>;
  { list_classified_many(given.shafts, bounds, given.lists, given.lists, given.query) } -> std::same_as<void>;
};

template <class Of>
concept TellsWhetherAny = requires(const Of& bounds, Given given) {
  { any(given.shaft, bounds) } -> std::same_as<bool>;
  { any(given.shaft, bounds, given.query) } -> std::same_as<bool>;
  { any_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { any_many(given.shafts, bounds, given.words, given.query) } -> std::same_as<void>;
};

template <class Of>
concept TellsFirstContact = requires(const Of& bounds, Given given) {
  { first_contact(given.shaft, bounds) } -> std::same_as<FirstContact>;
  { first_contact(given.shaft, bounds, given.query) } -> std::same_as<FirstContact>;
  { first_contact_many(given.shafts, bounds, given.contacts) } -> std::same_as<void>;
  { first_contact_many(given.shafts, bounds, given.contacts, given.query) } -> std::same_as<void>;
  { entry_times(given.shaft, bounds, given.indices, given.times) } -> std::same_as<void>;
};

template <class Of>
concept TellsWhatBlocks = requires(const Of& bounds, Given given) {
  { occluded(given.shaft, bounds) } -> std::same_as<bool>;
  { occluded(given.shaft, bounds, given.query) } -> std::same_as<bool>;
  { occluded_many(given.shafts, bounds, given.words) } -> std::same_as<void>;
  { occluded_many(given.shafts, bounds, given.words, given.query) } -> std::same_as<void>;
  { find_occluder(given.shaft, bounds) } -> std::same_as<std::optional<std::uint32_t>>;
  { find_occluder(given.shaft, bounds, given.query) } -> std::same_as<std::optional<std::uint32_t>>;
  { list_occluders(given.shaft, bounds, given.indices) } -> std::same_as<std::size_t>;
  { list_occluders(given.shaft, bounds, given.room, given.query) } -> std::same_as<std::size_t>;
  { list_occluders_many(given.shafts, bounds, given.lists) } -> std::same_as<void>;
  { list_occluders_many(given.shafts, bounds, given.lists, given.query) } -> std::same_as<void>;
};

template <class Of>
concept Answers = GivesBits<Of> && GivesNumbers<Of> && GivesLists<Of> && TellsWhetherAny<Of> && TellsFirstContact<Of> &&
    TellsWhatBlocks<Of>;

static_assert(Answers<BoxView> && Answers<BoxStream> && Answers<BoxTree>);
static_assert(Answers<SphereView> && Answers<SphereStream> && Answers<SphereTree>);
static_assert(Answers<TriangleView> && Answers<TriangleStream> && Answers<TriangleTree>);
static_assert(Answers<Bounds>);

/// Bounds are made of every holder, with layers of those that have none themselves. Arrays and meshes are packed first.
template <class Of>
constexpr bool takes_layers = std::constructible_from<Bounds, const Of&, std::vector<std::uint32_t>>;
static_assert(takes_layers<BoxView> && takes_layers<SphereView> && takes_layers<TriangleView>);
static_assert(takes_layers<BoxStream> && takes_layers<SphereStream> && takes_layers<TriangleStream>);
static_assert(!takes_layers<BoxTree> && !takes_layers<SphereTree> && !takes_layers<TriangleTree>);
static_assert(!std::constructible_from<Bounds, MeshView> && !std::constructible_from<Bounds, std::vector<Box>>);
static_assert(!std::constructible_from<Bounds, Box>, "one bound is asked about by keeps()");

/// Streams and trees are made of whatever holds bounds.
static_assert(std::constructible_from<TriangleStream, MeshView> && std::constructible_from<TriangleTree, MeshView>);
static_assert(std::constructible_from<TriangleTree, TriangleStream> && !std::convertible_to<MeshView, TriangleTree>);
static_assert(!std::constructible_from<BoxStream, TriangleView> && !std::constructible_from<BoxTree, TriangleView>);
static_assert(std::constructible_from<BoxStream, BoxView> && std::constructible_from<SphereStream, SphereView>);
static_assert(std::constructible_from<BoxTree, BoxView> && std::constructible_from<BoxTree, BoxStream>);
static_assert(std::constructible_from<SphereTree, SphereStream>);
static_assert(!std::convertible_to<BoxView, BoxStream>, "nothing is copied unseen");
static_assert(!std::constructible_from<BoxStream, SphereView> && !std::convertible_to<BoxStream, SphereView>);

/// One bound at a time.
template <class Bound>
concept IsKeptAlone = requires(const Bound& bound, const CompiledShaft& shaft) {
  { keeps(shaft, bound) } -> std::same_as<bool>;
};
static_assert(IsKeptAlone<Box> && IsKeptAlone<Sphere> && IsKeptAlone<Triangle>);
static_assert(requires(const CompiledShaft& shaft, const Triangle& triangle) {
  { keeps(shaft, triangle, TriangleTest::vertices) } -> std::same_as<bool>;
});

template <class Bound>
concept IsClassifiedAlone = requires(const Bound& bound, const CompiledShaft& shaft) {
  { classify(shaft, bound) } -> std::same_as<Answer>;
};
static_assert(IsClassifiedAlone<Box> && IsClassifiedAlone<Sphere> && !IsClassifiedAlone<Triangle>);

template <class Bound>
concept BlocksAlone = requires(const Bound& bound, const CompiledShaft& shaft) {
  { occluded(shaft, bound) } -> std::same_as<bool>;
};
static_assert(BlocksAlone<Box> && BlocksAlone<std::vector<Vec3>> && !BlocksAlone<Sphere>);

std::string row_text(const std::array<const char*, 3>& row) {
  std::string text = "| " + std::string(row[0]);
  for (std::size_t cell = 1; cell != row.size(); ++cell) {
    const std::string verb = row[cell];
    text += verb.empty() ? " | –" : " | `" + verb + "`";
  }
  return text + " |";
}

TEST(Verbs, AreThoseOfTheTable) {
  const std::string page = text_of(SHAFTCULL_QUESTIONS_PAGE);
  ASSERT_FALSE(page.empty()) << "cannot read " << SHAFTCULL_QUESTIONS_PAGE;
  std::string rows = "| question | one shaft | many shafts |\n|---|---|---|\n";
  for (const auto& row : verbs) rows += row_text(row) + "\n";
  EXPECT_NE(page.find(rows + "\n"), std::string::npos) << "docs/questions.md lacks the table\n" << rows;
}

/// Two of each kind in the shaft, of every holder.
struct Scene {
  const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}});
  const std::vector<CompiledShaft> shafts{shaft};
  const BoxStream boxes{std::vector<Box>(2, Box{{0, 0, 5}, {1, 1, 6}})};
  const BoxTree box_tree{boxes};
  const SphereStream spheres{std::vector<Sphere>(2, Sphere{{0.5F, 0.5F, 5}, 1})};
  const SphereTree sphere_tree{spheres};
  const TriangleStream triangles{std::vector<Triangle>(2, Triangle{{{{0, 0, 5}, {1, 0, 5}, {0, 1, 6}}}})};
  const TriangleTree triangle_tree{triangles};

  [[nodiscard]] std::vector<Bounds> of_spheres() const { return {spheres.view(), spheres, sphere_tree}; }
  [[nodiscard]] std::vector<Bounds> of_triangles() const { return {triangles.view(), triangles, triangle_tree}; }
  [[nodiscard]] std::vector<Bounds> all() const {
    std::vector<Bounds> every = {boxes.view(), boxes, box_tree};
    for (const Bounds& each : of_spheres()) every.push_back(each);
    for (const Bounds& each : of_triangles()) every.push_back(each);
    return every;
  }
};

TEST(Verbs, AnswerForAllHoldersOfAllKinds) {
  const Scene scene;
  for (const Bounds& bounds : scene.all()) {
    EXPECT_EQ(bounds.size(), 2U);
    std::array<std::uint64_t, 1> kept = {};
    cull(scene.shaft, bounds, kept);
    EXPECT_EQ(kept[0], 3U);
    EXPECT_TRUE(any(scene.shaft, bounds));
    EXPECT_EQ(count(scene.shaft, bounds), 2U);
    const KeptCounts counts = count_classified(scene.shaft, bounds);
    EXPECT_EQ(counts.overlap + counts.inside, 2U);
    std::vector<std::uint32_t> list_of_kept;
    EXPECT_EQ(list(scene.shaft, bounds, list_of_kept), 2U);
    EXPECT_EQ(list_of_kept.size(), 2U);
  }
}

template <class Call>
void expect_refused(const Call& call, const std::vector<Bounds>& bounds) {
  for (const Bounds& each : bounds) EXPECT_TRUE(caught<InvalidArgument>([&] { call(each); }));
}

TEST(Verbs, OfTimesRefuseTriangles) {
  const Scene scene;
  const std::array<std::uint32_t, 1> indices = {0};
  std::array<float, 1> times = {-1};
  std::array<FirstContact, 1> contacts;
  contacts[0].time = -1;
  expect_refused([&](const Bounds& bounds) { (void)first_contact(scene.shaft, bounds); }, scene.of_triangles());
  expect_refused([&](const Bounds& bounds) { first_contact_many(scene.shafts, bounds, contacts); },
                 scene.of_triangles());
  expect_refused([&](const Bounds& bounds) { entry_times(scene.shaft, bounds, indices, times); }, scene.of_triangles());
  EXPECT_EQ(times[0], -1);
  EXPECT_EQ(contacts[0].time, -1);
}

TEST(Verbs, OfWhatBlocksRefuseAllButBoxes) {
  const Scene scene;
  std::array<std::uint64_t, 1> bits = {7};
  std::array<std::uint32_t, 2> indices = {8, 9};
  IndexLists lists;
  for (const std::vector<Bounds>& bounds : {scene.of_spheres(), scene.of_triangles()}) {
    expect_refused([&](const Bounds& each) { (void)occluded(scene.shaft, each); }, bounds);
    expect_refused([&](const Bounds& each) { (void)find_occluder(scene.shaft, each); }, bounds);
    expect_refused([&](const Bounds& each) { (void)list_occluders(scene.shaft, each, indices); }, bounds);
    expect_refused([&](const Bounds& each) { occluded_many(scene.shafts, each, bits); }, bounds);
    expect_refused([&](const Bounds& each) { list_occluders_many(scene.shafts, each, lists); }, bounds);
  }
  EXPECT_EQ(bits[0], 7U);
  EXPECT_EQ(indices[0], 8U);
  EXPECT_EQ(lists.size(), 0U);
}

}  // namespace
}  // namespace shaftcull
