// SPDX-License-Identifier: MIT
/// Every query by the C interface, against the C++ one: over random scenes, of bounds of all kinds in all holders, of
/// all kinds of shafts, with each option and with all of them. Where the C++ interface refuses an option, the C
/// interface refuses it in the same words.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
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
  constexpr std::size_t all = 2 + pairs + 2 + 4 + 4 * 2 + 5;
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
  ok(set_between(c, next, ca[0], cb[0]));
  add(compile(a[0], b[0]));
  ok(set_between(c, next, ca[1], cb[1], SHAFTCULL_CONTACT_OPEN));
  add(compile(a[1], b[1], Contact::open));
  const BoxStream stream_a{std::span<const Box>(a)};
  const BoxStream stream_b{std::span<const Box>(b)};
  std::vector<CompiledShaft> batch(pairs);
  const auto add_batch = [&] {
    for (const CompiledShaft& shaft : batch) add(shaft);
  };
  const shaftcull_batch_planes batch_planes{cplanes.data(), pairs, nullptr, 0};
  ok(shaftcull_shafts_set_between(c, next, pairs, &from, &to, nullptr, &batch_planes, SHAFTCULL_CONTACT_CLOSED));
  compile_batch(stream_a, stream_b, batch, {.a = planes});
  add_batch();
  const std::vector<shaftcull_index_pair> cpairs{{0, 4}, {3, 1}};
  const std::vector<IndexPair> index_pairs{{0, 4}, {3, 1}};
  ok(shaftcull_shafts_set_between(c, next, 2, &from, &to, cpairs.data(), nullptr, SHAFTCULL_CONTACT_OPEN));
  batch.resize(2);
  compile_batch(stream_a, stream_b, index_pairs, batch, {}, Contact::open);
  add_batch();
  shafts.between = shafts.cpp.size();

  // Moving boxes, one at a time and two at once.
  const float reach = 2.5F;
  const auto at = [](const std::vector<shaftcull_box>& boxes, std::size_t i) { return shaftcull_boxes(&boxes[i], 1); };
  const shaftcull_source first_a = at(ca, 0);
  const shaftcull_source first_b = at(cb, 0);
  const shaftcull_source second_a = at(ca, 1);
  const shaftcull_source second_b = at(cb, 1);
  ok(shaftcull_shafts_set_swept(c, next, 1, &first_a, vectors[0].data(), cplanes.data(), 1));
  add(swept(a[0], vectors[0], std::span(planes).first(1)));
  ok(shaftcull_shafts_set_swept_infinite(c, next, 1, &second_a, vectors[1].data(), nullptr, 0));
  add(swept_infinite(a[1], vectors[1]));
  ok(shaftcull_shafts_set_shadow(c, next, 1, &first_a, &first_b, nullptr, nullptr, nullptr));
  add(shadow(a[0], b[0]));
  const shaftcull_batch_planes shadow_planes{cplanes.data(), 2, cplanes.data() + 2, 1};
  ok(shaftcull_shafts_set_shadow(c, next, 1, &second_a, &second_b, nullptr, &reach, &shadow_planes));
  add(shadow(a[1], b[1], reach, std::span(planes).first(3)));
  const shaftcull_source last_a = shaftcull_boxes(&ca[3], 2);
  const shaftcull_source last_b = shaftcull_boxes(&cb[3], 2);
  const BoxStream last_stream_a(std::span<const Box>(a).last(2));
  const BoxStream last_stream_b(std::span<const Box>(b).last(2));
  const std::span<const Vec3> last_vectors = std::span(vectors).last(2);
  const float* const last_floats = &floats[3 * (pairs - 2)];
  ok(shaftcull_shafts_set_swept(c, next, 2, &last_a, last_floats, cplanes.data(), 4));
  swept_batch(last_stream_a, last_vectors, batch, std::span(planes).first(4));
  add_batch();
  ok(shaftcull_shafts_set_swept_infinite(c, next, 2, &last_a, last_floats, nullptr, 0));
  swept_infinite_batch(last_stream_a, last_vectors, batch);
  add_batch();
  ok(shaftcull_shafts_set_shadow(c, next, 2, &last_a, &last_b, nullptr, nullptr, nullptr));
  shadow_batch(last_stream_a, last_stream_b, batch);
  add_batch();
  ok(shaftcull_shafts_set_shadow(c, next, 2, &from, &to, cpairs.data(), &reach, nullptr));
  shadow_batch(stream_a, stream_b, index_pairs, reach, batch);
  ok(shaftcull_shafts_set_contact(c, next, 2, SHAFTCULL_CONTACT_OPEN));
  set_contact(batch, Contact::open);
  add_batch();
  shafts.moving = shafts.cpp.size();

  // Hulls. They stay in the array of C when they are freed.
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

