// SPDX-License-Identifier: MIT
/// Drawings as SVG.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "drawing.hpp"

namespace shaftcull::cli {
namespace {

constexpr double largest_width = 720;
constexpr double largest_height = 400;
constexpr double free_edge = 30;  ///< around what is shown
constexpr double font_size = 15;
constexpr double letter_width = 8;  ///< about the widest that a letter is, on average

struct Colours {
  const char* fill;
  const char* line;
  const char* text;
};

constexpr Colours red{"#ffc9c9", "#c92a2a", "#8a1c1c"};
constexpr Colours blue{"#a5d8ff", "#1864ab", "#0b4a82"};
constexpr Colours amber{"#fff3bf", "#e67700", "#8a4b00"};
constexpr Colours grey{"#dee2e6", "#868e96", "#5c636a"};
constexpr Colours yellow{"#ffe066", "#b7791f", "#8a5a12"};
constexpr Colours green{"#8ce99a", "#2b8a3e", "#2b8a3e"};
constexpr Colours dark{"#495057", "#212529", "#212529"};

const Colours& colours_of(Answer answer) {
  return answer == Answer::inside ? green : answer == Answer::overlap ? yellow : grey;
}

const Colours& colours_of(const DrawnBound& bound) { return bound.blocks ? dark : colours_of(bound.answer); }

std::string_view text_of(Answer answer) {
  return answer == Answer::inside ? "inside" : answer == Answer::overlap ? "overlap" : "outside";
}

/// A tenth of a pixel is enough.
std::string pixels(double x) { return fmt::format("{}", std::round(x * 10) / 10 + 0.0); }

class SvgPicture {
 public:
  SvgPicture(const ShaftDrawing& drawing, std::size_t across, std::size_t up)
      : drawing_(drawing), across_(across), up_(up), frame_(drawing.frame) {
    const double width = frame_.extent(across);
    const double height = frame_.extent(up);
    const double most = std::max(width / (largest_width - 2 * free_edge), height / (largest_height - 2 * free_edge));
    scale_ = most > 0 ? 1 / most : 1;
    // What has no end goes on to the edge of the picture.
    for (const std::size_t axis : {across, up}) {
      frame_.lo[axis] -= free_edge / scale_;
      frame_.hi[axis] += free_edge / scale_;
    }
  }

  std::string text() {
    const double width = frame_.extent(across_) * scale_;
    const double height = frame_.extent(up_) * scale_;
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"{2}\">\n"
        "  <title>{3}</title>\n"
        "  <rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        pixels(width), pixels(height), font_size, title());
    add_region();
    add_ends(false);
    for (const DrawnBound& bound : drawing_.bounds) {
      add_box(bound.box, colours_of(bound), "");
      add_label(bound.box, label_of(bound), colours_of(bound));
    }
    for (const DrawnTriangle& drawn : drawing_.triangles) add_triangle(drawn);
    // Patches lie on walls, which would hide them.
    add_ends(true);
    return svg_ + "</svg>\n";
  }

 private:
  /// The rectangle that a box is seen as, in pixels.
  struct SeenBox {
    double left;
    double top;
    double right;
    double bottom;
  };

  SeenBox seen_box(const Box& box) const {
    const Point2 lo = on_page(seen(in_doubles(box.lo)));
    const Point2 hi = on_page(seen(in_doubles(box.hi)));
    return {lo[0], hi[1], hi[0], lo[1]};
  }

  /// Whether it has no extent once it is rounded to what pixels() writes.
  static bool is_thin(double extent) { return pixels(extent) == "0"; }
  static bool is_flat(const SeenBox& box) { return is_thin(box.right - box.left) || is_thin(box.bottom - box.top); }

  std::string title() const {
    std::string_view what;
    switch (drawing_.choice.kind()) {
      case ShaftKind::between:
        what = "The shaft between two boxes";
        break;
      case ShaftKind::swept:
        what = "The volume that a body sweeps over";
        break;
      case ShaftKind::swept_infinite:
        what = "The volume that a body sweeps over without end";
        break;
      case ShaftKind::shadow:
        what = "The volume that an occluder can shadow from a light";
        break;
      case ShaftKind::hull:
        what = drawing_.region.directions.empty() ? "A convex hull" : "A convex hull without end";
        break;
    }
    return fmt::format("{}{}, {} to the right, {} up", what,
                       drawing_.choice.contact() == Contact::open ? " with open contact" : "", "xyz"[across_],
                       "xyz"[up_]);
  }

