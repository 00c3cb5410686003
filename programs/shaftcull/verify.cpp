// SPDX-License-Identifier: MIT
/// `shaftcull verify`: compares answers with exact arithmetic, by the million.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "number.hpp"
#include "progress.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "trial/sight_trial.hpp"
#include "trial/trial.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct VerifyOptions {
  std::uint64_t cases = 1'000'000;
  std::uint64_t seed = 1;
  std::vector<std::string> isas;
  int threads = 0;
};

/// Trials in memory at once, of the first batch and at most, and those that a thread takes at a time. The first batches
/// are small so that there is soon something to show.
constexpr std::size_t first_batch_trials = 256;
constexpr std::size_t most_batch_trials = 4096;
constexpr std::size_t chunk_trials = 32;

/// For so many cases there is one scene of patches, all pairs of which are asked about.
constexpr std::uint64_t cases_per_scene = 4096;

/// Reproducers that are printed; later failures are only counted.
constexpr std::uint64_t most_reproducers = 20;

class Verification {
 public:
  explicit Verification(const VerifyOptions& options) : options_(options), isas_(instruction_sets(options.isas)) {}

  /// An interrupt gives up the batch of that moment: its cases do not count, but wrong answers found in it do.
  void run() {
    const Workers workers(options_.threads);
    progress_.milestone(
        fmt::format("{} cases (seed {}) on:{}", grouped(options_.cases), options_.seed, names_of(isas_)));
    workers.run([&] {
      while (compared_ < options_.cases && interrupt_.signal() == 0) {
        run_batch();
        look_at_pairs();
        show_progress();
      }
    });
  }

  [[nodiscard]] std::uint64_t wrong() const noexcept { return wrong_; }
  [[nodiscard]] std::uint64_t compared() const noexcept { return compared_; }
  /// The signal that ended it early, or 0.
  [[nodiscard]] int interrupted() const noexcept { return compared_ < options_.cases ? interrupt_.signal() : 0; }