enum class Kind { boxes, spheres, triangles };

/// Options of a query, in no language yet. Those for each shaft are there for all shafts.
struct Options {
  std::string name;
  bool everywhere = false;  ///< asked of every shaft by itself, and not of some only
  bool null = false;        ///< C passes no query
  Indices exclude;
  Indices exclude_each;  ///< excluded_each a shaft
  Words exclude_mask;
  Indices layer_masks;  ///< none, one for all, or one for each shaft
  std::optional<Indices> only;
  std::size_t limit = 0;
  TriangleTest test = TriangleTest::exact;
};
constexpr std::size_t excluded_each = 40;

/// The same query in both languages, about `count` shafts from `first` on. Refers to the options.
class Asked {
 public:
  Asked(const Options& options, std::size_t first, std::size_t count)
      : each_(options.exclude_each.empty()
                  ? std::span<const std::uint32_t>()
                  : std::span(options.exclude_each).subspan(first * excluded_each, count * excluded_each)),
        masks_(options.layer_masks.size() <= 1 ? std::span(options.layer_masks)
                                               : std::span(options.layer_masks).subspan(first, count)),
        cpp_{.exclude = options.exclude,
             .exclude_each = each_,
             .exclude_mask = options.exclude_mask,
             .layer_mask = masks_,
             .limit = options.limit == 0 ? Query::no_limit : options.limit,
             .only = options.only ? std::optional(std::span(*options.only)) : std::nullopt,
             .triangle_test = options.test},
        is_null_(options.null) {
    static constexpr std::uint32_t no_candidates = 0;  // not NULL
    c_.exclude = options.exclude.data();
    c_.exclude_count = options.exclude.size();
    c_.exclude_each = each_.data();
    c_.exclude_each_count = each_.size();
    c_.exclude_mask = options.exclude_mask.data();
    c_.exclude_mask_words = options.exclude_mask.size();
    c_.layer_masks = masks_.data();
    c_.layer_mask_count = masks_.size();
    if (options.only) {
      c_.only = options.only->empty() ? &no_candidates : options.only->data();
      c_.only_count = options.only->size();
    }
    c_.limit = options.limit;
    c_.triangle_test =
        options.test == TriangleTest::exact ? SHAFTCULL_TRIANGLES_EXACT : SHAFTCULL_TRIANGLES_BY_VERTICES;
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  [[nodiscard]] const Query& cpp() const { return cpp_; }
  [[nodiscard]] const shaftcull_query* c() const { return is_null_ ? nullptr : &c_; }

 private:
  std::span<const std::uint32_t> each_;
  std::span<const std::uint32_t> masks_;
  Query cpp_;
  shaftcull_query c_{};
  bool is_null_;
};

/// Shafts and bounds in both languages.
struct Case {
  const Shafts& shafts;
  const shaftcull_bounds* c;
  Bounds cpp;
  Kind kind;
  bool has_layers;
};

/// The queries about a case.
struct Question {
  const Case& of;
  const Options& options;
  std::size_t start = 0;  ///< the first shaft that is asked by itself
  std::size_t step = 1;   ///< and how far it is to the next one

  [[nodiscard]] const shaftcull_shafts* shafts() const { return of.shafts.c.get(); }
  [[nodiscard]] const CompiledShaft& shaft(std::size_t s) const { return of.shafts.cpp[s]; }
  [[nodiscard]] std::size_t size() const { return of.cpp.size(); }
  /// How many of the shafts answer. Hulls answer about triangles by vertices only.
  [[nodiscard]] std::size_t count() const {
    const bool is_exact = of.kind == Kind::triangles && options.test == TriangleTest::exact;
    return is_exact ? of.shafts.moving : of.shafts.cpp.size();
  }

