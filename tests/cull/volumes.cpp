// SPDX-License-Identifier: MIT
/// Shafts of moving boxes: swept bodies and shadows, with and without an end. Every answer equals the one of exact
/// arithmetic, in every form, and on every instruction set.
#include "shaftcull/volumes.hpp"
#include "forms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "cull/agreement.hpp"
#include "dispatch/active_kernels.hpp"
#include "flat/grid_group.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "query/bound_streams.hpp"
#include "sanitizers.hpp"
#include "shaftcull/many.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

Answer answer_at(const std::vector<std::uint64_t>& kept, const std::vector<std::uint64_t>& inside, std::size_t i) {
  const auto bit = [&](const std::vector<std::uint64_t>& words) { return (words[i / 64] >> i % 64 & 1U) != 0; };
  return !bit(kept) ? Answer::outside : bit(inside) ? Answer::inside : Answer::overlap;
}

/// Fails, with a reproducer for the first wrong one, unless all answers of all calls are the oracle's.
template <class Hull, class Bound>
void expect_exact(const MovingInput& input, const Hull& hull, const std::vector<Bound>& bounds) {
  std::vector<Answer> right;
  for (const Bound& bound : bounds) right.push_back(hull.answer(bound));
  const auto memory = columns(bounds);
  const auto check = [&](const char* form, const auto& answer) {
    for (std::size_t i = 0; i != bounds.size(); ++i) {
      const Answer is = answer(i);
      if (is == right[i]) continue;
      ADD_FAILURE() << "on " << name(active_isa()) << ", form " << form << "; bound " << i << ":\n  "
                    << source_text(input) << "\n  " << source_text(bounds[i]) << "\n  is " << text(right[i])
                    << ", answered " << text(is);
      return;
    }
  };
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    CompiledShaft shaft = shaft_of(input);
    for (const bool is_complete : {false, true}) {
      if (is_complete) complete(shaft);
      for (const auto& [form, form_name] : {std::pair(Form::slab, "slab"), std::pair(Form::planes, "planes")}) {
        std::vector<std::uint64_t> culled(bit_words(bounds.size()), ~std::uint64_t{0});
        std::vector<std::uint64_t> kept = culled;
        std::vector<std::uint64_t> inside = culled;
        cull(in_form(shaft, form), memory.view(), culled);
        classify(in_form(shaft, form), memory.view(), kept, inside);
        EXPECT_EQ(culled, kept) << "cull() and classify() keep different bounds of " << source_text(input);
        check(form_name, [&](std::size_t i) { return answer_at(kept, inside, i); });
      }
    }
    check("one", [&](std::size_t i) { return classify(shaft, bounds[i]); });
    const GridAnswers on_grid = grid_answers(shaft, memory.view(), 0);
    check("grid", [&](std::size_t i) { return answer_at(on_grid.kept, on_grid.inside, i); });
  }
}

/// The same with open contact, for every third bound.
void expect_exact_of_open(MovingInput input, const std::vector<Box>& boxes, const std::vector<Sphere>& spheres) {
  input.contact = Contact::open;
  const oracle::OpenHull hull(input);
  const auto some = [](const auto& bounds) {
    auto thirds = bounds;
    thirds.clear();
    for (std::size_t i = 0; i < bounds.size(); i += 3) thirds.push_back(bounds[i]);
    return thirds;
  };
  expect_exact(input, hull, some(boxes));
  expect_exact(input, hull, some(spheres));
}

/// Checks `shafts` inputs of each kind.
template <class MakeInput>
void check(std::uint64_t seed, std::size_t shafts, const MakeInput& input_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(shafts); ++i) {
    for (const MovingKind kind : moving_kinds) {
      if (testing::Test::HasFailure()) return;
      const MovingInput input = input_of(random, kind);
      std::vector<Box> boxes;
      for (int k = 0; k != 40; ++k) boxes.push_back(touching_box(random, input));
      for (int k = 0; k != 12; ++k) {
        const Vec3 p = nearby_point(random, input);
        boxes.push_back(Random::sorted(p, random.one_in(2) ? p : nearby_point(random, input)));
      }
      for (int k = 0; k != 16; ++k) boxes.push_back(random.box(-6, 6, 0.01F, 2.0F));
      const oracle::MovingHull hull(input);
      expect_exact(input, hull, boxes);
      std::vector<Sphere> spheres;
      for (int k = 0; k != 24; ++k) spheres.push_back(nearby_sphere(random, input, hull));
      expect_exact(input, hull, spheres);
      expect_exact_of_open(input, boxes, spheres);
    }
  }
}

