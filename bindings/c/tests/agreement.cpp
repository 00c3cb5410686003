// SPDX-License-Identifier: MIT
/// Every question by the C interface, against the C++ one: over random scenes, in all holders, of all kinds of shafts.
#include <gmock/gmock.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "handles.hpp"
#include "oracle/random.hpp"
#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {
namespace {

using Words = std::vector<std::uint64_t>;
using Indices = std::vector<std::uint32_t>;

template <class Set>
concept FlatSet = std::same_as<Set, BoxView> || std::same_as<Set, SphereView>;
template <class Set>
concept Triangles = std::same_as<Set, TriangleView> || std::same_as<Set, TriangleTree>;
template <class Set>
concept Boxes = std::same_as<Set, BoxView> || std::same_as<Set, BoxTree>;

/// Shafts of all kinds, the same in both languages: first those between boxes, then other moving boxes, then hulls.
struct Shafts {
  std::vector<CompiledShaft> cpp;
  std::vector<ConvexHull> hulls;  // that the last of them refer to
  ShaftsHandle c;
  std::size_t between = 0;
  std::size_t moving = 0;
};

void make_shafts(Random& random, Shafts& shafts) {
  constexpr std::size_t pairs = 5;
  constexpr std::size_t all = 2 * pairs + 13;
  shafts.c = made<ShaftsHandle>(shaftcull_shafts_create, std::uint64_t{all});
  shaftcull_shafts* const c = shafts.c.get();
  std::uint64_t next = 0;

  std::vector<Box> a;
  std::vector<Box> b;
  std::vector<Vec3> vectors;
  std::vector<float> floats;
  std::vector<Plane> planes;
  for (std::size_t i = 0; i != pairs; ++i) {
    a.push_back(random.box(-5, -2, 0.1F, 1.0F));
    b.push_back(random.box(2, 5, 0.1F, 1.0F));
    vectors.push_back(random.vec3(1, 6));
    floats.insert(floats.end(), vectors.back().begin(), vectors.back().end());
    const Vec3 normal = random.vec3(-1, 1);
    planes.push_back({normal, random.uniform(1, 4)});
  }
  const std::vector<shaftcull_box> ca = as_c(a);
  const std::vector<shaftcull_box> cb = as_c(b);
  const std::vector<shaftcull_plane> cplanes = as_c(planes);
  const shaftcull_source from = source_of(ca);
  const shaftcull_source to = source_of(cb);
  const auto add = [&](const CompiledShaft& shaft) {
    shafts.cpp.push_back(shaft);
    ++next;
  };

  // Between two boxes.
  ok(shaftcull_shafts_set_between(c, next, &ca[0], &cb[0], SHAFTCULL_CONTACT_CLOSED));
  add(compile(a[0], b[0]));
  ok(shaftcull_shafts_set_between(c, next, &ca[1], &cb[1], SHAFTCULL_CONTACT_OPEN));
  add(compile(a[1], b[1], Contact::open));
  const BoxStream stream_a{std::span<const Box>(a)};
  const BoxStream stream_b{std::span<const Box>(b)};
  std::vector<CompiledShaft> batch(pairs);
  const auto add_batch = [&] {
    for (const CompiledShaft& shaft : batch) add(shaft);
  };
  const shaftcull_batch_planes batch_planes{cplanes.data(), pairs, nullptr, 0};
  ok(shaftcull_shafts_set_between_batch(c, next, &from, &to, nullptr, pairs, &batch_planes, SHAFTCULL_CONTACT_CLOSED));
  compile_batch(stream_a, stream_b, batch, {.a = planes});
  add_batch();
  const std::vector<shaftcull_index_pair> cpairs{{0, 4}, {3, 1}};
  const std::vector<IndexPair> index_pairs{{0, 4}, {3, 1}};
  ok(shaftcull_shafts_set_between_batch(c, next, &from, &to, cpairs.data(), 2, nullptr, SHAFTCULL_CONTACT_OPEN));
  batch.resize(2);
  compile_batch(stream_a, stream_b, index_pairs, batch, {}, Contact::open);
  add_batch();
  Shaft formed(a[2], b[3], {.order = PlaneOrder::by_volume});
  formed.add_plane(planes[4]);
  const shaftcull_shaft_options options{SHAFTCULL_FORMATION_TABLE729, SHAFTCULL_ORDER_BY_VOLUME, 1, 1, 1, 0, 0, {0}};
  const ShaftHandle shaft = made<ShaftHandle>(shaftcull_shaft_create, &ca[2], &cb[3], &options);
  ok(shaftcull_shaft_add_plane(shaft.get(), &cplanes[4]));
  ok(shaftcull_shafts_set_formed(c, next, shaft.get()));
  add(compile(formed));
  shafts.between = shafts.cpp.size();

  // Moving boxes.
  const float reach = 2.5F;
  ok(shaftcull_shafts_set_swept(c, next, &ca[0], vectors[0].data(), cplanes.data(), 1));
  add(swept(a[0], vectors[0], std::span(planes).first(1)));
  ok(shaftcull_shafts_set_swept_without_end(c, next, &ca[1], vectors[1].data(), nullptr, 0));
  add(swept_without_end(a[1], vectors[1]));
  ok(shaftcull_shafts_set_shadow(c, next, &ca[2], &cb[2], nullptr, nullptr, 0));
  add(shadow(a[2], b[2]));
  ok(shaftcull_shafts_set_shadow(c, next, &ca[3], &cb[3], &reach, cplanes.data(), 2));
  add(shadow(a[3], b[3], reach, std::span(planes).first(2)));
  batch.resize(1);
  const std::span<const Box> last_a = std::span(a).last(1);
  const shaftcull_source one = shaftcull_boxes(&ca[4], 1);
  const shaftcull_source other = shaftcull_boxes(&cb[4], 1);
  const std::span<const Vec3> last_vector = std::span(vectors).last(1);
  const float* const last_floats = &floats[3 * (pairs - 1)];
  ok(shaftcull_shafts_set_swept_batch(c, next, &one, last_floats, cplanes.data(), 2));
  swept_batch(BoxStream(last_a), last_vector, batch, std::span(planes).first(2));
  add_batch();
  ok(shaftcull_shafts_set_swept_without_end_batch(c, next, &one, last_floats, nullptr, 0));
  swept_without_end_batch(BoxStream(last_a), last_vector, batch);
  add_batch();
  ok(shaftcull_shafts_set_shadow_batch(c, next, &one, &other, nullptr, 1, nullptr, nullptr));
  shadow_batch(BoxStream(last_a), BoxStream(std::span<const Box>(b).last(1)), batch);
  add_batch();
  const std::vector<shaftcull_index_pair> cpair{{1, 2}};
  const std::vector<IndexPair> pair{{1, 2}};
  ok(shaftcull_shafts_set_shadow_batch(c, next, &from, &to, cpair.data(), 1, &reach, nullptr));
  shadow_batch(stream_a, stream_b, pair, reach, batch);
  ok(shaftcull_shafts_set_contact(c, next, 1, SHAFTCULL_CONTACT_OPEN));
  set_contact(batch[0], Contact::open);
  add_batch();
  shafts.moving = shafts.cpp.size();

  // Hulls. What C put into its array stays when the hull is freed.
  shafts.hulls.reserve(5);  // shafts refer to them where they are
  std::vector<Vec3> corners;
  std::vector<float> corner_floats;
  for (int i = 0; i != 7; ++i) {
    corners.push_back(random.vec3(-4, 4));
    corner_floats.insert(corner_floats.end(), corners.back().begin(), corners.back().end());
  }
  const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02F, 3, 0, 0, -1, 4};
  const auto add_hull = [&](HullHandle&& hull, ConvexHull&& same) {
    ok(shaftcull_shafts_set_hull(c, next, hull.get()));
    hull.reset();
    shafts.hulls.push_back(std::move(same));
    add(shafts.hulls.back().compiled());
  };
  using None = const float*;
  add_hull(made<HullHandle>(shaftcull_hull_create, corner_floats.data(), std::uint64_t{7}, None(), std::uint64_t{0}),
           ConvexHull(corners));
  add_hull(made<HullHandle>(shaftcull_hull_create, corner_floats.data(), std::uint64_t{6}, &corner_floats[18],
                            std::uint64_t{1}),
           ConvexHull(std::span(corners).first(6), std::span(corners).last(1)));
  const HullHandle view =
      made<HullHandle>(shaftcull_hull_of_frustum, &matrix[0], std::uint32_t{SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE});
  add_hull(made<HullHandle>(shaftcull_hull_of_frustum, &matrix[0], std::uint32_t{SHAFTCULL_DEPTH_ZERO_TO_ONE}),
           frustum(matrix, ClipDepth::zero_to_one));
  const ConvexHull same_view = frustum(matrix, ClipDepth::minus_one_to_one);
  add_hull(made<HullHandle>(shaftcull_hull_of_casters, view.get(), vectors[3].data()), casters(same_view, vectors[3]));
  add_hull(made<HullHandle>(shaftcull_hull_of_casters_towards, view.get(), vectors[3].data()),
           casters_towards(same_view, vectors[3]));
  ASSERT_EQ(next, shaftcull_shafts_count(c)) << "the array has as many shafts as were made";

