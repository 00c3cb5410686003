// SPDX-License-Identifier: MIT
/// Hot calls do not allocate: every call of operator new is counted, in all threads.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "failing_memory.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "parallel/thread_sanitizer.hpp"
#include "shaftcull/paper.hpp"
#include "shaftcull/shaftcull.hpp"
#include "support/threads.hpp"

namespace shaftcull {
namespace {

constexpr std::size_t bound_count = 5000;

class Allocation : public testing::Test {
 protected:
  Allocation() {
    Random random(111);
    for (std::size_t i = 0; i != bound_count; ++i) {
      // Some touch the shaft exactly, so that the slow, exact step runs as well.
      boxes_.push_back(i % 3 == 0 ? random.grid_box(-5, 5) : random.box(-5, 5, 0.05F, 1.0F));
      spheres_.push_back({boxes_.back().lo, random.integer(0, 3)});
    }
    const std::vector<Plane> planes(1, Plane{{1, 2, 3}, 4});
    for (int s = 0; s != 10; ++s) {
      const Box a = random.grid_box(-5, 5);
      shafts_.push_back(compile(a, random.grid_box(-5, 5), planes));
      complete(shafts_.back());
      if (s % 3 == 2) set_contact(shafts_.back(), Contact::open);
    }
  }

  template <class Call>
  static std::size_t allocations_in(const Call& call) {
    const std::size_t before = allocations();
    call();
    return allocations() - before;
  }

