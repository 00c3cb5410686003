// SPDX-License-Identifier: MIT
/// Views of every count and every misalignment: the same answers, nothing read or written past the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "cull/agreement.hpp"
#include "forms.hpp"
#include "guarded_floats.hpp"
#include "instruction_sets.hpp"
#include "misaligned.hpp"
#include "oracle/random.hpp"
#include "result_words.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

constexpr std::size_t most_bounds = 200;

const ShaftInput input{{{-2, -2, -2}, {-1, -0.5F, 0}}, {{1, 0.5F, -1}, {2, 2, 1}}};

std::vector<Box> some_boxes() {
  Random random(51);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i != most_bounds; ++i) boxes.push_back(random.box(-2, 2, 0.01F, 0.5F));
  return boxes;
}

std::vector<Sphere> some_spheres() {
  Random random(52);
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i != most_bounds; ++i) spheres.push_back({random.vec3(-2, 2), random.uniform(0, 0.5F)});
  return spheres;
}

/// Answers of a view must be the first `view.count` of `right`, all bits after them zero, and no word more written.
template <class View>
void expect_view(const CompiledShaft& shaft, const View& view, const std::vector<Answer>& right, Form form) {
  const std::size_t words = bit_words(view.count);
  std::vector<std::uint64_t> culled(words + 1, sentinel);
  std::vector<std::uint64_t> kept(words + 1, sentinel);
  std::vector<std::uint64_t> inside(words + 1, sentinel);
  cull(in_form(shaft, form), view, std::span(culled).first(words));
  classify(in_form(shaft, form), view, std::span(kept).first(words), std::span(inside).first(words));
  ASSERT_EQ(culled, kept);
  ASSERT_EQ(kept[words], sentinel) << "written past the end";
  ASSERT_EQ(inside[words], sentinel) << "written past the end";
  for (std::size_t i = 0; i != words * 64; ++i) {
    ASSERT_EQ(bit(kept, i), i < view.count && right[i] != Answer::outside) << "bound " << i << " of " << view.count;
    ASSERT_EQ(bit(inside, i), i < view.count && right[i] == Answer::inside) << "bound " << i << " of " << view.count;
  }
}