  // Some have their planes already.
  ok(shaftcull_shafts_complete(c, 0, 3));
  for (std::size_t s = 0; s != 3; ++s) complete(shafts.cpp[s]);
}

/// Views are asked without an option.
struct NoOption {};

/// A shaft and bounds as both languages know them, and how they are asked.
template <class Set, class Option>
struct Question {
  const Shafts& shafts;
  const shaftcull_bounds* bounds;
  const Set& set;
  const shaftcull_query* query;
  const Option& option;
  std::size_t size;  ///< of the bounds

  /// Returns ask(option), or ask() if there is none.
  template <class Ask>
  decltype(auto) with(const Ask& ask) const {
    if constexpr (std::same_as<Option, NoOption>) {
      return ask();
    } else {
      return ask(option);
    }
  }
};

KeptCounts as_counts(const shaftcull_kept_counts& counts) {
  return {static_cast<std::size_t>(counts.overlap), static_cast<std::size_t>(counts.inside)};
}

template <class Range>
std::pair<std::uint64_t, std::uint64_t> as_pair(const Range& range) {
  return {range.first, range.size};
}
using Pairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
template <class Ranges>
Pairs as_pairs(const Ranges& ranges) {
  Pairs out;
  for (const auto& range : ranges) out.push_back(as_pair(range));
  return out;
}

