// SPDX-License-Identifier: MIT
/// `shaftcull stats`: the paper's statistics over random shafts.
///
/// Shafts and the cubes that they meet are those of the test harness that the paper describes (random_shafts.hpp). Both
/// boxes of a shaft are stretched so that the shaft box is the unit cube. Then it fills the grid, and no cube is
/// trivially outside; the same shafts before stretching tell what the shaft box culls.
///
/// The paper knows shafts between two boxes, and what is outside or inside of them. Of other kinds, of open contact, of
/// triangles and of what blocks, the library's answers are counted (answer_count.hpp).
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "answer_count.hpp"
#include "instruction_set.hpp"
#include "number.hpp"
#include "plane_count.hpp"
#include "random_shafts.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/paper.hpp"
#include "subcommand.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

struct StatsOptions {
  RandomShafts shafts;
  ShaftChoice choice;
  bool solid = false;
  bool triangles = false;
  InstructionSet isa;
};

/// The pair with its shaft box stretched to the unit cube. Equal coordinates stay equal.
BoxPair stretched(BoxPair pair) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float lo = std::min(pair.a.lo[axis], pair.b.lo[axis]);
    const float length = std::max(pair.a.hi[axis], pair.b.hi[axis]) - lo;
    if (length == 0) continue;
    for (float* x : {&pair.a.lo[axis], &pair.a.hi[axis], &pair.b.lo[axis], &pair.b.hi[axis]}) *x = (*x - lo) / length;
  }
  return pair;
}

struct Statistics {
  std::array<std::uint64_t, max_joining_planes + 1> histogram{};
  PlaneCount stretched;
  PlaneCount as_drawn;
};

Statistics gather(const StatsOptions& options) {
  const std::vector<Box> cubes = grid_of_cubes(options.shafts);
  std::mt19937_64 random(options.shafts.seed);
  Statistics statistics;
  for (std::uint32_t i = 0; i < options.shafts.count; ++i) {
    const BoxPair drawn = random_pair(random);
    const BoxPair filling = stretched(drawn);
    statistics.as_drawn.add(drawn.a, drawn.b, cubes);
    ++statistics.histogram[statistics.stretched.add(filling.a, filling.b, cubes)];
  }
  return statistics;
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string mean(std::uint64_t sum, std::uint64_t count) {
  return count == 0 ? "-" : fmt::format("{:.2f}", static_cast<double>(sum) / static_cast<double>(count));
}

void print_histogram(const Statistics& statistics, std::uint32_t shafts) {
  std::uint64_t planes = 0;
  for (std::size_t n = 0; n < statistics.histogram.size(); ++n) planes += n * statistics.histogram[n];
  fmt::print("Joining planes per shaft: {} on average\n\n", mean(planes, shafts));
  Table table({"planes", "shafts", "share"});
  for (std::size_t n = 0; n < statistics.histogram.size(); ++n) {
    table.add_row({fmt::format("{}", n), grouped(statistics.histogram[n]), percent(statistics.histogram[n], shafts)});
  }
  fmt::print("{}\n", table.text());
}

void print_plane_tests(const PlaneCount& count) {
  fmt::print("Plane tests per bound, for bounds that the shaft box does not decide\n\n");
  Table table({"order of planes", "outside", "inside"});
  constexpr std::array<const char*, plane_orders.size()> names{"unsorted", "by volume", "by added volume"};
  for (std::size_t order = 0; order < plane_orders.size(); ++order) {
    table.add_row({names[order], mean(count.outside_plane_tests[order], count.outside_tests),
                   mean(count.inside_plane_tests[order], count.inside_tests)});
  }
  fmt::print("{}\n", table.text());
}

void print_answers(const Statistics& statistics) {
  fmt::print("Answers for the bounds\n\n");
  Table table({"shafts", "culled by box", "culled by planes", "kept", "of these inside"});
  const auto add = [&](const char* what, const PlaneCount& count) {
    table.add_row({what, percent(count.bounds - count.outside_tests, count.bounds),
                   percent(count.culled_by_planes, count.bounds),
                   percent(count.outside_tests - count.culled_by_planes, count.bounds),
                   percent(count.inside, count.outside_tests - count.culled_by_planes)});
  };
  add("stretched to the cube", statistics.stretched);
  add("as drawn", statistics.as_drawn);
  fmt::print("{}", table.text());
}

void add_row(Table& table, std::string row, const AnswerCount& count) {
  table.add_row({std::move(row), percent(count.outside, count.bounds), percent(count.touching, count.outside),
                 percent(count.bounds - count.outside - count.inside, count.bounds),
                 percent(count.inside, count.bounds)});
}

void print_answers(const StatsOptions& options) {
  const std::string kind(name(options.choice.kind()));
  Table table({"shafts", "outside", "of these touching", "overlap", "inside"});
  if (options.triangles) {
    add_row(table, kind + ", by vertices", count_triangles(options.shafts, options.choice, TriangleTest::vertices));
    add_row(table, kind + ", exact", count_triangles(options.shafts, options.choice, TriangleTest::exact));
  } else {
    add_row(table, kind, count_cubes(options.shafts, options.choice));
  }
  fmt::print("Answers for the {}\n\n{}", options.triangles ? "triangles" : "bounds", table.text());
}

void print_blocking(const StatsOptions& options) {
  const OcclusionCount count = count_blocking(options.shafts, options.choice);
  Table table({"number of", "by any cube", "share", "by one around no end", "share"});
  const auto add = [&](const char* what, const OcclusionSum& sum) {
    table.add_row({what, grouped(sum.by_any), percent(sum.by_any, sum.all), grouped(sum.by_one_between),
                   percent(sum.by_one_between, sum.all)});
  };
  add("cubes that block", count.cubes);
  add("shafts that are occluded", count.shafts);
  fmt::print("\nCubes that hide all of one end from the other\n\n{}", table.text());
}

void run(const StatsOptions& options) {
  options.isa.select();
  const RandomShafts& shafts = options.shafts;
  const bool counts_answers = options.choice.kind() != ShaftKind::between ||
                              options.choice.contact() == Contact::open || shafts.lattice != 0 || options.solid ||
                              options.triangles;
  const char* const contact = options.choice.contact() == Contact::open ? " with open contact"
                              : counts_answers                          ? " with closed contact"
                                                                        : "";
  fmt::print("{} random shafts{}, each against {} {} of half extent {} (seed {})\n\n", grouped(shafts.count), contact,
             grouped(grid_points * grid_points * grid_points), options.triangles ? "triangles in cubes" : "cubes",
             shafts.box_radius, shafts.seed);
  if (counts_answers) {
    print_answers(options);
    if (options.solid) print_blocking(options);
    return;
  }
  const Statistics statistics = gather(options);
  print_histogram(statistics, shafts.count);
  print_plane_tests(statistics.stretched);
  print_answers(statistics);
}

}  // namespace