  /// Whether the options mean something to these bounds.
  [[nodiscard]] bool fits() const {
    return (of.kind == Kind::triangles || options.test == TriangleTest::exact) &&
           (of.has_layers || options.layer_masks.empty());
  }
  /// ... and to a verb that takes no limit.
  [[nodiscard]] bool fits_without_limit() const { return fits() && options.limit == 0; }
};

/// Makes both calls. Where the C++ one refuses the query, as it must unless it `fits`, so does the one of C, in the
/// same words.
template <class Cpp, class C>
void both_answer(bool fits, const Cpp& cpp, const C& c) {
#if defined(__cpp_exceptions)
  try {
    cpp();
  } catch (const InvalidArgument& refused) {
    EXPECT_FALSE(fits) << refused.what();
    EXPECT_EQ(c(), SHAFTCULL_INVALID_ARGUMENT);
    EXPECT_STREQ(shaftcull_error_message(), refused.what());
    return;
  }
  EXPECT_TRUE(fits) << "an option that means nothing was not refused";
#else
  if (!fits) return;  // errors are no statuses
  cpp();
#endif
  ok(c());
}

KeptCounts as_counts(const shaftcull_kept_counts& counts) {
  return {static_cast<std::size_t>(counts.overlap), static_cast<std::size_t>(counts.inside)};
}

FirstContact as_contact(const shaftcull_contact_found& contact) {
  EXPECT_EQ(contact.found, contact.index == SHAFTCULL_NONE ? 0U : 1U);
  return {contact.found == 0 ? FirstContact::none : static_cast<std::uint32_t>(contact.index), contact.time};
}

/// The first `size` of them, or fewer if there is less room.
Indices first_of(const Indices& indices, std::size_t size) {
  return {indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(std::min(size, indices.size()))};
}

void expect_same(const ListsHandle& given, const IndexLists& expected) {
  const shaftcull_lists* const lists = given.get();
  const shaftcull_lists_info info = described(shaftcull_lists_describe, lists);
  ASSERT_EQ(info.count, expected.size());
  ASSERT_EQ(info.offsets == nullptr, expected.offsets.empty());
  EXPECT_EQ(Words(info.offsets, info.offsets + expected.offsets.size()), expected.offsets);
  ASSERT_EQ(info.indices == nullptr, expected.indices.empty());
  EXPECT_EQ(Indices(info.indices, info.indices + expected.indices.size()), expected.indices);
}

// Of all comparisons below: both calls write over the same values. So results are the same after a call that is
// refused, too, since it writes nothing.

/// Bits, classified counts and any, of one shaft.
void compare_bits(const Question& q, std::size_t s) {
  const Asked asked(q.options, s, 1);
  const shaftcull_shafts* const c = q.shafts();
  const Bounds& bounds = q.of.cpp;
  const bool fits = q.fits_without_limit();
  const std::size_t words = bit_words(q.size());
  Words kept(words, 99);
  Words inside(words, 99);
  Words given_kept(words, 99);
  Words given_inside(words, 99);
  both_answer(
      fits, [&] { cull(q.shaft(s), bounds, kept, asked.cpp()); },
      [&] { return shaftcull_cull(c, s, 1, q.of.c, asked.c(), given_kept.data(), words); });
  EXPECT_EQ(given_kept, kept);
  kept.assign(words, 99);
  given_kept.assign(words, 99);
  both_answer(
      fits, [&] { classify(q.shaft(s), bounds, kept, inside, asked.cpp()); },
      [&] { return shaftcull_classify(c, s, 1, q.of.c, asked.c(), given_kept.data(), given_inside.data(), words); });
  EXPECT_EQ(given_kept, kept);
  EXPECT_EQ(given_inside, inside);
  inside.assign(words, 99);
  given_inside.assign(words, 99);
  both_answer(
      fits, [&] { classify(q.shaft(s), bounds, {}, inside, asked.cpp()); },
      [&] { return shaftcull_classify(c, s, 1, q.of.c, asked.c(), nullptr, given_inside.data(), words); });
  EXPECT_EQ(given_inside, inside);

  KeptCounts counts{99, 99};
  shaftcull_kept_counts given_counts{99, 99};
  both_answer(
      fits, [&] { counts = count_classified(q.shaft(s), bounds, asked.cpp()); },
      [&] { return shaftcull_count_classified(c, s, 1, q.of.c, asked.c(), &given_counts); });
  EXPECT_EQ(as_counts(given_counts), counts);
  std::uint64_t is_any = 99;
  std::uint64_t given_any = 99;
  both_answer(
      fits, [&] { is_any = any(q.shaft(s), bounds, asked.cpp()) ? 1 : 0; },
      [&] { return shaftcull_any(c, s, 1, q.of.c, asked.c(), &given_any); });
  EXPECT_EQ(given_any, is_any);
}

/// Counts and lists of one shaft.
void compare_lists(const Question& q, std::size_t s) {
  const Asked asked(q.options, s, 1);
  const shaftcull_shafts* const c = q.shafts();
  const Bounds& bounds = q.of.cpp;
  std::size_t number = 99;
  std::uint64_t given_number = 99;
  both_answer(
      q.fits(), [&] { number = count(q.shaft(s), bounds, asked.cpp()); },
      [&] { return shaftcull_count(c, s, 1, q.of.c, asked.c(), &given_number); });
  EXPECT_EQ(given_number, number);
  for (const std::size_t room : {q.size(), std::size_t{3}}) {
    Indices expected(room, 99);
    Indices given(room, 99);
    number = 99;
    given_number = 99;
    both_answer(
        q.fits(), [&] { number = list(q.shaft(s), bounds, std::span<std::uint32_t>(expected), asked.cpp()); },
        [&] { return shaftcull_list(c, s, q.of.c, asked.c(), given.data(), room, &given_number); });
    ASSERT_EQ(given_number, number);
    EXPECT_EQ(first_of(given, number), first_of(expected, number));
  }
  Indices overlap(q.size(), 99);
  Indices inside(q.size(), 99);
  Indices given_overlap(q.size(), 99);
  Indices given_inside(q.size(), 99);
  KeptCounts counts{99, 99};
  shaftcull_kept_counts given_counts{99, 99};
  both_answer(
      q.fits_without_limit(), [&] { counts = list_classified(q.shaft(s), bounds, overlap, inside, asked.cpp()); },
      [&] {
        return shaftcull_list_classified(c, s, q.of.c, asked.c(), given_overlap.data(), q.size(), given_inside.data(),
                                         q.size(), &given_counts);
      });
  ASSERT_EQ(as_counts(given_counts), counts);
  EXPECT_EQ(first_of(given_overlap, counts.overlap), first_of(overlap, counts.overlap));
  EXPECT_EQ(first_of(given_inside, counts.inside), first_of(inside, counts.inside));

  // Lists of candidates may overwrite them.
  if (!q.fits() || !q.options.only || q.options.only->empty()) return;
  Options options = q.options;
  Options given_options = q.options;
  const Asked over(options, s, 1);
  const Asked given_over(given_options, s, 1);
  Indices& left = *options.only;
  Indices& given_left = *given_options.only;
  number = list(q.shaft(s), bounds, std::span<std::uint32_t>(left), over.cpp());
  ok(shaftcull_list(c, s, q.of.c, given_over.c(), given_left.data(), given_left.size(), &given_number));
  ASSERT_EQ(given_number, number);
  EXPECT_EQ(first_of(given_left, number), first_of(left, number));
}

/// Bits, counts and lists of many shafts, from `first` on.
void compare_many(const Question& q, std::size_t first) {
  const std::size_t shafts = q.count() - first;
  const Asked asked(q.options, first, shafts);
  const shaftcull_shafts* const c = q.shafts();
  const std::span<const CompiledShaft> cpp = std::span(q.of.shafts.cpp).subspan(first, shafts);
  const Bounds& bounds = q.of.cpp;
  const bool fits = q.fits_without_limit();
  const std::size_t words = bit_words(q.size()) * shafts;
  Words kept(words, 99);
  Words inside(words, 99);
  Words given_kept(words, 99);
  Words given_inside(words, 99);
  both_answer(
      fits, [&] { cull_many(cpp, bounds, kept, asked.cpp()); },
      [&] { return shaftcull_cull(c, first, shafts, q.of.c, asked.c(), given_kept.data(), words); });
  EXPECT_EQ(given_kept, kept);
  kept.assign(words, 99);
  given_kept.assign(words, 99);
  both_answer(
      fits, [&] { classify_many(cpp, bounds, kept, inside, asked.cpp()); },
      [&] {
        return shaftcull_classify(c, first, shafts, q.of.c, asked.c(), given_kept.data(), given_inside.data(), words);
      });
  EXPECT_EQ(given_kept, kept);
  EXPECT_EQ(given_inside, inside);
  inside.assign(words, 99);
  given_inside.assign(words, 99);
  both_answer(
      fits, [&] { classify_many(cpp, bounds, {}, inside, asked.cpp()); },
      [&] { return shaftcull_classify(c, first, shafts, q.of.c, asked.c(), nullptr, given_inside.data(), words); });
  EXPECT_EQ(given_inside, inside);

  Words numbers(shafts, 99);
  Words given_numbers(shafts, 99);
  both_answer(
      q.fits(), [&] { count_many(cpp, bounds, numbers, asked.cpp()); },
      [&] { return shaftcull_count(c, first, shafts, q.of.c, asked.c(), given_numbers.data()); });
  EXPECT_EQ(given_numbers, numbers);
  std::vector<KeptCounts> counts(shafts, KeptCounts{99, 99});
  std::vector<shaftcull_kept_counts> given_counts(shafts, shaftcull_kept_counts{99, 99});
  both_answer(
      fits, [&] { count_classified_many(cpp, bounds, counts, asked.cpp()); },
      [&] { return shaftcull_count_classified(c, first, shafts, q.of.c, asked.c(), given_counts.data()); });
  for (std::size_t s = 0; s != shafts; ++s) {
    EXPECT_EQ(as_counts(given_counts[s]), counts[s]);
  }
  Words any_bits(bit_words(shafts), 99);
  Words given_any(bit_words(shafts), 99);
  both_answer(
      fits, [&] { any_many(cpp, bounds, any_bits, asked.cpp()); },
      [&] { return shaftcull_any(c, first, shafts, q.of.c, asked.c(), given_any.data()); });
  EXPECT_EQ(given_any, any_bits);

  IndexLists lists;
  IndexLists inside_lists;
  const ListsHandle given = made<ListsHandle>(shaftcull_lists_create);
  const ListsHandle given_inside_lists = made<ListsHandle>(shaftcull_lists_create);
  both_answer(
      q.fits(), [&] { list_many(cpp, bounds, lists, asked.cpp()); },
      [&] { return shaftcull_list_many(c, first, shafts, q.of.c, asked.c(), given.get()); });
  expect_same(given, lists);
  both_answer(
      fits, [&] { list_classified_many(cpp, bounds, lists, inside_lists, asked.cpp()); },
      [&] {
        return shaftcull_list_classified_many(c, first, shafts, q.of.c, asked.c(), given.get(),
                                              given_inside_lists.get());
      });
  expect_same(given, lists);
  expect_same(given_inside_lists, inside_lists);
}

/// First contact and entry times, of the shafts in which something moves. Triangles are refused.
void compare_times(const Question& q) {
  const shaftcull_shafts* const c = q.shafts();
  const Bounds& bounds = q.of.cpp;
  const std::size_t shafts = q.of.shafts.moving;
  const bool fits = q.fits_without_limit() && q.of.kind != Kind::triangles;
  Indices indices;
  for (std::size_t i = 0; i < q.size(); i += 2) indices.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t s = q.start; s < shafts; s += q.step) {
    const Asked asked(q.options, s, 1);
    FirstContact expected{99, 99};
    shaftcull_contact_found given{99, 99, 1};
    both_answer(
        fits, [&] { expected = first_contact(q.shaft(s), bounds, asked.cpp()); },
        [&] { return shaftcull_first_contact(c, s, 1, q.of.c, asked.c(), &given); });
    EXPECT_EQ(as_contact(given), expected);
    if (!q.options.null) continue;  // entry times have no query
    std::vector<float> times(indices.size(), 99);
    std::vector<float> given_times(indices.size(), 99);
    both_answer(
        fits, [&] { entry_times(q.shaft(s), bounds, indices, times); },
        [&] { return shaftcull_entry_times(c, s, q.of.c, indices.data(), given_times.data(), indices.size()); });
    EXPECT_EQ(given_times, times);
  }
  const Asked asked(q.options, 0, shafts);
  std::vector<FirstContact> expected(shafts, FirstContact{99, 99});
  std::vector<shaftcull_contact_found> given(shafts, shaftcull_contact_found{99, 99, 1});
  both_answer(
      fits, [&] { first_contact_many(std::span(q.of.shafts.cpp).first(shafts), bounds, expected, asked.cpp()); },
      [&] { return shaftcull_first_contact(c, 0, shafts, q.of.c, asked.c(), given.data()); });
  for (std::size_t s = 0; s != shafts; ++s) {
    EXPECT_EQ(as_contact(given[s]), expected[s]);
  }
}

