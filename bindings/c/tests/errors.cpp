// SPDX-License-Identifier: MIT
/// Errors: what is recorded, for which thread, and that nothing is thrown into C.
#include <gmock/gmock.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "environment.hpp"
#include "handles.hpp"
#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"
#include "status.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;
using testing::StrEq;

TEST(CErrors, AreOfTheThreadThatMadeTheCall) {
  EXPECT_EQ(shaftcull_select_isa("first"), SHAFTCULL_INVALID_ARGUMENT);
  std::string at_first;
  std::string afterwards;
  std::thread other([&] {
    at_first = shaftcull_error_message();
    EXPECT_EQ(shaftcull_select_isa("second"), SHAFTCULL_INVALID_ARGUMENT);
    afterwards = shaftcull_error_message();
  });
  other.join();
  EXPECT_THAT(at_first, StrEq(""));
  EXPECT_THAT(afterwards, HasSubstr("second"));
  EXPECT_THAT(shaftcull_error_message(), HasSubstr("first"));
}

TEST(CErrors, StayUntilTheNextFailure) {
  EXPECT_EQ(shaftcull_select_isa("wrong"), SHAFTCULL_INVALID_ARGUMENT);
  const char* name = nullptr;
  ok(shaftcull_isa_name(0, &name));
  EXPECT_THAT(shaftcull_error_message(), HasSubstr("wrong"));
}

TEST(CErrors, SayAllThatTheCppInterfaceSays) {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {1, 1, 1}}};
  const std::vector<shaftcull_box> in_c = as_c(boxes);
  const shaftcull_source source = source_of(in_c);
  shaftcull_bounds* stream = nullptr;
  try {
    const BoxStream cpp{std::span<const Box>(boxes)};
    FAIL() << "a box with lo > hi was packed";
  } catch (const BadBound& bad) {
    EXPECT_EQ(shaftcull_stream_create(&source, &stream), SHAFTCULL_BAD_BOUND);
    EXPECT_THAT(shaftcull_error_message(), StrEq(bad.what()));
    EXPECT_EQ(shaftcull_error_position(), bad.index());
  }
  EXPECT_EQ(stream, nullptr);
}

TEST(CErrors, PositionIsThatOfTheLastFailureOnly) {
  const std::vector<shaftcull_sphere> bad{{{0, 0, 0}, -1}};
  const shaftcull_source source = source_of(bad);
  shaftcull_bounds* stream = nullptr;
  EXPECT_EQ(shaftcull_stream_create(&source, &stream), SHAFTCULL_BAD_BOUND);
  EXPECT_EQ(shaftcull_error_position(), 0U);
  EXPECT_EQ(shaftcull_stream_create(nullptr, &stream), SHAFTCULL_INVALID_ARGUMENT);
  EXPECT_EQ(shaftcull_error_position(), SHAFTCULL_NONE);
}

TEST(CErrors, AreCutOffIfTheyAreLong) {
  const std::string name(5000, 'x');
  EXPECT_EQ(shaftcull_select_isa(name.c_str()), SHAFTCULL_INVALID_ARGUMENT);
  const std::string message = shaftcull_error_message();
  EXPECT_GT(message.size(), 900U);
  EXPECT_LT(message.size(), name.size());
}

TEST(CErrors, OfSeveralShaftsSayWhichBoxes) {
  const std::vector<Box> good{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  const std::vector<Box> bad{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {1, 1, 1}}};
  const std::vector<shaftcull_box> good_in_c = as_c(good);
  const std::vector<shaftcull_box> bad_in_c = as_c(bad);
  const shaftcull_source a = source_of(good_in_c);
  const shaftcull_source b = source_of(bad_in_c);
  const ShaftsHandle array = made<ShaftsHandle>(shaftcull_shafts_create, std::uint64_t{2});
  shaftcull_shafts* const shafts = array.get();
  EXPECT_EQ(shaftcull_shafts_set_between(shafts, 0, 2, &a, &b, nullptr, nullptr, SHAFTCULL_CONTACT_CLOSED),
            SHAFTCULL_BAD_BOUND);
  EXPECT_THAT(shaftcull_error_message(), testing::StartsWith("shaft 1: box b: lo.x = 2"));
  EXPECT_EQ(shaftcull_error_position(), 1U);
  // Boxes that no pair names may be anything.
  const shaftcull_index_pair pair{1, 0};
  ok(shaftcull_shafts_set_between(shafts, 0, 1, &a, &b, &pair, nullptr, SHAFTCULL_CONTACT_CLOSED));
  // Without pairs, there is nothing to form.
  ok(shaftcull_shafts_set_between(shafts, 0, 0, &a, &a, nullptr, nullptr, SHAFTCULL_CONTACT_CLOSED));
  ok(shaftcull_shafts_set_shadow(shafts, 0, 0, &a, &a, nullptr, nullptr, nullptr));
}

#ifndef SHAFTCULL_SHARED  // a shared library shows no more than the interface
TEST(CErrors, WhatElseIsThrownIsAnInternalError) {
  EXPECT_EQ(binding::guarded([] { throw std::runtime_error("the disk is full"); }), SHAFTCULL_INTERNAL_ERROR);
  EXPECT_THAT(shaftcull_error_message(), StrEq("the disk is full"));
  EXPECT_EQ(binding::guarded([] { throw 7; }), SHAFTCULL_INTERNAL_ERROR);
  EXPECT_THAT(shaftcull_error_message(), HasSubstr("no std::exception"));
  EXPECT_EQ(binding::guarded([] { throw std::bad_alloc(); }), SHAFTCULL_OUT_OF_MEMORY);
  EXPECT_THAT(shaftcull_error_message(), HasSubstr("memory"));
  EXPECT_EQ(binding::guarded([] { throw NeedsRefit("later"); }), SHAFTCULL_NEEDS_REFIT);
  EXPECT_THAT(shaftcull_error_message(), StrEq("later"));
}
#endif

}  // namespace
}  // namespace shaftcull