  Point2 seen(const Point3& point) const { return {point[across_], point[up_]}; }
  Point2 on_page(const Point2& p) const {
    return {(p[0] - frame_.lo[across_]) * scale_, (frame_.hi[up_] - p[1]) * scale_};
  }
  std::string pair_of(const Point2& p) const {
    const Point2 page = on_page(p);
    return pixels(page[0]) + ',' + pixels(page[1]);
  }
  std::string list_of(const std::vector<Point2>& points) const {
    std::string list;
    for (const Point2& point : points) list += (list.empty() ? "" : " ") + pair_of(point);
    return list;
  }

  /// Whether both points are on the same edge of the picture: no face of the region is there.
  bool on_edge(const Point2& p, const Point2& q) const {
    const auto both_at = [&](std::size_t i, double x) { return p[i] == x && q[i] == x; };
    return both_at(0, frame_.lo[across_]) || both_at(0, frame_.hi[across_]) || both_at(1, frame_.lo[up_]) ||
           both_at(1, frame_.hi[up_]);
  }

  void add_region() {
    const std::vector<Point2> outline = outline_of(drawing_.region, frame_, across_, up_);
    if (outline.empty()) return;
    svg_ += fmt::format("  <polygon points=\"{}\" fill=\"#e8eefc\"/>\n", list_of(outline));
    std::string path;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point2& p = outline[i];
      const Point2& q = outline[(i + 1) % outline.size()];
      if (!on_edge(p, q)) path += fmt::format("{}M{} L{}", path.empty() ? "" : " ", pair_of(p), pair_of(q));
    }
    svg_ += fmt::format(
        "  <path d=\"{}\" fill=\"none\" stroke=\"#3b5bdb\" stroke-width=\"2.5\" stroke-linecap=\"round\"/>\n", path);
  }

  /// Those ends that are flat as they are seen, or those that are not, with all that belongs to ends.
  void add_ends(bool flat) {
    const auto add_end = [&](const Box& box, const Colours& colours, std::string_view label) {
      if (is_flat(seen_box(box)) != flat) return;
      add_box(box, colours, "");
      add_label(box, label, colours);
    };
    const auto add_way = [&](bool to_the_end) {
      if (!flat) add_arrow(*drawing_.a, drawing_.choice.motion(), to_the_end);
    };
    switch (drawing_.choice.kind()) {
      case ShaftKind::between:
        add_end(*drawing_.a, red, "A");
        add_end(*drawing_.b, blue, "B");
        break;
      case ShaftKind::swept:
        if (!flat) add_box(*drawing_.b, red, " stroke-dasharray=\"5 4\" fill-opacity=\"0.4\"");
        add_end(*drawing_.a, red, "body");
        add_way(true);
        break;
      case ShaftKind::swept_infinite:
        add_end(*drawing_.a, red, "body");
        add_way(false);
        break;
      case ShaftKind::shadow:
        if (!flat) add_rays();
        add_end(*drawing_.a, amber, "light");
        add_end(*drawing_.b, blue, "occluder");
        break;
      case ShaftKind::hull:
        if (!flat) add_corners();
        break;
    }
  }

  /// A box that is flat as it is seen is a line, or a dot: SVG does not draw rectangles without width or height.
  void add_box(const Box& box, const Colours& colours, std::string_view style) {
    const SeenBox seen = seen_box(box);
    const auto [left, top, right, bottom] = seen;
    if (is_thin(right - left) && is_thin(bottom - top)) {
      svg_ += fmt::format("  <circle cx=\"{}\" cy=\"{}\" r=\"4.5\" fill=\"{}\"{}/>\n", pixels(left), pixels(top),
                          colours.line, style);
    } else if (is_flat(seen)) {
      svg_ += fmt::format("  <path d=\"M{},{} L{},{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"5\"{}/>\n",
                          pixels(left), pixels(top), pixels(right), pixels(bottom), colours.line, style);
    } else {
      svg_ += fmt::format(
          "  <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
          pixels(left), pixels(top), pixels(right - left), pixels(bottom - top), colours.fill, colours.line, style);
    }
  }

