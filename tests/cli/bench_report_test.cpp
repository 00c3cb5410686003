/// `shaftcull bench-report`, from outside, on a stored summary of a run (cli/summary.json).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

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
        "By number of shafts", "By number of threads", "Share of what the machine allows", "Roofline", "To be reached",
        "What limits each path", "Machine"}) {
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
  std::size_t met = 0;
  for (const json& row : summary.at("reach")) met += row.at("met").get<bool>() ? 1 : 0;
  EXPECT_THAT(page, HasSubstr(std::to_string(met) + " of " + std::to_string(summary.at("reach").size())));
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

TEST(BenchReport, RefusesWhatIsNotASummary) {
  expect_refusal("", "empty");
  expect_refusal("speed!", "not JSON");
  expect_refusal(stored().substr(0, stored().size() / 2), "cut short");
  expect_refusal("[]", "not what shaftcull-bench writes");
  expect_refusal("{}", "machine");
}

TEST(BenchReport, RefusesASummaryThatLacksAPart) {
  for (const char* part : {"machine", "run", "results", "reach", "limits"}) {
    json summary = json::parse(stored());
    summary.erase(part);
    expect_refusal(summary.dump(), part);
  }
}

TEST(BenchReport, RefusesFiguresThatCannotBe) {
  json summary = json::parse(stored());
  summary["results"]["form/batch"]["per_s"] = "fast";
  expect_refusal(summary.dump(), "not what shaftcull-bench writes");
  summary["results"]["form/batch"]["per_s"] = 0;
  expect_refusal(summary.dump(), "form/batch has the speed 0");
  summary["results"] = json::object();
  expect_refusal(summary.dump(), "there are no results");
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
  EXPECT_THAT(outcome.error, HasSubstr("--out"));
}

}  // namespace
}  // namespace shaftcull::test
