// SPDX-License-Identifier: MIT
/// Arguments that no call can use: null memory, sizes that wrap, values that are no enumerators. Each is refused with a
/// message, and nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "calls/every_call.hpp"
#include "caught.hpp"
#include "forms.hpp"
#include "message_of.hpp"
#include "shaftcull/paper.hpp"

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
    constexpr bool are_triangles = std::is_same_v<View, TriangleView>;
    using Bound =
        std::conditional_t<std::is_same_v<View, BoxView>, Box, std::conditional_t<are_triangles, Triangle, Sphere>>;
    const std::span<std::uint64_t> row(kept_.data(), 2);
    const std::span<std::uint64_t> inside_row(inside_.data(), 2);
    const std::vector<std::uint32_t> candidates = {1, 2};
    std::vector<std::uint32_t> kept(2, 7);
    std::vector<std::uint32_t> inside(2, 7);
    std::vector<std::uint64_t> counts(shafts_.size(), 7);
    std::vector<KeptCounts> classified(shafts_.size());
    IndexLists lists;
    IndexLists insides;
    std::vector<std::string> messages;
    const auto ask = [&](const auto& call) { messages.push_back(message_of(call)); };
    ask([&] { cull(shafts_[0], view, row); });
    ask([&] { classify(shafts_[0], view, row, inside_row); });
    ask([&] { classify(shafts_[0], view, {}, inside_row); });
    ask([&] { (void)shaftcull::count(shafts_[0], view); });
    ask([&] { (void)shaftcull::count(shafts_[0], view, {.limit = 3}); });
    ask([&] { (void)count_classified(shafts_[0], view); });
    ask([&] { (void)list(shafts_[0], view, kept); });
    ask([&] { (void)list(shafts_[0], view, std::span(kept)); });
    ask([&] { (void)list(shafts_[0], view, std::span(kept), {.limit = 2}); });
    ask([&] { (void)list(shafts_[0], view, std::span(kept), {.only = candidates}); });
    ask([&] { (void)list_classified(shafts_[0], view, kept, inside); });
    ask([&] { (void)any(shafts_[0], view); });
    ask([&] { cull_many(shafts_, view, kept_); });
    ask([&] { classify_many(shafts_, view, kept_, inside_); });
    ask([&] { classify_many(shafts_, view, {}, inside_); });
    ask([&] { count_many(shafts_, view, counts); });
    ask([&] { count_many(shafts_, view, counts, {.limit = 3}); });
    ask([&] { count_classified_many(shafts_, view, classified); });
    ask([&] { any_many(shafts_, view, std::span(kept_).first(1)); });
    ask([&] { list_many(shafts_, view, lists); });
    ask([&] { list_many(shafts_, view, lists, {.limit = 3}); });
    ask([&] { list_many(shafts_, view, lists, {.only = candidates}); });
    ask([&] { list_classified_many(shafts_, view, lists, insides); });
    if constexpr (std::is_same_v<View, BoxView>) {
      ask([&] { (void)occluded(shafts_[0], view); });
      ask([&] { (void)find_occluder(shafts_[0], view); });
      ask([&] { (void)list_occluders(shafts_[0], view, kept); });
      ask([&] { occluded_many(shafts_, view, std::span(kept_).first(1)); });
      ask([&] { list_occluders_many(shafts_, view, lists); });
    }
    if constexpr (are_triangles) {
      ask([&] { TriangleStream{view}; });
      ask([&] { TriangleTree{view}; });
    } else {
      std::vector<FirstContact> contacts(shafts_.size());
      std::vector<float> times(candidates.size());
      ask([&] { (void)first_contact(shafts_[0], view); });
      ask([&] { first_contact_many(shafts_, view, contacts); });
      ask([&] { entry_times(shafts_[0], view, candidates, times); });
      BoundsTree<Bound> tree{std::span<const Bound>(std::vector<Bound>(count))};
      ask([&] { BoundsTree<Bound>{view}; });
      ask([&] { tree.update(view); });
    }
    EXPECT_EQ(kept_, untouched_);
    EXPECT_EQ(inside_, untouched_);
    EXPECT_EQ(kept, std::vector<std::uint32_t>(2, 7));
    EXPECT_EQ(inside, std::vector<std::uint32_t>(2, 7));
    EXPECT_EQ(counts, std::vector<std::uint64_t>(shafts_.size(), 7));
    EXPECT_EQ(lists.size(), 0U);
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
  const TriangleStream stream{std::vector<Triangle>(count, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}})};
  TriangleView triangles = stream.view();
  triangles.stream[5] = nullptr;
  for (const std::string& message : refusals_of(triangles)) {
    EXPECT_THAT(message, AllOf(HasSubstr("triangles.stream[5] is null"), HasSubstr("70 floats")));
  }
  std::vector<CompiledShaft> out(count);
  EXPECT_THAT(message_of([&] { compile_batch(boxes_.view(), boxes, out); }), HasSubstr("boxes.stream[4] is null"));
}