  /// Within the box if it is large enough; beside it if it is an upright line; else below it, or above it where the
  /// picture ends below.
  void add_label(const Box& box, std::string_view label, const Colours& colours) {
    const SeenBox seen = seen_box(box);
    const double room = letter_width * static_cast<double>(label.size());
    const double middle = (seen.top + seen.bottom) / 2 + 0.35 * font_size;
    const bool is_high = seen.bottom - seen.top >= 1.2 * font_size;
    if (is_high && seen.right - seen.left >= room && !is_behind_triangle(seen)) {
      add_text({(seen.left + seen.right) / 2, middle}, "middle", label,
               fmt::format("fill=\"{}\"", colours.fill == dark.fill ? "#ffffff" : colours.text));
    } else if (is_high && is_thin(seen.right - seen.left)) {
      const bool is_left = seen.left < frame_.extent(across_) * scale_ / 2;
      add_text({seen.left + (is_left ? 0.6 : -0.6) * font_size, middle}, is_left ? "start" : "end", label,
               with_rim(colours));
    } else {
      add_label_below(seen, label, colours);
    }
  }

  void add_label_below(const SeenBox& seen, std::string_view label, const Colours& colours) {
    const double below = seen.bottom + 1.1 * font_size;
    const bool fits = below + 0.3 * font_size < frame_.extent(up_) * scale_;
    add_text({(seen.left + seen.right) / 2, fits ? below : seen.top - 0.4 * font_size}, "middle", label,
             with_rim(colours));
  }

