/// `shaftcull verify`: compares answers with exact arithmetic, by the million.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cases/families.hpp"
#include "instruction_sets.hpp"
#include "progress.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "trial.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct VerifyOptions {
  std::uint64_t cases = 1'000'000;
  std::uint64_t seed = 1;
  std::vector<std::string> isas;
  int threads = 0;
};

/// Trials in memory at once, and those that a thread takes at a time.
constexpr std::size_t batch_trials = 4096;
constexpr std::size_t chunk_trials = 32;

/// Reproducers that are printed; later failures are only counted.
constexpr std::uint64_t most_reproducers = 20;

std::vector<Isa> isas_of(const VerifyOptions& options) {
  if (options.isas.empty()) return isas_under_test();
  const std::vector<Isa> available = available_isas();
  std::string names;
  for (const Isa isa : available) names += fmt::format("{}{}", names.empty() ? "" : ", ", name(isa));
  std::vector<Isa> isas;
  for (const std::string& text : options.isas) {
    const auto isa = isa_from_name(text);
    if (!isa || std::find(available.begin(), available.end(), *isa) == available.end()) {
      throw InvalidArgument(fmt::format("--isa {}: no such instruction set here; available: {}", text, names));
    }
    isas.push_back(*isa);
  }
  return isas;
}

class Verification {
 public:
  explicit Verification(const VerifyOptions& options) : options_(options), isas_(isas_of(options)) {}

  void run() {
    const Workers workers(options_.threads);
    workers.run([&] {
      while (done_ < options_.cases) {
        run_batch();
        show_progress();
      }
    });
  }

  [[nodiscard]] std::uint64_t wrong() const noexcept { return wrong_; }

  void print_summary() const {
    Table table({"family", "cases", "outside", "inside", "undecided, slab", "undecided, planes", "on the boundary", "wrong"});
    Tally sum;
    const auto add_row = [&](const std::string& what, const Tally& tally) {
      const auto share = [&](std::uint64_t part) {
        return tally.bounds == 0 ? "-" : fmt::format("{:.3f} %", 100.0 * static_cast<double>(part) / static_cast<double>(tally.bounds));
      };
      table.add_row({what, grouped(tally.bounds), share(tally.outside), share(tally.inside), share(tally.undecided_slab),
                     share(tally.undecided_planes), share(tally.touching), grouped(tally.wrong)});
    };
    for (std::size_t family = 0; family != std::size(families); ++family) {
      for (const bool spheres : {false, true}) {
        const Tally& tally = tallies_[spheres][family];
        add_row(fmt::format("{}: {}", spheres ? "spheres" : "boxes", families[family].name), tally);
        sum += tally;
      }
    }
    add_row("all", sum);
    fmt::print("{}\n", table.text());
    std::string names;
    for (const Isa isa : isas_) names += fmt::format(" {}", name(isa));
    fmt::print("{} cases (seed {}), each in slab and plane form on:{}\n", grouped(sum.bounds), options_.seed, names);
    fmt::print("Undecided by the float filter: {} in slab form, {} in plane form\n", grouped(sum.undecided_slab),
               grouped(sum.undecided_planes));
    fmt::print("Right answers from rational arithmetic: {}, {} of them exactly on the boundary; the others proved in intervals\n",
               grouped(sum.by_rationals), grouped(sum.touching));
    fmt::print("Wrong answers: {}   ({:.0f} s, {} cases/s)\n", grouped(sum.wrong), seconds(),
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
    for (; done_ < options_.cases && places.size() != batch_trials; ++next_) {
      const std::uint64_t left = options_.cases - done_;
      places.push_back({next_, static_cast<std::size_t>(std::min<std::uint64_t>(Trial::natural_size(next_), left))});
      done_ += places.back().bounds;
    }
    std::vector<std::vector<Trial>> chunks((places.size() + chunk_trials - 1) / chunk_trials);
    Workers::for_chunks(places.size(), chunk_trials, [&](std::size_t first, std::size_t size) {
      std::vector<Trial>& chunk = chunks[first / chunk_trials];
      chunk.reserve(size);
      for (const Place& place : std::span(places).subspan(first, size)) {
        chunk.emplace_back(options_.seed, place.number, place.bounds);
      }
    });
    for (const Isa isa : isas_) {
      select_isa(isa);
      Workers::for_chunks(chunks.size(), 1, [&](std::size_t i, std::size_t) { Trial::ask(chunks[i]); });
    }
    for (const std::vector<Trial>& chunk : chunks) {
      for (const Trial& trial : chunk) take(trial);
    }
  }

  void take(const Trial& trial) {
    tallies_[trial.has_spheres()][trial.family()] += trial.tally();
    for (const std::string& failure : trial.failures()) {
      if (++reported_ <= most_reproducers) progress_.milestone("WRONG: " + failure);
      if (reported_ == most_reproducers) progress_.milestone("Further reproducers are left out.");
    }
    wrong_ += trial.tally().wrong;
  }

  void show_progress() {
    constexpr std::size_t width = 30;
    const double share = static_cast<double>(done_) / static_cast<double>(options_.cases);
    const auto full = static_cast<std::size_t>(share * width);
    const double left = seconds() * (1 / share - 1);
    const std::string line =
        fmt::format("[{}{}] {:3.0f} %  {} of {} cases, {} wrong, {:.0f} s left", std::string(full, '#'),
                    std::string(width - full, '.'), 100 * share, grouped(done_), grouped(options_.cases), grouped(wrong_), left);
    progress_.update(line);
    if (progress_.on_terminal() || share < next_tenth_) return;
    progress_.milestone(line);  // a log gets ten lines
    next_tenth_ = share + 0.1;
  }

  const VerifyOptions& options_;
  std::vector<Isa> isas_;
  Tally tallies_[2][std::size(families)];  ///< of boxes, then of spheres
  std::uint64_t next_ = 0;
  std::uint64_t done_ = 0;
  std::uint64_t wrong_ = 0;
  std::uint64_t reported_ = 0;
  Progress progress_;
  double next_tenth_ = 0.1;
  Clock::time_point start_ = Clock::now();
};

void run(const VerifyOptions& options) {
  Verification verification(options);
  verification.run();
  verification.print_summary();
  if (verification.wrong() != 0) {
    std::fflush(stdout);
    throw std::runtime_error(fmt::format("{} of {} cases got a wrong answer; reproducers are above",
                                         grouped(verification.wrong()), grouped(options.cases)));
  }
}

}  // namespace

void add_verify(CLI::App& program) {
  const auto options = std::make_shared<VerifyOptions>();
  CLI::App& verify = *program.add_subcommand("verify", "Compare answers with exact rational arithmetic");
  verify.add_option("--cases", options->cases, "How many bounds to test (default: 1000000)")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 50U));
  verify.add_option("--seed", options->seed, "Seed of the random cases (default: 1)")->type_name("S");
  verify.add_option("--isa", options->isas, "Instruction sets to test (default: that of SHAFTCULL_ISA, or all)")->type_name("NAME");
  verify.add_option("--threads", options->threads, "Threads, 0 for all there are; results do not depend on it (default: 0)")
      ->type_name("N");
  verify.footer(
      "A case is one bound against one shaft: every question, in slab and plane form, on every instruction set. Shafts\n"
      "and bounds come from families that look for trouble: touching but for an ulp, on a grid, degenerate, far from the\n"
      "origin, of every magnitude, with faces of every colour, with added planes. Exit code 1 if any answer is wrong.");
  verify.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
