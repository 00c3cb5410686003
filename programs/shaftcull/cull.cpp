// SPDX-License-Identifier: MIT
/// `shaftcull cull`: which bounds of a mesh file may lie between two of its objects, in the way of one, in a shadow?
#include <array>
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
#include "number.hpp"
#include "origin_option.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"

namespace shaftcull::cli {
namespace {

struct CullOptions {
  std::string path;
  std::string bounds;  ///< empty: what the ends are
  std::string from;
  std::string to;
  std::size_t random_pairs = 0;
  std::string ends;  ///< empty: parts where objects are few
  std::uint64_t seed = 1;
  std::string format = "text";
  bool tree = false;
  bool solid = false;
  bool times = false;
  bool first = false;
  std::string triangles;  ///< empty: boxes around them are tested
  ShaftChoice choice;
  OriginOption origin;
  InstructionSet isa;
};

/// A file with fewer objects has too few pairs of them to draw from.
constexpr std::size_t fewest_objects = 4;

ShaftEnd object_end(const MeshScene& scene, std::uint32_t object) {
  return {scene.boxes[object], scene.names[object], object};
}

std::string part_name(const MeshScene& scene, const MeshPart& part) {
  return fmt::format("{} part {}", scene.names[part.object], part.number);
}

ShaftEnd part_end(const MeshScene& scene, std::uint32_t part) {
  return {scene.parts[part].box, part_name(scene, scene.parts[part]), scene.parts[part].object, part};
}

std::string names_of_ends(std::string_view wanted, const MeshScene& scene) {
  const bool one = scene.names.size() == 1;
  std::string text =
      fmt::format("{} {}", one ? "its object is" : "its objects are", closest_names(wanted, scene.names));
  if (scene.names.size() < fewest_objects) {
    text += fmt::format(", {} parts such as '{}'", one ? "with" : "each with", part_name(scene, scene.parts.front()));
  }
  return text;
}

ShaftEnd end_from_option(const MeshScene& scene, const std::string& path, std::string_view option,
                         const std::string& text) {
  for (std::uint32_t i = 0; i < scene.names.size(); ++i) {
    if (scene.names[i] == text) return object_end(scene, i);
  }
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    if (part_name(scene, scene.parts[i]) == text) return part_end(scene, i);
  }
  if (looks_like_box(text)) return {box_option(option, text, Origin(scene.origin)), text};
  throw InvalidArgument(
      fmt::format("{} {}: {} has no object of that name; {} (or give a box: lo x,lo y,lo z,hi x,hi y,hi z)", option,
                  text, path, names_of_ends(text, scene)));
}

bool joins_parts(const MeshScene& scene, const CullOptions& options) {
  return options.ends.empty() ? scene.names.size() < fewest_objects : options.ends == "part";
}

/// Pairs of different objects, or of different parts; those of a shadow are apart. Drawn with a generator and a method
/// of our own choice, so that a seed means the same pairs with every standard library.
std::vector<PairResult> random_pairs(const MeshScene& scene, const CullOptions& options) {
  const bool parts = joins_parts(scene, options);
  const std::size_t ends = parts ? scene.parts.size() : scene.names.size();
  if (ends < 2) {
    throw InvalidArgument(fmt::format("--random {}: pairs need two ends, but {} has only one {}, '{}'",
                                      options.random_pairs, options.path, parts ? "triangle" : "object",
                                      scene.names.front()));
  }
  const auto end = [&](std::uint32_t i) { return parts ? part_end(scene, i) : object_end(scene, i); };
  std::mt19937_64 random(options.seed);
  const auto draw = [&] {
    const auto from = static_cast<std::uint32_t>(random() % ends);
    const auto skipped = static_cast<std::uint32_t>(random() % (ends - 1));
    return PairResult{end(from), end(skipped < from ? skipped : skipped + 1), {}};
  };
  std::vector<PairResult> pairs(options.random_pairs);
  for (PairResult& pair : pairs) {
    pair = draw();
    constexpr int most_draws = 10'000;
    for (int i = 0; options.choice.kind() == ShaftKind::shadow && touch(pair.from.box, pair.to.box); ++i) {
      if (i == most_draws) {
        throw InvalidArgument(
            fmt::format("--random {}: found no two {}s of {} that are apart, as a light and an occluder must be",
                        options.random_pairs, parts ? "part" : "object", options.path));
      }
      pair = draw();
    }
    if (!options.choice.has_to()) pair.to = {};
  }
  return pairs;
}

/// What is missing on a command line that does not say which shaft.
[[noreturn]] void ask_for_ends(const MeshScene& scene, const CullOptions& options) {
  const ShaftKind kind = options.choice.kind();
  const bool one = kind == ShaftKind::swept || kind == ShaftKind::swept_infinite;
  const char* const question = one ? "no body is given; add --from NAME"
                               : kind == ShaftKind::shadow
                                   ? "no light and occluder are given; add --from LIGHT --to OCCLUDER"
                                   : "no ends are given; add --from NAME --to NAME";
  throw InvalidArgument(
      fmt::format("cull {}: {}, or --random 10; {}", options.path, question, names_of_ends("", scene)));
}

std::vector<PairResult> pairs_of(const MeshScene& scene, const CullOptions& options) {
  if (!options.choice.has_from()) return {PairResult{}};
  if (options.random_pairs > 0) return random_pairs(scene, options);
  if (options.from.empty() || (options.choice.has_to() && options.to.empty())) ask_for_ends(scene, options);
  PairResult pair{end_from_option(scene, options.path, "--from", options.from), {}, {}};
  if (options.choice.has_to()) pair.to = end_from_option(scene, options.path, "--to", options.to);
  return {pair};
}

Grain grain_of(const CullOptions& options, const PairResult& pair) {
  if (!options.triangles.empty()) return Grain::triangle;
  if (options.bounds.empty()) return pair.from.part != none || pair.to.part != none ? Grain::part : Grain::object;
  if (options.bounds == "object") return Grain::object;
  return options.bounds == "part" ? Grain::part : Grain::triangle;
}

std::vector<CullBound> bounds_of(const MeshScene& scene, Grain grain) {
  std::vector<CullBound> bounds;
  switch (grain) {
    case Grain::object:
      for (std::uint32_t i = 0; i < scene.boxes.size(); ++i) bounds.push_back({scene.boxes[i], i, none, none});
      break;
    case Grain::part:
      for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
        bounds.push_back({scene.parts[i].box, scene.parts[i].object, i, none});
      }
      break;
    case Grain::triangle:
      bounds.reserve(scene.triangles.size());
      for (const MeshTriangle& each : scene.triangles) {
        bounds.push_back({each.box, each.object, each.part, each.triangle});
      }
      break;
  }
  return bounds;
}

