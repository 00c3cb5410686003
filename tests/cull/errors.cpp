// SPDX-License-Identifier: MIT
/// What cull() and classify() refuse, and what they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

const Box first_box{{0, 0, 0}, {1, 1, 1}};

class CullErrors : public testing::Test {
 protected:
  const CompiledShaft shaft_ = compile({{0, 0, 0}, {1, 1, 1}}, {{2, 3, 4}, {3, 4, 5}});
  const BoxColumns boxes_{std::vector<Box>(100, first_box)};
  const SphereColumns spheres_{std::vector<Sphere>(100, Sphere{{0, 0, 0}, 1})};
  std::vector<std::uint64_t> kept_ = std::vector<std::uint64_t>(2, 7);
  std::vector<std::uint64_t> inside_ = std::vector<std::uint64_t>(2, 7);
};

TEST_F(CullErrors, SpansThatShareMemoryAreRefused) {
  std::vector<std::uint64_t> both(3, 7);
  const std::vector<std::uint64_t> before = both;
  const std::span<std::uint64_t> kept = std::span(both).first(2);
  const auto names_them = HasSubstr("classify: kept and inside share memory");
  EXPECT_THAT(message_of([&] { classify(shaft_, boxes_.view(), kept, kept); }), names_them);
  EXPECT_THAT(message_of([&] { classify(shaft_, spheres_.view(), kept, std::span(both).last(2)); }), names_them);
  EXPECT_EQ(both, before);
}

TEST_F(CullErrors, SpansOfTheWrongSizeAreRefusedWithBothSizes) {
  for (const std::size_t size : {0U, 1U, 3U}) {
    std::vector<std::uint64_t> wrong(size, 7);
    const auto names_sizes = testing::AllOf(HasSubstr(std::to_string(size)), HasSubstr("2"));
    EXPECT_THAT(message_of([&] { cull(shaft_, boxes_.view(), wrong); }), names_sizes);
    EXPECT_THAT(message_of([&] { cull(shaft_, spheres_.view(), wrong); }), names_sizes);
    EXPECT_THAT(message_of([&] { classify(shaft_, spheres_.view(), kept_, wrong); }), names_sizes);
    if (size != 0) {  // without bits of kept bounds, those inside are asked for alone
      EXPECT_THAT(message_of([&] { classify(shaft_, boxes_.view(), wrong, inside_); }), names_sizes);
    }
    EXPECT_EQ(wrong, std::vector<std::uint64_t>(size, 7));
  }
  EXPECT_EQ(kept_, std::vector<std::uint64_t>(2, 7));
  EXPECT_EQ(inside_, std::vector<std::uint64_t>(2, 7));
}

TEST(IsaChoice, NamesAreReadBack) {
  for (const Isa isa : all_isas()) EXPECT_EQ(isa_from_name(name(isa)), isa);
  EXPECT_EQ(isa_from_name("AVX2"), Isa::avx2);
  EXPECT_EQ(isa_from_name("Sse4_2"), Isa::sse4_2);
  EXPECT_FALSE(isa_from_name("avx1024").has_value());
  EXPECT_FALSE(isa_from_name("avx").has_value());
  EXPECT_FALSE(isa_from_name("").has_value());
}

TEST(IsaChoice, ScalarIsAlwaysThereAndTheSlowestComesFirst) {
  const std::vector<Isa> isas = available_isas();
  ASSERT_FALSE(isas.empty());
  EXPECT_EQ(isas.front(), Isa::scalar);
  EXPECT_TRUE(std::is_sorted(isas.begin(), isas.end()));
}

TEST(IsaChoice, ASelectedInstructionSetIsActiveUntilTheNext) {
  const Isa before = active_isa();
  for (const Isa isa : available_isas()) {
    select_isa(isa);
    EXPECT_EQ(active_isa(), isa);
  }
  select_isa(before);
}

TEST(IsaChoice, AnUnavailableInstructionSetIsRefusedWithAListOfWhatThereIs) {
  const std::vector<Isa> isas = available_isas();
  const Isa before = active_isa();
  // Beyond the last, there is one that no build has.
  const Isa missing = isas.size() == 5 ? static_cast<Isa>(5) : static_cast<Isa>(isas.size());
  const std::string message = message_of([&] { select_isa(missing); });
  for (const Isa isa : isas) EXPECT_THAT(message, HasSubstr(std::string(name(isa))));
  EXPECT_EQ(active_isa(), before);
}

}  // namespace
}  // namespace shaftcull
