// SPDX-License-Identifier: MIT
#include "cull_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "box_text.hpp"
#include "printable.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

using Json = nlohmann::ordered_json;

const char* answer_name(const Candidate& candidate) {
  if (candidate.blocks) return "blocks";
  return candidate.inside ? "inside" : "overlap";
}

const char* grain_name(Grain grain) {
  return grain == Grain::object ? "object" : grain == Grain::part ? "part" : "triangle";
}

/// What tells a bound from others of its object: the number of its triangle or part; nothing if it is the object's.
std::string number_in_object(const CullReport& report, const CullBound& bound) {
  switch (report.grain) {
    case Grain::object:
      return "";
    case Grain::part:
      return fmt::format("{}", report.scene.parts[bound.part].number);
    case Grain::triangle:
      break;
  }
  return fmt::format("{}", bound.triangle);
}

/// Which shaft, and what is the case of those that it keeps.
struct Heading {
  std::string shaft;
  const char* verb;
};

Heading heading_of(const ShaftChoice& choice, const PairResult& pair) {
  switch (choice.kind()) {
    case ShaftKind::swept:
      return {fmt::format("{} swept by {}", pair.from.label, to_text(choice.motion())), "may be hit"};
    case ShaftKind::swept_infinite:
      return {fmt::format("{} swept without end along {}", pair.from.label, to_text(choice.motion())), "may be hit"};
    case ShaftKind::shadow:
      return {fmt::format("shadow of {} from {}", pair.to.label, pair.from.label), "may lie in it"};
    case ShaftKind::hull:
      return {fmt::format("convex hull of {} points", choice.points().size()), "may lie in it"};
    case ShaftKind::between:
      break;
  }
  return {fmt::format("{} -> {}", pair.from.label, pair.to.label), "may lie between"};
}

std::string as_text(const CullReport& report) {
  std::string text =
      fmt::format("{}: {}, {}, {}\n", printable(report.path), counted(report.scene.names.size(), "object"),
                  counted(report.bounds.size(), fmt::format("{} bound", grain_name(report.grain))), report.isa);
  if (report.scene.origin != WorldPoint{}) {
    text += fmt::format("computed relative to {}, where floats are finer\n", fmt::join(report.scene.origin, ", "));
  }
  for (const PairResult& pair : report.pairs) {
    const auto inside = static_cast<std::size_t>(
        std::count_if(pair.candidates.begin(), pair.candidates.end(), [](const Candidate& c) { return c.inside; }));
    const std::string kept = counted(pair.candidates.size(), grain_name(report.grain));
    const Heading heading = heading_of(report.choice, pair);
    text += fmt::format("\n{}: ", printable(heading.shaft));
    text += !report.first_only        ? fmt::format("{} {}", kept, heading.verb)
            : pair.candidates.empty() ? "nothing is reached"
                                      : fmt::format("{} is reached first", kept);
    text += fmt::format(" ({} inside, {} overlap)", grouped(inside), grouped(pair.candidates.size() - inside));
    if (report.solid) {
      const auto blocking = static_cast<std::size_t>(
          std::count_if(pair.candidates.begin(), pair.candidates.end(), [](const Candidate& c) { return c.blocks; }));
      text += blocking == 0 ? ", none of them blocks"
                            : fmt::format(", {} of them block{}", grouped(blocking), blocking == 1 ? "s" : "");
    }
    text += '\n';
    for (const Candidate& candidate : pair.candidates) {
      const CullBound& bound = report.bounds[candidate.bound];
      const std::string number = report.grain == Grain::object
                                     ? ""
                                     : fmt::format(" {} {}", grain_name(report.grain), number_in_object(report, bound));
      const std::string time = report.times ? fmt::format("  from {}", candidate.time) : "";
      text +=
          fmt::format("  {:<7}  {}{}  [{}]{}\n", answer_name(candidate), printable(report.scene.names[bound.object]),
                      number, to_text(bound.box, report.scene.origin), time);
    }
  }
  return text;
}

