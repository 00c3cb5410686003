// SPDX-License-Identifier: MIT
/// `shaftcull bench-report`, from outside, on a stored summary of a run (cli/summary.json).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string stored() { return content_of(SHAFTCULL_STORED_SUMMARY); }

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

Outcome report(const ScratchFolder& scratch, const std::string& summary, const std::string& environment = "") {
  return run_program({"bench-report", "--in", scratch.write("in.json", summary), "--out", scratch.path("out.html")},
                     environment);
}

/// Expects a refusal in one line that holds `words`, and no page.
void expect_refusal(const std::string& summary, const std::string& words, const std::string& environment = "") {
  SCOPED_TRACE(words);
  const ScratchFolder scratch;
  const Outcome outcome = report(scratch, summary, environment);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(lines(outcome.error), SizeIs(1)) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr(words));
  EXPECT_THAT(outcome.error, Not(HasSubstr("json.exception")));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(scratch.path("out.html")));
}

/// The page for a summary.
class BenchReportPage : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no gnuplot here";
  }
  static std::string page_of(const std::string& summary) {
    const ScratchFolder scratch;
    const Outcome outcome = report(scratch, summary);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return content_of(scratch.path("out.html"));
  }
};

TEST_F(BenchReportPage, HasEveryPlotAndTable) {
  const std::string page = page_of(stored());
  EXPECT_EQ(occurrences(page, "<svg "), 7U);
  EXPECT_EQ(occurrences(page, "</svg>"), 7U);
  for (const char* title :
       {"Tests a second, by instruction set and form", "Times as fast as the paper's method", "By number of boxes",
        "By number of shafts", "By number of threads", "Share of what the machine allows", "Roofline",
        "Figures and targets", "What limits each path", "Machine"}) {
    EXPECT_THAT(page, HasSubstr(title));
  }
  EXPECT_THAT(page, Not(HasSubstr("Not measured in this run")));
}

