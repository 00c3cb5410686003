// SPDX-License-Identifier: MIT
/// `shaftcull draw`: slices through a shaft, in characters, or a picture of it, in SVG.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "box_text.hpp"
#include "drawing.hpp"
#include "instruction_set.hpp"
#include "number.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/paper.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"

namespace shaftcull::cli {
namespace {

struct DrawOptions {
  // The pair that the paper's harness shows first.
  std::string from = "0,0,0,1,1,1";
  std::string to = "-1,-1,0.5,-0.5,1.5,1.5";
  ShaftChoice choice;
  std::vector<std::string> bounds;
  std::vector<std::string> solids;
  std::vector<std::string> corners;  ///< of triangles, three each
  bool times = false;
  int columns = 48;
  bool svg = false;
  std::string view = "xy";
  InstructionSet isa;
};

/// A character is about twice as high as wide.
constexpr double character_aspect = 2.0;
/// Cells of outside drawn around what is shown.
constexpr int margin = 2;

/// The cells of one slice: `across` and `up` are the axes of the picture, `through` the axis that is cut.
struct Slice {
  std::size_t across;
  std::size_t up;
  std::size_t through;
};

std::array<Point3, 3> corners_of(const Triangle& triangle) {
  return {in_doubles(triangle.vertex[0]), in_doubles(triangle.vertex[1]), in_doubles(triangle.vertex[2])};
}

bool holds(const Box& box, std::size_t axis, double x) {
  return x >= static_cast<double>(box.lo[axis]) && x <= static_cast<double>(box.hi[axis]);
}

/// What the plane x[axis] = cut has of a triangle: a segment, a point, all of it, or nothing.
std::vector<Point3> cut_through(const Triangle& triangle, std::size_t axis, double cut) {
  std::vector<Point3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 p = in_doubles(triangle.vertex[i]);
    const Point3 q = in_doubles(triangle.vertex[(i + 1) % 3]);
    const double from_p = p[axis] - cut;
    const double from_q = q[axis] - cut;
    if (from_p == 0) points.push_back(p);
    if ((from_p < 0 && from_q > 0) || (from_p > 0 && from_q < 0)) {
      Point3 crossing{};
      for (std::size_t k = 0; k < 3; ++k) crossing[k] = p[k] + from_p / (from_p - from_q) * (q[k] - p[k]);
      points.push_back(crossing);
    }
  }
  return points;
}

/// Draws slices of one shaft, all at one scale.
class Picture {
 public:
  Picture(const ShaftDrawing& drawing, int columns)
      : drawing_(drawing), cell_width_(widest(drawing.frame) / (columns - 2 * margin)) {
    // A shaft that is a point has no extent to scale by.
    if (cell_width_ == 0) cell_width_ = 1;
  }

  std::string draw(const Slice& slice) const {
    const double cut = drawing_.frame.middle(slice.through);
    std::string text = fmt::format("{}{} slice at {} = {:.4g}  ({} to the right, {} up)\n", "xyz"[slice.across],
                                   "xyz"[slice.up], "xyz"[slice.through], cut, "xyz"[slice.across], "xyz"[slice.up]);
    const double cell_height = cell_width_ * character_aspect;
    const int columns = cells(slice.across, cell_width_);
    const int rows = cells(slice.up, cell_height);
    for (int row = rows - 1; row >= 0; --row) {
      const double y = drawing_.frame.middle(slice.up) + (row - (rows - 1) / 2.0) * cell_height;
      text += fmt::format("{:>8.3g} ", y);
      for (int column = 0; column < columns; ++column) {
        const double x = drawing_.frame.middle(slice.across) + (column - (columns - 1) / 2.0) * cell_width_;
        text += mark(slice, x, y, cut);
      }
      text += '\n';
    }
    const double left = drawing_.frame.middle(slice.across) - (columns - 1) / 2.0 * cell_width_;
    const double right = drawing_.frame.middle(slice.across) + (columns - 1) / 2.0 * cell_width_;
    text += fmt::format("{:9}{:<{}.3g}{:>{}.3g}\n", "", left, columns / 2, right, columns - columns / 2);
    return text;
  }