TriangleTest test_of(const CullOptions& options) {
  return options.triangles == "vertices" ? TriangleTest::vertices : TriangleTest::exact;
}

std::vector<std::uint32_t> indices_of(const std::vector<Candidate>& candidates) {
  std::vector<std::uint32_t> indices;
  for (const Candidate& candidate : candidates) indices.push_back(static_cast<std::uint32_t>(candidate.bound));
  return indices;
}

/// Leaves the candidate that the shaft reaches first.
void keep_first(const Bounds& bounds, const CompiledShaft& shaft, std::vector<Candidate>& candidates) {
  const std::vector<std::uint32_t> indices = indices_of(candidates);
  const FirstContact first = first_contact(shaft, bounds, {.only = indices});
  std::erase_if(candidates, [&](const Candidate& candidate) { return candidate.bound != first.index; });
}

void find_times(const Bounds& bounds, const CompiledShaft& shaft, std::vector<Candidate>& candidates) {
  std::vector<float> times(candidates.size());
  entry_times(shaft, bounds, indices_of(candidates), times);
  for (std::size_t i = 0; i < times.size(); ++i) candidates[i].time = times[i];
}

/// Finds what the shafts keep of the report's bounds, without their own ends. `bounds` are these, or triangles in them.
void find_candidates(const CullOptions& options, const Bounds& bounds, CullReport& report) {
  std::vector<std::uint64_t> kept(bit_words(bounds.size()));
  std::vector<std::uint64_t> inside(kept.size());
  for (PairResult& pair : report.pairs) {
    const FormedShaft shaft = report.choice.form(pair.from.box, pair.to.box);
    classify(shaft.compiled(), bounds, kept, inside, {.triangle_test = test_of(options)});
    for (const std::size_t i : BitView(kept)) {
      if (pair.from.holds(report.bounds[i]) || pair.to.holds(report.bounds[i])) continue;
      pair.candidates.push_back({i, BitView(inside)[i], false});
    }
    if (options.first) keep_first(bounds, shaft.compiled(), pair.candidates);
    if (report.times) find_times(bounds, shaft.compiled(), pair.candidates);
  }
}

void find_triangles(const CullOptions& options, CullReport& report) {
  std::vector<Triangle> triangles;
  triangles.reserve(report.scene.triangles.size());
  for (const MeshTriangle& each : report.scene.triangles) triangles.push_back({each.vertex});
  if (options.tree) {
    find_candidates(options, TriangleTree(triangles), report);
  } else {
    find_candidates(options, TriangleStream(triangles), report);
  }
}

void find_bounds(const CullOptions& options, CullReport& report) {
  const StridedBoxes records{&report.bounds.front().box.lo, &report.bounds.front().box.hi, sizeof(CullBound),
                             report.bounds.size()};
  if (options.tree) {
    find_candidates(options, BoxTree(records), report);
  } else {
    find_candidates(options, BoxStream(records), report);
  }
}

void find_occluders(const CullOptions& options, const CullReport& report, PairResult& pair) {
  const CompiledShaft shaft = compile(pair.from.box, pair.to.box);
  for (Candidate& candidate : pair.candidates) {
    candidate.blocks = options.triangles.empty() ? occluded(shaft, report.bounds[candidate.bound].box)
                                                 : occluded(shaft, report.scene.triangles[candidate.bound].vertex);
  }
}