TEST(Kinds, OrdinaryShaftsAnswerExactly) { check(1, 20, random_movement); }

TEST(Kinds, ShaftsOnAGridAnswerExactly) { check(2, 20, grid_movement); }

TEST(Kinds, ShaftsAlongAnAxisOrAPlaneAnswerExactly) { check(3, 20, straight_movement); }

TEST(Kinds, DisplacementsOfAFewUlpsAreNotRoundedAway) { check(4, 15, tiny_movement); }

TEST(Kinds, ShaftsFarFromTheOriginAnswerExactly) { check(5, 15, distant_movement); }

TEST(Kinds, ShaftsThatEndFarBeyondTheSceneAnswerExactly) { check(6, 15, far_movement); }

TEST(Kinds, EveryMagnitudeFromDenormalsTo1e38IsAnsweredExactly) { check(7, 30, wild_movement); }

TEST(Kinds, EndsBeyondTheLargestFloatAreAnsweredExactly) {
  constexpr float most = std::numeric_limits<float>::max();
  constexpr float far = 0.75F * most;
  const std::vector<Box> bodies = {{{most, 0, 0}, {most, 1, 1}},
                                   {{far, 0, 0}, {far, 1, 1}},
                                   {{most / 2, 0, 0}, {most, 1, 1}},
                                   {{far, far, far}, {far, far, far}}};
  std::vector<Box> boxes = bodies;
  for (const float x : {0.0F, far, most}) boxes.push_back({{x, -1, -1}, {most, 2, 2}});
  boxes.push_back({{-1, -1, -1}, {far, 2, 2}});
  boxes.push_back({{far, 2, 0}, {most, 3, 1}});
  const std::vector<Sphere> spheres = {{{most, 0, 0}, 1}, {{far, 5, 0}, 4}, {{far, 5, 0}, 5}, {{0, 0, 0}, far}};
  for (const Box& body : bodies) {
    for (const float by : {1.0F, 0x1p103F, far, most}) {
      for (const Vec3 displacement : {Vec3{by, 0, 0}, Vec3{by, by, by}}) {
        const MovingInput input{MovingKind::swept, body, displacement, {}, 1, {}, Contact::closed};
        expect_exact(input, oracle::MovingHull(input), boxes);
        expect_exact(input, oracle::MovingHull(input), spheres);
      }
    }
    for (const float reach : {1 + 0x1p-23F, 2.0F, 1000.0F}) {
      const MovingInput input{MovingKind::shadow, body, {}, {{0, 0, 0}, {0, 0, 0}}, reach, {}, Contact::closed};
      expect_exact(input, oracle::MovingHull(input), boxes);
    }
  }
}

