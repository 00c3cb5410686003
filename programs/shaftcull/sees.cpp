// SPDX-License-Identifier: MIT
/// `shaftcull sees`: which patches of a mesh see each other?
#include "sees.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "batch/launcher.hpp"
#include "number.hpp"
#include "peak_memory.hpp"
#include "sees_estimate.hpp"
#include "sees_job.hpp"
#include "sees_ranks.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

void run(const SeesOptions& options) {
  SeesJob job(options);
  if (batch::is_launched()) return run_on_launched_ranks(job);
  options.require_files({});
  options.isa.select();
  job.prepare();
  const std::span<SightSink* const> sinks = job.open();
  const SeesPictures pictures = job.open_pictures();
  const Workers workers(options.threads);
  SeesReport report{};
  {
    Progress progress;
    const InterruptWatch interrupt;
    workers.run([&] {
      report = run_sees(job.scene(), job.patches(), job.work(), job.source(), options.out, sinks, progress, interrupt);
    });
  }
  job.finish(std::move(report), pictures);
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
                    const std::string& out, std::span<SightSink* const> sinks, Progress& progress,
                    const InterruptWatch& interrupt) {
  progress.milestone(announcement(source, scene, patches));
  const std::string likely = estimate(scene, patches, work, out, !sinks.empty(), 1);
  if (!likely.empty()) progress.milestone(likely);
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  VisibilityProgress last{};
  work.progress = [&](const VisibilityProgress& now) {
    last = now;
    progress.update(progress_text(now, seconds()));
    return interrupt.signal() == 0;
  };
  work.stops = [&] { return interrupt.signal() != 0; };
  SeesReport report = report_of(scene, work, source);
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
  CLI::App& sees =
      *program.add_subcommand("sees", "Prove which pairs of patches of a mesh file see each other, and which cannot");
  options->scene.add(sees,
                     "Split triangles until no edge is longer (default: a 32nd of the scene; more if that makes over "
                     "500 million pairs)");
  options->scene.may_be_two_sided = true;
  sees.add_flag("--two-sided", options->scene.choice.two_sided,
                "Patches see on both sides; by default, they see where the right-hand normal of their triangle points")
      ->excludes("--flip");
  add_number(sees, "--rays", options->content.rays, 1, 65'536, "Decide each undecided pair by S rays")->type_name("S");
  add_number(sees, "--seed", options->scene.seed, 0, largest_seed, "Seed of --rays and --rooms (default: 1)")
      ->type_name("S");
  CLI::Option* out =
      sees.add_option("--out", options->out,
                      "Write all answers to a file: .npz, for NumPy, or .csv; - is standard output (CSV)")
          ->type_name("FILE");
  sees.add_flag("--candidates", options->content.candidates,
                "With --out FILE.npz: also write which occluders reach between the patches of undecided pairs")
      ->needs(out);
  CLI::Option* svg =
      sees.add_option("--svg", options->svg,
                      "Draw patches from above, coloured by the share of others that they see; - is standard output")
          ->type_name("FILE");
  sees.add_option("--ply", options->ply,
                  "Write patches as a mesh, coloured by the share of others that they see; face i is patch i")
      ->type_name("FILE");
  sees.add_flag("--objects", options->objects,
                "Also report, for each pair of objects, how much they see of each other");
  sees.add_option("--up", options->up, "With --svg: the axis that points up in the scene (default: z)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS")
      ->needs(svg);
  sees.add_option("--format", options->format, "Output: text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  add_number(sees, "--memory", options->megabytes, 1, 1'000'000,
             "Limit of the memory of pending answers, in MB (default: 256)")
      ->type_name("MB");
  add_number(sees, "--threads", options->threads, 0, most_threads,
             "Number of threads, 0 for all; answers do not depend on it (default: 0)")
      ->type_name("N");
  options->isa.add_option(sees);
  sees.footer(
      "A pair of patches is clear if nothing stands between the two, occluded if one solid hides all of\n"
      "one from the other, facing away if one lies behind the plane of the other, and otherwise undecided.\n"
      "The first three answers are proven. For undecided pairs, rays measure how much is visible.\n"
      "Ctrl-C (SIGINT) or SIGTERM ends the run early, without a file. A second signal ends it at once.");
  sees.callback([options] {
    options->scene.require_scene("sees");
    run(*options);
  });
}

}  // namespace shaftcull::cli
