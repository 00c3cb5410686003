// SPDX-License-Identifier: MIT
/// Arguments that no call can use: null memory, sizes that wrap, values that are no enumerators. Each is refused with a
/// message, and nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "calls/every_call.hpp"
#include "caught.hpp"
#include "forms.hpp"
#include "message_of.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Arguments : public testing::Test {
 protected:
  static constexpr std::size_t count = 70;
  const std::vector<CompiledShaft> shafts_ = EveryCall::shafts(4);
  const BoxStream boxes_{std::vector<Box>(count, Box{{0, 0, 0}, {1, 1, 1}})};
  const SphereStream spheres_{std::vector<Sphere>(count, Sphere{{0, 0, 0}, 1})};
  const std::vector<std::uint64_t> untouched_ = std::vector<std::uint64_t>(8, 7);
  std::vector<std::uint64_t> kept_ = untouched_;
  std::vector<std::uint64_t> inside_ = untouched_;

  /// What all calls that read a view say of it.
  template <class View>
  std::vector<std::string> refusals_of(const View& view) {
    const std::span<std::uint64_t> row(kept_.data(), 2);
    const std::span<std::uint64_t> inside_row(inside_.data(), 2);
    const std::vector<std::uint32_t> candidates = {1, 2};
    std::vector<std::uint32_t> kept(2);
    std::vector<std::uint32_t> inside(2);
    std::vector<std::uint64_t> counts(shafts_.size());
    std::vector<std::uint32_t> few(3 * shafts_.size());
    std::vector<KeptCounts> classified(shafts_.size());
    IndexLists lists;
    IndexLists insides;
    using Bound = std::conditional_t<std::is_same_v<View, BoxView>, Box, Sphere>;
    const BoundsTree<Bound> whole{std::span<const Bound>(std::vector<Bound>(count))};
    BoundsTree<Bound> tree(whole);
    std::vector<std::string> messages;
    const auto ask = [&](const auto& call) { messages.push_back(message_of(call)); };
    ask([&] { cull(shafts_[0], view, row); });
    ask([&] { classify(shafts_[0], view, row, inside_row); });
    ask([&] { contained(shafts_[0], view, inside_row); });
    ask([&] { (void)shaftcull::count(shafts_[0], view); });
    ask([&] { (void)count_classified(shafts_[0], view); });
    ask([&] { (void)list(shafts_[0], view, kept); });
    ask([&] { (void)list_classified(shafts_[0], view, kept, inside); });
    ask([&] { (void)any(shafts_[0], view); });
    if constexpr (std::is_same_v<View, BoxView>) {
      ask([&] { (void)blocked(shafts_[0], view); });
      ask([&] { (void)blocked_by(shafts_[0], view); });
      ask([&] { (void)list_blocking(shafts_[0], view, kept); });
      ask([&] { blocked_many(shafts_, view, std::span(kept_).first(1)); });
      ask([&] { list_blocking_many(shafts_, view, lists); });
    }
    ask([&] { cull_many(shafts_, view, kept_); });
    ask([&] { classify_many(shafts_, view, kept_, inside_); });
    ask([&] { contained_many(shafts_, view, inside_); });
    ask([&] { count_many(shafts_, view, counts); });
    ask([&] { count_classified_many(shafts_, view, classified); });
    ask([&] { any_many(shafts_, view, std::span(kept_).first(1)); });
    ask([&] { (void)count_at_most(shafts_[0], view, 3); });
    ask([&] { (void)list_at_most(shafts_[0], view, kept); });
    ask([&] { count_at_most_many(shafts_, view, 3, counts); });
    ask([&] { list_at_most_many(shafts_, view, 3, few, counts); });
    std::vector<FirstContact> contacts(shafts_.size());
    std::vector<float> times(candidates.size());
    ask([&] { (void)first_contact(shafts_[0], view); });
    ask([&] { first_contact_many(shafts_, view, contacts); });
    ask([&] { entry_times(shafts_[0], view, std::span<const std::uint32_t>(candidates), times); });
    ask([&] { list_many(shafts_, view, lists); });
    ask([&] { list_classified_many(shafts_, view, lists, insides); });
    ask([&] { for_each_tile(shafts_, view, [](const TileAnswers&) { FAIL(); }); });
    ask([&] { for_each_classified_tile(shafts_, view, [](const TileAnswers&) { FAIL(); }); });
    ask([&] { (void)refine(shafts_[0], view, std::span<const std::uint32_t>(candidates), kept); });
    ask([&] { refine_many(shafts_, view, candidates, lists); });
    ask([&] { BoundsTree<Bound>{view}; });
    ask([&] { tree.update(view); });
    EXPECT_EQ(kept_, untouched_);
    EXPECT_EQ(inside_, untouched_);
    return messages;
  }
};