/// Bits, counts and any, of one shaft and of `count` from the first on.
template <class Set, class Option>
void compare_bits(const Question<Set, Option>& q, std::size_t count) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::span<const CompiledShaft> shafts = std::span(q.shafts.cpp).first(count);
  const std::size_t words = words_for(q.size);
  for (std::size_t s = 0; s != count; ++s) {
    SCOPED_TRACE("shaft " + std::to_string(s));
    Words expected(words);
    Words given(words, 99);
    q.with([&](const auto&... option) { return cull(shafts[s], q.set, expected, option...); });
    ok(shaftcull_cull(c, s, q.bounds, q.query, given.data(), words));
    EXPECT_EQ(given, expected);
    std::uint64_t number = 99;
    ok(shaftcull_count(c, s, q.bounds, q.query, &number));
    EXPECT_EQ(number, q.with([&](const auto&... option) { return shaftcull::count(shafts[s], q.set, option...); }));
    std::uint32_t any_kept = 99;
    ok(shaftcull_any(c, s, q.bounds, q.query, &any_kept));
    EXPECT_EQ(any_kept != 0, q.with([&](const auto&... option) { return any(shafts[s], q.set, option...); }));
  }
  Words expected(words * count);
  Words given(words * count, 99);
  q.with([&](const auto&... option) { return cull_many(shafts, q.set, expected, option...); });
  ok(shaftcull_cull_many(c, 0, count, q.bounds, q.query, given.data(), given.size()));
  EXPECT_EQ(given, expected);
  expected.assign(count, 0);
  given.assign(count, 99);
  q.with([&](const auto&... option) { return count_many(shafts, q.set, expected, option...); });
  ok(shaftcull_count_many(c, 0, count, q.bounds, q.query, given.data()));
  EXPECT_EQ(given, expected);
  expected.assign(words_for(count), 0);
  given.assign(words_for(count), 99);
  q.with([&](const auto&... option) { return any_many(shafts, q.set, expected, option...); });
  ok(shaftcull_any_many(c, 0, count, q.bounds, q.query, given.data(), given.size()));
  EXPECT_EQ(given, expected);
}

/// Lists of indices.
template <class Set, class Option>
void compare_lists(const Question<Set, Option>& q, std::size_t count) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::span<const CompiledShaft> shafts = std::span(q.shafts.cpp).first(count);
  for (std::size_t s = 0; s != count; ++s) {
    SCOPED_TRACE("shaft " + std::to_string(s));
    for (const std::size_t room : {q.size, std::size_t{3}}) {
      Indices expected(room);
      Indices given(room, 99);
      std::uint64_t number = 99;
      const std::size_t found = q.with(
          [&](const auto&... option) { return list(shafts[s], q.set, std::span<std::uint32_t>(expected), option...); });
      ok(shaftcull_list(c, s, q.bounds, q.query, given.data(), room, &number));
      ASSERT_EQ(number, found);
      expected.resize(std::min(found, room));
      given.resize(std::min(found, room));
      EXPECT_EQ(given, expected);
    }
  }
  IndexLists expected;
  q.with([&](const auto&... option) { return list_many(shafts, q.set, expected, option...); });
  const ListsHandle lists = made<ListsHandle>(shaftcull_lists_create, std::uint32_t{SHAFTCULL_LISTS_OF_INDICES});
  ok(shaftcull_list_many(c, 0, count, q.bounds, q.query, lists.get()));
  ASSERT_EQ(shaftcull_lists_count(lists.get()), count);
  const std::uint64_t* const offsets = shaftcull_lists_offsets(lists.get());
  EXPECT_EQ(Words(offsets, offsets + count + 1), expected.offsets);
  Indices given;
  const std::uint32_t* const indices = shaftcull_lists_indices(lists.get());
  if (indices != nullptr) given.assign(indices, indices + offsets[count]);
  EXPECT_EQ(shaftcull_lists_ranges(lists.get()), nullptr);
  EXPECT_EQ(given, expected.indices);
}

