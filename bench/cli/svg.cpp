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
  switch (answer) {
    case Answer::inside:
      return green;
    case Answer::overlap:
      return yellow;
    case Answer::outside:
      break;
  }
  return grey;
}

const Colours& colours_of(const DrawnBound& bound) { return bound.blocks ? dark : colours_of(bound.answer); }

std::string_view text_of(Answer answer) {
  switch (answer) {
    case Answer::inside:
      return "inside";
    case Answer::overlap:
      return "overlap";
    case Answer::outside:
      break;
  }
  return "outside";
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
    add_ends();
    for (const DrawnBound& bound : drawing_.bounds) {
      add_box(bound.box, colours_of(bound), "");
      add_label(bound.box, label_of(bound), colours_of(bound));
    }
    for (const DrawnTriangle& drawn : drawing_.triangles) add_triangle(drawn);
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

  std::string title() const {
    std::string_view what;
    switch (drawing_.choice.kind()) {
      case ShaftKind::between:
        what = "The shaft between two boxes";
        break;
      case ShaftKind::swept:
        what = "What a body sweeps over";
        break;
      case ShaftKind::swept_without_end:
        what = "What a body sweeps over without end";
        break;
      case ShaftKind::shadow:
        what = "What an occluder can shadow from a light";
        break;
      case ShaftKind::hull:
        what = drawing_.region.directions.empty() ? "A convex hull" : "A convex hull without end";
        break;
    }
    return fmt::format("{}, {} to the right, {} up", what, "xyz"[across_], "xyz"[up_]);
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

  void add_ends() {
    switch (drawing_.choice.kind()) {
      case ShaftKind::between:
        add_end(*drawing_.a, red, "A");
        add_end(*drawing_.b, blue, "B");
        break;
      case ShaftKind::swept:
        add_box(*drawing_.b, red, " stroke-dasharray=\"5 4\" fill-opacity=\"0.4\"");
        add_end(*drawing_.a, red, "body");
        add_arrow(*drawing_.a, drawing_.choice.motion(), true);
        break;
      case ShaftKind::swept_without_end:
        add_end(*drawing_.a, red, "body");
        add_arrow(*drawing_.a, drawing_.choice.motion(), false);
        break;
      case ShaftKind::shadow:
        add_rays();
        add_end(*drawing_.a, amber, "light");
        add_end(*drawing_.b, blue, "occluder");
        break;
      case ShaftKind::hull:
        add_corners();
        break;
    }
  }

  void add_end(const Box& box, const Colours& colours, std::string_view label) {
    add_box(box, colours, "");
    add_label(box, label, colours);
  }

  /// A box that is flat as it is seen is a line, or a dot: SVG does not draw rectangles without width or height.
  void add_box(const Box& box, const Colours& colours, std::string_view style) {
    const auto [left, top, right, bottom] = seen_box(box);
    const std::string width = pixels(right - left);
    const std::string height = pixels(bottom - top);
    if (width == "0" && height == "0") {
      svg_ += fmt::format("  <circle cx=\"{}\" cy=\"{}\" r=\"4.5\" fill=\"{}\"{}/>\n", pixels(left), pixels(top),
                          colours.line, style);
    } else if (width == "0" || height == "0") {
      svg_ += fmt::format("  <path d=\"M{},{} L{},{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"5\"{}/>\n",
                          pixels(left), pixels(top), pixels(right), pixels(bottom), colours.line, style);
    } else {
      svg_ += fmt::format(
          "  <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
          pixels(left), pixels(top), width, height, colours.fill, colours.line, style);
    }
  }

  void add_label(const Box& box, std::string_view label, const Colours& colours) {
    add_label(seen_box(box), label, colours, true);
  }

  /// Within the rectangle if that may be and it is large enough, else below it, or above it where the picture ends
  /// below.
  void add_label(const SeenBox& box, std::string_view label, const Colours& colours, bool may_be_within) {
    const double room = letter_width * static_cast<double>(label.size());
    const bool within = may_be_within && box.right - box.left >= room && box.bottom - box.top >= 1.2 * font_size;
    const double below = box.bottom + 1.1 * font_size;
    const bool fits_below = below + 0.3 * font_size < frame_.extent(up_) * scale_;
    const double y = within       ? (box.top + box.bottom) / 2 + 0.35 * font_size
                     : fits_below ? below
                                  : box.top - 0.4 * font_size;
    // Outside of the box, a white rim keeps the label apart from lines.
    const std::string style =
        within ? fmt::format("fill=\"{}\"", colours.fill == dark.fill ? "#ffffff" : colours.text)
               : fmt::format("fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"", colours.text);
    svg_ += fmt::format("  <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" {}>{}</text>\n",
                        pixels((box.left + box.right) / 2), pixels(y), style, label);
  }

  void add_triangle(const DrawnTriangle& drawn) {
    const Colours& colours = colours_of(drawn.answer);
    std::vector<Point2> corners;
    for (const Vec3& vertex : drawn.triangle.vertex) corners.push_back(seen(in_doubles(vertex)));
    svg_ += fmt::format(
        "  <polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\n",
        list_of(corners), colours.fill, colours.line);
    SeenBox around{1e300, 1e300, -1e300, -1e300};
    for (const Point2& corner : corners) {
      const Point2 page = on_page(corner);
      around = {std::min(around.left, page[0]), std::min(around.top, page[1]), std::max(around.right, page[0]),
                std::max(around.bottom, page[1])};
    }
    add_label(around, label_of(drawn), colours, false);
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
