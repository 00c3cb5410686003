// SPDX-License-Identifier: MIT
/// Shafts of moving boxes that are formed alone or in a batch, in registers or, alone with a plane, by the code for any
/// box: the same to the bit, on every instruction set.
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/shaft_data.hpp"
#include "cull/equal_shafts.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {
namespace {

using Kind = MovingInput::Kind;

using Planes = std::span<const Plane>;

CompiledShaft alone(const MovingInput& input, Planes planes) {
  switch (input.kind) {
    case Kind::swept:
      return swept(input.box, input.displacement, planes);
    case Kind::swept_infinite:
      return swept_infinite(input.box, input.displacement, planes);
    case Kind::shadow:
      return shadow(input.light, input.box, input.reach, planes);
    default:
      return shadow(input.light, input.box, planes);
  }
}

/// The third shaft of a batch of three, all of them written over `used`.
CompiledShaft of_batch(const MovingInput& input, Planes planes, const CompiledShaft& used) {
  std::vector<CompiledShaft> out(3, used);
  const BoxStream body(std::vector<Box>(3, input.box));
  const std::vector<Vec3> vectors(3, input.displacement);
  std::vector<Plane> all;
  for (int i = 0; i != 3; ++i) all.insert(all.end(), planes.begin(), planes.end());
  if (input.is_shadow()) {
    const BoxStream light(std::vector<Box>(3, input.light));
    if (input.kind == Kind::shadow) shadow_batch(light.view(), body.view(), input.reach, out, {.b = all});
    if (input.kind == Kind::shadow_without_end) shadow_batch(light.view(), body.view(), out, {.b = all});
  } else {
    if (input.kind == Kind::swept) swept_batch(body.view(), vectors, out, all);
    if (input.kind == Kind::swept_infinite) swept_infinite_batch(body.view(), vectors, out, all);
  }
  return out.back();
}

void expect_same(CompiledShaft one, CompiledShaft other) {
  const kernel::ShaftData& shaft = kernel::data_of(one);
  const kernel::ShaftData& expected = kernel::data_of(other);
  EXPECT_EQ(shaft.kind, expected.kind);
  EXPECT_EQ(bits(shaft.motion), bits(expected.motion));
  EXPECT_EQ(shaft.reach, expected.reach);
  complete(one);
  complete(other);
  expect_equal(one, other);
}

TEST(FormedAlone, HasTheBitsOfABatchAndOfAnyBox) {
  const Plane plane{{0.6F, 0, 0.8F}, -1.5F};
  CompiledShaft used = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 6, 7}, {8, 9, 9}}, std::span(&plane, 1));
  complete(used);
  set_contact(std::span(&used, 1), Contact::open);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    Random random(1);
    for (const MovingFamily& family : moving_families) {
      for (std::uint64_t i = 0; i != random_cases(200); ++i) {
        for (const Kind kind : {Kind::swept, Kind::swept_infinite, Kind::shadow, Kind::shadow_without_end}) {
          const MovingInput input = family.input(random, kind);
          for (const Planes planes : {Planes{}, Planes(&plane, 1)}) {
            expect_same(alone(input, planes), of_batch(input, planes, used));
          }
          if (testing::Test::HasFailure()) {
            FAIL() << "on " << name(isa) << ": " << family.name << "\n  " << source_text(input);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