 private:
  static double widest(const ShownSpace& frame) {
    return std::max({frame.extent(0), frame.extent(1), frame.extent(2)});
  }

  int cells(std::size_t axis, double size) const {
    return static_cast<int>(std::ceil(drawing_.frame.extent(axis) / size)) + 2 * margin;
  }

  /// The letter of a box in this cell: a capital where the slice cuts it, small where it lies before or behind
  /// the slice, 0 where it is not.
  static char box_mark(const std::optional<Box>& box, const Slice& slice, double x, double y, double cut, char letter) {
    if (!box || !holds(*box, slice.across, x) || !holds(*box, slice.up, y)) return 0;
    return holds(*box, slice.through, cut) ? letter : static_cast<char>(letter - 'A' + 'a');
  }

  /// T where the slice cuts a triangle, t where one lies before or behind it, 0 where there is none.
  char triangle_mark(const Slice& slice, double x, double y, double cut) const {
    const auto is_in_cell = [&](std::span<const Point3> points) {
      std::vector<Point2> seen;
      for (const Point3& point : points) seen.push_back({point[slice.across], point[slice.up]});
      const double half_height = cell_width_ * character_aspect / 2;
      return meets_rectangle(hull_outline(seen), {x - cell_width_ / 2, y - half_height},
                             {x + cell_width_ / 2, y + half_height});
    };
    char mark = 0;
    for (const DrawnTriangle& drawn : drawing_.triangles) {
      if (is_in_cell(cut_through(drawn.triangle, slice.through, cut))) return 'T';
      if (is_in_cell(corners_of(drawn.triangle))) mark = 't';
    }
    return mark;
  }

  char mark(const Slice& slice, double x, double y, double cut) const {
    // What the slice cuts hides what lies before or behind it.
    const char a = box_mark(drawing_.a, slice, x, y, cut, 'A');
    const char b = box_mark(drawing_.b, slice, x, y, cut, 'B');
    if (a == 'A' && b == 'B') return '@';
    if (a == 'A') return a;
    if (b == 'B') return b;
    const char triangle = triangle_mark(slice, x, y, cut);
    if (triangle == 'T') return triangle;
    if (a != 0 && b != 0) return '@';
    for (const char seen : {a, b, triangle}) {
      if (seen != 0) return seen;
    }
    const double half_height = cell_width_ * character_aspect / 2;
    Box cell{};
    set(cell, slice.across, x, cell_width_ / 2);
    set(cell, slice.up, y, half_height);
    // A cell has no thickness: with one, no cell could be inside a flat shaft.
    set(cell, slice.through, cut, 0);
    switch (classify(drawing_.shaft.compiled(), cell)) {
      case Answer::inside:
        return '#';
      case Answer::overlap:
        return '+';
      case Answer::outside:
        break;
    }
    return '.';
  }

  static void set(Box& box, std::size_t axis, double centre, double half_extent) {
    constexpr double most = std::numeric_limits<float>::max();
    box.lo[axis] = static_cast<float>(std::clamp(centre - half_extent, -most, most));
    box.hi[axis] = static_cast<float>(std::clamp(centre + half_extent, -most, most));
  }

  const ShaftDrawing& drawing_;
  double cell_width_;
};

/// What the user asks about: bounds, then solids.
std::vector<DrawnBound> bounds_of(const DrawOptions& options, const CompiledShaft& shaft) {
  std::vector<DrawnBound> bounds;
  for (const std::string& text : options.bounds) bounds.push_back({box_option("--bound", text), {}, false, {}});
  for (const std::string& text : options.solids) bounds.push_back({box_option("--solid", text), {}, false, {}});
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    bounds[i].answer = classify(shaft, bounds[i].box);
    bounds[i].blocks = i >= options.bounds.size() && occluded(shaft, bounds[i].box);
  }
  if (!options.times) return bounds;
  std::vector<Box> boxes;
  for (const DrawnBound& bound : bounds) boxes.push_back(bound.box);
  std::vector<std::uint32_t> indices(bounds.size());
  std::iota(indices.begin(), indices.end(), 0U);
  std::vector<float> times(bounds.size());
  entry_times(shaft, BoxStream(boxes), indices, times);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (bounds[i].answer != Answer::outside) bounds[i].time = times[i];
  }
  return bounds;
}