/// What boxes and spheres are asked and triangles are not: inside, at most so many, candidates.
template <class Set, class Option>
void compare_classified(const Question<Set, Option>& q) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::size_t count = q.shafts.cpp.size();
  const std::span<const CompiledShaft> shafts(q.shafts.cpp);
  const std::size_t words = words_for(q.size);
  constexpr std::size_t most = 4;
  Indices candidates;
  for (std::size_t i = 0; i < q.size; i += 3) candidates.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t s = 0; s != count; ++s) {
    SCOPED_TRACE("shaft " + std::to_string(s));
    Words kept(words);
    Words inside(words);
    Words given_kept(words, 99);
    Words given_inside(words, 99);
    q.with([&](const auto&... option) { return classify(shafts[s], q.set, kept, inside, option...); });
    ok(shaftcull_classify(c, s, q.bounds, q.query, given_kept.data(), given_inside.data(), words));
    EXPECT_EQ(given_kept, kept);
    EXPECT_EQ(given_inside, inside);
    given_inside.assign(words, 99);
    if constexpr (FlatSet<Set>) {
      contained(shafts[s], q.set, inside);
    } else {
      q.with([&](const auto&... option) { return contained(shafts[s], q.set, inside, option...); });
    }
    ok(shaftcull_contained(c, s, q.bounds, q.query, given_inside.data(), words));
    EXPECT_EQ(given_inside, inside);

    std::uint64_t number = 99;
    ok(shaftcull_count_at_most(c, s, q.bounds, q.query, most, &number));
    EXPECT_EQ(number, q.with([&](const auto&... option) { return count_at_most(shafts[s], q.set, most, option...); }));
    shaftcull_kept_counts counts{99, 99};
    ok(shaftcull_count_classified(c, s, q.bounds, q.query, &counts));
    EXPECT_EQ(as_counts(counts),
              q.with([&](const auto&... option) { return count_classified(shafts[s], q.set, option...); }));

    Indices first(most);
    Indices given_first(most);
    const std::size_t found = q.with([&](const auto&... option) {
      return list_at_most(shafts[s], q.set, std::span<std::uint32_t>(first), option...);
    });
    Indices overlap(q.size);
    Indices within(q.size);
    Indices given_overlap(q.size);
    Indices given_within(q.size);
    const KeptCounts expected = q.with([&](const auto&... option) {
      return list_classified(shafts[s], q.set, std::span<std::uint32_t>(overlap), std::span<std::uint32_t>(within),
                             option...);
    });
    Indices refined(candidates.size());
    Indices given_refined(candidates.size());
    const std::size_t left = refine(shafts[s], q.set, candidates, refined);
    std::uint64_t given_left = 99;
    ok(shaftcull_list_at_most(c, s, q.bounds, q.query, given_first.data(), most, &number));
    ok(shaftcull_list_classified(c, s, q.bounds, q.query, given_overlap.data(), q.size, given_within.data(), q.size,
                                 &counts));
    ok(shaftcull_refine(c, s, q.bounds, candidates.data(), candidates.size(), given_refined.data(),
                        given_refined.size(), &given_left));
    ASSERT_EQ(number, found);
    first.resize(found);
    given_first.resize(found);
    EXPECT_EQ(given_first, first);
    ASSERT_EQ(as_counts(counts), expected);
    overlap.resize(expected.overlap);
    given_overlap.resize(expected.overlap);
    within.resize(expected.inside);
    given_within.resize(expected.inside);
    EXPECT_EQ(given_overlap, overlap);
    EXPECT_EQ(given_within, within);
    ASSERT_EQ(given_left, left);
    refined.resize(left);
    given_refined.resize(left);
    EXPECT_EQ(given_refined, refined);
  }

  Words kept(words * count);
  Words inside(words * count);
  Words given_kept(words * count, 99);
  Words given_inside(words * count, 99);
  q.with([&](const auto&... option) { return classify_many(shafts, q.set, kept, inside, option...); });
  ok(shaftcull_classify_many(c, 0, count, q.bounds, q.query, given_kept.data(), given_inside.data(), kept.size()));
  EXPECT_EQ(given_kept, kept);
  EXPECT_EQ(given_inside, inside);
  given_inside.assign(words * count, 99);
  ok(shaftcull_contained_many(c, 0, count, q.bounds, q.query, given_inside.data(), inside.size()));
  EXPECT_EQ(given_inside, inside);

  Words numbers(count);
  Words given_numbers(count, 99);
  q.with([&](const auto&... option) { return count_at_most_many(shafts, q.set, most, numbers, option...); });
  ok(shaftcull_count_at_most_many(c, 0, count, q.bounds, q.query, most, given_numbers.data()));
  EXPECT_EQ(given_numbers, numbers);
  std::vector<KeptCounts> counts(count);
  std::vector<shaftcull_kept_counts> given_counts(count);
  q.with([&](const auto&... option) { return count_classified_many(shafts, q.set, counts, option...); });
  ok(shaftcull_count_classified_many(c, 0, count, q.bounds, q.query, given_counts.data()));
  for (std::size_t s = 0; s != count; ++s) {
    EXPECT_EQ(as_counts(given_counts[s]), counts[s]);
  }

  const std::uint32_t kind = SHAFTCULL_LISTS_OF_INDICES;
  const ListsHandle given_overlap = made<ListsHandle>(shaftcull_lists_create, kind);
  const ListsHandle given_within = made<ListsHandle>(shaftcull_lists_create, kind);
  const ListsHandle given_refined = made<ListsHandle>(shaftcull_lists_create, kind);
  IndexLists overlap;
  IndexLists within;
  IndexLists refined;
  q.with([&](const auto&... option) { return list_classified_many(shafts, q.set, overlap, within, option...); });
  refine_many(shafts, q.set, candidates, refined);
  ok(shaftcull_list_classified_many(c, 0, count, q.bounds, q.query, given_overlap.get(), given_within.get()));
  Indices rows(count * most);
  Indices given_rows(count * most);
  q.with([&](const auto&... option) {
    return list_at_most_many(shafts, q.set, most, std::span<std::uint32_t>(rows), numbers, option...);
  });
  ok(shaftcull_refine_many(c, 0, count, q.bounds, candidates.data(), candidates.size(), given_refined.get()));
  ok(shaftcull_list_at_most_many(c, 0, count, q.bounds, q.query, most, given_rows.data(), given_numbers.data()));
  const auto same = [&](const ListsHandle& given, const IndexLists& lists) {
    const std::uint64_t* const offsets = shaftcull_lists_offsets(given.get());
    ASSERT_NE(offsets, nullptr);
    EXPECT_EQ(Words(offsets, offsets + count + 1), lists.offsets);
    const std::uint32_t* const indices = shaftcull_lists_indices(given.get());
    EXPECT_EQ(Indices(indices, indices + (indices == nullptr ? 0 : offsets[count])), lists.indices);
  };
  same(given_overlap, overlap);
  same(given_within, within);
  same(given_refined, refined);
  EXPECT_EQ(given_numbers, numbers);
  for (std::size_t s = 0; s != count; ++s) {
    for (std::size_t i = 0; i != numbers[s]; ++i) EXPECT_EQ(given_rows[s * most + i], rows[s * most + i]);
  }
}

