// SPDX-License-Identifier: MIT
/// Shafts of moving boxes that are formed alone, in registers, against those of a batch: the same to the bit, on every
/// instruction set.
#include <gtest/gtest.h>

#include <cstdint>
#include <span>

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

CompiledShaft alone(const MovingInput& input) {
  switch (input.kind) {
    case Kind::swept:
      return swept(input.box, input.displacement);
    case Kind::swept_infinite:
      return swept_infinite(input.box, input.displacement);
    case Kind::shadow:
      return shadow(input.light, input.box, input.reach);
    default:
      return shadow(input.light, input.box);
  }
}

CompiledShaft of_batch(const MovingInput& input) {
  CompiledShaft shaft;
  const std::span<CompiledShaft> out(&shaft, 1);
  const BoxStream body(std::span(&input.box, 1));
  const std::span<const Vec3> vector(&input.displacement, 1);
  if (input.is_shadow()) {
    const BoxStream light(std::span(&input.light, 1));
    if (input.kind == Kind::shadow) shadow_batch(light.view(), body.view(), input.reach, out);
    if (input.kind == Kind::shadow_without_end) shadow_batch(light.view(), body.view(), out);
  } else {
    if (input.kind == Kind::swept) swept_batch(body.view(), vector, out);
    if (input.kind == Kind::swept_infinite) swept_infinite_batch(body.view(), vector, out);
  }
  return shaft;
}

void expect_same(const MovingInput& input) {
  CompiledShaft one = alone(input);
  CompiledShaft other = of_batch(input);
  const kernel::ShaftData& shaft = kernel::data_of(one);
  const kernel::ShaftData& expected = kernel::data_of(other);
  EXPECT_EQ(shaft.kind, expected.kind);
  EXPECT_EQ(bits(shaft.motion), bits(expected.motion));
  EXPECT_EQ(shaft.reach, expected.reach);
  complete(one);
  complete(other);
  expect_equal(one, other);
}

TEST(FormedAlone, HasTheBitsOfABatch) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    Random random(1);
    for (const MovingFamily& family : moving_families) {
      for (std::uint64_t i = 0; i != random_cases(200); ++i) {
        for (const Kind kind : {Kind::swept, Kind::swept_infinite, Kind::shadow, Kind::shadow_without_end}) {
          const MovingInput input = family.input(random, kind);
          expect_same(input);
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