/// Occluders of the shafts that are between two boxes. Spheres, triangles and candidates are refused.
void compare_occluders(const Question& q) {
  const shaftcull_shafts* const c = q.shafts();
  const Bounds& solids = q.of.cpp;
  const std::size_t shafts = q.of.shafts.between;
  const bool lists_fit = q.fits() && q.of.kind == Kind::boxes && !q.options.only;
  const bool fits = lists_fit && q.options.limit == 0;
  for (std::size_t s = q.start; s < shafts; s += q.step) {
    const Asked asked(q.options, s, 1);
    std::uint64_t is_occluded = 99;
    std::uint64_t given_occluded = 99;
    both_answer(
        fits, [&] { is_occluded = occluded(q.shaft(s), solids, asked.cpp()) ? 1 : 0; },
        [&] { return shaftcull_occluded(c, s, 1, q.of.c, asked.c(), &given_occluded); });
    EXPECT_EQ(given_occluded, is_occluded);
    std::optional<std::uint32_t> by = 99;
    std::uint64_t given_by = 99;
    both_answer(
        fits, [&] { by = find_occluder(q.shaft(s), solids, asked.cpp()); },
        [&] { return shaftcull_find_occluder(c, s, q.of.c, asked.c(), &given_by); });
    EXPECT_EQ(given_by, by ? std::uint64_t{*by} : SHAFTCULL_NONE);
  }
  const Asked asked(q.options, 0, shafts);
  const std::span<const CompiledShaft> cpp = std::span(q.of.shafts.cpp).first(shafts);
  Words expected(bit_words(shafts), 99);
  Words given(expected.size(), 99);
  both_answer(
      fits, [&] { occluded_many(cpp, solids, expected, asked.cpp()); },
      [&] { return shaftcull_occluded(c, 0, shafts, q.of.c, asked.c(), given.data()); });
  EXPECT_EQ(given, expected);
  IndexLists expected_lists;
  const ListsHandle given_lists = made<ListsHandle>(shaftcull_lists_create);
  both_answer(
      lists_fit, [&] { list_occluders_many(cpp, solids, expected_lists, asked.cpp()); },
      [&] { return shaftcull_list_occluders(c, 0, shafts, q.of.c, asked.c(), given_lists.get()); });
  expect_same(given_lists, expected_lists);
}