TEST_F(BenchReportPage, NeedsNoOtherFile) {
  const std::string page = page_of(stored());
  for (const char* reference : {"<link", "<script", "src=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(reference)));
}

TEST_F(BenchReportPage, TakesItsColoursFromThePage) {
  // Whatever gnuplot draws in one of the page's inks can be told apart in light and dark.
  const std::string page = page_of(stored());
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(page, HasSubstr("='var(--ink-6)'"));
  EXPECT_THAT(page, Not(HasSubstr("rgb(")));
}

TEST_F(BenchReportPage, GivesNamesOnce) {
  const std::string page = page_of(stored());
  EXPECT_EQ(occurrences(page, "id='plot0-gpPt7'"), 1U);
  EXPECT_EQ(occurrences(page, "id='plot1-gpPt7'"), 1U);
  EXPECT_THAT(page, Not(HasSubstr("id='gp")));
}

TEST_F(BenchReportPage, ShowsTheFiguresOfTheRun) {
  const json summary = json::parse(stored());
  const std::string page = page_of(summary.dump());
  EXPECT_THAT(page, HasSubstr("<td>small/one_shaft_64_boxes/avx2</td><td>time</td>"));
  EXPECT_THAT(page, HasSubstr("not measured"));  // the stored run lacks the figure of its first target
}

TEST_F(BenchReportPage, ShowsHowMuchOfATargetWasReached) {
  json summary = json::parse(stored());
  summary["reach"] = {{{"row", "a"},
                       {"against", "b"},
                       {"value", 0.9},
                       {"target", 1.0},
                       {"unit", "x"},
                       {"bound", "least"},
                       {"met", false}},
                      {{"row", "c"},
                       {"against", "d"},
                       {"value", 1.5},
                       {"target", 1.2},
                       {"unit", "x"},
                       {"bound", "most"},
                       {"met", false}},
                      {{"row", "e"},
                       {"against", nullptr},
                       {"value", 50.0},
                       {"target", 60.0},
                       {"unit", "ns"},
                       {"bound", "most"},
                       {"met", true}},
                      {{"row", "f"},
                       {"against", "g"},
                       {"value", nullptr},
                       {"target", 2.0},
                       {"unit", "x"},
                       {"bound", "least"},
                       {"met", false}}};
  const std::string page = page_of(summary.dump());
  EXPECT_THAT(page, HasSubstr(">0.90 ×</td><td class=\"n\">≥ 1.00 ×</td><td class=\"n below\">90 %<"));
  EXPECT_THAT(page, HasSubstr(">1.50 ×</td><td class=\"n\">≤ 1.20 ×</td><td class=\"n below\">80 %<"));
  EXPECT_THAT(page, HasSubstr(">50.0 ns</td><td class=\"n\">≤ 60.0 ns</td><td class=\"n met\">✓ 120 %<"));
  EXPECT_THAT(page, HasSubstr("not measured"));
  EXPECT_THAT(page,
              HasSubstr("<b>1 of 3</b><span>figures of this run reach their target, the others 90 % of it (median)"));
}

TEST_F(BenchReportPage, DoesNotCallABusyMachineAFailure) {
  json summary = json::parse(stored());
  summary["machine"]["load"] = 5.25;
  const std::string page = page_of(summary.dump());
  EXPECT_THAT(page, AllOf(HasSubstr("measure again when it is idle"),
                          HasSubstr("Load average when measuring began: 5.2, on 2 threads.")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("missed")), Not(HasSubstr("failed"))));
}

TEST_F(BenchReportPage, HasTooltipsForReaders) {
  const std::string page = page_of(stored());
  EXPECT_THAT(page, HasSubstr("<title>boxes, cull, slab, AVX-512: 5.82 G</title>"));
  EXPECT_THAT(page, HasSubstr("<title>boxes, cull, slab, AVX-512: 46 ×</title>"));
  EXPECT_THAT(page, HasSubstr("<title>64 shafts, AVX2: up to "));
  EXPECT_THAT(page, HasSubstr(" tests a second with 1024 shafts</title>"));
  for (const char* raw : {"using", "every", "gnuplot", "NaN", "$curve", "$points"}) {
    SCOPED_TRACE(raw);
    const std::regex title(std::string("<title>[^<]*") + (raw[0] == '$' ? "[$]" + std::string(raw + 1) : raw));
    EXPECT_FALSE(std::regex_search(page, title));
  }
}

/// A text of a picture, roughly: across is where it begins and how long it is, along its direction.
struct Label {
  std::string text;
  double across;
  double down;
  double length;
  bool rotated;
};

std::vector<Label> labels_of(const std::string& svg) {
  const std::regex pattern(
      "translate\\(([-0-9.]+),([-0-9.]+)\\)( "
      "rotate\\(([-0-9.]+)\\))?\"[^>]*text-anchor=\"([a-z]+)\">\\s*<text>([^<]*)");
  std::vector<Label> labels;
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at) {
    const std::smatch& match = *at;
    const bool rotated = match[3].matched;
    const double angle = rotated ? std::stod(match[4]) * std::numbers::pi / 180 : 0;
    const double x = std::stod(match[1]);
    const double y = std::stod(match[2]);
    const std::string text = match[6];
    constexpr double character_width = 6.5;
    const double length = character_width * static_cast<double>(std::count_if(
                                                text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
    const double shift = match[5] == "end" ? length : match[5] == "middle" ? length / 2 : 0;
    labels.push_back({text, x * std::cos(angle) + y * std::sin(angle) - shift,
                      y * std::cos(angle) - x * std::sin(angle), length, rotated});
  }
  return labels;
}

TEST_F(BenchReportPage, HasNoLabelOverAnother) {
  // Figures that lie close together: instruction sets in the dot plots, caches and kinds of arithmetic on the roofline.
  json summary = json::parse(stored());
  json& results = summary.at("results");
  const std::vector<std::pair<std::string, double>> isas{
      {"scalar", 0.5}, {"sse4_2", 4.6}, {"avx2", 5.6}, {"avx512", 5.7}};
  for (auto& [name, result] : results.items()) {
    for (const auto& [isa, speed] : isas) {
      if (name.starts_with("test/") && name.ends_with(isa)) result = {{"per_s", speed * 1e9}, {"vs_paper", speed * 10}};
    }
  }
  for (const auto& [isa, speed] : isas) {
    results["roofline/slab_arithmetic/" + isa] = {{"per_s", speed * 1e9}, {"vs_paper", nullptr}};
    results["roofline/grid_arithmetic/" + isa] = {{"per_s", speed * 1.1e9}, {"vs_paper", nullptr}};
    for (const auto& [level, bandwidth] :
         std::vector<std::pair<std::string, double>>{{"l1", 230e9}, {"l2", 200e9}, {"l3", 60e9}, {"dram", 30e9}}) {
      results["roofline/read_" + level + "_bytes/" + isa] = {{"per_s", bandwidth}, {"vs_paper", nullptr}};
    }
  }
  const std::string page = page_of(summary.dump());
  std::size_t pictures = 0;
  for (std::size_t begin = 0; (begin = page.find("<svg ", begin)) != std::string::npos; ++pictures) {
    const std::size_t end = page.find("</svg>", begin);
    const std::vector<Label> labels = labels_of(page.substr(begin, end - begin));
    EXPECT_GT(labels.size(), 5U);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Label& a = labels[i];
        const Label& b = labels[j];
        if (a.rotated != b.rotated || std::abs(a.down - b.down) > 10) continue;
        EXPECT_FALSE(a.across < b.across + b.length && b.across < a.across + a.length)
            << "'" << a.text << "' and '" << b.text << "' in picture " << pictures;
      }
    }
    begin = end;
  }
  EXPECT_EQ(pictures, 7U);
}

TEST_F(BenchReportPage, TreatsNamesAsText) {
  const std::string page = page_of(stored());
  EXPECT_THAT(page, AllOf(HasSubstr("Made-up &lt;Processor&gt; &amp; Co."), Not(HasSubstr("<Processor>"))));
}