/// First contact and entry times, of the shafts in which something moves.
template <class Set, class Option>
void compare_times(const Question<Set, Option>& q) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::span<const CompiledShaft> shafts = std::span(q.shafts.cpp).first(q.shafts.moving);
  Indices indices;
  for (std::size_t i = 0; i < q.size; i += 2) indices.push_back(static_cast<std::uint32_t>(i));
  const auto same = [](const shaftcull_contact_found& given, const auto& expected) {
    EXPECT_EQ(given.found != 0, static_cast<bool>(expected));
    EXPECT_EQ(given.time, expected.time);
    EXPECT_EQ(given.index, expected ? std::uint64_t{expected.index} : SHAFTCULL_NONE);
  };
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    shaftcull_contact_found contact{};
    ok(shaftcull_first_contact(c, s, q.bounds, q.query, &contact));
    same(contact, q.with([&](const auto&... option) { return first_contact(shafts[s], q.set, option...); }));
    std::vector<float> expected(indices.size());
    std::vector<float> given(indices.size());
    entry_times(shafts[s], q.set, indices, expected);
    ok(shaftcull_entry_times(c, s, q.bounds, indices.data(), given.data(), indices.size()));
    EXPECT_EQ(given, expected);
  }
  std::vector<FirstContact> expected(shafts.size());
  std::vector<shaftcull_contact_found> contacts(shafts.size());
  q.with([&](const auto&... option) { return first_contact_many(shafts, q.set, expected, option...); });
  ok(shaftcull_first_contact_many(c, 0, shafts.size(), q.bounds, q.query, contacts.data()));
  for (std::size_t s = 0; s != shafts.size(); ++s) same(contacts[s], expected[s]);
}

/// What blocks the shafts that are between two boxes.
template <class Set, class Option>
void compare_blocking(const Question<Set, Option>& q) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::span<const CompiledShaft> shafts = std::span(q.shafts.cpp).first(q.shafts.between);
  const auto call = [&](auto&& verb) {
    if constexpr (FlatSet<Set>) {
      return verb(q.set);
    } else {
      return q.with([&](const auto&... option) { return verb(q.set, option...); });
    }
  };
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    std::uint32_t is_blocked = 99;
    ok(shaftcull_blocked(c, s, q.bounds, q.query, &is_blocked));
    EXPECT_EQ(is_blocked != 0, call([&](const auto&... asked) { return blocked(shafts[s], asked...); }));
    std::uint64_t index = 99;
    ok(shaftcull_blocked_by(c, s, q.bounds, q.query, &index));
    const auto by = call([&](const auto&... asked) { return blocked_by(shafts[s], asked...); });
    EXPECT_EQ(index, by ? std::uint64_t{*by} : SHAFTCULL_NONE);
    Indices expected(q.size);
    Indices given(q.size);
    std::size_t found = 0;
    if constexpr (FlatSet<Set>) {
      found = list_blocking(shafts[s], q.set, std::span<std::uint32_t>(expected));
    } else {
      found = q.with([&](const auto&... option) {
        return list_blocking(shafts[s], q.set, std::span<std::uint32_t>(expected), option...);
      });
    }
    std::uint64_t number = 99;
    ok(shaftcull_list_blocking(c, s, q.bounds, q.query, given.data(), q.size, &number));
    ASSERT_EQ(number, found);
    expected.resize(found);
    given.resize(found);
    EXPECT_EQ(given, expected);
  }
  Words expected(words_for(shafts.size()));
  Words given(expected.size(), 99);
  IndexLists expected_lists;
  if constexpr (FlatSet<Set>) {
    blocked_many(shafts, q.set, expected);
    list_blocking_many(shafts, q.set, expected_lists);
  } else {
    q.with([&](const auto&... option) { return blocked_many(shafts, q.set, expected, option...); });
    q.with([&](const auto&... option) { return list_blocking_many(shafts, q.set, expected_lists, option...); });
  }
  ok(shaftcull_blocked_many(c, 0, shafts.size(), q.bounds, q.query, given.data(), given.size()));
  EXPECT_EQ(given, expected);
  const ListsHandle lists = made<ListsHandle>(shaftcull_lists_create, std::uint32_t{SHAFTCULL_LISTS_OF_INDICES});
  ok(shaftcull_list_blocking_many(c, 0, shafts.size(), q.bounds, q.query, lists.get()));
  const std::uint64_t* const offsets = shaftcull_lists_offsets(lists.get());
  EXPECT_EQ(Words(offsets, offsets + shafts.size() + 1), expected_lists.offsets);
}

/// What a callback was told.
struct Told {
  std::vector<std::tuple<std::uint64_t, std::uint64_t, Words, Words>> tiles;
  std::vector<std::tuple<std::uint64_t, Pairs, Pairs>> ranges;
  friend bool operator==(const Told&, const Told&) = default;
};

extern "C" std::int32_t record_tile(const shaftcull_tile* tile, void* user) {
  const std::size_t words = words_for(tile->size);
  static_cast<Told*>(user)->tiles.emplace_back(
      tile->shaft, tile->first, Words(tile->kept, tile->kept + words),
      tile->inside == nullptr ? Words() : Words(tile->inside, tile->inside + words));
  return 0;
}
extern "C" std::int32_t record_ranges(const shaftcull_ranges* ranges, void* user) {
  static_cast<Told*>(user)->ranges.emplace_back(ranges->shaft, as_pairs(std::span(ranges->kept, ranges->kept_count)),
                                                as_pairs(std::span(ranges->inside, ranges->inside_count)));
  return 0;
}