TEST_F(Arguments, ANullStreamIsRefusedByEveryCallAndNamed) {
  BoxView boxes = boxes_.view();
  boxes.stream[4] = nullptr;
  for (const std::string& message : refusals_of(boxes)) {
    EXPECT_THAT(message, AllOf(HasSubstr("boxes.stream[4] is null"), HasSubstr("70 floats")));
  }
  SphereView spheres = spheres_.view();
  spheres.stream[3] = nullptr;
  for (const std::string& message : refusals_of(spheres)) {
    EXPECT_THAT(message, AllOf(HasSubstr("spheres.stream[3] is null"), HasSubstr("70 floats")));
  }
  std::vector<CompiledShaft> out(count);
  EXPECT_THAT(message_of([&] { compile_batch(boxes_.view(), boxes, out); }), HasSubstr("boxes.stream[4] is null"));
}

TEST_F(Arguments, ANullStreamOfTrianglesIsRefusedByEveryCallAndNamed) {
  const TriangleStream triangles{std::vector<Triangle>(count, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}})};
  TriangleView view = triangles.view();
  view.stream[5] = nullptr;
  std::vector<std::uint32_t> kept(2);
  std::vector<std::uint64_t> counts(shafts_.size());
  IndexLists lists;
  std::vector<std::string> messages;
  const auto ask = [&](const auto& call) { messages.push_back(message_of(call)); };
  ask([&] { cull(shafts_[0], view, std::span(kept_).first(2)); });
  ask([&] { (void)shaftcull::count(shafts_[0], view); });
  ask([&] { (void)any(shafts_[0], view); });
  ask([&] { (void)list(shafts_[0], view, kept); });
  ask([&] { cull_many(shafts_, view, kept_); });
  ask([&] { count_many(shafts_, view, counts); });
  ask([&] { any_many(shafts_, view, std::span(kept_).first(1)); });
  ask([&] { list_many(shafts_, view, lists); });
  ask([&] { TriangleStream{view}; });
  ask([&] { TriangleTree{view}; });
  for (const std::string& message : messages) {
    EXPECT_THAT(message, AllOf(HasSubstr("triangles.stream[5] is null"), HasSubstr("70 floats")));
  }
  EXPECT_EQ(kept_, untouched_);
}

TEST_F(Arguments, NullStreamsOfAnEmptyViewAreLegal) {
  cull(shafts_[0], TriangleView(), {});
  cull_many(shafts_, TriangleView(), {});
  EXPECT_EQ(TriangleTree(TriangleView()).size(), 0U);
  cull(shafts_[0], BoxView(), {});
  contained(shafts_[0], SphereView(), {});
  cull_many(shafts_, BoxView(), {});
  compile_batch(BoxView(), BoxView(), {});
  IndexLists lists;
  list_many(shafts_, SphereView(), lists);
  EXPECT_EQ(lists.size(), shafts_.size());
  EXPECT_EQ(BoxTree(BoxView()).size(), 0U);
}

TEST_F(Arguments, ACountThatNoMemoryHoldsIsRefused) {
  BoxView boxes = boxes_.view();
  boxes.count = SIZE_MAX / 4 + 1;
  std::vector<std::uint64_t> none;
  EXPECT_THAT(message_of([&] { cull(shafts_[0], boxes, none); }),
              HasSubstr("boxes.count = " + std::to_string(boxes.count)));
  EXPECT_THAT(message_of([&] { cull_many(shafts_, boxes, none); }), HasSubstr("more than memory can hold"));
}

