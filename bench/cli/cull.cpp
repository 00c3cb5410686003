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
#include "number.hpp"
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
  std::string contact = "closed";
  InstructionSet isa;
};

/// A file with fewer objects has too few pairs of them to draw from.
constexpr std::size_t fewest_objects = 4;

ReportFormat format_of(const CullOptions& options) {
  if (options.format == "json") return ReportFormat::json;
  return options.format == "csv" ? ReportFormat::csv : ReportFormat::text;
}

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
    text += fmt::format(", {} parts, as '{}'", one ? "with its" : "each with", part_name(scene, scene.parts.front()));
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
  if (looks_like_box(text)) return {box_option(option, text), text};
  throw InvalidArgument(
      fmt::format("{} {}: {} has no object of that name; {} (or give a box, "
                  "lo x,lo y,lo z,hi x,hi y,hi z)",
                  option, text, path, names_of_ends(text, scene)));
}

bool joins_parts(const MeshScene& scene, const CullOptions& options) {
  return options.ends.empty() ? scene.names.size() < fewest_objects : options.ends == "part";
}

/// Pairs of different objects, or of different parts. Drawn with a generator and a method of our own choice, so that
/// a seed means the same pairs with every standard library.
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
  std::vector<PairResult> pairs(options.random_pairs);
  for (PairResult& pair : pairs) {
    const auto from = static_cast<std::uint32_t>(random() % ends);
    const auto skipped = static_cast<std::uint32_t>(random() % (ends - 1));
    pair.from = end(from);
    pair.to = end(skipped < from ? skipped : skipped + 1);
  }
  return pairs;
}

std::vector<PairResult> pairs_of(const MeshScene& scene, const CullOptions& options) {
  if (options.random_pairs > 0) return random_pairs(scene, options);
  if (options.from.empty()) {
    throw InvalidArgument(fmt::format("cull {}: between what? Add --from NAME --to NAME, or --random 10; {}",
                                      options.path, names_of_ends("", scene)));
  }
  return {{end_from_option(scene, options.path, "--from", options.from),
           end_from_option(scene, options.path, "--to", options.to),
           {}}};
}

Grain grain_of(const CullOptions& options, const PairResult& pair) {
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

CompiledShaft shaft_of(const PairResult& pair, Contact contact) {
  return compile(Shaft(pair.from.box, pair.to.box, {.contact = contact}));
}

void find_candidates(std::span<const CullBound> all, const BoxTree& bounds, Contact contact, PairResult& pair) {
  const CompiledShaft shaft = shaft_of(pair, contact);
  std::vector<std::uint32_t> overlap(bounds.size());
  std::vector<std::uint32_t> inside(bounds.size());
  const KeptCounts counts = list_classified(shaft, bounds, std::span(overlap), std::span(inside));
  const auto add = [&](std::span<const std::uint32_t> indices, bool is_inside) {
    for (const std::uint32_t bound : indices) {
      if (!pair.from.holds(all[bound]) && !pair.to.holds(all[bound]))
        pair.candidates.push_back({bound, is_inside, false});
    }
  };
  add(std::span(overlap).first(counts.overlap), false);
  add(std::span(inside).first(counts.inside), true);
  // In the order of the file, as a scan has them.
  std::sort(pair.candidates.begin(), pair.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.bound < b.bound; });
}

void find_candidates(std::span<const CullBound> all, const BoxStream& bounds, Contact contact, PairResult& pair) {
  const CompiledShaft shaft = shaft_of(pair, contact);
  std::vector<std::uint64_t> kept(words_for(bounds.size()));
  std::vector<std::uint64_t> inside(kept.size());
  classify(shaft, bounds.view(), kept, inside);
  for (std::size_t w = 0; w < kept.size(); ++w) {
    for (std::uint64_t left = kept[w]; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      const std::size_t bound = 64 * w + bit;
      if (pair.from.holds(all[bound]) || pair.to.holds(all[bound])) continue;
      pair.candidates.push_back({bound, (inside[w] >> bit & 1) != 0, false});
    }
  }
}

void find_blockers(std::span<const CullBound> all, PairResult& pair) {
  const CompiledShaft shaft = compile(pair.from.box, pair.to.box);
  for (Candidate& candidate : pair.candidates) candidate.blocks = blocked(shaft, all[candidate.bound].box);
}