TEST(Kinds, SpheresOnTheWayOfAFaceThatStartsFarOutAndHardlyMovesAreAnsweredExactly) {
  Random random(11);
  const auto power = [&](int low, int high) {
    const float x = std::ldexp(1.0F, low + static_cast<int>(random.below(static_cast<unsigned>(high - low + 1))));
    return random.one_in(2) ? x : -x;
  };
  for (std::size_t i = 0; i != random_cases(200); ++i) {
    const float start = power(0, 90);
    const Vec3 direction = {power(-20, 60), power(-99, -20), power(-30, 30)};
    const float size = random.one_in(2) ? 0.0F : 0x1p-20F * std::fabs(direction[0]);
    const MovingInput input{
        MovingKind::swept_infinite, {{0, start, 0}, {size, start, size}}, direction, {}, 1, {}, Contact::closed};
    std::vector<Sphere> spheres;
    for (int k = 0; k != 24; ++k) {
      const float t = std::ldexp(random.uniform(0.5F, 1.0F), static_cast<int>(random.below(30)) - 10);
      const float radius = std::fabs(direction[0]) * std::ldexp(1.0F, -static_cast<int>(random.below(60)));
      spheres.push_back({{t * direction[0], start, t * direction[2]}, radius});
    }
    expect_exact(input, oracle::MovingHull(input), spheres);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Kinds, ShadowsOfWhichOnlyASlowFaceFollowsAreAnsweredExactly) {
  constexpr std::uint64_t seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const auto power = [&](int low, int high) {
    return std::ldexp(random.uniform(0.5F, 1.0F),
                      low + static_cast<int>(random.below(static_cast<unsigned>(high - low))));
  };
  const Box light{{0, 0, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i != random_cases(100); ++i) {
    // All faces move away from the light but for one, as far a second as they are from it.
    Box occluder;
    for (unsigned k = 0; k != 3; ++k) {
      occluder.lo[k] = -power(-90, 98);
      occluder.hi[k] = power(-90, 98);
    }
    occluder.hi[0] = -power(-98, -20);
    if (occluder.lo[0] > occluder.hi[0]) std::swap(occluder.lo[0], occluder.hi[0]);
    const MovingInput input{MovingKind::shadow_without_end, occluder, {}, light, 1, {}, Contact::closed};
    const oracle::MovingHull hull(input);
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int n = 0; n != 48; ++n) {
      const float later = power(1, 24);
      Vec3 p;
      for (unsigned k = 0; k != 3; ++k) p[k] = later * (random.one_in(2) ? occluder.lo[k] : occluder.hi[k]);
      boxes.push_back({p, p});
      const float radius = std::fabs(p[random.below(3)]) * power(-40, 2);
      p[random.below(3)] += random.one_in(2) ? radius : -radius;
      spheres.push_back({p, radius});
    }
    expect_exact(input, hull, boxes);
    expect_exact(input, hull, spheres);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Kinds, ShaftsWithOpenContactOnALatticeAnswerExactly) {
  constexpr std::uint64_t seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(40); ++i) {
    for (const MovingKind kind : moving_kinds) {
      if (HasFailure()) return;
      MovingInput input = lattice_movement(random, kind);
      input.contact = Contact::open;
      const oracle::OpenHull hull(input);
      std::vector<Box> boxes;
      for (int k = 0; k != 64; ++k) boxes.push_back(lattice_bound(random));
      expect_exact(input, hull, boxes);
      std::vector<Sphere> spheres;
      for (int k = 0; k != 32; ++k) spheres.push_back({boxes[static_cast<std::size_t>(k)].lo, random.integer(0, 2)});
      expect_exact(input, hull, spheres);
    }
  }
}

/// A body at rest and one that moves; boxes on either side.
TEST(Kinds, MeanWhatTheirNamesSay) {
  on_each_instruction_set([] {
    const Box body{{0, 0, 0}, {1, 1, 1}};
    const Box beyond{{10, 0, 0}, {11, 1, 1}};
    const Box behind{{-3, 0, 0}, {-2, 1, 1}};
    EXPECT_EQ(classify(swept(body, {0, 0, 0}), body), Answer::inside);
    EXPECT_FALSE(keeps(swept(body, {0, 0, 0}), beyond));
    EXPECT_TRUE(keeps(swept(body, {9, 0, 0}), beyond)) << "it touches";
    EXPECT_FALSE(keeps(swept(body, {std::nextafter(9.0F, 0.0F), 0, 0}), beyond));
    EXPECT_EQ(classify(swept_infinite(body, {1e-30F, 0, 0}), beyond), Answer::inside);
    EXPECT_FALSE(keeps(swept_infinite(body, {1, 0, 0}), behind));

    const Box lamp{{-9, 0.5F, 0.5F}, {-9, 0.5F, 0.5F}};
    EXPECT_EQ(classify(shadow(lamp, body), beyond), Answer::inside);
    EXPECT_FALSE(keeps(shadow(lamp, body), behind)) << "between lamp and occluder is light";
    EXPECT_EQ(classify(shadow(lamp, body, 1), body), Answer::inside);
    EXPECT_FALSE(keeps(shadow(lamp, body, 1.9F), beyond))
        << "the float is less than 1.9, at which the shadow ends at x = 10";
    EXPECT_TRUE(keeps(shadow(lamp, body, std::nextafter(1.9F, 2.0F)), beyond));
  });
}

TEST(Kinds, AreRefusedWhereTheyMeanNothing) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const Box light{{5, 0, 0}, {6, 1, 1}};
  const Box bad{{0, 0, 0}, {1, -1, 1}};
  const std::vector<Plane> many(max_added_planes + 1, Plane{{1, 0, 0}, 1});
  const Plane flat[] = {{{1, 0, 0}, 1}, {{0, 0, 0}, 1}};
  using testing::HasSubstr;
  EXPECT_THAT(message_of([&] { (void)swept(bad, {1, 0, 0}); }), HasSubstr("box body: lo.y = 0 is above hi.y = -1"));
  EXPECT_THAT(message_of([&] { (void)swept(box, {1, infinity, 0}); }), HasSubstr("displacement.y = inf"));
  EXPECT_THAT(message_of([&] { (void)swept(box, {1, 0, 0}, many); }), HasSubstr("16 added planes only, not for 17"));
  EXPECT_THAT(message_of([&] { (void)swept(box, {1, 0, 0}, flat); }), HasSubstr("planes[1]"));
  EXPECT_THAT(message_of([&] { (void)swept_infinite(bad, {1, 0, 0}); }), HasSubstr("box body"));
  EXPECT_THAT(message_of([&] { (void)swept_infinite(box, {0, -0.0F, 0}); }), HasSubstr("direction is 0"));
  EXPECT_THAT(message_of([&] { (void)swept_infinite(box, {0, 0, std::nanf("")}); }), HasSubstr("direction.z = nan"));
  EXPECT_THAT(message_of([&] { (void)shadow(bad, box); }), HasSubstr("box light"));
  EXPECT_THAT(message_of([&] { (void)shadow(light, bad); }), HasSubstr("box occluder"));
  EXPECT_THAT(message_of([&] { (void)shadow(light, bad, 2); }), HasSubstr("box occluder"));
  EXPECT_THAT(message_of([&] { (void)shadow(box, box); }), HasSubstr("overlap or touch"));
  EXPECT_THAT(message_of([&] { (void)shadow(box, {{1, 0, 0}, {2, 1, 1}}, 2); }), HasSubstr("overlap or touch"));
  for (const float reach : {std::nextafter(1.0F, 0.0F), -2.0F, infinity, std::nanf("")}) {
    EXPECT_THAT(message_of([&] { (void)shadow(light, box, reach); }), HasSubstr("reach = "));
  }
}

