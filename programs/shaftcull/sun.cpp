// SPDX-License-Identifier: MIT
/// `shaftcull sun`: how long the sun shines on each facet of a mesh.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "facet_ranks.hpp"
#include "interrupt.hpp"
#include "number.hpp"
#include "peak_memory.hpp"
#include "progress.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"
#include "sun_job.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

/// Whether the hours are found in about a second.
bool is_short(const SunResult& result) {
  constexpr double many = 1 << 26;
  return static_cast<double>(result.patches.size() * result.positions.size()) * result.most_rays < many;
}

/// Finds all hours in this process, part by part, so that they have the bits that ranks find.
void find(SunResult& result, const SunOptions& options) {
  const Workers workers(options.threads);
  Progress progress;
  const InterruptWatch interrupt;
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  workers.run([&] {
    const PatchSet patches(result.patches.corners, result.patches.first);
    const std::size_t parts = sun_parts(result);
    for (std::size_t part = 0; part != parts; ++part) {
      const double left = part == 0 ? 0 : seconds() * static_cast<double>(parts - part) / static_cast<double>(part);
      progress.update(fmt::format("{} of {} parts of the positions of the sun{}", part, parts,
                                  part == 0 ? "" : fmt::format(", {:.0f} s left", std::ceil(left))));
      if (interrupt.signal() != 0) {
        throw Interrupted(interrupt.signal(),
                          fmt::format("sun: interrupted after {} of {} parts; no file was written", part, parts));
      }
      add_lit(result, part, lit_by(result, patches, part, options), options);
    }
    result.threads = concurrency();
  });
  result.seconds = seconds();
  result.memory = peak_memory();
}

void run(const SunOptions& options) {
  if (batch::is_launched()) return run_sun_in_parts(options);
  require_sun_files(options);
  options.isa.select();
  SunResult result = sun_scene(options);
  if (!is_short(result) && !options.kept_beside().empty() && can_keep_parts()) {
    return run_sun_in_parts(options, std::move(result));
  }
  find(result, options);
  write_sun(result, options);
}

}  // namespace

void add_sun(CLI::App& program) {
  const auto options = std::make_shared<SunOptions>();
  CLI::App& sun =
      *program.add_subcommand("sun", "Compute how long the sun shines on each facet of a mesh file, shadows included");
  options->scene.add(sun, "Cut facets until no edge is longer (default: facets stay whole, as in the file)");
  CLI::Option* latitude =
      add_number(sun, "--latitude", options->latitude, -90, 90, "Degrees north of the equator, negative to the south")
          ->type_name("DEGREES");
  CLI::Option* day = sun.add_option("--day", options->day, "Month and day, for example 06-21")->type_name("MM-DD");
  latitude->needs(day);
  day->needs(latitude);
  CLI::Option* every =
      add_number(sun, "--every", options->minutes, 1, 360,
                 "Minutes between positions of the sun, rounded so that equal steps divide the day (default: 15)")
          ->type_name("MINUTES");
  sun.add_option("--directions", options->directions,
                 "Instead of a day: a file with a direction to the sun in each line, x,y,z or x,y,z,hours")
      ->type_name("FILE")
      ->excludes(latitude)
      ->excludes(day)
      ->excludes(every);
  add_number(sun, "--rays", options->ask.rays, 1, 65'536,
             "Maximum number of rays per patch and position of the sun, rounded up to a multiple of 16 (default: 64)")
      ->type_name("S");
  add_number(sun, "--error", options->ask.error, 0, 1,
             "Cast fewer rays if the standard error of the lit share is at most this (default: 0, all rays)")
      ->type_name("E");
  add_number(sun, "--seed", options->scene.seed, 0, largest_seed, "Seed of rays and --rooms (default: 1)")
      ->type_name("S");
  sun.add_option("--out", options->out,
                 "Write hours, and the lit share of each patch at each position, to a file for NumPy: .npz")
      ->type_name("FILE");
  sun.add_option("--svg", options->svg, "Draw patches from above, coloured by their hours; - is standard output")
      ->type_name("FILE");
  sun.add_option("--ply", options->ply, "Write patches as a mesh, coloured by their hours; face i is patch i")
      ->type_name("FILE");
  sun.add_flag("--objects", options->objects, "Also report the hours of each object, averaged over its area");
  sun.add_option("--up", options->up, "The axis that points up in the scene (default: z)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS");
  sun.add_option("--format", options->format, "Output: text, json, or csv with a row per patch (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  add_number(sun, "--threads", options->threads, 0, most_threads,
             "Number of threads, 0 for all; hours do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(sun);
  sun.footer(
      "Hours are in solar time: the sun is highest at noon. Facets are lit on the side from which their\n"
      "corners are seen in counterclockwise order. With --up z, x points east and y points north. With\n"
      "--up y, x points east and -z points north. With --up x, y points east and z points north.\n"
      "Ctrl-C (SIGINT) or SIGTERM ends the run early. If the run takes more than about a second, a file to write,\n"
      "FILE, has finished parts stored in FILE.parts/, and the same command resumes the run. With mpirun, processes\n"
      "share the work.");
  sun.callback([options] {
    options->scene.require_scene("sun");
    run(*options);
  });
}

}  // namespace shaftcull::cli