/// Tiles of views.
template <class Set, class Option>
void compare_tiles(const Question<Set, Option>& q) {
  const std::uint64_t count = q.shafts.cpp.size() - 1;  // from shaft 1 on
  const std::span<const CompiledShaft> shafts = std::span(q.shafts.cpp).subspan(1);
  Told expected;
  Told given;
  const auto record = [&](const TileAnswers& answers) {
    expected.tiles.emplace_back(answers.shaft + 1, answers.first, Words(answers.kept.begin(), answers.kept.end()),
                                Words(answers.inside.begin(), answers.inside.end()));
  };
  q.with([&](const auto&... option) { return for_each_tile(shafts, q.set, record, option...); });
  q.with([&](const auto&... option) { return for_each_classified_tile(shafts, q.set, record, option...); });
  ok(shaftcull_for_each_tile(q.shafts.c.get(), 1, count, q.bounds, q.query, record_tile, &given));
  ok(shaftcull_for_each_classified_tile(q.shafts.c.get(), 1, count, q.bounds, q.query, record_tile, &given));
  EXPECT_FALSE(expected.tiles.empty());
  EXPECT_EQ(given, expected);
}

/// Ranges of leaves of trees: in the caller's memory, in lists, and for callbacks.
template <class Set>
void compare_ranges(const Question<Set, Excluding>& q) {
  const shaftcull_shafts* const c = q.shafts.c.get();
  const std::span<const CompiledShaft> shafts(q.shafts.cpp);
  const std::size_t count = shafts.size();
  using Ranges = std::vector<LeafRange>;
  for (std::size_t s = 0; s != count; ++s) {
    SCOPED_TRACE("shaft " + std::to_string(s));
    for (const std::size_t room : {q.size, std::size_t{1}}) {
      Ranges ranges(room);
      std::vector<shaftcull_leaf_range> given(room);
      std::uint64_t number = 99;
      const std::size_t found =
          q.with([&](const auto&... option) { return list(shafts[s], q.set, std::span(ranges), option...); });
      ok(shaftcull_list_ranges(c, s, q.bounds, q.query, given.data(), room, &number));
      ASSERT_EQ(number, found);
      ranges.resize(std::min(room, found));
      given.resize(std::min(room, found));
      EXPECT_EQ(as_pairs(given), as_pairs(ranges));
    }
    Ranges overlap(q.size);
    Ranges inside(q.size);
    std::vector<shaftcull_leaf_range> given_overlap(q.size);
    std::vector<shaftcull_leaf_range> given_inside(q.size);
    shaftcull_kept_counts counts{};
    const KeptCounts found = q.with([&](const auto&... option) {
      return list_classified(shafts[s], q.set, std::span(overlap), std::span(inside), option...);
    });
    ok(shaftcull_list_classified_ranges(c, s, q.bounds, q.query, given_overlap.data(), q.size, given_inside.data(),
                                        q.size, &counts));
    ASSERT_EQ(as_counts(counts), found);
    overlap.resize(found.overlap);
    given_overlap.resize(found.overlap);
    inside.resize(found.inside);
    given_inside.resize(found.inside);
    EXPECT_EQ(as_pairs(given_overlap), as_pairs(overlap));
    EXPECT_EQ(as_pairs(given_inside), as_pairs(inside));
  }

  const auto same = [count](const ListsHandle& given, const LeafRangeLists& lists) {
    ASSERT_EQ(shaftcull_lists_count(given.get()), count);
    const std::uint64_t* const offsets = shaftcull_lists_offsets(given.get());
    EXPECT_EQ(Words(offsets, offsets + count + 1), lists.offsets);
    const shaftcull_leaf_range* const ranges = shaftcull_lists_ranges(given.get());
    EXPECT_EQ(as_pairs(std::span(ranges, ranges == nullptr ? 0 : offsets[count])), as_pairs(lists.ranges));
  };
  const auto kind = std::uint32_t{SHAFTCULL_LISTS_OF_RANGES};
  const ListsHandle given = made<ListsHandle>(shaftcull_lists_create, kind);
  const ListsHandle given_inside = made<ListsHandle>(shaftcull_lists_create, kind);
  LeafRangeLists lists;
  LeafRangeLists inside_lists;
  q.with([&](const auto&... option) { return list_many(shafts, q.set, lists, option...); });
  ok(shaftcull_list_many(c, 0, count, q.bounds, q.query, given.get()));
  same(given, lists);
  q.with([&](const auto&... option) { return list_classified_many(shafts, q.set, lists, inside_lists, option...); });
  ok(shaftcull_list_classified_many(c, 0, count, q.bounds, q.query, given.get(), given_inside.get()));
  same(given, lists);
  same(given_inside, inside_lists);

  Told expected;
  Told told;
  for_each_kept(
      shafts, q.set,
      [&](const KeptRanges& answers) { expected.ranges.emplace_back(answers.shaft, as_pairs(answers.kept), Pairs()); },
      q.option);
  for_each_classified(
      shafts, q.set,
      [&](const ClassifiedRanges& answers) {
        expected.ranges.emplace_back(answers.shaft, as_pairs(answers.overlap), as_pairs(answers.inside));
      },
      q.option);
  ok(shaftcull_for_each_kept(c, 0, count, q.bounds, q.query, record_ranges, &told));
  ok(shaftcull_for_each_classified(c, 0, count, q.bounds, q.query, record_ranges, &told));
  EXPECT_EQ(told, expected);
}