void run(const CullOptions& options) {
  options.isa.select();
  const bool with_triangles = options.bounds == "triangle" || !options.triangles.empty();
  CullReport report{options.path,
                    Grain::object,
                    std::string(name(active_isa())),
                    load_mesh_isolated(options.path, {.triangles = with_triangles, .origin = options.origin.value()}),
                    {},
                    {},
                    options.solid,
                    options.times || options.first,
                    options.first,
                    options.choice,
                    options.triangles};
  report.choice.set_origin(Origin(report.scene.origin));
  report.pairs = pairs_of(report.scene, options);
  report.grain = grain_of(options, report.pairs.front());
  report.bounds = bounds_of(report.scene, report.grain);
  if (options.triangles.empty()) {
    find_bounds(options, report);
  } else {
    find_triangles(options, report);
  }
  if (options.solid) {
    for (PairResult& pair : report.pairs) find_occluders(options, report, pair);
  }
  std::fputs(format_report(report, report_format(options.format)).c_str(), stdout);
}

}  // namespace

void add_cull(CLI::App& program) {
  const auto options = std::make_shared<CullOptions>();
  CLI::App& cull = *program.add_subcommand(
      "cull", "List the objects of a mesh file that may lie between two of them, in the way of one, or in a shadow");
  CLI::Option* scene =
      cull.add_option("scene,--scene", options->path, "Mesh file, in any format that assimp reads; - is standard input")
          ->type_name("FILE");
  CLI::Option* bounds =
      cull.add_option(
              "--bounds", options->bounds,
              "Items to test and list: object, part or triangle (default: object, or part if the ends are parts)")
          ->check(CLI::IsMember({"object", "part", "triangle"}))
          ->type_name("KIND");
  CLI::Option* from =
      cull.add_option("--from", options->from,
                      "First end, body or light: a name (room, or room part 3), or lo x,lo y,lo z,hi x,hi y,hi z")
          ->type_name("NAME|BOX");
  CLI::Option* to = cull.add_option("--to", options->to, "Second end, or occluder")->type_name("NAME|BOX");
  to->needs(from);
  CLI::Option* random = add_number(cull, "--random", options->random_pairs, 1, 1'000'000,
                                   "Draw N random pairs of ends, or N random bodies")
                            ->type_name("N");
  random->excludes(from)->excludes(to);
  cull.add_option("--ends", options->ends,
                  "Ends that --random draws: object or part (default: part if there are fewer than 4 objects)")
      ->check(CLI::IsMember({"object", "part"}))
      ->type_name("KIND")
      ->needs(random);
  add_number(cull, "--seed", options->seed, 0, largest_seed, "Seed of --random (default: 1)")
      ->type_name("S")
      ->needs(random);
  cull.add_option("--format", options->format, "Output: text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  cull.add_flag("--tree", options->tree, "Use a tree of the bounds instead of a scan; the answers are the same");
  options->choice.add_options(cull, to);
  CLI::Option* solid =
      cull.add_flag("--solid", options->solid,
                    "Treat bounds as solid, and report which block, that is, hide all of one end from the other")
          ->excludes(cull.get_option("--swept"))
          ->excludes(cull.get_option("--shadow"));
  CLI::Option* times = cull.add_flag("--times", options->times,
                                     "Report when the moving box of the shaft reaches each bound; time 0 is its start");
  CLI::Option* first =
      cull.add_flag("--first", options->first, "List only the bound that is reached first, and the time");
  cull.add_option("--triangles", options->triangles,
                  "Test triangles of the mesh instead of boxes: vertices (cheaper, keeps more) or exact")
      ->check(CLI::IsMember({"vertices", "exact"}))
      ->type_name("TEST")
      ->excludes(bounds)
      ->excludes(times)
      ->excludes(first);
  options->choice.add_hull_options(cull, std::array{from, to, random, solid, times, first});
  options->origin.add_option(cull, origin_of_meshes);
  options->isa.add_option(cull);
  cull.footer(
      "By default, the shaft lies between two ends. With --swept, it is the volume that --from sweeps over;\n"
      "with --shadow, the volume that --to can shadow from --from; with --hull, a convex hull. The ends\n"
      "themselves are not listed.\n"
      "The answer for a candidate is \"inside\" if it lies wholly inside the shaft, and otherwise \"overlap\".\n"
      "With --solid, it is \"blocks\" if every segment between the two ends passes through the candidate.\n"
      "With --times, each candidate has the first time at which the moving box touches it, rounded down. The\n"
      "time is a share of the displacement, or a multiple of it with --infinite. For a shadow, it is 0 at\n"
      "the occluder, and 1 at twice its distance from the light.\n"
      "Parts are groups of triangles of one object that lie close together. The object is halved along its\n"
      "widest axis, and its halves again, until no part has more than a 64th of the triangles of the file.");
  cull.callback([options, scene] {
    if (scene->count() == 0) {
      throw InvalidArgument(
          "cull: no file is given; use shaftcull cull FILE --from NAME --to NAME, or shaftcull cull FILE --random 10");
    }
    run(*options);
  });
}

}  // namespace shaftcull::cli
