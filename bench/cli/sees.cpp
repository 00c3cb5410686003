// SPDX-License-Identifier: MIT
/// `shaftcull sees`: which patches of a mesh see each other?
#include "sees.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "instruction_set.hpp"
#include "isolated_mesh.hpp"
#include "number.hpp"
#include "output_file.hpp"
#include "peak_memory.hpp"
#include "printable.hpp"
#include "rooms.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct SeesOptions {
  std::string path;
  std::size_t rooms = 0;
  SeesChoice choice;
  std::uint32_t rays = 0;
  std::uint64_t seed = 1;
  std::size_t megabytes = 256;
  std::string out;
  std::string svg;
  std::string up = "z";
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;
};

/// Whether one of the files is standard output. The report goes elsewhere then.
bool writes_to_standard_output(const SeesOptions& options) {
  const auto is_output = [](const std::string& path) { return !path.empty() && is_standard_output(path); };
  const bool out = is_output(options.out);
  const bool svg = is_output(options.svg);
  if ((out && svg) || (!options.out.empty() && options.out == options.svg)) {
    throw InvalidArgument(
        fmt::format("--out {} --svg {}: one cannot be both; give two files", options.out, options.svg));
  }
  return out || svg;
}

void run(const SeesOptions& options) {
  const bool is_output_taken = writes_to_standard_output(options);
  options.isa.select();
  const std::string source =
      options.rooms != 0 ? fmt::format("{} room{}", options.rooms, options.rooms == 1 ? "" : "s") : options.path;
  const SeesScene scene = make_sees_scene(
      options.rooms != 0 ? make_rooms(options.rooms, options.seed) : load_mesh_isolated(options.path, true),
      options.choice, source);
  const PatchSet patches(scene.boxes, scene.planes);

  std::vector<SightSink*> sinks;
  std::unique_ptr<SightSink> file;
  if (!options.out.empty()) {
    file = sight_file(options.out, scene, patches, options.rays);
    sinks.push_back(file.get());
  }
  std::unique_ptr<OutputFile> picture;
  SeenShares shares(patches, options.rays);
  if (!options.svg.empty()) {
    picture = std::make_unique<OutputFile>(options.svg);
    sinks.push_back(&shares);
  }

  const Workers workers(options.threads);
  SeesReport report{};
  {
    Progress progress;
    const InterruptWatch interrupt;
    SeesWork work{options.rays, options.seed, options.megabytes << 20, {}, {}};
    workers.run([&] { report = run_sees(scene, patches, work, source, sinks, progress, interrupt); });
  }
  if (picture) {
    picture->write(svg_of_shares(scene, shares.shares(), static_cast<std::size_t>(options.up[0] - 'x')));
    picture->finish();
  }
  std::fputs(format_report(report, report_format(options.format)).c_str(), is_output_taken ? stderr : stdout);
}

}  // namespace

std::string progress_text(const VisibilityProgress& progress, double seconds) {
  const double share =
      static_cast<double>(progress.done) / static_cast<double>(std::max<std::uint64_t>(progress.total, 1));
  std::string text = fmt::format("{:3.0f} %  {} pairs answered, {} left", 100 * share, grouped(progress.done),
                                 grouped(progress.total - progress.done));
  if (progress.done == 0 || seconds <= 0) return text;
  return text + fmt::format(", {}pairs/s, {:.0f} s left", prefixed(static_cast<double>(progress.done) / seconds),
                            std::ceil(seconds * (1 / share - 1)));
}