/// All questions of boxes or spheres in one holder.
template <class Set, class Option>
void compare_bounds(const Question<Set, Option>& q) {
  compare_bits(q, q.shafts.cpp.size());
  compare_lists(q, q.shafts.cpp.size());
  compare_classified(q);
  compare_times(q);
  if constexpr (Boxes<Set>) compare_blocking(q);
  if constexpr (FlatSet<Set>) {
    compare_tiles(q);
  } else {
    compare_ranges(q);
  }
}

/// A view or stream, with a query that says nothing, and without.
template <FlatSet Set>
void compare_flat(const Shafts& shafts, const shaftcull_bounds* bounds, const Set& set) {
  const NoOption none;
  const shaftcull_query query{};
  compare_bounds(Question<Set, NoOption>{shafts, bounds, set, &query, none, set.count});
  compare_bounds(Question<Set, NoOption>{shafts, bounds, set, nullptr, none, set.count});
}

/// A tree, without and with what is left out.
template <class Bound>
void compare_tree(Random& random, const Shafts& shafts, shaftcull_bounds* bounds, BoundsTree<Bound>& tree) {
  const Excluding nothing;
  using Q = Question<BoundsTree<Bound>, Excluding>;
  compare_bounds(Q{shafts, bounds, tree, nullptr, nothing, tree.size()});

  // A multiple of all numbers of shafts that are asked.
  Indices own(std::lcm(std::lcm(shafts.cpp.size(), shafts.moving), shafts.between));
  for (std::uint32_t& index : own) index = random.below(static_cast<unsigned>(tree.size()));
  Words mask(words_for(tree.size()));
  std::vector<std::uint32_t> layers(tree.size());
  for (std::size_t i = 0; i != tree.size(); ++i) {
    if (random.one_in(4)) mask[i / 64] |= std::uint64_t{1} << (i % 64);
    layers[i] = 1U << random.below(4);
  }
  tree.set_layers(layers);
  ok(shaftcull_tree_set_layers(bounds, layers.data(), layers.size()));
  const std::uint32_t only[] = {0b1011};
  const Excluding excluding{.own = std::span<const std::uint32_t>(own), .mask = mask, .only_layers = only};
  shaftcull_query query{};
  query.own = own.data();
  query.own_count = own.size();
  query.mask = mask.data();
  query.mask_words = mask.size();
  query.only_layers = only;
  query.only_layers_count = 1;
  compare_bounds(Q{shafts, bounds, tree, &query, excluding, tree.size()});
}

/// A tree before and after it is updated in all ways.
template <class Bound>
void compare_trees(Random& random, const Shafts& shafts, const std::vector<Bound>& values) {
  const auto in_c = as_c(values);
  const shaftcull_source source = source_of(in_c);
  BoundsTree<Bound> tree{std::span<const Bound>(values)};
  const BoundsHandle bounds = made<BoundsHandle>(shaftcull_tree_create, &source);
  compare_tree(random, shafts, bounds.get(), tree);

  std::vector<Bound> moved(values.rbegin(), values.rend());
  const auto moved_in_c = as_c(moved);
  const shaftcull_source moved_source = source_of(moved_in_c);
  tree.update(std::span<const Bound>(moved));
  ok(shaftcull_tree_update(bounds.get(), &moved_source));
  const Indices some{3, 1, 7};
  const auto three = std::vector(in_c.begin(), in_c.begin() + 3);
  const shaftcull_source three_source = source_of(three);
  tree.update(std::span<const std::uint32_t>(some), std::span(values).first(3));
  const std::uint32_t layers[] = {1, 2, 4};
  tree.set_layers(std::span<const std::uint32_t>(some), layers);
  ok(shaftcull_tree_update_some(bounds.get(), some.data(), 3, &three_source));
  ok(shaftcull_tree_set_layers_of(bounds.get(), some.data(), layers, 3));
#if defined(__cpp_exceptions)  // without, errors are no statuses
  std::uint64_t number = 0;
  EXPECT_EQ(shaftcull_count(shafts.c.get(), 0, bounds.get(), nullptr, &number), SHAFTCULL_NEEDS_REFIT);
#endif
  tree.refit();
  ok(shaftcull_tree_refit(bounds.get()));
  double growth = 0;
  ok(shaftcull_tree_growth(bounds.get(), &growth));
  EXPECT_EQ(growth, tree.growth());
  compare_tree(random, shafts, bounds.get(), tree);
  tree.rebuild();
  ok(shaftcull_tree_rebuild(bounds.get()));
  tree.renumber();
  ok(shaftcull_tree_renumber(bounds.get()));
  tree.clear_layers();
  ok(shaftcull_tree_clear_layers(bounds.get()));
  const std::uint32_t* given_layers = layers;
  ok(shaftcull_tree_layers(bounds.get(), &given_layers));
  EXPECT_EQ(given_layers, nullptr);
  compare_tree(random, shafts, bounds.get(), tree);
  shaftcull_box box{};
  ok(shaftcull_tree_box(bounds.get(), &box));
  EXPECT_EQ(std::bit_cast<Box>(box), tree.box());
}