  std::vector<Box> boxes_;
  std::vector<Sphere> spheres_;
  std::vector<CompiledShaft> shafts_;
};

// Before all others: it chooses the instruction set.
TEST_F(Allocation, TheFirstCallOfAProcessDoesNone) {
  const BoxColumns boxes(boxes_);
  std::vector<std::uint64_t> kept(bit_words(bound_count));
  EXPECT_EQ(allocations_in([&] { cull(shafts_[0], boxes.view(), kept); }), 0U);
}

TEST_F(Allocation, IsCountedHere) {
  // Called by name: a new-expression that is deleted at once may be optimised away.
  EXPECT_EQ(allocations_in([] { ::operator delete(::operator new(1)); }), 1U);
}

TEST_F(Allocation, CullAndClassifyDoNone) {
  const BoxColumns boxes(boxes_);
  const SphereColumns spheres(spheres_);
  std::vector<std::uint64_t> kept(bit_words(bound_count));
  std::vector<std::uint64_t> inside(kept.size());
  std::vector<std::uint32_t> listed(bound_count);
  const std::vector<Vec3> corners = {{-9, -9, -9}, {9, -9, -8}, {9, 9, 8.5F}, {-9, 9, 8}};
  const std::vector<std::uint32_t> few = {4, 1000};
  std::vector<Triangle> corners_of_boxes;
  for (const Box& box : boxes_) corners_of_boxes.push_back({{box.lo, {box.hi[0], box.lo[1], box.hi[2]}, box.hi}});
  const TriangleStream triangles(corners_of_boxes);
  const TriangleTree triangle_tree(triangles.view());
  const std::vector<std::uint64_t> mask(bit_words(bound_count), 0x0f0f);
  const std::vector<std::uint32_t> layers(bound_count, 2);
  const std::span<std::uint32_t> room(listed);
  std::vector<float> times(few.size());
  (void)list(shafts_[0], triangle_tree, room, {.only = few});  // the first one looks up the places of indices
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(allocations_in([&] {
                for (const CompiledShaft& shaft : shafts_) {
                  for (const Form form : forms) {
                    cull(in_form(shaft, form), boxes.view(), kept);
                    cull(in_form(shaft, form), spheres.view(), kept);
                    classify(in_form(shaft, form), boxes.view(), kept, inside);
                    classify(in_form(shaft, form), spheres.view(), kept, inside);
                  }
                  classify(shaft, boxes.view(), {}, inside);
                  classify(shaft, spheres.view(), {}, inside);
                  (void)classify(shaft, boxes_[0]);
                  (void)classify(shaft, spheres_[0]);
                  (void)keeps(shaft, boxes_[0]);
                  (void)keeps(shaft, spheres_[0]);
                  (void)count(shaft, boxes.view());
                  (void)count_classified(shaft, spheres.view());
                  (void)any(shaft, spheres.view());
                  for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
                    (void)keeps(shaft, corners_of_boxes[0], test);
                    const Query query{.triangle_test = test};
                    for (const Bounds& all : {Bounds(triangles), Bounds(triangle_tree)}) {
                      cull(shaft, all, kept, query);
                      classify(shaft, all, kept, inside, query);
                      (void)count(shaft, all, query);
                      (void)count_classified(shaft, all, query);
                      (void)any(shaft, all, query);
                      (void)list(shaft, all, room, query);
                      (void)list(shaft, all, room, {.exclude = {7, 9}, .limit = 9, .triangle_test = test});
                      (void)list_classified(shaft, all, room, std::span<std::uint32_t>(), query);
                      (void)list(shaft, all, room, {.only = few, .triangle_test = test});
                    }
                  }
                  (void)occluded(shaft, boxes_[0]);
                  (void)occluded(shaft, boxes.view());
                  (void)occluded(shaft, corners);
                  (void)find_occluder(shaft, boxes.view());
                  (void)list_occluders(shaft, boxes.view(), listed);
                  (void)count(shaft, boxes.view(), {.limit = 9});
                  (void)first_contact(shaft, boxes.view());
                  entry_times(shaft, boxes.view(), std::span<const std::uint32_t>(few), times);
                  (void)first_contact(shaft, spheres.view());
                  entry_times(shaft, spheres.view(), std::span<const std::uint32_t>(few), times);
                  (void)list(shaft, spheres.view(), room.first(9), {.limit = 9});
                  (void)list(shaft, boxes.view(), room);
                  (void)list_classified(shaft, boxes.view(), room, std::span<std::uint32_t>());
                  (void)list(shaft, boxes.view(), room, {.only = few});
                  cull(shaft, spheres.view(), kept, {.only = few});
                  const Query leave_out{.exclude = few, .exclude_mask = mask, .layer_mask = {6}};
                  classify(shaft, Bounds(boxes.view(), layers), kept, inside, leave_out);
                  (void)list(shaft, Bounds(spheres.view(), layers), room, leave_out);
                  (void)first_contact(shaft, Bounds(boxes.view(), layers), leave_out);
                  (void)occluded(shaft, Bounds(boxes.view(), layers), leave_out);
                }
              }),
              0U)
        << name(isa);
  }
}

TEST_F(Allocation, FormationAndCompilationDoNone) {
  for (const PlaneOrder order : {PlaneOrder::unsorted, PlaneOrder::by_volume, PlaneOrder::by_added_volume}) {
    for (const Formation formation : {Formation::search, Formation::table64, Formation::table729}) {
      ShaftOptions options;
      options.order = order;
      options.formation = formation;
      EXPECT_EQ(allocations_in([&] {
                  Shaft shaft(boxes_[0], boxes_[1], options);
                  shaft.add_plane({{1, 0, 0}, 1});
                  shafts_[0] = compile(shaft);
                }),
                0U);
    }
  }
  const std::vector<Plane> two_planes(2, Plane{{1, 2, 3}, 4});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(allocations_in([&] { shafts_[0] = compile(boxes_[0], boxes_[1]); }), 0U) << name(isa);
    EXPECT_EQ(allocations_in([&] { shafts_[0] = compile(boxes_[0], boxes_[1], two_planes); }), 0U) << name(isa);
  }
  const BoxColumns boxes(boxes_);
  std::vector<CompiledShaft> out(100);
  const std::vector<Plane> planes(100, Plane{{1, 2, 3}, 4});
  const std::vector<Plane> planes_of_all(bound_count, planes[0]);
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i != out.size(); ++i) pairs.push_back({i, i + 100});
  EXPECT_EQ(allocations_in([&] {
              compile_batch(boxes.view().slice(0, 100), boxes.view().slice(100, 100), out, {.a = planes, .b = planes});
              compile_batch(boxes.view(), boxes.view(), pairs, out, {.a = planes_of_all});
              for (CompiledShaft& shaft : out) complete(shaft);
              set_contact(out, Contact::open);
              set_contact(out[0], Contact::closed);
              out[1] = compile(boxes_[0], boxes_[1], Contact::open);
              compile_batch(boxes.view(), boxes.view(), pairs, out, {}, Contact::open);
            }),
            0U);
}

