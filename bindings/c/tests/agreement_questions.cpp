// SPDX-License-Identifier: MIT
/// Every query in C, against the one in C++. Where the C++ interface refuses an option, the C interface refuses it in
/// the same words.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "agreement.hpp"

namespace shaftcull::agreement {
namespace {

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
  EXPECT_EQ(contact.reserved, 0U);
  return {contact.found == 0 ? FirstContact::none : static_cast<std::uint32_t>(contact.index),
          contact.time,
          {contact.normal[0], contact.normal[1], contact.normal[2]}};
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
  const bool skips = q.options.skip_overlapping;  // which first contact alone takes
  const bool fits = (skips || q.fits_without_limit()) && q.of.kind != Kind::triangles;
  Indices indices;
  for (std::size_t i = 0; i < q.size(); i += 2) indices.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t s = q.start; s < shafts; s += q.step) {
    const Asked asked(q.options, s, 1);
    FirstContact expected{99, 99, {99, 99, 99}};
    shaftcull_contact_found given{99, 99, 1, {99, 99, 99}, 0};
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
  std::vector<FirstContact> expected(shafts, FirstContact{99, 99, {99, 99, 99}});
  std::vector<shaftcull_contact_found> given(shafts, shaftcull_contact_found{99, 99, 1, {99, 99, 99}, 0});
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

}  // namespace

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

}  // namespace shaftcull::agreement
