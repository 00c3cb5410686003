// SPDX-License-Identifier: MIT
/// Where the program writes what it is told to write: files, links, devices, pipes and standard output.
///
/// Devices are reached by links that the test makes: a program that replaces what it should write into replaces those.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> names_in(const ScratchFolder& folder) {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder.path(""))) {
    names.push_back(file.path().filename().string());
  }
  return names;
}

std::string option_for(const std::string& path) { return path.ends_with(".svg") ? "--svg" : "--out"; }

std::vector<std::string> writing_to(const std::string& path) { return with(one_room, {option_for(path), path}); }

std::string link_to(const std::string& target, const std::string& path) {
  std::filesystem::create_symlink(target, path);
  return path;
}

std::string picture_of_one_room() {
  const ScratchFolder folder;
  static_cast<void>(output_of(writing_to(folder.path("a.svg"))));
  return bytes_of_file(folder.path("a.svg"));
}

std::filesystem::perms permissions_of(const std::string& path) { return std::filesystem::status(path).permissions(); }

constexpr const char* full_disk = "trap '' XFSZ; ulimit -f 8;";

TEST(CliOutput, ADeviceIsWrittenIntoAndStaysWhatItIs) {
  for (const char* name : {"null.svg", "null.csv", "null.npz", "null"}) {
    const ScratchFolder folder;
    const std::string path = link_to("/dev/null", folder.path(name));
    static_cast<void>(output_of(writing_to(path)));
    EXPECT_TRUE(std::filesystem::is_character_file(path)) << name;
    EXPECT_THAT(names_in(folder), testing::ElementsAre(name));
  }
}

TEST(CliOutput, ADeviceThatIsFullIsAnError) {
  for (const char* name : {"full.svg", "full.csv", "full.npz"}) {
    const ScratchFolder folder;
    const std::string path = link_to("/dev/full", folder.path(name));
    const Outcome outcome = run_program(writing_to(path));
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("shaftcull: " + path + ": cannot be written: No space left on device"));
    EXPECT_TRUE(std::filesystem::is_character_file(path)) << name;
  }
}

/// What comes out of a pipe that has a name while `write` writes into it.
template <class Write>
std::string read_from_pipe(const std::string& path, const Write& write) {
  const int pipe = open(path.c_str(), O_RDONLY | O_NONBLOCK);
  std::atomic<bool> has_ended = false;
  std::thread writer([&] {
    write();
    has_ended = true;
  });
  std::string bytes;
  for (bool last = false; !last;) {
    last = has_ended;  // what was written until then is there to be read
    pollfd ready{pipe, POLLIN, 0};
    static_cast<void>(poll(&ready, 1, 20));
    std::array<char, 1 << 16> buffer{};
    for (ssize_t size = 0; (size = read(pipe, buffer.data(), buffer.size())) > 0;) {
      bytes.append(buffer.data(), static_cast<std::size_t>(size));
    }
  }
  writer.join();
  close(pipe);
  return bytes;
}

TEST(CliOutput, APipeGetsWhatAFileGets) {
  for (const char* name : {"pipe.svg", "pipe.csv", "pipe.npz"}) {
    const ScratchFolder folder;
    const std::string file = folder.path(std::string("file") + (name + 4));
    static_cast<void>(output_of(writing_to(file)));
    const std::string path = folder.path(name);
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const std::string bytes = read_from_pipe(path, [&] { static_cast<void>(output_of(writing_to(path))); });
    EXPECT_TRUE(bytes == bytes_of_file(file)) << name;
    EXPECT_TRUE(std::filesystem::is_fifo(path)) << name;
  }
}

TEST(CliOutput, ALinkStaysAndTheFileBehindItIsReplaced) {
  const ScratchFolder folder;
  const ScratchFolder elsewhere;
  const std::string picture = picture_of_one_room();
  const std::string old = elsewhere.write("old.svg", "old");
  const std::string link = link_to(link_to(old, elsewhere.path("link.svg")), folder.path("a.svg"));
  static_cast<void>(output_of(writing_to(link)));
  EXPECT_EQ(bytes_of_file(old), picture);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(std::filesystem::is_symlink(elsewhere.path("link.svg")));

  const std::string dangling = link_to("none.svg", folder.path("dangling.svg"));
  static_cast<void>(output_of(writing_to(dangling)));
  EXPECT_EQ(bytes_of_file(folder.path("none.svg")), picture);
  EXPECT_TRUE(std::filesystem::is_symlink(dangling));

  const std::string loop = link_to("loop.svg", folder.path("loop.svg"));
  EXPECT_THAT(refusal_of(writing_to(loop)), HasSubstr(loop + ": cannot be written: Too many levels of symbolic links"));
}