TEST_F(Arguments, NullStreamsOfAnEmptyViewAreLegal) {
  cull(shafts_[0], TriangleView(), {});
  cull_many(shafts_, TriangleView(), {});
  EXPECT_EQ(TriangleTree(TriangleView()).size(), 0U);
  cull(shafts_[0], BoxView(), {});
  classify(shafts_[0], SphereView(), {}, {});
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
  ASSERT_EQ(512 * bit_words(boxes.count), 0U);
  EXPECT_THAT(
      message_of([&] { cull_many(shafts, boxes, {}); }),
      AllOf(HasSubstr("kept_rows has 0 words"), HasSubstr("512 shafts"), HasSubstr("more than memory can hold")));
}

TEST_F(Arguments, NullOutputsAreRefused) {
  const std::span<std::uint64_t> null_row(static_cast<std::uint64_t*>(nullptr), 2);
  const std::span<std::uint64_t> null_rows(static_cast<std::uint64_t*>(nullptr), 8);
  const std::span<std::uint64_t> null_counts(static_cast<std::uint64_t*>(nullptr), 4);
  const std::span<std::uint64_t> row(kept_.data(), 2);
  const std::span<std::uint64_t> null_bits(static_cast<std::uint64_t*>(nullptr), 1);
  const std::span<KeptCounts> null_classified(static_cast<KeptCounts*>(nullptr), 4);
  const std::span<FirstContact> null_contacts(static_cast<FirstContact*>(nullptr), 4);
  const std::span<std::uint32_t> null_list(static_cast<std::uint32_t*>(nullptr), 2);
  std::vector<std::uint32_t> list_of_two = {7, 7};
  EXPECT_THAT(message_of([&] { cull(shafts_[0], boxes_, null_row); }),
              HasSubstr("kept is null; it must point to the first of 2 words"));
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], boxes_, null_list); }),
              HasSubstr("kept is null; it must point to the first of 2 indices"));
  const BoxTree box_tree(boxes_.view());
  const SphereTree sphere_tree(spheres_.view());
  const TriangleStream triangles{std::vector<Triangle>(count, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}})};
  const TriangleTree triangle_tree(triangles.view());
  const Bounds of_boxes_and_spheres[] = {boxes_, spheres_, box_tree, sphere_tree};
  std::vector<Bounds> all(std::begin(of_boxes_and_spheres), std::end(of_boxes_and_spheres));
  all.insert(all.end(), {triangles, triangle_tree});
  for (const Bounds& bounds : all) {
    EXPECT_THAT(message_of([&] { cull(shafts_[0], bounds, null_row); }), HasSubstr("kept is null"));
    EXPECT_THAT(message_of([&] { classify(shafts_[0], bounds, row, null_row); }), HasSubstr("inside is null"));
    EXPECT_THAT(message_of([&] { classify(shafts_[0], bounds, null_row, row); }), HasSubstr("kept is null"));
    EXPECT_THAT(message_of([&] { classify(shafts_[0], bounds, {}, null_row); }), HasSubstr("inside is null"));
    EXPECT_THAT(message_of([&] { cull_many(shafts_, bounds, null_rows); }), HasSubstr("kept_rows is null"));
    EXPECT_THAT(message_of([&] { classify_many(shafts_, bounds, kept_, null_rows); }),
                HasSubstr("inside_rows is null"));
    EXPECT_THAT(message_of([&] { classify_many(shafts_, bounds, null_rows, inside_); }),
                HasSubstr("kept_rows is null"));
    EXPECT_THAT(message_of([&] { classify_many(shafts_, bounds, {}, null_rows); }), HasSubstr("inside_rows is null"));
    EXPECT_THAT(message_of([&] { count_many(shafts_, bounds, null_counts); }), HasSubstr("kept_counts is null"));
    EXPECT_THAT(message_of([&] { count_many(shafts_, bounds, null_counts, {.limit = 3}); }),
                HasSubstr("kept_counts is null"));
    EXPECT_THAT(message_of([&] { count_classified_many(shafts_, bounds, null_classified); }),
                HasSubstr("counts is null"));
    EXPECT_THAT(message_of([&] { any_many(shafts_, bounds, null_bits); }), HasSubstr("any is null"));
    EXPECT_THAT(message_of([&] { (void)list(shafts_[0], bounds, null_list); }), HasSubstr("kept is null"));
    EXPECT_THAT(message_of([&] { (void)list(shafts_[0], bounds, null_list, {.limit = 2}); }),
                HasSubstr("kept is null"));
    EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], bounds, null_list, list_of_two); }),
                HasSubstr("overlap is null"));
    EXPECT_THAT(message_of([&] { (void)list_classified(shafts_[0], bounds, list_of_two, null_list); }),
                HasSubstr("inside is null"));
  }
  for (const Bounds& bounds : of_boxes_and_spheres) {
    EXPECT_THAT(message_of([&] { first_contact_many(shafts_, bounds, null_contacts); }), HasSubstr("contacts is null"));
  }
  for (const Bounds& bounds : {Bounds(boxes_), Bounds(box_tree)}) {
    EXPECT_THAT(message_of([&] { occluded_many(shafts_, bounds, null_bits); }), HasSubstr("occluded is null"));
    EXPECT_THAT(message_of([&] { (void)list_occluders(shafts_[0], bounds, null_list); }),
                HasSubstr("blocking is null"));
  }
  EXPECT_EQ(list_of_two, (std::vector<std::uint32_t>{7, 7}));
  EXPECT_EQ(kept_, untouched_);
  EXPECT_EQ(inside_, untouched_);
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
  const std::span<const std::uint64_t> null_mask(static_cast<const std::uint64_t*>(nullptr), bit_words(tree.size()));
  const std::span<const std::uint32_t> null_indices(static_cast<const std::uint32_t*>(nullptr), 4);
  const std::vector<std::uint32_t> layers(count, 1);
  std::vector<std::uint32_t> kept(4, 7);
  for (const Bounds& bounds : {Bounds(boxes_, layers), Bounds(tree)}) {
    EXPECT_THAT(message_of([&] { (void)shaftcull::count(shafts_[0], bounds, {.exclude = null_indices}); }),
                HasSubstr("query.exclude is null"));
    EXPECT_THAT(message_of([&] { (void)shaftcull::count(shafts_[0], bounds, {.exclude_each = null_indices}); }),
                HasSubstr("query.exclude_each is null"));
    EXPECT_THAT(message_of([&] { cull_many(shafts_, bounds, kept_, {.exclude_each = null_indices}); }),
                HasSubstr("query.exclude_each is null"));
    EXPECT_THAT(message_of([&] { (void)shaftcull::count(shafts_[0], bounds, {.exclude_mask = null_mask}); }),
                HasSubstr("query.exclude_mask is null"));
    EXPECT_THAT(message_of([&] { cull_many(shafts_, bounds, kept_, {.exclude_mask = null_mask}); }),
                HasSubstr("query.exclude_mask is null"));
    EXPECT_THAT(message_of([&] { cull_many(shafts_, bounds, kept_, {.layer_mask = null_indices}); }),
                HasSubstr("query.layer_mask is null"));
    EXPECT_THAT(message_of([&] { (void)list(shafts_[0], bounds, std::span(kept), {.only = null_indices}); }),
                HasSubstr("query.only is null"));
    EXPECT_THAT(message_of([&] { cull_many(shafts_, bounds, kept_, {.only = null_indices}); }),
                HasSubstr("query.only is null"));
  }
  EXPECT_THAT(message_of([&] { cull(shafts_[0], Bounds(boxes_, null_indices), std::span(kept_).first(2)); }),
              HasSubstr("layers is null"));
  EXPECT_EQ(kept, std::vector<std::uint32_t>(4, 7));
  EXPECT_EQ(kept_, untouched_);
  EXPECT_THAT(message_of([&] {
                BoxTree{StridedCentreExtents{nullptr, nullptr, sizeof(Box), 5}};
              }),
              AllOf(HasSubstr("StridedCentreExtents::centre is null"), HasSubstr("5 records")));
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
}

TEST_F(Arguments, NumbersForEachShaftNeedASpanOfTheirOwnSize) {
  std::vector<KeptCounts> three(3, KeptCounts{7, 7});
  EXPECT_THAT(message_of([&] { count_classified_many(shafts_, boxes_, three); }),
              HasSubstr("counts has room for 3; 4 shafts need one each"));
  EXPECT_EQ(three, std::vector<KeptCounts>(3, KeptCounts{7, 7}));
  EXPECT_THAT(message_of([&] { any_many(shafts_, boxes_, kept_); }),
              HasSubstr("any has 8 words; one bit for each of 4 shafts takes 1"));
  EXPECT_THAT(message_of([&] { classify_many(shafts_, boxes_, {}, std::span(inside_).first(7)); }),
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
  EXPECT_THAT(message_of([&] { (void)list(shafts_[0], boxes, std::span(kept)); }),
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
  shafts.push_back(compile({{-huge, -huge, -huge}, {huge, huge, huge}}, {{-1, -1, -1}, {1, 1, 1}}));
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