TEST_F(Arguments, RowsTimesWordsThatWrapAreRefused) {
  // 512 shafts times 2⁵⁵ words are 2⁶⁴, which wraps to 0: as many as no words at all. With 32 bits it is 2²³ words.
  const std::vector<CompiledShaft> shafts(512, shafts_[0]);
  alignas(64) static float nothing[1];
  BoxView boxes;
  boxes.stream.fill(nothing);
  boxes.count = SIZE_MAX / 8;
  ASSERT_EQ(512 * words_for(boxes.count), 0U);
  EXPECT_THAT(
      message_of([&] { cull_many(shafts, boxes, {}); }),
      AllOf(HasSubstr("kept_rows has 0 words"), HasSubstr("512 shafts"), HasSubstr("more than memory can hold")));
}

TEST_F(Arguments, NullOutputsAreRefused) {
  const std::span<std::uint64_t> null_row(static_cast<std::uint64_t*>(nullptr), 2);
  const std::span<std::uint64_t> null_rows(static_cast<std::uint64_t*>(nullptr), 8);
  const std::span<std::uint64_t> null_counts(static_cast<std::uint64_t*>(nullptr), 4);
  const std::span<std::uint64_t> row(kept_.data(), 2);
  EXPECT_THAT(message_of([&] { cull(shafts_[0], boxes_.view(), null_row); }),
              HasSubstr("kept is null; it must point to the first of 2 words"));
  EXPECT_THAT(message_of([&] { classify(shafts_[0], boxes_.view(), row, null_row); }), HasSubstr("inside is null"));
  EXPECT_THAT(message_of([&] { contained(shafts_[0], spheres_.view(), null_row); }), HasSubstr("inside is null"));
  EXPECT_THAT(message_of([&] { cull_many(shafts_, boxes_.view(), null_rows); }), HasSubstr("kept_rows is null"));
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_.view(), kept_, null_rows); }),
              HasSubstr("inside_rows is null"));
  EXPECT_THAT(message_of([&] { count_many(shafts_, boxes_.view(), null_counts); }), HasSubstr("kept_counts is null"));
  const BoxTree tree(boxes_.view());
  EXPECT_THAT(message_of([&] { cull(shafts_[0], tree, null_row); }), HasSubstr("kept is null"));
  EXPECT_THAT(message_of([&] { classify(shafts_[0], tree, row, null_row); }), HasSubstr("inside is null"));
  EXPECT_THAT(message_of([&] { contained(shafts_[0], tree, null_row); }), HasSubstr("inside is null"));
  EXPECT_THAT(message_of([&] { cull_many(shafts_, tree, null_rows); }), HasSubstr("kept_rows is null"));
  EXPECT_THAT(message_of([&] { classify_many(shafts_, tree, kept_, null_rows); }), HasSubstr("inside_rows is null"));
  EXPECT_THAT(message_of([&] { contained_many(shafts_, tree, null_rows); }), HasSubstr("inside_rows is null"));
  EXPECT_THAT(message_of([&] { count_many(shafts_, tree, null_counts); }), HasSubstr("kept_counts is null"));
  EXPECT_THAT(message_of([&] { any_many(shafts_, tree, null_row.first(1)); }), HasSubstr("any is null"));
  EXPECT_THAT(message_of([&] { count_at_most_many(shafts_, tree, 3, null_counts); }), HasSubstr("kept_counts is null"));
  std::vector<std::uint64_t> counts_of_few(shafts_.size(), 7);
  std::vector<std::uint32_t> few(3 * shafts_.size(), 7);
  EXPECT_THAT(message_of([&] { list_at_most_many(shafts_, boxes_, 3, few, null_counts); }),
              HasSubstr("kept_counts is null"));
  const std::span in_counts(reinterpret_cast<std::uint32_t*>(counts_of_few.data()), 2 * counts_of_few.size());
  EXPECT_THAT(message_of([&] { list_at_most_many(shafts_, boxes_, 1, in_counts.first(4), counts_of_few); }),
              HasSubstr("share memory"));
  EXPECT_THAT(message_of([&] { list_at_most_many(shafts_, boxes_, 4, few, counts_of_few); }),
              HasSubstr("kept has room for 12 indices; 4 shafts need room for most = 4 each"));
  EXPECT_THAT(message_of([&] { list_at_most_many(shafts_, tree, 2, std::span<std::uint32_t>(), counts_of_few); }),
              HasSubstr("kept has room for 0 indices; 4 shafts need room for most = 2 each"));
  EXPECT_EQ(few, std::vector<std::uint32_t>(few.size(), 7));
  EXPECT_EQ(counts_of_few, std::vector<std::uint64_t>(counts_of_few.size(), 7));
  EXPECT_THAT(message_of([&] {
                first_contact_many(shafts_, boxes_, {static_cast<FirstContact*>(nullptr), 4});
              }),
              HasSubstr("contacts is null"));
  EXPECT_THAT(message_of([&] {
                first_contact_many(shafts_, spheres_, {static_cast<FirstContact*>(nullptr), 4});
              }),
              HasSubstr("contacts is null"));
  EXPECT_THAT(message_of([&] {
                first_contact_many(shafts_, tree, {static_cast<FirstContact*>(nullptr), 4});
              }),
              HasSubstr("contacts is null"));
  EXPECT_THAT(message_of([&] { count_at_most_many(shafts_, boxes_, 3, null_counts); }),
              HasSubstr("kept_counts is null"));
  EXPECT_THAT(message_of([&] { contained_many(shafts_, boxes_, null_rows); }), HasSubstr("inside_rows is null"));
  const std::span<KeptCounts> null_classified(static_cast<KeptCounts*>(nullptr), 4);
  EXPECT_THAT(message_of([&] { count_classified_many(shafts_, boxes_, null_classified); }),
              HasSubstr("counts is null"));
  const std::span<std::uint64_t> null_bits(static_cast<std::uint64_t*>(nullptr), 1);
  EXPECT_THAT(message_of([&] { any_many(shafts_, boxes_, null_bits); }), HasSubstr("any is null"));
  const std::span<std::uint32_t> null_list(static_cast<std::uint32_t*>(nullptr), 2);
  std::vector<std::uint32_t> list_of_two = {7, 7};
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], boxes_, null_list); }), HasSubstr("kept is null"));
  EXPECT_THAT(message_of([&] { (void)list_at_most(shafts_[0], boxes_, null_list); }), HasSubstr("kept is null"));
  EXPECT_THAT(message_of([&] { (void)list_at_most(shafts_[0], tree, null_list); }), HasSubstr("kept is null"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], boxes_, null_list, list_of_two); }),
              HasSubstr("overlap is null"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], spheres_, list_of_two, null_list); }),
              HasSubstr("inside is null"));
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], tree, null_list); }),
              HasSubstr("kept is null; it must point to the first of 2 indices"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], tree, null_list, list_of_two); }),
              HasSubstr("overlap is null"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], tree, list_of_two, null_list); }),
              HasSubstr("inside is null"));
  const std::span<LeafRange> null_ranges(static_cast<LeafRange*>(nullptr), 2);
  std::vector<LeafRange> two_ranges(2);
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], tree, null_ranges); }),
              HasSubstr("kept is null; it must point to the first of 2 leaf ranges"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], tree, null_ranges, two_ranges); }),
              HasSubstr("overlap is null"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], tree, two_ranges, null_ranges); }),
              HasSubstr("inside is null"));
  EXPECT_EQ(list_of_two, (std::vector<std::uint32_t>{7, 7}));
  EXPECT_EQ(kept_, untouched_);
  const std::span<CompiledShaft> null_shafts(static_cast<CompiledShaft*>(nullptr), count);
  EXPECT_THAT(message_of([&] { compile_batch(boxes_.view(), boxes_.view(), null_shafts); }), HasSubstr("out is null"));
}

