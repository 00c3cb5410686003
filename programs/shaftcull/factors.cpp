// SPDX-License-Identifier: MIT
/// `shaftcull factors`: view factors between all facets of a mesh.
#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "factors_result.hpp"
#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "number.hpp"
#include "output_file.hpp"
#include "peak_memory.hpp"
#include "progress.hpp"
#include "scene_options.hpp"
#include "sees.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct FactorsOptions {
  SceneOptions scene;
  ViewFactorOptions ask;
  std::size_t megabytes = 256;
  std::string out;
  std::string svg;
  std::string ply;
  bool objects = false;
  std::string up = "z";
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;
};

void find(FactorsResult& result, const FactorsOptions& options) {
  const Workers workers(options.threads);
  Progress progress;
  const InterruptWatch interrupt;
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  VisibilityProgress last{};
  ViewFactorOptions ask = options.ask;
  ask.seed = options.scene.seed;
  ask.memory = options.megabytes << 20;
  ask.tolerance = result.scene.tolerance;
  ask.progress = [&](const VisibilityProgress& now) {
    last = now;
    progress.update(progress_text(now, seconds()));
    return interrupt.signal() == 0;
  };
  try {
    workers.run([&] {
      const PatchSet patches(result.patches.corners, result.patches.first);
      result.factors = view_factors(patches, result.scene.occluders, ask);
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
  if (!options.out.empty()) require_factors_name(options.out);
  require_different_files({{"--out", options.out}, {"--svg", options.svg}, {"--ply", options.ply}},
                          options.scene.paths);
  options.isa.select();
  FactorsResult result{make_facet_scene(options.scene, options.objects)};
  result.most_rays = options.ask.rays;
  result.shows_objects = options.objects;
  find(result, options);
  const std::string hint = options.scene.hint_about_normals(result.factors.counts);
  if (!hint.empty()) static_cast<void>(std::fputs(hint.c_str(), stderr));
  if (!options.out.empty()) write_factors(result, options.out);
  const std::vector<double> skies = result.skies();
  const FacetMap sky{skies, 1, "sky", "of the radiation meets no patch", "Sky view factors"};
  if (!options.svg.empty()) write_map_svg(result, sky, options.svg, static_cast<std::size_t>(options.up[0] - 'x'));
  if (!options.ply.empty()) write_map_ply(result, sky, options.ply);
  // Where a file is standard output, the report goes elsewhere.
  const auto is_output = [](const std::string& path) { return !path.empty() && is_standard_output(path); };
  const bool is_taken = is_output(options.out) || is_output(options.svg) || is_output(options.ply);
  std::fputs(format_report(result, report_format(options.format)).c_str(), is_taken ? stderr : stdout);
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
             "Cast fewer rays if the standard error of the factor is at most this (default: 0.00002)")
      ->type_name("E");
  CLI::Option* least = add_number(factors, "--min", options->ask.least, 0, 1,
                                  "Leave out smaller factors, and report what they add up to")
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
      "Ctrl-C (SIGINT) or SIGTERM ends the run early, without a file.");
  factors.callback([options] {
    options->scene.require_scene("factors");
    run(*options);
  });
}

}  // namespace shaftcull::cli