template <class Columns, class Bound>
void expect_every_count(const std::vector<Bound>& bounds) {
  const CompiledShaft shaft = compile(input.a, input.b);
  const Columns memory(bounds);
  const auto all = memory.view();
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : forms) {
      const std::vector<Answer> right = answers(input, bounds, form);
      for (std::size_t count = 0; count <= most_bounds; ++count) {
        SCOPED_TRACE(std::string(name(isa)) + ", " + std::to_string(count) + " bounds");
        const GuardedView guarded(all.slice(0, count));
        expect_view(shaft, guarded.view(), right, form);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

template <class Columns, class Bound>
void expect_every_misalignment(const std::vector<Bound>& bounds) {
  const CompiledShaft shaft = compile(input.a, input.b);
  const Columns memory(bounds);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : forms) {
      const std::vector<Answer> right = answers(input, bounds, form);
      for (std::size_t offset = 0; offset != 16; ++offset) {
        for (const std::size_t apart :
             {0U, 1U, 5U}) {  // floats by which each stream is further out than the one before
          for (const std::size_t count :
               {std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{129}, most_bounds}) {
            SCOPED_TRACE(std::string(name(isa)) + ", first stream " + std::to_string(offset) + " floats off");
            const Misaligned moved(memory.view().slice(0, count), offset, apart);
            expect_view(shaft, moved.view(), right, form);
            if (testing::Test::HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

TEST(Views, EveryCountOfBoxesIsReadToItsEndAndNoFurther) { expect_every_count<BoxColumns>(some_boxes()); }

TEST(Views, EveryCountOfSpheresIsReadToItsEndAndNoFurther) { expect_every_count<SphereColumns>(some_spheres()); }

TEST(Views, NothingBehindAViewIsReadForAnyKindOfShaft) {
  // Among the bounds are some that touch at the origin: what a vector finds behind the last one may be zeros.
  const Box corner{{-2, -2, -2}, {-1, -1, -1}};
  const ConvexHull hull(std::vector<Vec3>{{-2, -2, -2}, {2, 2, 2}, {-1, 1, 0.5F}, {1, -1, 0.25F}});
  const CompiledShaft shafts[] = {swept(corner, {3, 3, 3}), swept_infinite(corner, {1, 1, 1}),
                                  shadow(Box{{2, 2, 2}, {3, 3, 3}}, Box{{1, 1, 1}, {1, 1, 1}}),
                                  shadow(Box{{2, 2, 2}, {3, 3, 3}}, Box{{1, 1, 1}, {1, 1, 1}}, 2), hull.compiled()};
  std::vector<Box> boxes = some_boxes();
  std::vector<Sphere> spheres = some_spheres();
  for (std::size_t i = 0; i < most_bounds; i += 3) boxes[i] = {{0, 0, 0}, {0, 0, 0}}, spheres[i] = {{0, 0, 0}, 0};
  const BoxColumns box_memory(boxes);
  const SphereColumns sphere_memory(spheres);
  const auto expect_right = [](const CompiledShaft& shaft, const auto& view) {
    for (const Form form : forms) {
      std::vector<Answer> right;
      for (std::size_t i = 0; i != view.count; ++i) right.push_back(classify(shaft, view[i]));
      for (std::size_t count = 0; count <= view.count; ++count) {
        SCOPED_TRACE(std::to_string(count) + " bounds");
        expect_view(shaft, GuardedView(view.slice(0, count)).view(), right, form);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  };
  const auto expect_first = [](const CompiledShaft& shaft, const auto& view) {
    const std::uint64_t none = FirstContact::none;
    const std::uint64_t first = first_contact(shaft, view).index;
    for (std::size_t count = 0; count <= most_bounds; ++count) {
      const GuardedView guarded(view.slice(0, count));
      const std::uint64_t found = first_contact(shaft, guarded.view()).index;
      if (first < count) {
        ASSERT_EQ(found, first);
      }
      ASSERT_TRUE(found == none || found < count);
    }
  };
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (std::size_t s = 0; s != std::size(shafts); ++s) {
      SCOPED_TRACE(std::string(name(isa)) + ", shaft " + std::to_string(s));
      expect_right(shafts[s], box_memory.view());
      expect_right(shafts[s], sphere_memory.view());
      if (&shafts[s] == std::end(shafts) - 1) continue;  // hulls do not move
      expect_first(shafts[s], box_memory.view());
      expect_first(shafts[s], sphere_memory.view());
    }
  }
}

TEST(Views, EveryMisalignmentOfBoxesGivesTheSameAnswers) { expect_every_misalignment<BoxColumns>(some_boxes()); }

TEST(Views, EveryMisalignmentOfSpheresGivesTheSameAnswers) { expect_every_misalignment<SphereColumns>(some_spheres()); }

TEST(Views, AnEmptyViewMayHaveNullStreams) {
  const CompiledShaft shaft = compile(input.a, input.b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : forms) {
      EXPECT_NO_THROW(cull(in_form(shaft, form), BoxView{}, {}));
      EXPECT_NO_THROW(cull(in_form(shaft, form), SphereView{}, {}));
      EXPECT_NO_THROW(classify(in_form(shaft, form), BoxView{}, {}, {}));
      EXPECT_NO_THROW(classify(in_form(shaft, form), SphereView{}, {}, {}));
    }
  }
}

TEST(Views, ASliceAnswersLikeItsPartOfTheWhole) {
  const CompiledShaft shaft = compile(input.a, input.b);
  const BoxColumns memory(some_boxes());
  const std::vector<Answer> right = answers(input, some_boxes(), Form::slab);
  for (const std::size_t first : {1U, 64U, 77U, 200U}) {
    const std::vector<Answer> part(right.begin() + static_cast<std::ptrdiff_t>(first), right.end());
    expect_view(shaft, memory.view().slice(first, part.size()), part, Form::slab);
  }
}

/// A single bound gets the answer of a view, from a shaft that has its planes and from one whose planes are pending.
template <class Bound>
void expect_single(const ShaftInput& asked, const std::vector<Bound>& bounds) {
  const std::vector<Answer> right = answers(asked, bounds, Form::slab);
  const CompiledShaft shafts[] = {shaft_of(asked), compile(asked.a, asked.b, asked.added)};
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const CompiledShaft& shaft : shafts) {
      for (std::size_t i = 0; i != bounds.size(); ++i) {
        ASSERT_EQ(classify(shaft, bounds[i]), right[i]) << source_text(bounds[i]) << ", " << name(isa);
        ASSERT_EQ(keeps(shaft, bounds[i]), right[i] != Answer::outside) << source_text(bounds[i]) << ", " << name(isa);
      }
    }
  }
}

TEST(Views, ASingleBoundAnswersLikeAView) {
  const Box box = {{-1, -1, -1}, {1, 1, 1}};
  const ShaftInput inputs[] = {
      input,
      {input.a, input.b, {{{1, 2, 3}, 1}, {{-1, 0, 0}, 0.5F}}},
      {box, box, {}},                                                         // every face is purple
      {{{-3e38F, -2, -2}, {-1, 2, 2}}, {{0, -1, -3}, {2, 1, 1}}, {}},         // too large for floats
      {{{1e6F, 1e6F, 1e6F}, {1e6F, 1e6F, 1e6F}}, {{0, 0, 0}, {1, 1, 1}}, {}}  // far apart
  };
  std::vector<Box> boxes = some_boxes();
  std::vector<Sphere> spheres = some_spheres();
  Random random(53);
  for (std::size_t i = 0; i != most_bounds; ++i) {  // many that touch
    boxes.push_back(random.grid_box(-2, 2));
    spheres.push_back({{random.integer(-2, 2), random.integer(-2, 2), random.integer(-2, 2)}, random.integer(0, 1)});
  }
  for (const ShaftInput& each : inputs) {
    expect_single(each, boxes);
    expect_single(each, spheres);
  }
}

TEST(Views, AnEmptyBoundIsOutsideAndOneWithNanIsNot) {
  const CompiledShaft shaft = compile(input.a, input.b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_FALSE(keeps(shaft, Box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}));
    EXPECT_FALSE(keeps(shaft, Sphere{{0, 0, 0}, -1}));
    EXPECT_EQ(classify(shaft, Box{{nan, nan, nan}, {nan, nan, nan}}), Answer::overlap);
    EXPECT_TRUE(keeps(shaft, Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
  }
}

template <class Columns, class Bound>
void expect_layers(const std::vector<Bound>& bounds) {
  Random random(45);
  const CompiledShaft shaft = compile(input.a, input.b);
  const std::vector<Answer> right = answers(input, bounds, Form::slab);
  for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 200U}) {
    const Columns memory(std::vector<Bound>(bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(count)));
    std::vector<std::uint32_t> layers(count);
    for (std::uint32_t& each : layers) each = random.one_in(4) ? 0 : 1U << random.below(32);
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (const std::uint32_t mask : {0U, 0xffff0000U, 0x80000001U, ~0U}) {
        std::vector<std::uint64_t> kept(bit_words(count) + 1, sentinel);
        std::vector<std::uint64_t> inside(kept);
        const std::size_t words = bit_words(count);
        classify(shaft, Bounds(memory.view(), layers), std::span(kept).first(words), std::span(inside).first(words),
                 {.layer_mask = {mask}});
        ASSERT_EQ(kept[words], sentinel) << "written past the end";
        ASSERT_EQ(inside[words], sentinel) << "written past the end";
        for (std::size_t i = 0; i != 64 * words; ++i) {
          const bool is_asked = i < count && (layers[i] & mask) != 0;
          ASSERT_EQ(bit(kept, i), is_asked && right[i] != Answer::outside)
              << name(isa) << ", bound " << i << " of " << count;
          ASSERT_EQ(bit(inside, i), is_asked && right[i] == Answer::inside)
              << name(isa) << ", bound " << i << " of " << count;
        }
      }
    }
  }
}

TEST(Views, BoundsInNoneOfTheLayersAreLeftOut) {
  expect_layers<BoxColumns>(some_boxes());
  expect_layers<SphereColumns>(some_spheres());
}

TEST(Views, LayersOfTheWrongSizeAreRefused) {
  const CompiledShaft shaft = compile(input.a, input.b);
  const BoxColumns memory(some_boxes());
  std::vector<std::uint64_t> kept(bit_words(most_bounds), 7);
  const auto layers = [](std::size_t count) { return std::vector<std::uint32_t>(count, 1); };
  const auto ask = [&](std::span<const std::uint32_t> of_bounds) {
    cull(shaft, Bounds(memory.view(), of_bounds), kept, {.layer_mask = {1}});
  };
  EXPECT_THROW(ask(layers(most_bounds - 1)), InvalidArgument);
  EXPECT_THROW(ask(layers(most_bounds + 1)), InvalidArgument);
  EXPECT_THROW(ask(layers(0)), InvalidArgument) << "there are none";
  EXPECT_THROW(ask({static_cast<const std::uint32_t*>(nullptr), most_bounds}), InvalidArgument);
  EXPECT_EQ(kept, std::vector<std::uint64_t>(bit_words(most_bounds), 7));
  EXPECT_NO_THROW(ask(layers(most_bounds)));
}

}  // namespace
}  // namespace shaftcull