TEST_F(Arguments, NullInputsAreRefused) {
  const std::span<const CompiledShaft> null_shafts(static_cast<const CompiledShaft*>(nullptr), 4);
  EXPECT_THAT(message_of([&] { cull_many(null_shafts, boxes_.view(), kept_); }),
              HasSubstr("shafts is null; it must point to the first of 4 shafts"));
  const BoxTree tree(boxes_.view());
  std::vector<std::uint64_t> counts(4);
  EXPECT_THAT(message_of([&] { count_many(null_shafts, tree, counts); }), HasSubstr("shafts is null"));
  const std::span<const std::uint64_t> null_mask(static_cast<const std::uint64_t*>(nullptr), words_for(tree.size()));
  EXPECT_THAT(message_of([&] { (void)shaftcull::count(shafts_[0], tree, {.mask = null_mask}); }),
              HasSubstr("excluding.mask is null"));
  EXPECT_THAT(message_of([&] { cull_many(shafts_, tree, kept_, {.mask = null_mask}); }),
              HasSubstr("excluding.mask is null"));
  EXPECT_EQ(kept_, untouched_);
  const std::span<const std::uint32_t> null_candidates(static_cast<const std::uint32_t*>(nullptr), 3);
  std::vector<std::uint32_t> kept(3);
  EXPECT_THAT(message_of([&] { (void)refine(shafts_[0], boxes_.view(), null_candidates, kept); }),
              HasSubstr("candidates is null"));
  EXPECT_THAT(message_of([&] { static_cast<void>(refine(shafts_[0], tree, null_candidates, kept)); }),
              HasSubstr("candidates is null"));
  EXPECT_THAT(message_of([&] {
                BoxTree{CentreExtentRecords{nullptr, nullptr, sizeof(Box), 5}};
              }),
              AllOf(HasSubstr("CentreExtentRecords::centre is null"), HasSubstr("5 records")));
  EXPECT_THAT(message_of([&] { BoxStream{std::span<const Box>(static_cast<const Box*>(nullptr), 5)}; }),
              HasSubstr("boxes is null; it must point to the first of 5 boxes"));
  EXPECT_THAT(message_of([&] { SphereStream{std::span<const Sphere>(static_cast<const Sphere*>(nullptr), 5)}; }),
              HasSubstr("spheres is null; it must point to the first of 5 spheres"));
}