  void print_summary() const {
    Table table({"subject", "cases", "outside", "inside", "blocking", "undecided, slab", "undecided, planes",
                 "on the boundary", "wrong"});
    TrialCounts sum;
    const auto add_row = [&](const std::string& what, const TrialCounts& counts) {
      const auto share = [&](std::uint64_t part) {
        return counts.bounds == 0
                   ? "-"
                   : fmt::format("{:.3f} %", 100.0 * static_cast<double>(part) / static_cast<double>(counts.bounds));
      };
      table.add_row({what, grouped(counts.bounds), share(counts.outside), share(counts.inside), share(counts.blocking),
                     share(counts.undecided_slab), share(counts.undecided_planes), share(counts.touching),
                     grouped(counts.wrong)});
    };
    for (std::size_t subject = 0; subject != Trial::subjects; ++subject) {
      for (const bool spheres : {false, true}) {
        const TrialCounts& counts = counts_[spheres][subject];
        add_row(fmt::format("{}: {}", spheres ? "spheres" : "boxes", Trial::subject_name(subject)), counts);
        sum += counts;
      }
    }
    add_row("all", sum);
    fmt::print("{}\n", table.text());
    fmt::print("{} cases (seed {}), each in slab and plane form on:{}\n", grouped(sum.bounds), options_.seed,
               names_of(isas_));
    fmt::print("Undecided by the float filter: {} in slab form, {} in plane form\n", grouped(sum.undecided_slab),
               grouped(sum.undecided_planes));
    fmt::print(
        "Right answers from rational arithmetic: {}, {} of them exactly on the boundary; all others proven in interval "
        "arithmetic\n",
        grouped(sum.by_rationals), grouped(sum.touching));
    fmt::print("Visibility: {} pairs of patches in {} scenes, all right answers from exact integers\n", grouped(pairs_),
               grouped(scenes_));
    fmt::print("Wrong answers: {}   ({:.0f} s, {} cases/s)\n", grouped(wrong_), seconds(),
               prefixed(static_cast<double>(sum.bounds) / seconds()));
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  void run_batch() {
    // What each trial is depends on its number alone, so threads may take them in any order.
    struct Place {
      std::uint64_t number;
      std::size_t bounds;
    };
    std::vector<Place> places;
    std::uint64_t placed = compared_;
    for (; placed < options_.cases && places.size() != batch_trials_; ++next_) {
      const std::uint64_t left = options_.cases - placed;
      places.push_back({next_, static_cast<std::size_t>(std::min<std::uint64_t>(Trial::natural_size(next_), left))});
      placed += places.back().bounds;
    }
    std::vector<std::vector<Trial>> chunks((places.size() + chunk_trials - 1) / chunk_trials);
    Workers::for_chunks(places.size(), chunk_trials, [&](std::size_t first, std::size_t size) {
      if (interrupt_.signal() != 0) return;
      std::vector<Trial>& chunk = chunks[first / chunk_trials];
      chunk.reserve(size);
      for (const Place& place : std::span(places).subspan(first, size)) {
        chunk.emplace_back(options_.seed, place.number, place.bounds);
      }
    });
    for (const Isa isa : isas_) {
      select_isa(isa);
      Workers::for_chunks(chunks.size(), 1, [&](std::size_t i, std::size_t) {
        if (interrupt_.signal() == 0) Trial::ask(chunks[i]);
      });
    }
    const bool complete = interrupt_.signal() == 0;
    for (const std::vector<Trial>& chunk : chunks) {
      for (const Trial& trial : chunk) {
        if (complete) counts_[trial.has_spheres()][trial.subject()] += trial.counts();
        take_failures(trial);
      }
    }
    if (complete) compared_ = placed;
    batch_trials_ = std::min(2 * batch_trials_, most_batch_trials);
  }

  void take_failures(const Trial& trial) {
    for (const std::string& failure : trial.failures()) report(failure);
    wrong_ += trial.counts().wrong;
  }

  void report(const std::string& failure) {
    if (++reported_ <= most_reproducers) progress_.milestone("WRONG: " + failure);
    if (reported_ == most_reproducers) progress_.milestone("Further reproducers are left out.");
  }

  /// What sees what, in as many scenes as the cases until now ask for.
  void look_at_pairs() {
    const std::uint64_t scenes = (compared_ + cases_per_scene - 1) / cases_per_scene;
    if (scenes <= scenes_ || interrupt_.signal() != 0) return;
    std::vector<std::unique_ptr<SightTrial>> trials(static_cast<std::size_t>(scenes - scenes_));
    Workers::for_chunks(trials.size(), 1, [&](std::size_t i, std::size_t) {
      trials[i] = std::make_unique<SightTrial>(options_.seed, scenes_ + i);
    });
    for (const Isa isa : isas_) {
      select_isa(isa);
      Workers::for_chunks(trials.size(), 1, [&](std::size_t i, std::size_t) { trials[i]->ask(); });
    }
    for (const std::unique_ptr<SightTrial>& trial : trials) {
      pairs_ += trial->pairs();
      if (trial->failure().empty()) continue;
      report(trial->failure());
      ++wrong_;
    }
    scenes_ = scenes;
  }

  void show_progress() {
    constexpr std::size_t width = 30;
    if (compared_ == 0) return;
    const double share = static_cast<double>(compared_) / static_cast<double>(options_.cases);
    const auto full = static_cast<std::size_t>(share * width);
    const double left = seconds() * (1 / share - 1);
    const std::string line = fmt::format("[{}{}] {:3.0f} %  {} of {} cases, {} wrong, {:.0f} s left",
                                         std::string(full, '#'), std::string(width - full, '.'), 100 * share,
                                         grouped(compared_), grouped(options_.cases), grouped(wrong_), left);
    progress_.update(line);
  }

  const VerifyOptions& options_;
  std::vector<Isa> isas_;
  TrialCounts counts_[2][Trial::subjects];  ///< of boxes, then of spheres
  std::size_t batch_trials_ = first_batch_trials;
  std::uint64_t next_ = 0;
  std::uint64_t compared_ = 0;  ///< cases in all complete batches
  std::uint64_t wrong_ = 0;
  std::uint64_t reported_ = 0;
  std::uint64_t scenes_ = 0;  ///< of patches
  std::uint64_t pairs_ = 0;   ///< in these
  Progress progress_;
  InterruptWatch interrupt_;
  Clock::time_point start_ = Clock::now();
};

void run(const VerifyOptions& options) {
  Verification verification(options);
  verification.run();
  verification.print_summary();
  if (verification.wrong() != 0) {
    std::fflush(stdout);
    throw std::runtime_error(fmt::format("{} of {} cases have a wrong answer; reproducers are above",
                                         grouped(verification.wrong()), grouped(verification.compared())));
  }
  if (const int signal = verification.interrupted(); signal != 0) {
    throw Interrupted(signal, fmt::format("verify: interrupted after {} of {} cases", grouped(verification.compared()),
                                          grouped(options.cases)));
  }
}

}  // namespace

void add_verify(CLI::App& program) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App& verify = *program.add_subcommand("verify", "Compare answers with exact rational arithmetic");
  add_number(verify, "--cases", options->cases, 1, std::uint64_t{1} << 50U,
             "Number of bounds to test (default: 1000000)")
      ->type_name("N");
  add_number(verify, "--seed", options->seed, 0, largest_seed, "Seed of the random cases (default: 1)")->type_name("S");
  verify.add_option("--isa", options->isas, "Instruction sets to test (default: that of SHAFTCULL_ISA, or all)")
      ->type_name("NAME");
  add_number(verify, "--threads", options->threads, 0, most_threads,
             "Number of threads, 0 for all; results do not depend on it (default: 0)")
      ->type_name("N");
  verify.footer(
      "A case is one bound against one shaft. It is tested with every query, in slab and plane form, among\n"
      "many shafts and in a tree, on every instruction set. Shafts and bounds come from families that\n"
      "provoke faults: touching to within an ulp, on a grid, degenerate, far from the origin, of every\n"
      "magnitude, with faces of every colour, with added planes. One shaft in 32 has open contact. One in 6\n"
      "is a swept body, a shadow or a convex hull. Shafts between two boxes are also tested for occluders,\n"
      "one shaft in 8 for first contact, and one in 64 against triangles. For every 4096 cases, there is a\n"
      "scene of patches, and the visibility of all its pairs is tested. Exit code 1 if any answer is wrong.\n"
      "Ctrl-C (SIGINT) or SIGTERM ends the run early, with the summary of the cases so far. A second signal\n"
      "ends it at once.");
  verify.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