TEST_F(Allocation, ShaftsOfMovingBoxesDoNone) {
  const SphereColumns spheres(spheres_);
  std::vector<std::uint64_t> kept(bit_words(bound_count));
  std::vector<std::uint64_t> inside(kept.size());
  const std::vector<Plane> planes(3, Plane{{1, 2, 3}, 4});
  EXPECT_EQ(allocations_in([&] {
              for (const CompiledShaft& shaft :
                   {swept(boxes_[0], {1, 2, 3}, planes), swept_infinite(boxes_[0], {1, 2, 3}),
                    shadow(Box{{9, 9, 9}, {9, 9, 9}}, boxes_[0]), shadow(Box{{9, 9, 9}, {9, 9, 9}}, boxes_[0], 4)}) {
                classify(shaft, spheres.view(), kept, inside);
                (void)classify(shaft, boxes_[0]);
              }
            }),
            0U);
}

TEST_F(Allocation, MakingAStreamDoesOneAndAnEmptyOneNone) {
  EXPECT_EQ(allocations_in([&] { const BoxStream stream(boxes_); }), 1U);
  EXPECT_EQ(allocations_in([&] { const SphereStream stream(spheres_); }), 1U);
  EXPECT_EQ(allocations_in([] { const BoxStream stream(7); }), 1U);
  EXPECT_EQ(allocations_in([] { const SphereStream stream(0); }), 0U);
  const BoxStream boxes(boxes_);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): that is what is counted
  EXPECT_EQ(allocations_in([&] { const BoxStream copy(boxes); }), 1U);
  BoxStream assigned(7);
  EXPECT_EQ(allocations_in([&] { assigned = boxes; }), 1U);
  EXPECT_EQ(allocations_in([&] { const BoxStream moved(std::move(assigned)); }), 0U);
}

TEST_F(Allocation, UpdatingAStreamInPlaceDoesNone) {
  BoxStream boxes(boxes_);
  SphereStream spheres(spheres_);
  EXPECT_EQ(allocations_in([&] {
              boxes.update(1000, std::span<const Box>(boxes_).first(500));
              spheres.update(1000, std::span<const Sphere>(spheres_).first(500));
            }),
            0U);
}