class CAgreesWithCpp : public testing::TestWithParam<Shape> {};

TEST_P(CAgreesWithCpp, OnBoxesAndSpheresInViewsStreamsAndTrees) {
  Random random(20 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  std::vector<Box> boxes = scene<Box>(random, GetParam(), 333);
  boxes[5] = boxes[210] = {{-0.5F, -20, -20}, {0.5F, 20, 20}};  // walls, which block all shafts between two boxes
  const std::vector<Sphere> spheres = scene<Sphere>(random, GetParam(), 333);
  const BoxStream box_stream{std::span<const Box>(boxes)};
  const SphereStream sphere_stream{std::span<const Sphere>(spheres)};
  const BoundsHandle box_view = made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_BOXES},
                                                   box_stream.view().stream.data(), std::uint64_t{boxes.size()});
  const std::vector<shaftcull_sphere> c_spheres = as_c(spheres);
  const shaftcull_source source = source_of(c_spheres);
  const BoundsHandle c_sphere_stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  std::uint64_t wall = 0;
  ok(shaftcull_blocked_by(shafts.c.get(), 0, box_view.get(), nullptr, &wall));
  EXPECT_LE(wall, 5U);  // a scene may have one before it
  compare_flat(shafts, box_view.get(), box_stream.view());
  compare_flat(shafts, c_sphere_stream.get(), sphere_stream.view());
  compare_trees(random, shafts, boxes);
  compare_trees(random, shafts, spheres);
}

TEST_P(CAgreesWithCpp, OnTriangles) {
  Random random(70 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  std::vector<Triangle> triangles;
  for (const Box& box : scene<Box>(random, Shape::uniform, 333)) {
    triangles.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, box.hi}});
  }
  const std::vector<shaftcull_triangle> in_c = as_c(triangles);
  const shaftcull_source source = source_of(in_c);
  const TriangleStream stream{std::span<const Triangle>(triangles)};
  const TriangleTree tree{std::span<const Triangle>(triangles)};
  const BoundsHandle c_stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  const BoundsHandle c_tree = made<BoundsHandle>(shaftcull_tree_create, &source);
  for (const TriangleTest test : {TriangleTest::exact, TriangleTest::vertices}) {
    const bool exact = test == TriangleTest::exact;
    shaftcull_query query{};
    query.triangle_test = exact ? SHAFTCULL_TRIANGLES_EXACT : SHAFTCULL_TRIANGLES_BY_VERTICES;
    const std::size_t count = exact ? shafts.moving : shafts.cpp.size();  // hulls take vertices only
    const TriangleView view = stream.view();
    const Question<TriangleView, TriangleTest> flat{shafts, c_stream.get(), view, &query, test, view.count};
    compare_bits(flat, count);
    compare_lists(flat, count);
    const Question<TriangleTree, TriangleTest> in_tree{shafts, c_tree.get(), tree, &query, test, tree.size()};
    compare_bits(in_tree, count);
    compare_lists(in_tree, count);
    for (std::size_t s = 0; s != count; ++s) {
      for (std::size_t i = 0; i < triangles.size(); i += 10) {
        std::uint32_t kept = 99;
        ok(shaftcull_ask_triangle(shafts.c.get(), s, &in_c[i], query.triangle_test, &kept));
        EXPECT_EQ(kept != 0, cull(shafts.cpp[s], triangles[i], test));
      }
    }
  }
}

TEST_P(CAgreesWithCpp, OnOneBoxSphereOrPolygon) {
  Random random(120 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  const shaftcull_shafts* const c = shafts.c.get();
  for (std::size_t i = 0; i != 50; ++i) {
    const Box box = random.box(-4, 4, 0.1F, 3);
    const Sphere sphere{random.vec3(-4, 4), random.uniform(0, 2)};
    const std::vector<Vec3> polygon{box.lo, {box.hi[0], box.lo[1], box.lo[2]}, box.hi};
    const shaftcull_box c_box = as_c(box);
    const shaftcull_sphere c_sphere = as_c(sphere);
    std::vector<float> corners;
    for (const Vec3& corner : polygon) corners.insert(corners.end(), corner.begin(), corner.end());
    for (std::size_t s = 0; s != shafts.cpp.size(); ++s) {
      const CompiledShaft& shaft = shafts.cpp[s];
      shaftcull_answer answer = 99;
      ok(shaftcull_ask_box(c, s, &c_box, 1, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, box));
      ok(shaftcull_ask_box(c, s, &c_box, 0, &answer));
      EXPECT_EQ(answer != SHAFTCULL_OUTSIDE, cull(shaft, box));
      ok(shaftcull_ask_sphere(c, s, &c_sphere, 1, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, sphere));
      ok(shaftcull_ask_sphere(c, s, &c_sphere, 0, &answer));
      EXPECT_EQ(answer != SHAFTCULL_OUTSIDE, cull(shaft, sphere));
      if (s >= shafts.between) continue;
      std::uint32_t hidden = 99;
      ok(shaftcull_blocked_by_box(c, s, &c_box, &hidden));
      EXPECT_EQ(hidden != 0, blocked(shaft, box));
      ok(shaftcull_blocked_by_polygon(c, s, corners.data(), 3, &hidden));
      EXPECT_EQ(hidden != 0, blocked(shaft, polygon));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CAgreesWithCpp, testing::ValuesIn(shapes));

}  // namespace
}  // namespace shaftcull