TEST(CliOutput, FilesOfTheUserBesideItStayAsTheyAre) {
  const ScratchFolder folder;
  const std::string other = folder.write("other", "mine");
  const std::string part = folder.write("a.svg.part", "mine, too");
  static_cast<void>(link_to(other, folder.path("b.svg.part")));
  for (const char* name : {"a.svg", "b.svg"}) static_cast<void>(output_of(writing_to(folder.path(name))));
  EXPECT_EQ(bytes_of_file(other), "mine");
  EXPECT_EQ(bytes_of_file(part), "mine, too");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("b.svg.part")));
  EXPECT_THAT(names_in(folder), testing::SizeIs(5));
}

TEST(CliOutput, PermissionsAreThoseOfTheFileThatIsReplacedOrTheUsual) {
  using std::filesystem::perms;
  const ScratchFolder folder;
  for (const char* name : {"a.svg", "a.csv", "a.npz"}) {
    const std::string path = folder.path(name);
    EXPECT_EQ(run_program(writing_to(path), "umask 027;").exit_code, 0);
    EXPECT_EQ(permissions_of(path), perms(0640)) << name;
    std::filesystem::permissions(path, perms(0604));
    EXPECT_EQ(run_program(writing_to(path), "umask 077;").exit_code, 0);
    EXPECT_EQ(permissions_of(path), perms(0604)) << name;
  }
}

TEST(CliOutput, AFileThatMayNotBeWrittenIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write every file";
  const ScratchFolder folder;
  const std::string path = folder.write("a.svg", "old");
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  EXPECT_THAT(refusal_of(writing_to(path)), HasSubstr(path + ": cannot be written: Permission denied"));
  EXPECT_EQ(bytes_of_file(path), "old");
}

TEST(CliOutput, AFailureLeavesTheOldFileAndNothingElse) {
  for (const char* name : {"a.svg", "a.csv", "a.npz"}) {
    const ScratchFolder folder;
    const std::string path = folder.write(name, "old");
    const Outcome outcome = run_program(writing_to(path), full_disk);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("shaftcull: " + path + ": cannot be written: File too large"));
    EXPECT_EQ(bytes_of_file(path), "old");
    EXPECT_THAT(names_in(folder), testing::ElementsAre(name));
  }
}

TEST(CliOutput, AMinusIsStandardOutputAndTheReportGoesToStandardError) {
  const Outcome picture = run_program(with(one_room, {"--svg", "-"}));
  EXPECT_EQ(picture.exit_code, 0);
  EXPECT_EQ(picture.out, picture_of_one_room());
  EXPECT_THAT(picture.error, HasSubstr("1 room: 8 objects"));
  EXPECT_FALSE(std::filesystem::exists("-"));

  const ScratchFolder folder;
  const std::string path = folder.path("a.csv");
  EXPECT_THAT(output_of(writing_to(path)), StartsWith("1 room: 8 objects"));
  const Outcome table = run_program(with(one_room, {"--out", "-", "--format", "json"}));
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_TRUE(table.out == bytes_of_file(path));
  EXPECT_THAT(table.error, HasSubstr("\"facing_away\""));
  EXPECT_FALSE(std::filesystem::exists("-"));

  for (const char* option : {"--svg", "--out"}) {
    const Outcome full = run_program(with(one_room, {option, "-"}), "", ">/dev/full");
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.error, HasSubstr("shaftcull: standard output cannot be written: No space left on device"));
    const Outcome closed = run_program(with(one_room, {option, "-"}), "", ">&-");
    expect_refusal(closed);
    EXPECT_THAT(closed.error, HasSubstr("shaftcull: standard output cannot be written: Bad file descriptor"));
  }
}

