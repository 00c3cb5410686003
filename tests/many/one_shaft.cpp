// SPDX-License-Identifier: MIT
/// Numbers and lists of one shaft: what cull() and classify() say, over several chunks of bounds, and whether or not
/// the results fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "columns.hpp"
#include "forms.hpp"
#include "guarded_floats.hpp"
#include "many/workload.hpp"
#include "result_words.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull {
namespace {

/// More than two of the largest chunks, and no whole word at the end.
constexpr std::size_t many_bounds = 40001;

/// A list of `results` into room for `room` of them holds the first that fit, and nothing past the room is written.
template <class List>
void expect_listed(const std::vector<std::uint32_t>& results, std::size_t room, const List& list) {
  SCOPED_TRACE("room for " + std::to_string(room) + " of " + std::to_string(results.size()));
  constexpr auto unwritten = static_cast<std::uint32_t>(sentinel);
  std::vector<std::uint32_t> memory(room + 64, unwritten);
  list(std::span(memory).first(room));
  const auto fit = static_cast<std::ptrdiff_t>(std::min(room, results.size()));
  EXPECT_TRUE(std::equal(results.begin(), results.begin() + fit, memory.begin()));
  const auto behind = memory.begin() + static_cast<std::ptrdiff_t>(room);
  EXPECT_EQ(std::vector<std::uint32_t>(behind, memory.end()), std::vector<std::uint32_t>(64, unwritten))
      << "written past the room";
}

template <class View>
void expect_numbers_and_lists(const CompiledShaft& shaft, const View& view, Form form) {
  const ExpectedLists right = ExpectedRows({shaft}, view).lists(0);
  const KeptCounts counts{right.overlap.size(), right.inside.size()};
  ASSERT_GT(counts.overlap, 10U);
  ASSERT_GT(counts.inside, 10U);
  EXPECT_EQ(count(in_form(shaft, form), view), right.kept.size());
  EXPECT_EQ(count_classified(in_form(shaft, form), view), counts);
  EXPECT_TRUE(any(in_form(shaft, form), view));
  const std::size_t most = right.kept.size();
  for (const std::size_t room : {std::size_t{0}, std::size_t{1}, most / 2, most - 1, most, most + 1, most + 40}) {
    expect_listed(right.kept, room, [&](std::span<std::uint32_t> kept) {
      EXPECT_EQ(list(in_form(shaft, form), view, kept), right.kept.size());
    });
    expect_listed(right.kept, room, [&](std::span<std::uint32_t> kept) {
      EXPECT_EQ(list(in_form(shaft, form), view, kept, {.limit = room}), std::min(room, right.kept.size()));
    });
    expect_listed(right.kept, room, [&](std::span<std::uint32_t> kept) {
      EXPECT_EQ(list(in_form(shaft, form), view, kept, {.limit = room + 30}), std::min(room + 30, right.kept.size()));
    });
    std::vector<std::uint32_t> kept(most + 41, static_cast<std::uint32_t>(sentinel));
    EXPECT_EQ(list(in_form(shaft, form), view, std::span(kept), {.limit = room}), std::min(room, right.kept.size()));
    EXPECT_TRUE(std::equal(right.kept.begin(),
                           right.kept.begin() + static_cast<std::ptrdiff_t>(std::min(room, right.kept.size())),
                           kept.begin()))
        << "more room than the limit";
    EXPECT_EQ(count(in_form(shaft, form), view, {.limit = room}), std::min(room, right.kept.size()));
  }
  for (const std::size_t room : {std::size_t{0}, counts.inside / 2, counts.inside, most + 1}) {
    expect_listed(right.inside, room, [&](std::span<std::uint32_t> inside) {
      expect_listed(right.overlap, counts.overlap - room % 7, [&](std::span<std::uint32_t> overlap) {
        EXPECT_EQ(list_classified(in_form(shaft, form), view, overlap, inside), counts);
      });
    });
  }
}

template <class Bound>
void expect_all(const std::vector<Bound>& bounds) {
  const auto memory = columns(bounds);
  const GuardedView guarded(memory.view());
  const Box a{{-4, -2, -1}, {-3, 0, 1}};
  const Box b{{2, -1, -2}, {4, 2, 2}};
  const Plane plane{{0, 1, 1}, 1};
  CompiledShaft with_joining_planes = compile(a, b);
  complete(with_joining_planes);
  for (const CompiledShaft& shaft : {compile(a, b), with_joining_planes, compile(a, b, std::span(&plane, 1))}) {
    for (const Form form : forms) {
      expect_numbers_and_lists(shaft, guarded.view(), form);
    }
  }
}

TEST(OneShaft, NumbersAndListsOfBoxesSayWhatTheBitsSay) { expect_all(random_boxes(201, many_bounds)); }

TEST(OneShaft, NumbersAndListsOfSpheresSayWhatTheBitsSay) { expect_all(random_spheres(202, many_bounds)); }

TEST(OneShaft, AnyFindsASingleBoundWhereverItIs) {
  const CompiledShaft shaft = compile(Box{{-1, -1, -1}, {0, 0, 0}}, Box{{0, 0, 0}, {1, 1, 1}});
  BoxStream boxes(many_bounds);  // empty ones, which no shaft keeps
  EXPECT_FALSE(any(shaft, boxes));
  const std::vector<Box> kept = {{{0, 0, 0}, {1, 1, 1}}};
  const std::vector<Box> empty = {boxes[0]};
  for (const std::size_t at : {std::size_t{0}, std::size_t{63}, std::size_t{511}, std::size_t{512}, std::size_t{1535},
                               std::size_t{1536}, std::size_t{32255}, std::size_t{32256}, many_bounds - 1}) {
    boxes.update(at, kept);
    EXPECT_TRUE(any(shaft, boxes)) << at;
    EXPECT_FALSE(any(shaft, boxes.view().slice(0, at))) << at;
    boxes.update(at, empty);
  }
  EXPECT_FALSE(any(shaft, boxes));
}

TEST(OneShaft, AnyAndLimitedCallsStopAfterTheChunkThatHoldsEnoughKeptBounds) {
  const CompiledShaft shaft = compile(Box{{-1, -1, -1}, {0, 0, 0}}, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxColumns memory(std::vector<Box>(512, Box{{0, 0, 0}, {1, 1, 1}}));
  const GuardedView guarded(memory.view());  // what is past the 512 boxes must not be read
  BoxView more = guarded.view();
  more.count = 1000000;
  EXPECT_TRUE(any(shaft, more));
  EXPECT_EQ(count(shaft, more, {.limit = 300}), 300U);
  std::vector<std::uint32_t> first;
  EXPECT_EQ(list(shaft, more, first, {.limit = 300}), 300U);
  EXPECT_EQ(first.size(), 300U);
}

TEST(OneShaft, OfNoBoundsNothingIsKept) {
  const CompiledShaft shaft = compile(Box{{-1, -1, -1}, {0, 0, 0}}, Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(count(shaft, BoxView()), 0U);
  EXPECT_EQ(count_classified(shaft, SphereView()), (KeptCounts{0, 0}));
  EXPECT_FALSE(any(shaft, BoxView()));
  EXPECT_EQ(list(shaft, SphereView(), std::span<std::uint32_t>()), 0U);
  EXPECT_EQ(list_classified(shaft, BoxView(), std::span<std::uint32_t>(), std::span<std::uint32_t>()),
            (KeptCounts{0, 0}));
}

}  // namespace
}  // namespace shaftcull