SeesReport run_sees(const SeesScene& scene, const PatchSet& patches, SeesWork work, const std::string& source,
                    std::span<SightSink* const> sinks, Progress& progress, const InterruptWatch& interrupt) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  VisibilityProgress last{};
  work.progress = [&](const VisibilityProgress& now) {
    last = now;
    progress.update(progress_text(now, seconds()));
    return interrupt.signal() == 0;
  };
  work.stops = [&] { return interrupt.signal() != 0; };
  const std::uint64_t pairs = std::uint64_t{patches.size()} * (patches.size() - 1) / 2;
  progress.milestone(
      fmt::format("{}: {} patches, {} pairs", printable(source), grouped(patches.size()), grouped(pairs)));
  SeesReport report{source,
                    std::string(name(active_isa())),
                    scene.mesh.names.size(),
                    scene.mesh.triangles.size(),
                    scene.patches.size(),
                    scene.patch_size,
                    scene.blockers.size(),
                    scene.solids,
                    work.rays,
                    {},
                    0,
                    concurrency(),
                    0};
  try {
    report.counts = find_what_sees(scene, patches, work, sinks);
  } catch (const Cancelled&) {
    throw Interrupted(interrupt.signal(), fmt::format("sees: interrupted after {} of {} pairs; no file was written",
                                                      grouped(last.done), grouped(last.total)));
  }
  report.seconds = seconds();
  report.memory = peak_memory();
  return report;
}

void add_sees(CLI::App& program) {
  const auto options = std::make_shared<SeesOptions>();
  CLI::App& sees = *program.add_subcommand(
      "sees", "Tell of all pairs of patches of a mesh file which see each other for certain, and which cannot");
  CLI::Option* scene =
      sees.add_option("scene,--scene", options->path, "Mesh file, in any format that assimp reads")->type_name("FILE");
  CLI::Option* rooms = add_number(sees, "--rooms", options->rooms, 1, most_rooms,
                                  "Instead of a file: so many rooms with doors and furniture, made from --seed")
                           ->type_name("N");
  add_number(sees, "--patches", options->choice.patch_size, 1e-30, 1e30,
             "Triangles are split until no edge is longer (default: a 32nd of the scene)")
      ->type_name("SIZE");
  sees.add_flag("--two-sided", options->choice.two_sided,
                "Patches see on both sides; without it, where the right-hand normal of their triangle points");
  sees.add_option("--solid", options->choice.solid,
                  "Objects that are solid, by name or pattern ('wall*'): convex, with 32 corners at most")
      ->type_name("NAME");
  add_number(sees, "--rays", options->rays, 1, 1'000'000,
             "Decide undecided pairs by so many rays each; solids then hide nothing of what lies inside them")
      ->type_name("S");
  add_number(sees, "--seed", options->seed, 0, largest_seed, "Seed of --rays and --rooms (default: 1)")->type_name("S");
  sees.add_option("--out", options->out,
                  "Write all answers to a file: .npz, for NumPy, or .csv; - is standard output (CSV)")
      ->type_name("FILE");
  CLI::Option* svg =
      sees.add_option("--svg", options->svg,
                      "Draw patches from above, coloured by what share of the others they see; - is standard "
                      "output")
          ->type_name("FILE");
  sees.add_option("--up", options->up, "With --svg: the axis that points up in the scene (default: z)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS")
      ->needs(svg);
  sees.add_option("--format", options->format, "Output: text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  add_number(sees, "--memory", options->megabytes, 1, 1'000'000, "MB that answers under way may take (default: 256)")
      ->type_name("MB");
  add_number(sees, "--threads", options->threads, 0, most_threads,
             "Threads, 0 for all there are; answers do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(sees);
  sees.footer(
      "A pair of patches is clear if nothing stands between them, blocked if one solid hides all, facing away if one\n"
      "lies behind the plane of the other, and undecided otherwise. The first three are proven; rays tell of "
      "undecided\n"
      "pairs how much is seen. Ctrl-C (SIGINT, or SIGTERM) ends it early, without a file; a second one ends it at\n"
      "once.");
  sees.callback([options, scene, rooms] {
    if (scene->count() == 0 && rooms->count() == 0) {
      throw InvalidArgument("sees: in what file? Give shaftcull sees FILE, or shaftcull sees --rooms 6");
    }
    if (scene->count() != 0 && rooms->count() != 0) {
      throw InvalidArgument(fmt::format("sees: the file {} and --rooms {} do not go together; give one of them",
                                        options->path, options->rooms));
    }
    run(*options);
  });
}

}  // namespace shaftcull::cli