std::string as_csv(const CullReport& report) {
  std::string text = fmt::format("pair,from,to,object,{},answer,lo_x,lo_y,lo_z,hi_x,hi_y,hi_z{}\n",
                                 report.grain == Grain::part ? "part" : "triangle", report.times ? ",time" : "");
  for (std::size_t p = 0; p < report.pairs.size(); ++p) {
    const PairResult& pair = report.pairs[p];
    for (const Candidate& candidate : pair.candidates) {
      const CullBound& bound = report.bounds[candidate.bound];
      text += fmt::format("{},{},{},{},{},{},{}{}\n", p, csv_cell(pair.from.label), csv_cell(pair.to.label),
                          csv_cell(report.scene.names[bound.object]), number_in_object(report, bound),
                          answer_name(candidate), to_text(bound.box, report.scene.origin),
                          report.times ? fmt::format(",{}", candidate.time) : "");
    }
  }
  return text;
}

/// Where the point is in the file.
Json as_json(const Vec3& point, const WorldPoint& origin) {
  Json json = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) json.push_back(shortest(point[axis], origin[axis]));
  return json;
}

Json as_json(const Vec3& vector) { return as_json(vector, WorldPoint{}); }

Json as_json(const Box& box, const WorldPoint& origin) {
  return Json{{"lo", as_json(box.lo, origin)}, {"hi", as_json(box.hi, origin)}};
}

Json as_json(const ShaftChoice& choice, const WorldPoint& origin) {
  Json json{{"kind", std::string(name(choice.kind()))}};
  switch (choice.kind()) {
    case ShaftKind::swept:
      json["displacement"] = as_json(choice.motion());
      break;
    case ShaftKind::swept_infinite:
      json["direction"] = as_json(choice.motion());
      break;
    case ShaftKind::shadow:
      json["reach"] = choice.reach() ? Json(shortest(*choice.reach())) : Json(nullptr);
      break;
    case ShaftKind::hull:
      for (const Vec3& point : choice.points()) json["points"].push_back(as_json(point, origin));
      for (const Vec3& direction : choice.directions()) json["direction"] = as_json(direction);
      return json;
    case ShaftKind::between:
      break;
  }
  json["contact"] = choice.contact() == Contact::open ? "open" : "closed";
  return json;
}

Json as_json(const MeshScene& scene, const ShaftEnd& end) {
  Json json{{"object", end.object == none ? Json(nullptr) : Json(scene.names[end.object])}};
  if (end.part != none) json["part"] = scene.parts[end.part].number;
  json["box"] = as_json(end.box, scene.origin);
  return json;
}

std::string as_json(const CullReport& report) {
  Json pairs = Json::array();
  for (const PairResult& pair : report.pairs) {
    Json candidates = Json::array();
    for (const Candidate& candidate : pair.candidates) {
      const CullBound& bound = report.bounds[candidate.bound];
      Json entry{{"object", report.scene.names[bound.object]}};
      if (report.grain == Grain::part) entry["part"] = report.scene.parts[bound.part].number;
      if (report.grain == Grain::triangle) entry["triangle"] = bound.triangle;
      entry["answer"] = answer_name(candidate);
      entry["box"] = as_json(bound.box, report.scene.origin);
      if (report.times) entry["time"] = shortest(candidate.time);
      candidates.push_back(std::move(entry));
    }
    Json entry = Json::object();
    if (report.choice.has_from()) entry["from"] = as_json(report.scene, pair.from);
    if (report.choice.has_to()) entry["to"] = as_json(report.scene, pair.to);
    entry["candidates"] = std::move(candidates);
    pairs.push_back(std::move(entry));
    if (report.solid) {
      pairs.back()["occluded"] =
          std::any_of(pair.candidates.begin(), pair.candidates.end(), [](const Candidate& c) { return c.blocks; });
    }
  }
  Json root{{"scene", report.path},
            {"bounds", grain_name(report.grain)},
            {"objects", report.scene.names.size()},
            {"count", report.bounds.size()},
            {"isa", report.isa},
            {"shaft", as_json(report.choice, report.scene.origin)}};
  if (report.scene.origin != WorldPoint{}) root["origin"] = report.scene.origin;
  if (!report.triangles.empty()) root["triangles"] = report.triangles;
  root["pairs"] = std::move(pairs);
  // Names come from files: bytes that are not UTF-8 are replaced, not an error.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string format_report(const CullReport& report, ReportFormat format) {
  return in_format(format, report, as_text, as_json, as_csv);
}

}  // namespace shaftcull::cli