/// Bits of what each shaft says of some boxes.
std::vector<std::uint64_t> bits_of(const std::vector<CompiledShaft>& shafts) {
  Random random(71);
  std::vector<Box> boxes;
  for (int i = 0; i != 200; ++i) boxes.push_back(random.one_in(2) ? random.grid_box(-6, 6) : random.box(-6, 6, 0, 1));
  const auto memory = columns(boxes);
  const std::size_t words = bit_words(boxes.size());
  std::vector<std::uint64_t> bits(2 * words * shafts.size());
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    const std::span<std::uint64_t> of = std::span(bits).subspan(2 * words * s, 2 * words);
    classify(shafts[s], memory.view(), of.first(words), of.last(words));
  }
  return bits;
}

/// Bodies, lights and vectors, any light apart from any body, and a plane for each.
struct BatchInput {
  std::vector<Box> bodies;
  std::vector<Box> lights;
  std::vector<Vec3> vectors;
  std::vector<Plane> body_planes;   // two each
  std::vector<Plane> light_planes;  // one each

  explicit BatchInput(std::size_t count) {
    Random random(70);
    for (std::size_t i = 0; i != count; ++i) {
      bodies.push_back(random.one_in(2) ? random.grid_box(-3, 3) : random.box(-3, 3, 0.1F, 1.0F));
      lights.push_back(random.box(-3, 3, 0, 0.3F));
      lights.back().lo[0] += 9;
      lights.back().hi[0] += 9;
      vectors.push_back(random.vec3(-4, 4));
      light_planes.push_back({random.vec3(-1, 1), random.uniform(0, 3)});
      for (int plane = 0; plane != 2; ++plane) body_planes.push_back({random.vec3(-1, 1), random.uniform(0, 3)});
    }
  }
};