std::vector<DrawnTriangle> triangles_of(const DrawOptions& options, const CompiledShaft& shaft) {
  const std::vector<std::string>& corners = options.corners;
  if (corners.size() % 3 != 0) {
    throw InvalidArgument(fmt::format("--triangle {}: {} corners; a triangle takes three: X,Y,Z X,Y,Z X,Y,Z",
                                      fmt::join(corners, " "), corners.size()));
  }
  if (corners.empty()) return {};
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    triangles[i / 3].vertex[i % 3] = vector_option("--triangle", corners[i], "a corner");
  }
  std::vector<std::uint64_t> kept(bit_words(triangles.size()));
  std::vector<std::uint64_t> inside(kept.size());
  classify(shaft, TriangleStream(triangles), kept, inside);
  std::vector<DrawnTriangle> drawn;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    drawn.push_back({triangles[i], BitView(inside)[i] ? Answer::inside
                                   : BitView(kept)[i] ? Answer::overlap
                                                      : Answer::outside});
  }
  return drawn;
}

ShaftDrawing drawing_of(const DrawOptions& options) {
  const ShaftChoice& choice = options.choice;
  const Box from = box_option("--from", options.from);
  const Box to = box_option("--to", options.to);
  ShaftDrawing drawing{choice, {}, {}, choice.form(from, to), {}, {}, region_of(choice, from, to), {}};
  if (choice.has_from()) drawing.a = from;
  if (choice.has_to()) drawing.b = to;
  if (choice.kind() == ShaftKind::swept) drawing.b = drawing.shaft.compiled().b();
  drawing.bounds = bounds_of(options, drawing.shaft.compiled());
  drawing.triangles = triangles_of(options, drawing.shaft.compiled());
  std::vector<Point3> shown;
  const auto show = [&](const Box& box) { shown.insert(shown.end(), {in_doubles(box.lo), in_doubles(box.hi)}); };
  for (const std::optional<Box>& end : {drawing.a, drawing.b}) {
    if (end) show(*end);
  }
  for (const DrawnBound& bound : drawing.bounds) show(bound.box);
  for (const DrawnTriangle& drawn : drawing.triangles) {
    for (const Vec3& vertex : drawn.triangle.vertex) shown.push_back(in_doubles(vertex));
  }
  drawing.frame = frame_around(drawing.region, shown);
  return drawing;
}

/// The lines above the slices: what the letters are.
std::string heading_of(const ShaftDrawing& drawing) {
  const ShaftChoice& choice = drawing.choice;
  const auto box = [](const std::optional<Box>& end) { return to_text(*end); };
  std::string what;
  switch (choice.kind()) {
    case ShaftKind::between:
      what = fmt::format("A = [{}]\nB = [{}]\n{} joining planes", box(drawing.a), box(drawing.b),
                         Shaft(*drawing.a, *drawing.b).joining_planes().size());
      break;
    case ShaftKind::swept:
      what = fmt::format("body A = [{}]\nends at B = [{}]\nSwept by {}", box(drawing.a), box(drawing.b),
                         to_text(choice.motion()));
      break;
    case ShaftKind::swept_infinite:
      what = fmt::format("body A = [{}]\nSwept without end along {}", box(drawing.a), to_text(choice.motion()));
      break;
    case ShaftKind::shadow:
      what = fmt::format(
          "light A = [{}]\noccluder B = [{}]\nShadow {}", box(drawing.a), box(drawing.b),
          choice.reach() ? fmt::format("up to {} times the distance of the occluder", *choice.reach()) : "without end");
      break;
    case ShaftKind::hull:
      what = fmt::format("Convex hull of {} points", choice.points().size());
      if (!choice.directions().empty()) {
        what += fmt::format(", extended without end towards {}", to_text(choice.directions().front()));
      }
      break;
  }
  std::string letters;
  if (drawing.b) {
    letters = " A B boxes (a b: before or behind the slice, @: both),";
  } else if (drawing.a) {
    letters = " A box (a: before or behind the slice),";
  }
  if (!drawing.triangles.empty()) letters += " T triangle (t: before or behind it),";
  return fmt::format("{}.{} # inside, + overlap, . outside\n", what, letters);
}

