// SPDX-License-Identifier: MIT
/// What of `shaftcull sees` needs other programs, limits and signals of POSIX systems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/running_program.hpp"

namespace shaftcull::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

// Reads a file as docs/program.md says, checks that its arrays fit together, and prints how many pairs there are of
// each kind.
constexpr const char* reader = R"(
import json, sys, zipfile
import numpy
assert zipfile.ZipFile(sys.argv[1]).testzip() is None
z = numpy.load(sys.argv[1])
order, blocks, undecided = z['order'], z['blocks'], z['undecided']
first, candidates, seen, rays = z['first_candidate'], z['candidates'], z['seen'], z['rays'][0]
patches, occluders = len(z['patch_boxes']), len(z['occluder_boxes'])
assert sorted(order) == list(range(patches))
dense = numpy.zeros((patches, patches), int)
answer = numpy.zeros((patches, patches), int)
for a, count_a, b, count_b, sight in blocks:
    rows, columns = order[a:a + count_a], order[b:b + count_b]
    dense[numpy.ix_(rows, columns)] += 1
    answer[numpy.ix_(rows, columns)] = sight
    if (a, count_a) != (b, count_b):
        dense[numpy.ix_(columns, rows)] += 1
        answer[numpy.ix_(columns, rows)] = sight
for a, b in undecided:
    dense[a, b] += 1
    dense[b, a] += 1
numpy.fill_diagonal(dense, 1)
assert (dense == 1).all()
numpy.fill_diagonal(answer, 9)
assert first[0] == 0 and first[-1] == len(candidates) and (first[1:] > first[:-1]).all()
assert len(first) == len(undecided) + 1 and len(seen) == len(undecided)
assert candidates.max() < occluders and seen.max() <= rays
assert z['patch_planes'].shape == (patches, 4) and z['patch_objects'].max() == z['occluder_objects'].max()
corners, boxes = z['patch_corners'], z['patch_boxes']
assert (corners.min(axis=1) >= boxes[:, 0]).all() and (corners.max(axis=1) <= boxes[:, 1]).all()
print(json.dumps({'all': patches * (patches - 1) // 2, 'clear': int((answer == 1).sum() // 2),
                  'occluded': int((answer == 2).sum() // 2), 'facing_away': int((answer == 3).sum() // 2),
                  'undecided': len(undecided), 'rays_visible': int((seen == rays).sum()),
                  'rays_partly': int(((seen > 0) & (seen < rays)).sum()), 'rays_hidden': int((seen == 0).sum())}))
)";

std::string output_of_command(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

TEST(CliSees, NumPyReadsWhatWasPrinted) {
  if (std::system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no NumPy";
  const ScratchFolder folder;
  const std::string path = folder.path("sights.npz");
  const Json report = Json::parse(output_of(with(report_of_one_room, {"--rays", "4", "--candidates", "--out", path})));
  const std::string script = folder.write("reader.py", reader);
  const std::string counts = output_of_command("/usr/bin/python3 '" + script + "' '" + path + "' 2>&1");
  ASSERT_THAT(counts, testing::StartsWith("{"));
  EXPECT_EQ(Json::parse(counts), report["pairs"]);
}

TEST(CliSees, AFullDiskIsAnErrorThatLeavesNoFile) {
  const ScratchFolder folder;
  for (const char* name : {"sights.npz", "sights.csv", "picture.svg"}) {
    const std::string path = folder.path(name);
    const std::string option = path.ends_with(".svg") ? "--svg" : "--out";
    const Outcome outcome = run_program(with(report_of_one_room, {option, path}), "trap '' XFSZ; ulimit -f 8;");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("shaftcull: " + path + ": cannot be written: "));
    EXPECT_EQ(files_in(folder.path("")), 0) << path;
  }
}

TEST(CliSees, AnInterruptLeavesNoFile) {
  const ScratchFolder folder;
  for (const char* rays : {"1", "60000"}) {
    RunningProgram program({"sees", "--rooms", "16", "--patches", "0.3", "--rays", rays, "--out",
                            folder.path("sights.npz"), "--svg", folder.path("picture.svg")});
    ASSERT_TRUE(program.wait_for(" pairs\n"));
    program.send(SIGINT);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr("shaftcull: sees: interrupted after "));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files_in(folder.path("")), 0);
  }
}

}  // namespace
}  // namespace shaftcull::test