TEST(CliOutput, AFileThatIsOpenAlreadyIsWrittenInto) {
  const ScratchFolder folder;
  const std::string picture = picture_of_one_room();
  // As /dev/stdout is.
  const std::string output = link_to("/proc/self/fd/1", folder.path("stdout.svg"));
  const std::string file = folder.write("file", "before\n");
  const Outcome outcome = run_program(writing_to(output), "", ">>'" + file + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(bytes_of_file(file), "before\n" + picture);
  EXPECT_THAT(outcome.error, HasSubstr("1 room: 8 objects"));
  // As what a shell gives for >(command) is.
  const std::string fifth = link_to("/proc/self/fd/5", folder.path("fifth.svg"));
  const Outcome piped = run_program(writing_to(fifth), "", "5>&1 >/dev/null");
  EXPECT_EQ(piped.out, picture) << piped.error;
  EXPECT_TRUE(std::filesystem::is_symlink(output) && std::filesystem::is_symlink(fifth));
}

TEST(CliOutput, ANumberThatIsNotOpenIsRefused) {
  const ScratchFolder folder;
  const std::string path = link_to("/proc/self/fd/99", folder.path("a.svg"));
  EXPECT_THAT(refusal_of(writing_to(path)), HasSubstr(path + ": cannot be written: Bad file descriptor"));
}

TEST(CliOutput, TwoOutputsAreTwoFiles) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.csv");
  EXPECT_THAT(refusal_of(with(one_room, {"--out", path, "--svg", path})),
              AllOf(HasSubstr("--out " + path), HasSubstr("--svg " + path), HasSubstr("give two")));
  EXPECT_THAT(refusal_of(with(one_room, {"--out", "-", "--svg", "-"})), HasSubstr("give two"));
  const std::string output = link_to("/proc/self/fd/1", folder.path("stdout.svg"));
  EXPECT_THAT(refusal_of(with(one_room, {"--out", "-", "--svg", output})), HasSubstr("give two"));
  EXPECT_THAT(names_in(folder), testing::ElementsAre("stdout.svg"));
}

TEST(CliOutput, NobodyWhoReadsIsAnErrorThatLeavesNoOtherFile) {
  const ScratchFolder folder;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  close(ends[0]);
  const Outcome outcome =
      run_program(with(one_room, {"--out", "-", "--svg", folder.path("a.svg")}), "", ">&" + std::to_string(ends[1]));
  close(ends[1]);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("shaftcull: standard output cannot be written: Broken pipe"));
  EXPECT_THAT(names_in(folder), testing::IsEmpty());
}

/// Whatever writes to standard output.
const std::vector<std::vector<std::string>> writers{{"--help"},
                                                    {"--version"},
                                                    {"draw", "--help"},
                                                    {"draw"},
                                                    {"draw", "--size", "400"},
                                                    {"draw", "--svg"},
                                                    {"stats", "--shafts", "1"},
                                                    {"verify", "--cases", "100"},
                                                    {"hash", "--quick", "--family", "solids"},
                                                    {"sees", "--rooms", "1", "--patches", "4"},
                                                    {"demo", "--bounds", "100", "--frames", "1"}};

TEST(CliOutput, ThatCannotBeWrittenIsAnError) {
  for (const std::vector<std::string>& arguments : writers) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Outcome full = run_program(arguments, "", ">/dev/full");
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.error, HasSubstr("shaftcull: standard output cannot be written"));
    const Outcome closed = run_program(arguments, "", ">&-");
    EXPECT_EQ(closed.exit_code, 1);
    EXPECT_THAT(closed.error, HasSubstr("shaftcull: standard output cannot be written"));
  }
}

TEST(CliOutput, ErrorsThatNobodyCanReadKeepTheirExitCode) {
  EXPECT_EQ(run_program({"fly"}, "", "2>/dev/full").exit_code, 2);
  EXPECT_EQ(run_program({"draw"}, "SHAFTCULL_ISA=mmx", "2>/dev/full").exit_code, 0);
  EXPECT_EQ(run_program({"demo", "--bounds", "100", "--frames", "1"}, "", "2>/dev/full").exit_code, 0);
}

}  // namespace
}  // namespace shaftcull::test