TEST_F(Allocation, QueriesOfATreeIntoTheCallersMemoryDoNone) {
  BoxTree boxes{std::span<const Box>(boxes_)};
  const SphereTree spheres{std::span<const Sphere>(spheres_)};
  boxes.set_layers(std::vector<std::uint32_t>(bound_count, 6));
  std::vector<std::uint32_t> kept(bound_count);
  std::vector<std::uint32_t> inside(bound_count);
  const std::span<std::uint32_t> room(kept);
  const std::vector<std::uint32_t> few = {1, 2};
  std::vector<float> times(few.size());
  std::vector<std::uint64_t> bits(bit_words(bound_count));
  std::vector<std::uint64_t> other_bits(bits.size());
  (void)list(shafts_[0], boxes, room, {.only = few});  // the first one looks up the leaves of indices
  (void)list(shafts_[0], spheres, room, {.only = few});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_EQ(allocations_in([&] {
                for (const CompiledShaft& shaft : shafts_) {
                  (void)count(shaft, boxes, {.exclude = few});
                  (void)count_classified(shaft, boxes);
                  (void)list(shaft, boxes, room);
                  (void)list_classified(shaft, boxes, room, std::span(inside));
                  (void)list_classified(shaft, spheres, room, std::span(inside), {.exclude = few});
                  (void)list(shaft, boxes.leaves(), room, {.only = few});
                  (void)list(shaft, boxes, room, {.only = few});
                  cull(shaft, boxes, bits);
                  classify(shaft, spheres, bits, other_bits, {.exclude = few});
                  classify(shaft, spheres, {}, bits);
                  (void)any(shaft, boxes);
                  (void)occluded(shaft, boxes, {.exclude = few});
                  (void)find_occluder(shaft, boxes);
                  (void)list_occluders(shaft, boxes, room);
                  (void)count(shaft, boxes, {.layer_mask = {4}});
                  (void)count(shaft, boxes, {.layer_mask = {1}});
                  (void)count(shaft, boxes, {.limit = 9});
                  (void)first_contact(shaft, boxes, {.exclude = few});
                  entry_times(shaft, boxes, few, times);
                  (void)first_contact(shaft, spheres, {.exclude_each = few});
                  entry_times(shaft, spheres, few, times);
                  (void)list(shaft, spheres, room.first(9), {.limit = 9});
                }
              }),
              0U)
        << name(isa);
  }
}

TEST_F(Allocation, UpdatingAndRefittingATreeDoNone) {
  BoxTree boxes{std::span<const Box>(boxes_)};
  const std::vector<std::uint32_t> few = {1, 2};
  const auto calls = [&] {
    boxes.update(std::span<const Box>(boxes_));
    boxes.update(few, std::span<const Box>(boxes_).first(2));
    boxes.refit();
  };
  calls();  // threads are started once, and leaves are looked for by index
  EXPECT_EQ(allocations_in(calls), 0U);
}

TEST_F(Allocation, CallsForManyIntoTheCallersMemoryDoNone) {
  if (!kernel::thread_objects_may_have_destructors) GTEST_SKIP() << "threads keep no memory here for the next call";
#ifdef SHAFTCULL_THREAD_SANITIZER
  GTEST_SKIP() << "in this build task memory comes from operator new, once for every thread that comes to help";
#endif
  // oneTBB's own task memory does not come from operator new.
  const BoxColumns boxes(boxes_);
  const SphereColumns spheres(spheres_);
  std::vector<std::uint64_t> kept(shafts_.size() * bit_words(bound_count));
  std::vector<std::uint64_t> inside(kept.size());
  std::vector<std::uint64_t> counts(shafts_.size());
  std::vector<KeptCounts> classified(shafts_.size());
  std::vector<FirstContact> contacts(shafts_.size());
  const std::vector<std::uint32_t> of_each(2 * shafts_.size(), 7);
  const std::vector<std::uint32_t> layers(bound_count, 2);
  const std::vector<CompiledShaft> by_planes = in_form(shafts_, Form::planes);
  const std::span<const CompiledShaft> both_forms[] = {shafts_, by_planes};
  const auto calls = [&] {
    for (const std::span<const CompiledShaft> shafts : both_forms) {
      const auto ask = [&](const auto& view) {
        cull_many(shafts, view, kept);
        classify_many(shafts, view, kept, inside);
        count_many(shafts, view, counts);
        count_classified_many(shafts, view, classified);
        any_many(shafts, view, std::span(counts).first(1));
        count_many(shafts, view, counts, {.limit = 9});
        classify_many(shafts, view, {}, inside);
        first_contact_many(shafts, view, contacts);
        cull_many(shafts, Bounds(view, layers), kept, {.exclude_each = of_each, .layer_mask = {6}});
      };
      ask(boxes.view());
      ask(spheres.view());
      occluded_many(shafts_, boxes.view(), std::span(counts).first(1));
    }
  };
  calls();  // threads are started once
  EXPECT_EQ(allocations_in(calls), 0U);
}

}  // namespace
}  // namespace shaftcull
