// SPDX-License-Identifier: MIT
/// `shaftcull sun`: how long the sun shines on each facet of a mesh.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "number.hpp"
#include "output_file.hpp"
#include "peak_memory.hpp"
#include "printable.hpp"
#include "progress.hpp"
#include "scene_options.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"
#include "sun_result.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct SunOptions {
  SceneOptions scene;
  RayOptions ask;
  double latitude = 0;
  std::string day;
  double minutes = 15;
  std::string directions;
  std::string up = "z";
  std::string out;
  std::string svg;
  std::string ply;
  bool objects = false;
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;
};

/// All files that are read.
std::vector<std::string> with_directions(std::vector<std::string> paths, const std::string& directions) {
  if (!directions.empty()) paths.push_back(directions);
  return paths;
}

void set_positions(SunResult& result, const SunOptions& options) {
  if (!options.directions.empty()) {
    result.positions = read_sun_positions(options.directions);
    result.where = "from " + printable(options.directions);
    return;
  }
  if (options.day.empty()) {
    throw InvalidArgument(
        "sun: no position of the sun is given; add --latitude DEGREES and --day MM-DD, or --directions FILE");
  }
  result.positions = sun_path(options.latitude, day_of_year(options.day), options.minutes, options.up[0]);
  result.where = fmt::format("latitude {}, {}, every {:.4g} min", options.latitude, printable(options.day),
                             sun_step(options.minutes));
}

void find(SunResult& result, const SunOptions& options, bool keeps_all) {
  const Workers workers(options.threads);
  Progress progress;
  const InterruptWatch interrupt;
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t patches = result.patches.size();
  const std::size_t positions = result.positions.size();
  result.hours.resize(patches);
  if (keeps_all) result.lit.resize(patches * positions);
  RayOptions ask = options.ask;
  ask.tolerance = result.scene.tolerance;
  workers.run([&] {
    const PatchSet set(result.patches.corners, result.patches.first);
    constexpr std::size_t at_once = 8;
    std::vector<float> fractions;
    for (std::size_t first = 0; first < positions; first += at_once) {
      progress.update(fmt::format("{} of {} positions of the sun", first, positions));
      if (interrupt.signal() != 0) {
        throw Interrupted(
            interrupt.signal(),
            fmt::format("sun: interrupted after {} of {} positions; no file was written", first, positions));
      }
      std::vector<Vec3> lights;
      for (std::size_t j = first; j != std::min(first + at_once, positions); ++j) {
        lights.push_back(result.positions[j].towards);
      }
      fractions.resize(patches * lights.size());
      ask.seed = options.scene.seed + first;
      lit_fractions(set, result.scene.occluders, lights, fractions, ask);
      for (std::size_t i = 0; i != patches; ++i) {
        for (std::size_t j = 0; j != lights.size(); ++j) {
          const float lit = fractions[i * lights.size() + j];
          result.hours[i] += double{lit} * result.positions[first + j].hours;
          if (keeps_all) result.lit[i * positions + first + j] = lit;
        }
      }
    }
    result.threads = concurrency();
  });
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.memory = peak_memory();
}

void run(const SunOptions& options) {
  if (!options.out.empty()) require_sun_name(options.out);
  require_different_files({{"--out", options.out}, {"--svg", options.svg}, {"--ply", options.ply}},
                          with_directions(options.scene.paths, options.directions));
  options.isa.select();
  SceneOptions scene = options.scene;
  scene.choice.finds_solids = false;  // rays meet the triangles themselves
  SunResult result{make_facet_scene(scene, options.objects)};
  set_positions(result, options);
  set_normals(result);
  result.most_rays = (options.ask.rays + 15) / 16 * 16;
  result.shows_objects = options.objects;
  find(result, options, !options.out.empty());

  if (!options.out.empty()) write_sun(result, options.out);
  const std::string words = fmt::format("of {:.2f} h of sun", result.daylight());
  const FacetMap map{result.hours, result.daylight(), "sun", words.c_str(), "Hours of sun"};
  if (!options.svg.empty()) write_map_svg(result, map, options.svg, static_cast<std::size_t>(options.up[0] - 'x'));
  if (!options.ply.empty()) write_map_ply(result, map, options.ply);
  // Where a file is standard output, the report goes elsewhere.
  const auto is_output = [](const std::string& path) { return !path.empty() && is_standard_output(path); };
  const bool is_taken = is_output(options.svg) || is_output(options.ply);
  std::fputs(format_report(result, report_format(options.format)).c_str(), is_taken ? stderr : stdout);
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
      "Ctrl-C (SIGINT) or SIGTERM ends the run early, without a file.");
  sun.callback([options] {
    options->scene.require_scene("sun");
    run(*options);
  });
}

}  // namespace shaftcull::cli