TEST_F(Arguments, AContactThatIsNoneIsRefused) {
  const auto contact = static_cast<Contact>(2);
  const auto names_it = AllOf(HasSubstr("contact = 2"), HasSubstr("Contact::open"));
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const IndexPair pair{0, 0};
  std::vector<CompiledShaft> out(1);
  EXPECT_THAT(message_of([&] { (void)compile(box, box, contact); }), names_it);
  EXPECT_THAT(
      message_of([&] { compile_batch(boxes_.view().slice(0, 1), boxes_.view().slice(0, 1), out, {}, contact); }),
      names_it);
  EXPECT_THAT(message_of([&] { compile_batch(boxes_, boxes_, std::span(&pair, 1), out, {}, contact); }), names_it);
  EXPECT_FALSE(out[0].formed()) << "written before the error was found";
  std::vector<CompiledShaft> shafts = shafts_;
  const Contact before = shafts[0].contact();
  EXPECT_THAT(message_of([&] { set_contact(shafts, contact); }), names_it);
  EXPECT_THAT(message_of([&] { set_contact(shafts[0], contact); }), names_it);
  EXPECT_EQ(shafts[0].contact(), before);
  EXPECT_THAT(message_of([&] { (void)Shaft(box, box, {.contact = contact}); }), HasSubstr("ShaftOptions::contact"));
  EXPECT_THAT(message_of([&] {
                set_contact(std::span<CompiledShaft>(static_cast<CompiledShaft*>(nullptr), 2), Contact::open);
              }),
              HasSubstr("shafts is null"));
}

