// SPDX-License-Identifier: MIT
/// The seed corpus of the fuzzer, and inputs near to it, without a fuzzer: any compiler runs this.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/check.hpp"
#include "fuzz/sights.hpp"
#include "fuzz/trees.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<std::filesystem::path> corpus() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SHAFTCULL_FUZZ_CORPUS)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Bytes contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string hexadecimal(const Bytes& bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

void check(const Bytes& bytes, std::size_t most_exact) {
  const Case it = Case::read(bytes);
  try {
    check_answers(it);
    check_exact(it, most_exact);
    check_trees(it);
    check_sights(it);
  } catch (const Fault& fault) {
    FAIL() << fault.what() << "\n  input (xxd -r -p): " << hexadecimal(bytes);
  }
}

TEST(FuzzCorpus, EverySeedHoldsWhatMustHold) {
  const auto files = corpus();
  ASSERT_GE(files.size(), 24U) << "in " << SHAFTCULL_FUZZ_CORPUS;
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    check(contents(file), 2 * Case::most_boxes);
  }
}

TEST(FuzzCorpus, SeedsCutShortOrWithBytesChangedHoldIt) {
  constexpr std::uint64_t seed = 131;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (const auto& file : corpus()) {
    SCOPED_TRACE(file.filename().string());
    const Bytes original = contents(file);
    for (std::uint64_t i = 0; i != random_cases(12) && !HasFailure(); ++i) {
      Bytes bytes = original;
      if (random.one_in(8)) bytes.resize(random.below(static_cast<unsigned>(bytes.size() + 1)));
      for (unsigned changes = 1 + random.below(4); !bytes.empty() && changes != 0; --changes) {
        bytes[random.below(static_cast<unsigned>(bytes.size()))] = static_cast<std::uint8_t>(random.below(256));
      }
      check(bytes, 2);
    }
  }
}

}  // namespace
}  // namespace shaftcull::fuzz