TEST(Kinds, BatchesGiveTheShaftsOfSingleCalls) {
  constexpr std::size_t count = 50;
  const BatchInput input(count);
  const BoxStream bodies(input.bodies);
  const BoxStream lights(input.lights);
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i != count; ++i) pairs.push_back({i * 7 % 50, i * i % 50});
  const auto check = [&](const char* call, bool has_planes, const auto& batch, const auto& single) {
    std::vector<CompiledShaft> shafts(count);
    batch(shafts);
    std::vector<CompiledShaft> right;
    for (std::size_t i = 0; i != count; ++i) {
      right.push_back(single(i));
    }
    EXPECT_EQ(bits_of(shafts), bits_of(right)) << call << (has_planes ? " with planes" : "");
  };
  for (const bool has_planes : {false, true}) {
    const std::span<const Plane> of_bodies =
        has_planes ? std::span<const Plane>(input.body_planes) : std::span<const Plane>();
    const BatchPlanes of_both = has_planes ? BatchPlanes{input.light_planes, input.body_planes} : BatchPlanes{};
    const auto planes_of = [&](std::size_t body) { return has_planes ? of_bodies.subspan(2 * body, 2) : of_bodies; };
    const auto planes_of_both = [&](std::size_t light, std::size_t body) {
      std::vector<Plane> planes;
      if (has_planes) planes = {input.light_planes[light], of_bodies[2 * body], of_bodies[2 * body + 1]};
      return planes;
    };
    check(
        "swept_batch", has_planes, [&](auto& out) { swept_batch(bodies.view(), input.vectors, out, of_bodies); },
        [&](std::size_t i) { return swept(input.bodies[i], input.vectors[i], planes_of(i)); });
    check(
        "swept_infinite_batch", has_planes,
        [&](auto& out) { swept_infinite_batch(bodies.view(), input.vectors, out, of_bodies); },
        [&](std::size_t i) { return swept_infinite(input.bodies[i], input.vectors[i], planes_of(i)); });
    check(
        "shadow_batch", has_planes, [&](auto& out) { shadow_batch(lights.view(), bodies.view(), out, of_both); },
        [&](std::size_t i) { return shadow(input.lights[i], input.bodies[i], planes_of_both(i, i)); });
    check(
        "shadow_batch, reach", has_planes,
        [&](auto& out) { shadow_batch(lights.view(), bodies.view(), 1.5F, out, of_both); },
        [&](std::size_t i) { return shadow(input.lights[i], input.bodies[i], 1.5F, planes_of_both(i, i)); });
    check(
        "shadow_batch, pairs", has_planes,
        [&](auto& out) { shadow_batch(lights.view(), bodies.view(), pairs, out, of_both); },
        [&](std::size_t i) {
          const auto [l, o] = pairs[i];
          return shadow(input.lights[l], input.bodies[o], planes_of_both(l, o));
        });
    check(
        "shadow_batch, pairs, reach", has_planes,
        [&](auto& out) { shadow_batch(lights.view(), bodies.view(), pairs, 1.5F, out, of_both); },
        [&](std::size_t i) {
          const auto [l, o] = pairs[i];
          return shadow(input.lights[l], input.bodies[o], 1.5F, planes_of_both(l, o));
        });
  }
}

TEST(Kinds, BatchesRefuseBeforeTheyWrite) {
  BatchInput input(4);
  const BoxStream lights(input.lights);
  const BoxStream bodies(input.bodies);
  std::vector<CompiledShaft> out(4);
  const IndexPair bad_pairs[] = {{0, 0}, {1, 4}, {0, 0}, {0, 0}};
  const std::vector<Plane> uneven(5, Plane{{1, 0, 0}, 1});
  using testing::HasSubstr;
  EXPECT_THAT(message_of([&] { swept_batch(bodies.view(), std::span(input.vectors).first(3), out); }),
              HasSubstr("not 4, 3 and 4"));
  EXPECT_THAT(message_of([&] { swept_batch(bodies.view(), input.vectors, out, uneven); }),
              HasSubstr("planes.a has 5 planes"));
  EXPECT_THAT(message_of([&] { shadow_batch(lights.view(), bodies.view(), std::span(out).first(2)); }),
              HasSubstr("not 4, 4 and 2"));
  EXPECT_THAT(message_of([&] { shadow_batch(lights.view(), bodies.view(), bad_pairs, out); }),
              HasSubstr("pairs[1].b = 4"));
  EXPECT_THAT(message_of([&] { shadow_batch(lights.view(), bodies.view(), std::span(bad_pairs).first(1), out); }),
              HasSubstr("not 1 and 4"));
  EXPECT_THAT(message_of([&] { shadow_batch(lights.view(), bodies.view(), 0.5F, out); }), HasSubstr("reach = 0.5"));
  EXPECT_THAT(message_of<BadBound>([&] { shadow_batch(bodies.view(), bodies.view(), out); }),
              HasSubstr("shaft 0: shadow: light and occluder overlap"));
  input.vectors[2] = {0, 0, 0};
  EXPECT_THAT(message_of<BadBound>([&] { swept_infinite_batch(bodies.view(), input.vectors, out); }),
              HasSubstr("shaft 2: swept_infinite: direction is 0"));
  for (const CompiledShaft& shaft : out) EXPECT_FALSE(shaft.formed()) << "written before the error was found";
}