TEST_F(Arguments, AFormThatIsNoEnumeratorIsRefused) {
  const auto form = static_cast<Form>(2);
  const auto names_it = AllOf(HasSubstr("form = 2"), HasSubstr("Form::planes"));
  std::vector<CompiledShaft> shafts = shafts_;
  EXPECT_THAT(message_of([&] { set_form(shafts, form); }), names_it);
  EXPECT_THAT(message_of([&] { set_form(shafts[0], form); }), names_it);
  EXPECT_EQ(shafts[0].form(), Form::slab);
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THAT(message_of([&] { (void)Shaft(box, box, {.form = form}); }), HasSubstr("ShaftOptions::form"));
  EXPECT_THAT(
      message_of([&] { set_form(std::span<CompiledShaft>(static_cast<CompiledShaft*>(nullptr), 2), Form::slab); }),
      HasSubstr("shafts is null"));
}

TEST_F(Arguments, FormsAreSetOfAllShaftsThatHaveOne) {
  const ConvexHull hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  std::vector<CompiledShaft> shafts = shafts_;
  shafts.push_back(hull);
  shafts.emplace_back();
  EXPECT_THAT(message_of([&] { set_form(shafts, Form::planes); }),
              AllOf(HasSubstr("shaft " + std::to_string(shafts_.size() + 1)), HasSubstr("never formed")));
  EXPECT_EQ(shafts[0].form(), Form::slab) << "written before the error was found";
  shafts.pop_back();
  set_form(shafts, Form::planes);
  EXPECT_EQ(shafts[0].form(), Form::planes);
  EXPECT_TRUE(shafts[0].has_planes());
  EXPECT_EQ(shafts.back().form(), Form::slab) << "a hull has one form";
  EXPECT_EQ(compile(Shaft({{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}, {.form = Form::planes})).form(),
            Form::planes);
}

TEST_F(Arguments, NumbersForEachShaftNeedASpanOfTheirOwnSize) {
  std::vector<KeptCounts> three(3, KeptCounts{7, 7});
  EXPECT_THAT(message_of([&] { count_classified_many(shafts_, boxes_, three); }),
              HasSubstr("counts has room for 3; 4 shafts need one each"));
  EXPECT_EQ(three, std::vector<KeptCounts>(3, KeptCounts{7, 7}));
  EXPECT_THAT(message_of([&] { any_many(shafts_, boxes_, kept_); }),
              HasSubstr("any has 8 words; one bit for each of 4 shafts takes 1"));
  EXPECT_THAT(message_of([&] { contained_many(shafts_, boxes_, std::span(inside_).first(7)); }),
              HasSubstr("inside_rows has 7 words"));
  EXPECT_EQ(kept_, untouched_);
  EXPECT_EQ(inside_, untouched_);
}

TEST_F(Arguments, ListsThatShareMemoryAreRefused) {
  std::vector<std::uint32_t> both(9, 7);
  EXPECT_THAT(
      message_of([&] { (void)list_classified(shafts_[0], boxes_, std::span(both).first(5), std::span(both).last(5)); }),
      HasSubstr("list_classified: overlap and inside share memory"));
  EXPECT_EQ(both, std::vector<std::uint32_t>(9, 7));
  IndexLists lists{{0, 1}, {5}};
  EXPECT_THAT(message_of([&] { list_classified_many(shafts_, spheres_, lists, lists); }),
              HasSubstr("list_classified_many: overlap and inside share memory"));
  EXPECT_EQ(lists.indices, std::vector<std::uint32_t>{5});
}

#if SIZE_MAX > UINT32_MAX
TEST_F(Arguments, ListsOfMoreBoundsThanIndicesReachAreRefused) {
  BoxView boxes = boxes_;
  boxes.count = (std::size_t{1} << 32U) + 1;  // never read
  std::vector<std::uint32_t> kept(1, 7);
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], boxes, kept); }),
              HasSubstr("list() got 4294967297 bounds, but 32-bit indices reach 4294967295; ask slices of the view"));
  EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], boxes, kept, std::span(kept).first(0)); }),
              HasSubstr("list_classified() got 4294967297 bounds"));
  IndexLists lists;
  IndexLists insides;
  EXPECT_THAT(message_of([&] { list_classified_many(shafts_, boxes, lists, insides); }),
              HasSubstr("list_classified_many() got 4294967297 bounds"));
  EXPECT_EQ(kept.front(), 7U);
}
#endif