void run(const CullOptions& options) {
  options.isa.select();
  CullReport report{options.path,
                    Grain::object,
                    std::string(name(active_isa())),
                    load_mesh_isolated(options.path, options.bounds == "triangle"),
                    {},
                    {},
                    options.solid};
  report.pairs = pairs_of(report.scene, options);
  report.grain = grain_of(options, report.pairs.front());
  report.bounds = bounds_of(report.scene, report.grain);
  const Contact contact = options.contact == "open" ? Contact::open : Contact::closed;
  const MinMaxRecords records{&report.bounds.front().box.lo, &report.bounds.front().box.hi, sizeof(CullBound),
                              report.bounds.size()};
  if (options.tree) {
    const BoxTree tree(records);
    for (PairResult& pair : report.pairs) find_candidates(report.bounds, tree, contact, pair);
  } else {
    const BoxStream stream(records);
    for (PairResult& pair : report.pairs) find_candidates(report.bounds, stream, contact, pair);
  }
  if (options.solid) {
    for (PairResult& pair : report.pairs) find_blockers(report.bounds, pair);
  }
  std::fputs(format_report(report, format_of(options)).c_str(), stdout);
}

}  // namespace

void add_cull(CLI::App& program) {
  const auto options = std::make_shared<CullOptions>();
  CLI::App& cull = *program.add_subcommand("cull", "List what may lie between two objects, or parts, of a mesh file");
  CLI::Option* scene =
      cull.add_option("scene,--scene", options->path, "Mesh file, in any format that assimp reads")->type_name("FILE");
  cull.add_option("--bounds", options->bounds,
                  "What gets a bound: object, part or triangle (default: object, or part if the ends are parts)")
      ->check(CLI::IsMember({"object", "part", "triangle"}))
      ->type_name("KIND");
  CLI::Option* from = cull.add_option("--from", options->from,
                                      "One end: a name (room, or room part 3), or lo x,lo y,lo z,hi x,hi y,hi z")
                          ->type_name("NAME|BOX");
  CLI::Option* to = cull.add_option("--to", options->to, "The other end")->type_name("NAME|BOX");
  from->needs(to);
  to->needs(from);
  CLI::Option* random =
      add_number(cull, "--random", options->random_pairs, 1, 1'000'000, "Between N random pairs instead")
          ->type_name("N");
  random->excludes(from)->excludes(to);
  cull.add_option("--ends", options->ends,
                  "What --random pairs: object or part (default: part if there are fewer than 4 objects)")
      ->check(CLI::IsMember({"object", "part"}))
      ->type_name("KIND")
      ->needs(random);
  add_number(cull, "--seed", options->seed, 0, largest_seed, "Seed of --random (default: 1)")
      ->type_name("S")
      ->needs(random);
  cull.add_option("--format", options->format, "Output: text, json or csv (default: text)")
      ->check(CLI::IsMember({"text", "json", "csv"}))
      ->type_name("FORMAT");
  cull.add_flag("--tree", options->tree,
                "Put the bounds into a tree instead of scanning all of them: the same answers");
  cull.add_flag("--solid", options->solid,
                "Take bounds for solid boxes, and say which of them block: hide all of one end from the other");
  cull.add_option(
          "--contact", options->contact,
          "What becomes of bounds that only touch the shaft: closed keeps them, open does not (default: closed)")
      ->check(CLI::IsMember({"closed", "open"}))
      ->type_name("CONTACT");
  options->isa.add_option(cull);
  cull.footer(
      "The two ends themselves are not listed: they always meet the shaft between them. A candidate's answer is\n"
      "\"inside\" if its bound is fully inside the shaft, else \"overlap\"; with --solid it is \"blocks\" if every\n"
      "segment between the two ends passes through it.\n"
      "Parts are triangles of one object that lie close together: the object is halved along its widest axis, and so\n"
      "are its halves, until a part has no more than a 64th of the file's triangles.");
  cull.callback([options, scene] {
    if (scene->count() == 0) {
      throw InvalidArgument("cull: in what file? Give shaftcull cull FILE --from NAME --to NAME, or FILE --random 10");
    }
    run(*options);
  });
}

}  // namespace shaftcull::cli