/// Shafts of all kinds as a group, and bounds in several tiles: many that touch some shaft, and in the second tile some
/// that are far away.
struct GridCase {
  std::vector<CompiledShaft> shafts;
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;

  GridCase(Random& random, std::size_t bounds) {
    std::vector<MovingInput> inputs;
    for (std::size_t s = 0; s != 24; ++s) {
      inputs.push_back(random_movement(random, moving_kinds[s % 4]));
      shafts.push_back(shaft_of(inputs.back()));
    }
    for (std::size_t i = 0; i != bounds; ++i) {
      const MovingInput& input = inputs[random.below(24)];
      const bool is_far = i / 2048 == 1 && random.one_in(300);
      Box box = random.one_in(3) ? touching_box(random, input) : random.box(-5, 5, 0.01F, 0.3F);
      for (std::size_t k = 0; k != 3 && !is_far; ++k) {
        box.lo[k] = std::clamp(box.lo[k], -6.0F, 6.0F);
        box.hi[k] = std::clamp(box.hi[k], -6.0F, 6.0F);
      }
      boxes.push_back(box);
      spheres.push_back({box.lo, random.uniform(0, 0.5F)});
    }
  }
};

template <class Bound>
void expect_same_among_many(const GridCase& input, const std::vector<Bound>& bounds) {
  const auto memory = columns(bounds);
  const std::size_t words = bit_words(bounds.size());
  std::vector<std::uint64_t> kept(words * input.shafts.size());
  std::vector<std::uint64_t> inside(kept.size());
  classify_many(input.shafts, memory.view(), kept, inside);
  for (std::size_t s = 0; s != input.shafts.size(); ++s) {
    std::vector<std::uint64_t> kept_alone(words);
    std::vector<std::uint64_t> inside_alone(words);
    classify(input.shafts[s], memory.view(), kept_alone, inside_alone);
    const auto row = [&](const std::vector<std::uint64_t>& rows) {
      return std::vector<std::uint64_t>(rows.begin() + static_cast<std::ptrdiff_t>(words * s),
                                        rows.begin() + static_cast<std::ptrdiff_t>(words * (s + 1)));
    };
    EXPECT_EQ(row(kept), kept_alone) << name(active_isa()) << ", shaft " << s;
    EXPECT_EQ(row(inside), inside_alone) << name(active_isa()) << ", shaft " << s;
  }
}

TEST(Kinds, AGroupOnAGridAnswersWhatEachShaftAnswersAlone) {
  constexpr std::uint64_t seed = 9;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int round = 0; round != 6 && !HasFailure(); ++round) {
    const GridCase input(random, 3 * 2048 + 77);
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      expect_same_among_many(input, input.boxes);
      expect_same_among_many(input, input.spheres);
    }
  }
}

TEST(Kinds, ShaftsWithoutEndHaveAPlaceOnTheGrid) {
  Random random(10);
  const GridCase input(random, 2048);
  const auto memory = columns(input.boxes);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    if (kernels.frame == nullptr) continue;
    const auto data = kernel::data_of(std::span<const CompiledShaft>(input.shafts));
    kernel::GroupOnGrid group;
    const BoxView boxes = memory.view();
    group.form(kernels, data, kernel::BoundStreams(boxes), input.boxes.size());
    ASSERT_TRUE(group.exists() && group.has_cuts);
    std::size_t endless = 0;
    for (std::size_t s = 0; s != data.size(); ++s) {
      if (data[s].is_endless() && group.shaft[s].exists &&
          static_cast<float>(group.shaft[s].cut.least) < kernel::grid_top)
        ++endless;
    }
    EXPECT_GE(endless, 10U) << "of 12";
  }
}

