// SPDX-License-Identifier: MIT
/// `shaftcull factors`: view factors between all facets of a mesh.
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "facet_ranks.hpp"
#include "factors_joiner.hpp"
#include "interrupt.hpp"
#include "number.hpp"
#include "part_count.hpp"
#include "peak_memory.hpp"
#include "progress.hpp"
#include "sees.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

/// Finds all factors in this process, part by part, so that they have the bits that ranks find.
void find(FactorsResult& result, const FactorsOptions& options) {
  const Workers workers(options.threads);
  Progress progress;
  const InterruptWatch interrupt;
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  VisibilityProgress last{};
  ViewFactorOptions ask = factors_question(options, result);
  ask.close_rows = false;
  ask.parts = part_count(result.patches.size(), parts_of_factors);
  std::uint64_t before = 0;
  ask.progress = [&](const VisibilityProgress& now) {
    last = {before + now.done, pair_count(result.patches.size())};
    progress.update(progress_text(last, seconds()));
    return interrupt.signal() == 0;
  };
  try {
    workers.run([&] {
      const PatchSet patches(result.patches.corners, result.patches.first);
      FactorsJoiner joiner;
      for (; ask.part != ask.parts; ++ask.part) {
        ViewFactors part = view_factors(patches, result.scene.occluders, ask);
        before += part.counts.total();
        joiner.add(std::move(part));
      }
      result.factors = joiner.all(options.ask.close_rows);
      result.threads = concurrency();
    });
  } catch (const Cancelled&) {
    throw Interrupted(interrupt.signal(), fmt::format("factors: interrupted after {} of {} pairs; no file was written",
                                                      grouped(last.done), grouped(last.total)));
  }
  result.seconds = seconds();
  result.memory = peak_memory();
}

void run(const FactorsOptions& options) {
  if (batch::is_launched()) return run_factors_in_parts(options);
  require_factor_files(options);
  options.isa.select();
  FactorsResult result = factors_scene(options);
  const bool is_short = part_count(result.patches.size(), parts_of_factors) == 1;
  if (!is_short && !options.kept_beside().empty() && can_keep_parts()) {
    return run_factors_in_parts(options, std::move(result));
  }
  find(result, options);
  write_factors(result, options);
}

}  // namespace

void add_factors(CLI::App& program) {
  const auto options = std::make_shared<FactorsOptions>();
  CLI::App& factors = *program.add_subcommand(
      "factors", "Compute view factors between all facets of a mesh file, and how much sky each facet sees");
  options->scene.add(factors, "Cut facets until no edge is longer (default: facets stay whole, as in the file)");
  add_number(factors, "--rays", options->ask.rays, 1, 65'536,
             "Maximum number of rays per partly visible pair (default: 4096)")
      ->type_name("S");
  add_number(factors, "--error", options->ask.error, 0, 1,
             "Cast fewer rays if the standard error of the factor is at most this (default: 0.00001)")
      ->type_name("E");
  CLI::Option* least = add_number(factors, "--min", options->ask.least, 0, 1,
                                  "Leave out pairs whose factors are both smaller, and report what they add up to")
                           ->type_name("F");
  factors.add_flag("--close", options->ask.close_rows,
                   "Scale factors so that they sum to 1 for each patch, as in a closed room");
  add_number(factors, "--seed", options->scene.seed, 0, largest_seed, "Seed of rays and --rooms (default: 1)")
      ->type_name("S");
  factors
      .add_option("--out", options->out,
                  "Write all factors to a file: .npz, for scipy.sparse.load_npz(), or .csv; - is standard output (CSV)")
      ->type_name("FILE");
  CLI::Option* svg = factors
                         .add_option("--svg", options->svg,
                                     "Draw patches from above, coloured by the sky that they see; - is standard output")
                         ->type_name("FILE");
  factors
      .add_option("--ply", options->ply,
                  "Write patches as a mesh, coloured by the sky that they see; face i is patch i")
      ->type_name("FILE");
  factors.add_flag("--objects", options->objects, "Also report the factors between each pair of objects")
      ->excludes(least);  // small ones add up
  factors.add_option("--up", options->up, "With --svg: the axis that points up in the scene (default: z)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS")
      ->needs(svg);
  factors.add_option("--format", options->format, "Output: text, json, or csv with a row per patch (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  add_number(factors, "--memory", options->megabytes, 1, 1'000'000,
             "Limit of the memory of pending answers, without the factors, in MB (default: 256)")
      ->type_name("MB");
  add_number(factors, "--threads", options->threads, 0, most_threads,
             "Number of threads, 0 for all; factors do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(factors);
  factors.footer(
      "The view factor from one facet to another is the share of the radiation of the first that arrives at the\n"
      "second. Facets radiate diffusely, on the side from which their corners are seen in counterclockwise\n"
      "order. The factors of fully visible pairs are integrated. For other pairs, rays measure the visible part.\n"
      "Ctrl-C (SIGINT) or SIGTERM ends the run early. With about 1,000 patches or more, finished parts are\n"
      "stored in FILE.parts/, where FILE is the file of --out, --svg or --ply, and the same command resumes the run.\n"
      "With mpirun, processes share the work.");
  factors.callback([options] {
    options->scene.require_scene("factors");
    run(*options);
  });
}

}  // namespace shaftcull::cli
