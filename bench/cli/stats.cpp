/// `shaftcull stats`: the paper's statistics over random shafts.
///
/// The distribution is that of the test harness that the paper describes. A shaft joins two boxes whose corners are
/// uniform in the unit cube; both are then stretched so that the shaft box is the unit cube. Every shaft meets
/// cubes of half extent `radius` centred on a grid of 21³ points that spans the unit cube, shifted by 0.001 so that no
/// centre is on a face. With a shaft box that fills the grid no cube is trivially outside; the same shafts before
/// stretching tell what the shaft box culls.
///
/// The paper knows shafts between two boxes. Of other kinds, and of open contact, the library's answers are counted.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "instruction_set.hpp"
#include "number.hpp"
#include "plane_count.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/streams.hpp"
#include "subcommand.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

struct StatsOptions {
  std::uint32_t shafts = 10'000;
  std::uint64_t seed = 12345;
  double box_radius = 0.125;
  std::uint32_t lattice = 0;  ///< corners are multiples of 1 / lattice; 0: anywhere
  ShaftChoice choice;
  InstructionSet isa;
};

constexpr int grid_points = 21;
constexpr double grid_shift = 0.001;

std::vector<Box> grid_of_cubes(double radius, double shift) {
  std::vector<Box> cubes;
  cubes.reserve(grid_points * grid_points * grid_points);
  const auto at = [=](int i) { return i / (grid_points - 1.0) + shift; };
  for (int z = 0; z < grid_points; ++z) {
    for (int y = 0; y < grid_points; ++y) {
      for (int x = 0; x < grid_points; ++x) {
        const std::array centre{at(x), at(y), at(z)};
        Box cube{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          cube.lo[axis] = static_cast<float>(centre[axis] - radius);
          cube.hi[axis] = static_cast<float>(centre[axis] + radius);
        }
        cubes.push_back(cube);
      }
    }
  }
  return cubes;
}

struct BoxPair {
  Box a;
  Box b;
};

/// Uniform in [0, 1), with 24 bits: the same numbers with every standard library.
float uniform(std::mt19937_64& random) { return static_cast<float>(random() >> 40) * 0x1p-24F; }

BoxPair random_pair(std::mt19937_64& random) {
  BoxPair pair{};
  for (Box* box : {&pair.a, &pair.b}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float p = uniform(random);
      const float q = uniform(random);
      box->lo[axis] = std::min(p, q);
      box->hi[axis] = std::max(p, q);
    }
  }
  return pair;
}

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
  const std::vector<Box> cubes = grid_of_cubes(options.box_radius, grid_shift);
  std::mt19937_64 random(options.seed);
  Statistics statistics;
  for (std::uint32_t i = 0; i < options.shafts; ++i) {
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
  fmt::print("Plane tests per bound, of bounds that the shaft box does not decide\n\n");
  Table table({"order of planes", "outside", "inside"});
  constexpr std::array<const char*, plane_orders.size()> names{"unsorted", "by volume", "by added volume"};
  for (std::size_t order = 0; order < plane_orders.size(); ++order) {
    table.add_row({names[order], mean(count.outside_plane_tests[order], count.outside_tests),
                   mean(count.inside_plane_tests[order], count.inside_tests)});
  }
  fmt::print("{}\n", table.text());
}