/// Shadows without end that leave the frame on the grid before they leave the bounds behind, and bounds far beyond the
/// frame, some in them and some not, but none where shadows are cut off.
GridCase case_of_wide_shadows(Random& random) {
  GridCase input(random, 3 * 2048 + 77);
  input.shafts.clear();
  for (int s = 0; s != 24; ++s) {
    const float y = random.uniform(-2, 2);
    const float half = random.uniform(2, 4);
    const Box light{{-5, y, 0}, {-5 + 0.1F, y + 0.1F, 0.1F}};
    input.shafts.push_back(shadow(light, {{-4, y - half, -half}, {-3.5F, y + half, half}}));
  }
  for (std::size_t i = 2048; i != 2 * 2048; ++i) {  // the second tile
    Box& box = input.boxes[i];
    box = random.box(-5, 5, 0.01F, 0.3F);
    if (!random.one_in(8)) continue;
    const float by = random.uniform(-60, 60);
    const std::size_t k = 1 + random.below(2);
    box.lo[k] += by;
    box.hi[k] += by;
    input.spheres[i] = {box.lo, random.uniform(0, 0.5F)};
  }
  for (std::size_t i = 2 * 2048; i < input.boxes.size(); i += 9) {  // empty ones, in the other tiles
    input.boxes[i] = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    input.spheres[i].radius = -1;
  }
  return input;
}

TEST(Kinds, ShadowsThatLeaveTheFrameAnswerWhatEachAnswersAlone) {
  constexpr std::uint64_t seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int round = 0; round != 6 && !HasFailure(); ++round) {
    const GridCase input = case_of_wide_shadows(random);
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      expect_same_among_many(input, input.boxes);
      expect_same_among_many(input, input.spheres);
    }
  }
}

TEST(Kinds, ShadowsThatLeaveTheFrameHaveAPlaceOnTheGrid) {
  Random random(13);
  const GridCase input = case_of_wide_shadows(random);
  const auto boxes = columns(std::vector<Box>(input.boxes.begin(), input.boxes.begin() + 2048));
  const auto spheres = columns(std::vector<Sphere>(input.spheres.begin(), input.spheres.begin() + 2048));
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    if (kernels.frame == nullptr) continue;
    const auto data = kernel::data_of(std::span<const CompiledShaft>(input.shafts));
    const BoxView box_view = boxes.view();
    const SphereView sphere_view = spheres.view();
    for (const kernel::BoundStreams& near : {kernel::BoundStreams(box_view), kernel::BoundStreams(sphere_view)}) {
      kernel::GroupOnGrid group;
      group.form(kernels, data, near, near.count);
      ASSERT_TRUE(group.exists());
      for (std::size_t s = 0; s != data.size(); ++s) {
        EXPECT_TRUE(group.shaft[s].exists && group.shaft[s].cut.leaves_frame) << "shaft " << s;
      }
    }
  }
}

/// The extent of a word of bounds all of whose coordinates are those of `usual`, but for one bound's.
kernel::TileExtent extent_with(std::int16_t usual, std::size_t bound, const std::vector<std::int16_t>& coordinates) {
  constexpr std::size_t bounds = 128;
  alignas(64) std::int16_t memory[6][bounds];
  const std::int16_t* grid[6];
  for (std::size_t s = 0; s != 6; ++s) {
    std::fill_n(memory[s], bounds, usual);
    memory[s][bound] = coordinates[s];
    grid[s] = memory[s];
  }
  return kernel::active_kernels().grid.extent(grid, bounds / 64);
}

