// SPDX-License-Identifier: MIT
/// `shaftcull hash`, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/program.hpp"
#include "hashes/hashes.hpp"

namespace shaftcull::test {
namespace {

using hashes::Family;
using testing::HasSubstr;
using testing::Not;

/// The last words of the row of a family.
std::vector<std::string> row_of(const std::string& out, const Family& family) {
  return words_after(out, fmt::format("{}  ", family.name));
}

TEST(CliHash, TellsTheHashOfEachFamilyThatIsAskedFor) {
  const Outcome outcome =
      run_program({"hash", "--quick", "--family", "solids", "--family", "sights", "--isa", "scalar"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const Family& family : hashes::families()) {
    SCOPED_TRACE(family.name);
    const std::string hash = fmt::format("{:016x}", family.hash_of_few);
    if (std::string(family.name) == "solids" || std::string(family.name) == "sights") {
      EXPECT_EQ(row_of(outcome.out, family).at(0), hash);
      EXPECT_EQ(row_of(outcome.out, family).at(1), "yes");
    } else {
      EXPECT_THAT(outcome.out, Not(HasSubstr(hash)));
    }
  }
  EXPECT_THAT(outcome.out, HasSubstr("on: scalar\n"));
}

TEST(CliHash, SaysWhichFamiliesThereAre) {
  const Outcome outcome = run_program({"hash", "--family", "hull"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, testing::AllOf(HasSubstr("--family hull"), HasSubstr("'hulls'")));
}

TEST(CliHash, ItsPageHasTheRecord) {
  std::ifstream file(std::string(SHAFTCULL_DOCS) + "/hashes.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const Family& family : hashes::families()) {
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| {} | {} | `{:016x}` | `{:016x}` |\n", family.name, family.what,
                                            family.hash_of_many, family.hash_of_few)));
  }
}

}  // namespace
}  // namespace shaftcull::test
