/// `shaftcull cull`: which bounds of a mesh file may lie between two of its objects?
#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "box_text.hpp"
#include "cull_report.hpp"
#include "instruction_set.hpp"
#include "isolated_mesh.hpp"
#include "mesh.hpp"
#include "name_search.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"

namespace shaftcull::cli {
namespace {

struct CullOptions {
  std::string path;
  std::string bounds = "object";
  std::string from;
  std::string to;
  std::size_t random_pairs = 0;
  std::uint64_t seed = 1;
  std::string format = "text";
  bool tree = false;
  InstructionSet isa;
};

Grain grain_of(const CullOptions& options) { return options.bounds == "triangle" ? Grain::triangle : Grain::object; }

ReportFormat format_of(const CullOptions& options) {
  if (options.format == "json") return ReportFormat::json;
  return options.format == "csv" ? ReportFormat::csv : ReportFormat::text;
}

ShaftEnd object_end(const MeshScene& scene, std::uint32_t object) {
  return {scene.boxes[object], scene.names[object], object};
}

ShaftEnd end_from_option(const MeshScene& scene, const std::string& path, std::string_view option,
                         const std::string& text) {
  for (std::uint32_t i = 0; i < scene.names.size(); ++i) {
    if (scene.names[i] == text) return object_end(scene, i);
  }
  if (const auto box = box_from_text(text)) {
    require_finite(*box, fmt::format("{} {}", option, text));
    return {*box, text};
  }
  throw InvalidArgument(
      fmt::format("{} {}: {} has no object of that name; it has {} (or give a box, "
                  "lo x,lo y,lo z,hi x,hi y,hi z)",
                  option, text, path, closest_names(text, scene.names)));
}

/// Pairs of different objects. Drawn with a generator and a method of our own choice, so that a seed means the same
/// pairs with every standard library.
std::vector<PairResult> random_pairs(const MeshScene& scene, const CullOptions& options) {
  const std::size_t objects = scene.names.size();
  if (objects < 2) {
    throw InvalidArgument(fmt::format("--random {}: {} has only one object, '{}'; pairs need two", options.random_pairs,
                                      options.path, scene.names.front()));
  }
  std::mt19937_64 random(options.seed);
  std::vector<PairResult> pairs(options.random_pairs);
  for (PairResult& pair : pairs) {
    const auto from = static_cast<std::uint32_t>(random() % objects);
    const auto skipped = static_cast<std::uint32_t>(random() % (objects - 1));
    pair.from = object_end(scene, from);
    pair.to = object_end(scene, skipped < from ? skipped : skipped + 1);
  }
  return pairs;
}

void find_candidates(const MeshScene& scene, const BoxTree& bounds, PairResult& pair) {
  const CompiledShaft shaft = compile(Shaft(pair.from.box, pair.to.box));
  std::vector<std::uint32_t> overlap(bounds.size());
  std::vector<std::uint32_t> inside(bounds.size());
  const KeptCounts counts = classify(shaft, bounds, std::span(overlap), std::span(inside));
  const auto add = [&](std::span<const std::uint32_t> indices, bool is_inside) {
    for (const std::uint32_t bound : indices) {
      const std::uint32_t object = scene.bounds[bound].object;
      if (object != pair.from.object && object != pair.to.object) pair.candidates.push_back({bound, is_inside});
    }
  };
  add(std::span(overlap).first(counts.overlap), false);
  add(std::span(inside).first(counts.inside), true);
  // In the order of the file, as a scan has them.
  std::sort(pair.candidates.begin(), pair.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
}

void find_candidates(const MeshScene& scene, const BoxStream& bounds, PairResult& pair) {
  const CompiledShaft shaft = compile(Shaft(pair.from.box, pair.to.box));
  std::vector<std::uint64_t> kept(words_for(bounds.size()));
  std::vector<std::uint64_t> inside(kept.size());
  classify(shaft, bounds.view(), kept, inside);
  for (std::size_t w = 0; w < kept.size(); ++w) {
    for (std::uint64_t left = kept[w]; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::size_t bound = 64 * w + bit;
      const std::uint32_t object = scene.bounds[bound].object;
      if (object == pair.from.object || object == pair.to.object) continue;
      pair.candidates.push_back({bound, (inside[w] >> bit & 1) != 0});
    }
  }
}

void run(const CullOptions& options) {
  options.isa.select();
  CullReport report{options.path,
                    grain_of(options),
                    std::string(name(active_isa())),
                    load_mesh_isolated(options.path, grain_of(options)),
                    {}};
  const MeshScene& scene = report.scene;
  if (options.random_pairs > 0) {
    report.pairs = random_pairs(scene, options);
  } else {
    report.pairs.push_back({end_from_option(scene, options.path, "--from", options.from),
                            end_from_option(scene, options.path, "--to", options.to),
                            {}});
  }
  const MinMaxRecords records{&scene.bounds.front().box.lo, &scene.bounds.front().box.hi, sizeof(MeshBound),
                              scene.bounds.size()};
  if (options.tree) {
    const BoxTree tree(records);
    for (PairResult& pair : report.pairs) find_candidates(scene, tree, pair);
  } else {
    const BoxStream stream(records);
    for (PairResult& pair : report.pairs) find_candidates(scene, stream, pair);
  }
  std::fputs(format_report(report, format_of(options)).c_str(), stdout);
}

}  // namespace

void add_cull(CLI::App& program) {
  const auto options = std::make_shared<CullOptions>();
  CLI::App& cull = *program.add_subcommand("cull", "List what may lie between two objects of a mesh file");
  cull.add_option("--scene", options->path, "Mesh file, in any format that assimp reads")
      ->required()
      ->type_name("FILE");
  cull.add_option("--bounds", options->bounds, "What gets a bound: object or triangle (default: object)")
      ->check(CLI::IsMember({"object", "triangle"}))
      ->type_name("KIND");
  CLI::Option* from =
      cull.add_option("--from", options->from, "One end: an object's name, or lo x,lo y,lo z,hi x,hi y,hi z")
          ->type_name("NAME|BOX");
  CLI::Option* to = cull.add_option("--to", options->to, "The other end")->type_name("NAME|BOX");
  from->needs(to);
  to->needs(from);
  CLI::Option* random = cull.add_option("--random", options->random_pairs, "Between N random pairs of objects instead")
                            ->type_name("N")
                            ->check(CLI::Range(1, 1'000'000));
  random->excludes(from)->excludes(to);
  cull.add_option("--seed", options->seed, "Seed of --random (default: 1)")->type_name("S")->needs(random);
  cull.add_option("--format", options->format, "Output: text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  cull.add_flag("--tree", options->tree,
                "Put the bounds into a tree instead of scanning all of them: the same answers");
  options->isa.add_option(cull);
  cull.footer(
      "The two objects themselves are not listed: they always meet the shaft between them. A candidate's answer is\n"
      "\"inside\" if its bound is fully inside the shaft, else \"overlap\".");
  cull.callback([options, from, random] {
    if (from->count() == 0 && random->count() == 0) {
      throw InvalidArgument("cull: between what? Give --from and --to, or --random N");
    }
    run(*options);
  });
}

}  // namespace shaftcull::cli
