// SPDX-License-Identifier: MIT
/// A CompiledShaft that was never formed: every call refuses it, and says which one it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "calls/every_call.hpp"
#include "message_of.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(NeverFormed, IsRefusedByEveryCall) {
  const EveryCall every(std::vector<CompiledShaft>(5), 300);
  for (const PublicCall& call : every.calls()) {
    if (!call.asks_shafts) continue;
    AnswerWords words;
    EXPECT_THAT(message_of([&] { call.call(words); }),
                AllOf(HasSubstr("shaft 0 was never formed"), HasSubstr("compile()")))
        << call.name;
  }
}

TEST(NeverFormed, IsNamedByItsPositionAmongMany) {
  std::vector<CompiledShaft> shafts = EveryCall::shafts(5);
  shafts[3] = CompiledShaft();
  const BoxStream boxes(70);
  std::vector<std::uint64_t> kept(10, 7);
  EXPECT_THAT(message_of([&] { cull_many(shafts, boxes.view(), kept); }), HasSubstr("shaft 3 was never formed"));
  EXPECT_EQ(kept, std::vector<std::uint64_t>(10, 7)) << "written before the error was found";
  EXPECT_THAT(message_of([&] { set_contact(shafts, Contact::open); }), HasSubstr("shaft 3 was never formed"));
  EXPECT_EQ(shafts[0].contact(), Contact::closed) << "written before the error was found";
}

TEST(NeverFormed, IsWhatAnyMemoryBecomes) {
  alignas(CompiledShaft) std::byte memory[sizeof(CompiledShaft)];
  std::memset(memory, 0xff, sizeof memory);
  CompiledShaft* const shaft = new (static_cast<void*>(memory)) CompiledShaft;  // not CompiledShaft(): no parentheses
  EXPECT_THAT(message_of([&] { (void)classify(*shaft, Box{{0, 0, 0}, {1, 1, 1}}); }), HasSubstr("never formed"));
  complete(*shaft);  // has nothing to complete
  const CompiledShaft copy = *shaft;
  EXPECT_THAT(message_of([&] { (void)classify(copy, Sphere{{0, 0, 0}, 1}); }), HasSubstr("never formed"));
}

}  // namespace
}  // namespace shaftcull