  /// A white rim keeps text apart from lines.
  static std::string with_rim(const Colours& colours) {
    return fmt::format("fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"", colours.text);
  }

  /// In pixels.
  void add_text(const Point2& at, std::string_view anchor, std::string_view text, std::string_view style) {
    svg_ += fmt::format("  <text x=\"{}\" y=\"{}\" text-anchor=\"{}\" {}>{}</text>\n", pixels(at[0]), pixels(at[1]),
                        anchor, style, text);
  }

  void add_triangle(const DrawnTriangle& drawn) {
    const Colours& colours = colours_of(drawn.answer);
    std::vector<Point2> corners;
    for (const Vec3& vertex : drawn.triangle.vertex) corners.push_back(seen(in_doubles(vertex)));
    svg_ += fmt::format(
        "  <polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\n",
        list_of(corners), colours.fill, colours.line);
    for (Point2& corner : corners) corner = on_page(corner);
    add_label(corners, label_of(drawn), colours);
  }

  /// Around the middle of a triangle, in pixels, if it is large enough, else below it.
  void add_label(const std::vector<Point2>& corners, std::string_view label, const Colours& colours) {
    const auto [left, right] = std::minmax({corners[0][0], corners[1][0], corners[2][0]});
    const auto [top, bottom] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
    const Point2 middle{(corners[0][0] + corners[1][0] + corners[2][0]) / 3,
                        (corners[0][1] + corners[1][1] + corners[2][1]) / 3};
    const Point2 half_size{letter_width * static_cast<double>(label.size()) / 2, 0.6 * font_size};
    bool is_within = true;
    for (const double x : {middle[0] - half_size[0], middle[0] + half_size[0]}) {
      for (const double y : {middle[1] - half_size[1], middle[1] + half_size[1]}) {
        is_within = is_within && meets_rectangle(corners, {x, y}, {x, y});
      }
    }
    if (is_within) {
      add_text({middle[0], middle[1] + 0.35 * font_size}, "middle", label, fmt::format("fill=\"{}\"", colours.text));
    } else {
      add_label_below({left, top, right, bottom}, label, colours);
    }
  }

  /// Whether a triangle, which is drawn over boxes, would hide a label in the middle of this one.
  bool is_behind_triangle(const SeenBox& box) const {
    return std::any_of(drawing_.triangles.begin(), drawing_.triangles.end(), [&](const DrawnTriangle& drawn) {
      std::vector<Point2> corners;
      for (const Vec3& vertex : drawn.triangle.vertex) corners.push_back(on_page(seen(in_doubles(vertex))));
      const Point2 middle{(box.left + box.right) / 2, (box.top + box.bottom) / 2};
      return meets_rectangle(corners, {middle[0] - font_size, middle[1] - font_size},
                             {middle[0] + font_size, middle[1] + font_size});
    });
  }

  /// From the edge of the box towards where it goes: as far as it does, or a short way.
  void add_arrow(const Box& box, const Vec3& motion, bool to_the_end) {
    const Point2 lo = on_page(seen(corner_of(box, 0)));
    const Point2 hi = on_page(seen(corner_of(box, 7)));
    const Point2 way{motion[across_] * scale_, -motion[up_] * scale_};
    const double length = std::hypot(way[0], way[1]);
    if (length == 0) return;
    constexpr double short_way = 60;
    double leaves = 1e30;
    for (std::size_t i = 0; i < 2; ++i) {
      if (way[i] != 0) leaves = std::min(leaves, std::abs(hi[i] - lo[i]) / 2 / std::abs(way[i]));
    }
    const Point2 centre{(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2};
    add_arrow_from({centre[0] + leaves * way[0], centre[1] + leaves * way[1]}, way,
                   to_the_end ? std::max(0.0, 1 - leaves) * length : short_way);
  }

  /// In pixels.
  void add_arrow_from(const Point2& start, const Point2& way, double length) {
    constexpr double head = 9;
    if (length < head) return;
    const double size = std::hypot(way[0], way[1]);
    const Point2 unit{way[0] / size, way[1] / size};
    const Point2 tip{start[0] + unit[0] * length, start[1] + unit[1] * length};
    const Point2 back{tip[0] - unit[0] * head, tip[1] - unit[1] * head};
    svg_ += fmt::format(
        "  <path d=\"M{},{} L{},{} M{},{} L{},{} L{},{}\" fill=\"none\" stroke=\"#212529\" stroke-width=\"1.5\"/>\n",
        pixels(start[0]), pixels(start[1]), pixels(tip[0]), pixels(tip[1]), pixels(back[0] - unit[1] * head / 2),
        pixels(back[1] + unit[0] * head / 2), pixels(tip[0]), pixels(tip[1]), pixels(back[0] + unit[1] * head / 2),
        pixels(back[1] - unit[0] * head / 2));
  }

  /// The rays of light that pass the occluder at its sides.
  void add_rays() {
    const auto cross = [](const Point2& p, const Point2& q) { return p[0] * q[1] - p[1] * q[0]; };
    struct Ray {
      Point2 from;
      Point2 to;
      Point2 way;
    };
    std::vector<Ray> rays;
    for (unsigned l = 0; l < 8; ++l) {
      for (unsigned o = 0; o < 8; ++o) {
        const Point2 from = seen(corner_of(*drawing_.a, l));
        const Point2 to = seen(corner_of(*drawing_.b, o));
        rays.push_back({from, to, {to[0] - from[0], to[1] - from[1]}});
      }
    }
    for (const double side : {-1.0, 1.0}) {
      const auto at_the_side = std::find_if(rays.begin(), rays.end(), [&](const Ray& ray) {
        return std::all_of(rays.begin(), rays.end(),
                           [&](const Ray& other) { return side * cross(ray.way, other.way) >= 0; });
      });
      if (at_the_side == rays.end()) continue;
      svg_ += fmt::format("  <path d=\"M{} L{}\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"5 4\"/>\n",
                          pair_of(at_the_side->from), pair_of(at_the_side->to), amber.line);
    }
  }

  /// A hull's points, those of them around the others joined, and the way that it goes on.
  void add_corners() {
    std::vector<Point2> points;
    for (const Point3& point : drawing_.region.points) points.push_back(seen(point));
    const std::vector<Point2> outline = hull_outline(points);
    if (!drawing_.region.directions.empty()) {
      svg_ +=
          fmt::format("  <polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.5\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                      list_of(outline), blue.fill, blue.line);
      Point2 centre{};
      for (const Point2& point : outline) {
        for (std::size_t i = 0; i < 2; ++i) centre[i] += point[i] / static_cast<double>(outline.size());
      }
      for (const Point3& direction : drawing_.region.directions) {
        const Point2 way{direction[across_] * scale_, -direction[up_] * scale_};
        constexpr double short_way = 60;
        if (std::hypot(way[0], way[1]) > 0) add_arrow_from(on_page(centre), way, short_way);
      }
    }
    for (const Point2& point : outline) {
      const Point2 page = on_page(point);
      svg_ +=
          fmt::format("  <circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"#212529\"/>\n", pixels(page[0]), pixels(page[1]));
    }
  }

  const ShaftDrawing& drawing_;
  std::size_t across_;
  std::size_t up_;
  ShownSpace frame_;
  double scale_ = 1;  ///< pixels a unit
  std::string svg_;
};

}  // namespace

std::string label_of(const DrawnBound& bound) {
  std::string label(bound.blocks ? "blocks" : text_of(bound.answer));
  if (bound.time) label += fmt::format(" from {}", *bound.time);
  return label;
}

std::string label_of(const DrawnTriangle& triangle) { return std::string(text_of(triangle.answer)); }

std::string svg_of(const ShaftDrawing& drawing, std::size_t across, std::size_t up) {
  return SvgPicture(drawing, across, up).text();
}

}  // namespace shaftcull::cli