void print_answers(const Statistics& statistics) {
  fmt::print("What becomes of the bounds\n\n");
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

/// What the library answers of the cubes.
struct AnswerCount {
  std::uint64_t bounds = 0;
  std::uint64_t outside = 0;
  std::uint64_t touching = 0;  ///< outside with the contact that was asked for, but not with closed contact
  std::uint64_t inside = 0;
};

std::uint64_t bits_in(std::span<const std::uint64_t> words) {
  return std::accumulate(words.begin(), words.end(), std::uint64_t{0}, [](std::uint64_t sum, std::uint64_t word) {
    return sum + static_cast<std::uint64_t>(std::popcount(word));
  });
}

/// The next pair whose shaft there is: those of shadows are apart.
BoxPair next_pair(const StatsOptions& options, std::mt19937_64& random) {
  for (;;) {
    BoxPair pair = random_pair(random);
    if (options.lattice != 0) {
      for (Vec3* const corner : {&pair.a.lo, &pair.a.hi, &pair.b.lo, &pair.b.hi}) {
        for (float& x : *corner) x = static_cast<float>(std::round(x * 1.0 * options.lattice) / options.lattice);
      }
    }
    if (options.choice.kind() != ShaftKind::shadow || !touch(pair.a, pair.b)) return pair;
  }
}

AnswerCount count_answers(const StatsOptions& options) {
  const BoxStream cubes(grid_of_cubes(options.box_radius, options.lattice == 0 ? grid_shift : 0));
  std::mt19937_64 random(options.seed);
  std::vector<std::uint64_t> kept(words_for(cubes.size()));
  std::vector<std::uint64_t> inside(kept.size());
  AnswerCount count;
  for (std::uint32_t i = 0; i < options.shafts; ++i) {
    const BoxPair pair = next_pair(options, random);
    const FormedShaft shaft = options.choice.form(pair.a, pair.b);
    classify(shaft.compiled(), cubes, kept, inside);
    const std::uint64_t kept_count = bits_in(kept);
    count.bounds += cubes.size();
    count.inside += bits_in(inside);
    count.outside += cubes.size() - kept_count;
    if (options.choice.contact() == Contact::open) {
      count.touching +=
          shaftcull::count(options.choice.form(pair.a, pair.b, Contact::closed).compiled(), cubes) - kept_count;
    }
  }
  return count;
}

void print_answers(const StatsOptions& options) {
  const AnswerCount count = count_answers(options);
  Table table({"shafts", "outside", "of these touching", "overlap", "inside"});
  table.add_row({std::string(name(options.choice.kind())), percent(count.outside, count.bounds),
                 percent(count.touching, count.outside),
                 percent(count.bounds - count.outside - count.inside, count.bounds),
                 percent(count.inside, count.bounds)});
  fmt::print("What becomes of the bounds\n\n{}", table.text());
}

void run(const StatsOptions& options) {
  options.isa.select();
  if (options.choice.kind() != ShaftKind::between || options.choice.contact() == Contact::open ||
      options.lattice != 0) {
    fmt::print("{} random shafts with {} contact, each against {} cubes of half extent {} (seed {})\n\n",
               grouped(options.shafts), options.choice.contact() == Contact::open ? "open" : "closed",
               grouped(grid_points * grid_points * grid_points), options.box_radius, options.seed);
    print_answers(options);
    return;
  }
  const Statistics statistics = gather(options);
  fmt::print("{} random shafts, each against {} cubes of half extent {} (seed {})\n\n", grouped(options.shafts),
             grouped(grid_points * grid_points * grid_points), options.box_radius, options.seed);
  print_histogram(statistics, options.shafts);
  print_plane_tests(statistics.stretched);
  print_answers(statistics);
}

}  // namespace

void add_stats(CLI::App& program) {
  const auto options = std::make_shared<StatsOptions>();
  CLI::App& stats = *program.add_subcommand("stats", "Gather the paper's statistics over random shafts");
  add_number(stats, "--shafts", options->shafts, 1, 100'000'000, "How many random shafts (default: 10000)")
      ->type_name("N");
  add_number(stats, "--seed", options->seed, 0, largest_seed, "Seed of the random shafts (default: 12345)")
      ->type_name("S");
  add_number(stats, "--box-radius", options->box_radius, 0, 10,
             "Half extent of the cubes that are tested (default: 0.125)")
      ->type_name("R");
  add_number(stats, "--lattice", options->lattice, 1, 1'000'000,
             "Put corners at multiples of 1/N and cubes on the grid itself, so that many touch (default: anywhere)")
      ->type_name("N");
  options->choice.add_options(stats, nullptr);
  options->isa.add_option(stats);
  stats.footer(
      "A shaft joins two boxes whose corners are uniform in the unit cube, stretched so that the shaft box is the\n"
      "unit cube; it meets cubes on a grid of 21 x 21 x 21 points over the unit cube. \"outside\" counts the plane\n"
      "tests until a bound is found outside, for all bounds that meet the shaft box; \"inside\" those until a bound "
      "is\n"
      "found not inside, for all bounds inside the shaft box that are not outside the shaft.\n"
      "With --swept, --shadow, --contact open or --lattice, shafts are of two random boxes, or one, as they are "
      "drawn;\n"
      "lights and occluders are apart. Then outside, overlap and inside are counted.");
  stats.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
