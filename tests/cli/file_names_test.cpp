// SPDX-License-Identifier: MIT
/// Files with names that not every system takes for granted, and the ends of lines in files of text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "file_path.hpp"

namespace shaftcull::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> writing(const std::string& path) {
  return with(one_room, {path.ends_with(".svg") ? "--svg" : "--out", path});
}

/// Some Latin letters with accents, Greek, Chinese, and one beyond 16 bits.
const std::string foreign = "r\u00e4ume \u03bb \u5c4b \U0001f3e0";

TEST(CliFileNames, MayHaveLettersOfEveryLanguage) {
  const ScratchFolder folder;
  const std::string plain = folder.path("plain.svg");
  static_cast<void>(output_of(writing(plain)));
  std::filesystem::create_directory(cli::file_path(folder.path(foreign)));
  for (const char* end : {".svg", ".csv", ".npz"}) {
    const std::string path = folder.path(foreign + '/' + foreign + end);
    static_cast<void>(output_of(writing(path)));
    EXPECT_THAT(bytes_of_file(path), Not(testing::IsEmpty())) << path;
  }
  EXPECT_EQ(bytes_of_file(folder.path(foreign + '/' + foreign + ".svg")), bytes_of_file(plain));
}

TEST(CliFileNames, AreToldAsTheyWereGiven) {
  const ScratchFolder folder;
  const std::string path = folder.path("none/" + foreign + ".svg");
  EXPECT_THAT(refusal_of(writing(path)), HasSubstr(path + ": cannot be written: No such file or directory"));
}

TEST(CliFileNames, MayStandForFilesThatAreReplaced) {
  const ScratchFolder folder;
  const std::string path = folder.write(foreign + ".svg", "old");
  static_cast<void>(output_of(writing(path)));
  EXPECT_THAT(bytes_of_file(path), StartsWith("<"));
  const std::filesystem::directory_iterator files(folder.path(""));
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "what was written before it was renamed is still there";
}

/// A folder of more than 260 characters below `folder`, none of whose names has more than 255.
std::filesystem::path long_folder(const ScratchFolder& folder) {
  std::filesystem::path path = cli::file_path(folder.path("long"));
  std::filesystem::create_directory(path);
  for (int i = 0; i != 4; ++i) {
    path /= std::string(100, 'x');
    std::filesystem::create_directory(path);
  }
  return path;
}

TEST(CliFileNames, MayBeLong) {
  const ScratchFolder folder;
  const std::filesystem::path path = long_folder(folder) / "a.svg";
  const std::string name = cli::file_name(path);
  ASSERT_GT(name.size(), 260U);
  for (int i = 0; i != 2; ++i) {  // made, then replaced
    static_cast<void>(output_of(writing(name)));
    EXPECT_THAT(bytes_of_file(name), StartsWith("<"));
  }
}

TEST(CliFileNames, OfFoldersAreRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal_of(writing(folder.path(""))), HasSubstr("cannot be written: it is a directory"));
}

TEST(CliTextFiles, HaveTheSameLineEndsOnEverySystem) {
  const ScratchFolder folder;
  for (const char* name : {"a.svg", "a.csv"}) {
    static_cast<void>(output_of(writing(folder.path(name))));
    EXPECT_THAT(bytes_of_file(folder.path(name)), testing::AllOf(HasSubstr("\n"), Not(HasSubstr("\r")))) << name;
  }
  EXPECT_THAT(output_of({"draw"}), testing::AllOf(HasSubstr("\n"), Not(HasSubstr("\r"))));
  EXPECT_THAT(refusal_of({"fly"}), Not(HasSubstr("\r")));
}

}  // namespace
}  // namespace shaftcull::test