void add_stats(CLI::App& program) {
  const auto options = std::make_shared<StatsOptions>();
  CLI::App& stats = *program.add_subcommand(
      "stats", "Print the paper's statistics over random shafts, or count the answers of other kinds of shafts");
  add_number(stats, "--shafts", options->shafts.count, 1, 100'000'000, "Number of random shafts (default: 10000)")
      ->type_name("N");
  add_number(stats, "--seed", options->shafts.seed, 0, largest_seed, "Seed of the random shafts (default: 12345)")
      ->type_name("S");
  add_number(stats, "--box-radius", options->shafts.box_radius, 0, 10,
             "Half extent of the cubes that are tested (default: 0.125)")
      ->type_name("R");
  add_number(stats, "--lattice", options->shafts.lattice, 1, 1'000'000,
             "Put corners at multiples of 1/N, and cubes exactly on their grid, so that many touch (default: anywhere)")
      ->type_name("N");
  options->choice.add_options(stats, nullptr);
  CLI::Option* solid =
      stats
          .add_flag("--solid", options->solid,
                    "Treat cubes as solid, and count those that block, that is, hide all of one end from the other")
          ->excludes(stats.get_option("--swept"))
          ->excludes(stats.get_option("--shadow"));
  stats
      .add_flag("--triangles", options->triangles,
                "Test a random triangle in each cube instead of the cube, by its vertices and exactly")
      ->excludes(solid);
  options->isa.add_option(stats);
  stats.footer(
      "A shaft joins two boxes whose corners are uniform in the unit cube. It is stretched so that\n"
      "its box is the unit cube, and tested against cubes on a grid of 21 x 21 x 21 points over\n"
      "the unit cube. \"outside\" counts the plane tests until a bound is found to be outside, for\n"
      "all bounds that meet the shaft box. \"inside\" counts the plane tests until a bound is\n"
      "found not to be inside, for all bounds inside the shaft box that are not outside the shaft.\n"
      "With --swept, --shadow, --contact open, --lattice, --solid or --triangles, shafts are\n"
      "formed of two random boxes, or of one, and are not stretched; lights and occluders do not\n"
      "touch. The answers outside, overlap and inside are counted.\n"
      "A cube blocks a shaft if every segment between the two ends passes through the cube. A cube\n"
      "around an end does so, too, so cubes around no end are also counted separately.");
  stats.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