TEST_F(Arguments, InsideAloneIsAnsweredByShaftsFormedForItAlone) {
  ShaftOptions options;
  options.outside = false;
  const std::vector<CompiledShaft> shafts(2, compile(Shaft(boxes_[0], boxes_[1], options)));
  EXPECT_NO_THROW(contained_many(shafts, boxes_, std::span(inside_).first(4)));
  EXPECT_THAT(message_of([&] { (void)any(shafts[0], boxes_); }), HasSubstr("formed without outside"));
  EXPECT_THAT(message_of([&] { (void)cull(shafts[0], boxes_[0]); }), HasSubstr("formed without outside"));
  EXPECT_THAT(message_of([&] { (void)classify(shafts[0], spheres_[0]); }), HasSubstr("formed without outside"));
}

TEST_F(Arguments, OptionsThatAreNoEnumeratorsAreRefused) {
  ShaftOptions options;
  options.order = static_cast<PlaneOrder>(3);
  EXPECT_THAT(message_of([&] { Shaft(boxes_[0], boxes_[1], options); }), HasSubstr("ShaftOptions::order"));
  options = {};
  options.formation = static_cast<Formation>(3);
  EXPECT_THAT(message_of([&] { Shaft(boxes_[0], boxes_[1], options); }), HasSubstr("ShaftOptions::formation"));
}

TEST_F(Arguments, PlanesBetweenFacesThatDoNotMeetCutNoVolume) {
  const Shaft shaft({{0, 0, 0}, {1, 1, 1}}, {{2, 3, 4}, {3, 4, 5}});
  JoiningPlane plane = shaft.joining_planes()[0];
  EXPECT_GT(culled_volume(shaft.box(), plane), 0);
  plane.red = 6;
  EXPECT_THAT(message_of([&] { (void)culled_volume(shaft.box(), plane); }), HasSubstr("red = 6"));
  plane.red = 2;
  plane.blue = 5;
  EXPECT_THAT(message_of([&] { (void)culled_volume(shaft.box(), plane); }), HasSubstr("do not meet"));
}

TEST_F(Arguments, MessagesSayOneWordAndNeverWrap) {
  std::vector<std::uint64_t> one(1);
  EXPECT_THAT(message_of([&] { cull(shafts_[0], boxes_.view(), one); }), HasSubstr("kept has 1 word; "));
  BoxStream stream(1);
  const std::vector<Box> box(2, Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_THAT(message_of([&] { stream.update(SIZE_MAX, box); }),
              AllOf(HasSubstr("2 boxes from position " + std::to_string(SIZE_MAX) + " on"), Not(HasSubstr(", 1)"))));
}

TEST_F(Arguments, NewStreamsHoldBoundsThatNoShaftKeeps) {
  const BoxStream boxes(count);
  const SphereStream spheres(count);
  EXPECT_LT(spheres[0].radius, 0);
  const float huge = 1e30F;
  std::vector<CompiledShaft> shafts = shafts_;
  shafts.push_back(compile(Shaft({{-huge, -huge, -huge}, {huge, huge, huge}}, {{-1, -1, -1}, {1, 1, 1}})));
  const std::vector<std::uint64_t> nothing(2);
  for (const CompiledShaft& shaft : shafts) {
    for (const Form form : forms) {
      std::vector<std::uint64_t> kept(2, 7);
      std::vector<std::uint64_t> inside(2, 7);
      cull(in_form(shaft, form), boxes.view(), kept);
      EXPECT_EQ(kept, nothing);
      classify(in_form(shaft, form), spheres.view(), kept, inside);
      EXPECT_EQ(kept, nothing);
      EXPECT_EQ(inside, nothing);
    }
  }
}

}  // namespace
}  // namespace shaftcull