TEST_F(BenchReportPage, SaysWhatAPartialRunLacks) {
  json summary = json::parse(stored());
  json& results = summary.at("results");
  for (auto it = results.begin(); it != results.end();)
    it = it.key().starts_with("sweep/") ? results.erase(it) : std::next(it);
  const std::string page = page_of(summary.dump());
  EXPECT_EQ(occurrences(page, "<svg "), 4U);
  EXPECT_THAT(
      page,
      HasSubstr(
          "Not measured in this run, and not shown: by number of boxes, by number of shafts, by number of threads."));
}

/// The number of the line that `part` is on.
std::string line_of(const std::string& text, const std::string& part) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return "line " + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": ";
}

TEST(BenchReport, RefusesWhatIsNotASummary) {
  expect_refusal("", "empty");
  expect_refusal("speed!", "line 1: not JSON");
  expect_refusal("{\n\"machine\": {\n\"cpu\" 7}}", "line 3: not JSON");
  expect_refusal("{\n\"machine\": 1e999\n}", "line 2: a number is too large");
  expect_refusal("[]", "line 1: the whole is a list, not an object");
  expect_refusal("{}", "line 1: the whole lacks 'machine'");
}

TEST(BenchReport, SaysWhereATextWasCut) {
  const std::string half = stored().substr(0, stored().size() / 2);
  const auto lines_before = 1 + std::count(half.begin(), half.end(), '\n');
  expect_refusal(half, "line " + std::to_string(lines_before) + ": cut short");
}

TEST(BenchReport, NamesThePartThatASummaryLacks) {
  for (const char* part : {"machine", "run", "results", "reach", "limits"}) {
    json summary = json::parse(stored());
    summary.erase(part);
    expect_refusal(summary.dump(), std::string("line 1: the whole lacks '") + part + "'");
  }
}

TEST(BenchReport, NamesTheLineOfWhatAPartLacks) {
  json summary = json::parse(stored());
  summary["machine"].erase("cpu");
  std::string text = summary.dump(2);
  expect_refusal(text, line_of(text, "\"machine\"") + "machine lacks 'cpu'");

  summary = json::parse(stored());
  summary["results"]["form/batch"].erase("per_s");
  text = summary.dump(2);
  expect_refusal(text, line_of(text, "\"form/batch\": {") + "results/form/batch lacks 'per_s'");

  summary = json::parse(stored());
  summary["limits"][1]["ceilings"][0].erase("what");
  text = summary.dump();
  text.insert(text.find("{\"by\":\"memory/read/avx512\""), "\n\n");
  expect_refusal(text, "line 3: limits/1/ceilings/0 lacks 'what'");
}

TEST(BenchReport, RefusesFiguresThatCannotBe) {
  json summary = json::parse(stored());
  summary["results"]["form/batch"]["per_s"] = "fast";
  expect_refusal(summary.dump(), "line 1: results/form/batch/per_s is \"fast\", not a number");
  summary["results"]["form/batch"]["per_s"] = 0;
  expect_refusal(summary.dump(), "results/form/batch/per_s is 0; it should be above 0");
  summary["results"]["form/batch"]["per_s"] = {{"a", 1}};
  expect_refusal(summary.dump(), "results/form/batch/per_s is an object, not a number");
  summary["results"] = json::object();
  expect_refusal(summary.dump(), "results is empty");
  summary = json::parse(stored());
  summary["machine"]["cores"] = -1;
  expect_refusal(summary.dump(), "machine/cores is -1; it should be a count");
  summary["machine"]["cores"] = 1;
  summary["run"]["quick"] = "yes";
  expect_refusal(summary.dump(), "run/quick is \"yes\", not true or false");
}

TEST(BenchReport, RefusesAFileThatIsNotThere) {
  const Outcome outcome = run_program({"bench-report", "--in", "/no/such/summary.json"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(lines(outcome.error), SizeIs(1)) << outcome.error;
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("/no/such/summary.json"), HasSubstr("./cmake/run bench")));
}

TEST(BenchReport, SaysThatGnuplotIsMissing) { expect_refusal(stored(), "gnuplot-nox", "PATH=/no/such/folder"); }

TEST_F(BenchReportPage, IsRefusedWhereItCannotBeWritten) {
  const ScratchFolder scratch;
  const Outcome outcome = run_program({"bench-report", "--in", scratch.write("in.json", stored()), "--out",
                                       scratch.write("file", "") + "/report.html"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(lines(outcome.error), SizeIs(1)) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr(scratch.path("file/report.html: cannot be written: Not a directory")));
}

TEST_F(BenchReportPage, GoesToStandardOutputAloneForAMinus) {
  const ScratchFolder scratch;
  const std::string in = scratch.write("in.json", stored());
  const Outcome outcome = run_program({"bench-report", "--in", in, "--out", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.out, page_of(stored()));
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST_F(BenchReportPage, IsWrittenIntoADevice) {
  const ScratchFolder scratch;
  const std::string in = scratch.write("in.json", stored());
  const std::string full = scratch.path("full.html");
  std::filesystem::create_symlink("/dev/full", full);
  const Outcome outcome = run_program({"bench-report", "--in", in, "--out", full});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr(full + ": cannot be written: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_character_file(full));
}

}  // namespace
}  // namespace shaftcull::test