void run(const DrawOptions& options) {
  options.isa.select();
  const ShaftDrawing drawing = drawing_of(options);
  if (options.svg) {
    const auto axis = [&](std::size_t i) { return static_cast<std::size_t>(options.view[i] - 'x'); };
    std::fputs(svg_of(drawing, axis(0), axis(1)).c_str(), stdout);
    return;
  }
  const Picture picture(drawing, options.columns);
  fmt::print("{}", heading_of(drawing));
  for (const DrawnBound& bound : drawing.bounds) fmt::print("[{}]: {}\n", to_text(bound.box), label_of(bound));
  for (const DrawnTriangle& drawn : drawing.triangles) {
    const auto& [p, q, r] = drawn.triangle.vertex;
    fmt::print("triangle [{} {} {}]: {}\n", to_text(p), to_text(q), to_text(r), label_of(drawn));
  }
  for (const Slice& slice : {Slice{0, 1, 2}, Slice{0, 2, 1}, Slice{1, 2, 0}}) fmt::print("\n{}", picture.draw(slice));
}

}  // namespace

void add_draw(CLI::App& program) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App& draw = *program.add_subcommand("draw", "Draw slices through the middle of a shaft, or a picture of it");
  CLI::Option* from = draw.add_option("--from", options->from,
                                      "Box A, which is also the body or the light: lo x,lo y,lo z,hi x,hi y,hi z")
                          ->type_name("BOX");
  CLI::Option* to = draw.add_option("--to", options->to, "Box B, which is also the occluder")->type_name("BOX");
  options->choice.add_options(draw, to);
  CLI::Option* solid = draw.add_option("--solid", options->solids,
                                       "Solid boxes to show, and whether they block, that is, hide all of A from B")
                           ->type_name("BOX")
                           ->excludes("--swept")
                           ->excludes("--shadow");
  CLI::Option* times =
      draw.add_flag("--times", options->times, "Show when the moving box reaches each bound: 0 at A, 1 at B");
  draw.add_option("--triangle", options->corners, "Triangles to show, three corners each, with their answers")
      ->type_name("X,Y,Z X,Y,Z X,Y,Z");
  options->choice.add_hull_options(draw, std::array{from, to, solid, times});
  draw.add_option("--bound", options->bounds, "Boxes to show, with their answers")->type_name("BOX");
  CLI::Option* size =
      add_number(draw, "--size", options->columns, 12, 400, "Columns for the longest side of the picture (default: 48)")
          ->type_name("COLS");
  CLI::Option* svg =
      draw.add_flag("--svg", options->svg, "Write an SVG file to standard output instead of slices")->excludes(size);
  draw.add_option("--view", options->view, "With --svg: the two axes to show (default: xy)")
      ->check(CLI::IsMember({"xy", "xz", "yz"}))
      ->type_name("AXES")
      ->needs(svg);
  options->isa.add_option(draw);
  draw.footer(
      "By default, the shaft lies between two boxes. With --swept, it is the volume that a body\n"
      "sweeps over; with --shadow, the volume that an occluder can shadow from a light; with\n"
      "--hull, a convex hull. Shafts without end are cut off at the edge of the picture.\n"
      "Times are shares of the displacement, or multiples of it with --infinite. For a shadow,\n"
      "the time is 0 at the occluder, and 1 at twice its distance from the light.\n"
      "Triangles are tested exactly. They have no times.");
  draw.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