/// All questions with these options. Some shafts are asked by themselves, others with other options.
void compare(const Case& of, const std::vector<Options>& all) {
  constexpr std::size_t some = 5;
  for (std::size_t o = 0; o != all.size(); ++o) {
    SCOPED_TRACE(all[o].name);
    const bool everywhere = all[o].everywhere;
    const Question q{of, all[o], everywhere ? 0 : o % some, everywhere ? 1 : some};
    for (std::size_t s = q.start; s < q.count(); s += q.step) {
      SCOPED_TRACE("shaft " + std::to_string(s));
      compare_bits(q, s);
      compare_lists(q, s);
    }
    compare_many(q, o % 2);
    compare_times(q);
    compare_occluders(q);
  }
}

/// Layers of so many bounds, four of them.
Indices some_layers(Random& random, std::size_t size) {
  Indices layers(size);
  for (std::uint32_t& layer : layers) layer = 1U << random.below(4);
  return layers;
}

/// No query, one that says nothing, and each option. Triangles are tested in one way, and other bounds refuse one.
std::vector<Options> each_option(Random& random, std::size_t shafts, std::size_t size, Kind kind, TriangleTest test) {
  const auto some_indices = [&](std::size_t count) {
    Indices indices(count);
    for (std::uint32_t& index : indices) index = random.below(static_cast<unsigned>(size));
    return indices;
  };
  std::vector<Options> all;
  const auto add = [&](const char* name) -> Options& {
    Options& options = all.emplace_back();
    options.name = name;
    options.test = test;
    return options;
  };
  if (test == TriangleTest::exact) add("no query").null = true;
  add("nothing");
  for (Options& options : all) options.everywhere = true;
  add("exclude").exclude = some_indices(60);
  add("exclude_each").exclude_each = some_indices(shafts * excluded_each);
  Words& mask = add("exclude_mask").exclude_mask;
  mask.resize(bit_words(size));
  for (std::size_t i = 0; i != size; ++i) {
    if (random.one_in(4)) mask[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  add("a layer mask").layer_masks = {0b1011};
  Indices& masks = add("layer masks").layer_masks;
  for (std::size_t s = 0; s != shafts; ++s) masks.push_back(random.below(16));
  Indices& only = add("only").only.emplace();
  for (std::size_t i = size; i >= 3; i -= 3) only.push_back(static_cast<std::uint32_t>(i - 1));  // they descend
  add("only none").only.emplace();
  add("limit").limit = 4;
  if (kind != Kind::triangles) add("triangle_test").test = TriangleTest::vertices;
  return all;
}

/// All of these at once, with a limit and without, which some verbs refuse, and with candidates and without, which
/// others refuse. The bounds may have no layers.
std::vector<Options> all_at_once(const std::vector<Options>& each, bool have_layers) {
  Options all;
  all.everywhere = true;
  all.test = each.front().test;
  for (const Options& options : each) {
    if (!options.exclude.empty()) all.exclude = options.exclude;
    if (!options.exclude_each.empty()) all.exclude_each = options.exclude_each;
    if (!options.exclude_mask.empty()) all.exclude_mask = options.exclude_mask;
    if (have_layers && !options.layer_masks.empty()) all.layer_masks = options.layer_masks;
    if (options.only && !options.only->empty()) all.only = options.only;
  }
  std::vector<Options> several(4, all);
  several[0].name = "all but a limit";
  several[1].name = "all options";
  several[1].limit = 2;
  several[2].name = "all but a limit and candidates";
  several[2].only.reset();
  several[3].name = "all but candidates";
  several[3].only.reset();
  several[3].limit = 2;
  return several;
}

/// A view or stream: without layers, and then with each option and all of them.
template <class View>
void compare_flat(Random& random, const Shafts& shafts, shaftcull_bounds* c, const View& view, Kind kind,
                  TriangleTest test = TriangleTest::exact) {
  const std::vector<Options> each = each_option(random, shafts.cpp.size(), view.count, kind, test);
  const std::vector<Options> all = all_at_once(each, true);
  const Indices layers = some_layers(random, view.count);
  compare({shafts, c, view, kind, false}, {each[0], all[0]});
  compare({shafts, c, view, kind, false}, all_at_once(each, false));
  ok(shaftcull_bounds_set_layers(c, nullptr, layers.data(), layers.size()));
  compare({shafts, c, Bounds(view, layers), kind, true}, each);
  compare({shafts, c, Bounds(view, layers), kind, true}, all);

  Indices others = layers;
  const Indices some{3, 1, 3};
  const Indices changed{1, 2, 8};
  others[1] = 2;
  others[3] = 8;  // the last counts
  ok(shaftcull_bounds_set_layers(c, some.data(), changed.data(), 3));
  const std::uint32_t* const given = described(c).layers;
  EXPECT_EQ(Indices(given, given + view.count), others);
  const BoundsHandle copy = made<BoundsHandle>(shaftcull_bounds_copy, static_cast<const shaftcull_bounds*>(c));
  ok(shaftcull_bounds_set_layers(c, nullptr, nullptr, view.count));
  EXPECT_EQ(described(c).layers, nullptr);
  compare({shafts, copy.get(), Bounds(view, others), kind, true}, {all[0]});
}

/// A tree before and after it is updated in all ways.
template <class Bound>
void compare_trees(Random& random, const Shafts& shafts, const std::vector<Bound>& values, Kind kind) {
  const auto in_c = as_c(values);
  const shaftcull_source source = source_of(in_c);
  BoundsTree<Bound> tree{std::span<const Bound>(values)};
  const BoundsHandle bounds = made<BoundsHandle>(shaftcull_tree_create, &source);
  const std::vector<Options> each = each_option(random, shafts.cpp.size(), values.size(), kind, TriangleTest::exact);
  const std::vector<Options> all = all_at_once(each, true);
  const std::vector<Options> few{each[0], all[0], all[3]};
  const auto compare_now = [&](const std::vector<Options>& options) {
    compare({shafts, bounds.get(), tree, kind, tree.has_layers()}, options);
  };
  compare_now(few);
  compare_now(all_at_once(each, false));
  const Indices all_layers = some_layers(random, values.size());
  tree.set_layers(all_layers);
  ok(shaftcull_bounds_set_layers(bounds.get(), nullptr, all_layers.data(), all_layers.size()));
  compare_now(each);
  compare_now(all);

  std::vector<Bound> moved(values.rbegin(), values.rend());
  const auto moved_in_c = as_c(moved);
  const shaftcull_source moved_source = source_of(moved_in_c);
  tree.update(std::span<const Bound>(moved));
  ok(shaftcull_bounds_update(bounds.get(), 0, &moved_source));
  const Indices some{3, 1, 7};
  const auto three = std::vector(in_c.begin(), in_c.begin() + 3);
  const shaftcull_source three_source = source_of(three);
  tree.update(std::span<const std::uint32_t>(some), std::span(values).first(3));
  const std::uint32_t layers[] = {1, 2, 4};
  tree.set_layers(std::span<const std::uint32_t>(some), layers);
  ok(shaftcull_tree_update_some(bounds.get(), some.data(), 3, &three_source));
  ok(shaftcull_bounds_set_layers(bounds.get(), some.data(), layers, 3));
#if defined(__cpp_exceptions)  // without, errors are no statuses
  std::uint64_t number = 0;
  EXPECT_EQ(shaftcull_count(shafts.c.get(), 0, 1, bounds.get(), nullptr, &number), SHAFTCULL_NEEDS_REFIT);
#endif
  tree.refit();
  ok(shaftcull_tree_refit(bounds.get()));
  double sah_ratio = 0;
  ok(shaftcull_tree_sah_ratio(bounds.get(), &sah_ratio));
  EXPECT_EQ(sah_ratio, tree.sah_ratio());
  compare_now(few);
  tree.rebuild();
  ok(shaftcull_tree_rebuild(bounds.get()));
  tree.reorder();
  ok(shaftcull_tree_reorder(bounds.get()));
  const shaftcull_bounds_info info = described(bounds.get());
  EXPECT_TRUE(std::ranges::equal(std::span(info.layers, tree.size()), tree.layers()));
  EXPECT_TRUE(std::ranges::equal(std::span(info.order, tree.size()), tree.order()));
  EXPECT_EQ(std::bit_cast<Box>(info.box), tree.box());
  compare_now(few);
  tree.clear_layers();
  ok(shaftcull_bounds_set_layers(bounds.get(), nullptr, nullptr, tree.size()));
  EXPECT_EQ(described(bounds.get()).layers, nullptr);
  compare_now(few);
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
  const BoundsHandle sphere_view =
      made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_SPHERES}, sphere_stream.view().stream.data(),
                         std::uint64_t{spheres.size()});
  const std::vector<shaftcull_box> c_boxes = as_c(boxes);
  const std::vector<shaftcull_sphere> c_spheres = as_c(spheres);
  const shaftcull_source box_source = source_of(c_boxes);
  const shaftcull_source sphere_source = source_of(c_spheres);
  const BoundsHandle c_box_stream = made<BoundsHandle>(shaftcull_stream_create, &box_source);
  const BoundsHandle c_sphere_stream = made<BoundsHandle>(shaftcull_stream_create, &sphere_source);
  std::uint64_t wall = 0;
  ok(shaftcull_find_occluder(shafts.c.get(), 0, box_view.get(), nullptr, &wall));
  EXPECT_LE(wall, 5U);  // a scene may have one before it
  compare_flat(random, shafts, box_view.get(), box_stream.view(), Kind::boxes);
  compare_flat(random, shafts, c_box_stream.get(), box_stream.view(), Kind::boxes);
  compare_flat(random, shafts, sphere_view.get(), sphere_stream.view(), Kind::spheres);
  compare_flat(random, shafts, c_sphere_stream.get(), sphere_stream.view(), Kind::spheres);
  compare_trees(random, shafts, boxes, Kind::boxes);
  compare_trees(random, shafts, spheres, Kind::spheres);
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
  const BoundsHandle c_view = made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_TRIANGLES},
                                                 stream.view().stream.data(), std::uint64_t{triangles.size()});
  const BoundsHandle c_stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  const BoundsHandle c_tree = made<BoundsHandle>(shaftcull_tree_create, &source);
  for (const TriangleTest test : {TriangleTest::exact, TriangleTest::vertices}) {
    const bool exact = test == TriangleTest::exact;
    SCOPED_TRACE(exact ? "exact" : "by vertices");
    compare_flat(random, shafts, c_view.get(), stream.view(), Kind::triangles, test);
    compare_flat(random, shafts, c_stream.get(), stream.view(), Kind::triangles, test);
    const std::vector<Options> each = each_option(random, shafts.cpp.size(), triangles.size(), Kind::triangles, test);
    compare({shafts, c_tree.get(), tree, Kind::triangles, false}, each);  // it has no layers
    compare({shafts, c_tree.get(), tree, Kind::triangles, false}, all_at_once(each, false));
    const std::size_t count = exact ? shafts.moving : shafts.cpp.size();  // hulls take vertices only
    Words inside(bit_words(triangles.size()));
    for (std::size_t s = 0; s != count; ++s) {
      classify(shafts.cpp[s], stream, {}, inside, {.triangle_test = test});
      for (std::size_t i = 0; i < triangles.size(); i += 10) {
        shaftcull_answer answer = 99;
        ok(shaftcull_classify_one(shafts.c.get(), s, SHAFTCULL_TRIANGLES, &in_c[i],
                                  exact ? SHAFTCULL_TRIANGLES_EXACT : SHAFTCULL_TRIANGLES_BY_VERTICES, &answer));
        EXPECT_EQ(answer != SHAFTCULL_OUTSIDE, keeps(shafts.cpp[s], triangles[i], test));
        EXPECT_EQ(answer == SHAFTCULL_INSIDE, (inside[i / 64] >> (i % 64) & 1) != 0);
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
      ok(shaftcull_classify_one(c, s, SHAFTCULL_BOXES, &c_box, 0, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, box));
      ok(shaftcull_classify_one(c, s, SHAFTCULL_SPHERES, &c_sphere, 0, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, sphere));
      if (s >= shafts.between) continue;
      std::uint32_t hidden = 99;
      ok(shaftcull_occluded_by_box(c, s, &c_box, &hidden));
      EXPECT_EQ(hidden != 0, occluded(shaft, box));
      ok(shaftcull_occluded_by_polygon(c, s, corners.data(), 3, &hidden));
      EXPECT_EQ(hidden != 0, occluded(shaft, polygon));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CAgreesWithCpp, testing::ValuesIn(shapes));

}  // namespace
}  // namespace shaftcull