TEST(Kinds, TheExtentOfATileIsThatOfAllItsBounds) {
  constexpr auto top = static_cast<std::int16_t>(kernel::grid_top);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    if (kernel::active_kernels().grid.frame == nullptr) continue;
    for (std::size_t bound = 0; bound != 128; ++bound) {
      const kernel::TileExtent inner = extent_with(100, bound, {-7, 6, -top, 4, 101, -2});
      EXPECT_THAT(inner.least, testing::ElementsAre(-7, 6, -top, 4, 100, -2)) << name(isa) << ", bound " << bound;
      EXPECT_FALSE(inner.any_above) << name(isa) << ", bound " << bound;
      EXPECT_TRUE(extent_with(100, bound, {1, 2, 3, 4, top, 6}).any_above) << name(isa) << ", bound " << bound;
      EXPECT_TRUE(extent_with(top, bound, {top, top, top, top, top, 6}).any_above) << name(isa) << ", bound " << bound;
      EXPECT_FALSE(extent_with(0, bound, {top, top, top, top, top, top}).any_above) << name(isa) << ", bound " << bound;
    }
  }
}

TEST(Kinds, BoundsThatAreNotFiniteAreAnsweredAlikeInEveryForm) {
  const Box light{{-9, 0, 0}, {-8, 1, 1}};
  const Box body{{0, 0, 0}, {1, 1, 1}};
  const std::vector<Box> boxes{
      {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}},  // the empty box
      {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}},
      {{-infinity, 0.2F, 0.2F}, {infinity, 0.3F, 0.3F}},
      {{0, infinity, 0}, {1, infinity, 1}},
      {{nan, nan, nan}, {nan, nan, nan}},
  };
  const std::vector<Answer> right{Answer::outside, Answer::overlap, Answer::overlap, Answer::outside, Answer::overlap};
  const auto memory = columns(boxes);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const CompiledShaft& shaft :
         {swept(body, {2, 1, 0.5F}), swept_infinite(body, {2, 1, 0.5F}), swept_infinite(body, {1, 0, 0}),
          swept_infinite(body, {-1, 0, 0}), shadow(light, body, 2), shadow(light, body)}) {
      for (const Form form : forms) {
        std::vector<std::uint64_t> kept(1);
        std::vector<std::uint64_t> inside(1);
        classify(in_form(shaft, form), memory.view(), kept, inside);
        for (std::size_t i = 0; i != boxes.size(); ++i) {
          EXPECT_EQ(text(answer_at(kept, inside, i)), text(right[i])) << name(isa) << ", box " << i;
        }
      }
    }
  }
}

/// What is met later than at the largest float: never, of a bound that ends, and in the end of one that does not.
TEST(Kinds, BoundsThatAreMetAfterEveryFloatAreMet) {
  const CompiledShaft shaft = swept_infinite({{0, 0, 0}, {1, 1, 1}}, {1, 1e-20F, 0});  // y = 1e30 at t = 1e50
  std::vector<Box> boxes;
  for (unsigned i = 0; i != 70; ++i) {
    boxes.push_back({{-infinity, 1e30F, 0}, {i % 2 == 0 ? infinity : std::numeric_limits<float>::max(), 2e30F, 1}});
  }
  const auto memory = columns(boxes);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : forms) {
      std::vector<std::uint64_t> kept(bit_words(boxes.size()));
      cull(in_form(shaft, form), memory.view(), kept);
      for (std::size_t i = 0; i != boxes.size(); ++i) {
        EXPECT_EQ((kept[i / 64] >> i % 64 & 1U) != 0, i % 2 == 0) << name(isa) << ", box " << i;
      }
    }
  }
}

TEST(Kinds, InfiniteBoxesAreNeverInside) {
  const CompiledShaft sweep = swept_infinite({{0, 0, 0}, {1, 1, 1}}, {1, 0, 0});
  const CompiledShaft shade = shadow({{-3, -1, -1}, {-2, 1, 1}}, {{0, -9, -9}, {1, 9, 9}});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const CompiledShaft& shaft : {sweep, shade}) {
      EXPECT_EQ(classify(shaft, Box{{2, 0.25F, 0.25F}, {1e30F, 0.5F, 0.5F}}), Answer::inside) << name(isa);
      EXPECT_EQ(classify(shaft, Box{{2, 0.25F, 0.25F}, {infinity, 0.5F, 0.5F}}), Answer::overlap) << name(isa);
    }
  }
}

TEST(Kinds, AddedPlanesAreAnsweredExactly) { check(8, 15, movement_with_planes); }

}  // namespace
}  // namespace shaftcull
