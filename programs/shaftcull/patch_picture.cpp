// SPDX-License-Identifier: MIT
#include "patch_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

constexpr double picture_width = 720;
constexpr double most_height = 560;
constexpr double margin = 16;
constexpr double legend_height = 44;
constexpr double bar_width = 260;
constexpr double bar_height = 12;
constexpr std::size_t shades = 48;

std::string shade(const ColourRamp& ramp, std::size_t number) {
  const std::array<int, 3> rgb = colour_at(ramp, static_cast<double>(number) / (shades - 1));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// Patches by height: one that is seen from above hides those before it.
class PatchPicture {
 public:
  /// The maps lie beside each other.
  PatchPicture(const PictureFaces& faces, std::span<const ShareMap> maps, std::size_t up)
      : faces_(faces),
        maps_(maps),
        map_width_(picture_width / static_cast<double>(maps.size())),
        across_((up + 1) % 3),
        along_((up + 2) % 3),
        up_(up),
        height_(faces.size()) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces_up(i)) shown_.push_back(i);
    }
    for (const std::size_t i : shown_) height_[i] = height_of(i);
    std::stable_sort(shown_.begin(), shown_.end(),
                     [&](std::size_t p, std::size_t q) { return height_[p] < height_[q]; });
    find_frame();
  }

  std::string text(const std::string& title) {
    const double width = picture_width;
    const double height = (hi_[1] - lo_[1]) * scale_ + 2 * margin + legend_height;
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 {0} {1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n"
        "  <title>{2}, {3} to the right, {4} up</title>\n"
        "  <rect width=\"{0}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
        width, height, title, "xyz"[across_], "xyz"[along_]);
    for (std::size_t i = 0; i < maps_.size(); ++i) {
      if (i != 0) svg_ += fmt::format("  <g transform=\"translate({} 0)\">\n", static_cast<double>(i) * map_width_);
      add_map(maps_[i], height - legend_height + 4);
      if (i != 0) svg_ += "  </g>\n";
    }
    return svg_ + "</svg>\n";
  }

 private:
  /// Upwards; both ways if faces are seen from both sides.
  [[nodiscard]] bool faces_up(std::size_t face) const {
    const std::span<const Point3> corner = faces_.of(face);
    Point3 normal{};
    for (std::size_t c = 2; c < corner.size(); ++c) {
      for (std::size_t k = 0; k != 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        normal[k] += (corner[c - 1][i] - corner[0][i]) * (corner[c][j] - corner[0][j]) -
                     (corner[c - 1][j] - corner[0][j]) * (corner[c][i] - corner[0][i]);
      }
    }
    const double up = normal[up_] / std::hypot(normal[0], normal[1], normal[2]);
    constexpr double edge_on = 1e-3;
    return up > edge_on || (faces_.both_sides && up < -edge_on);
  }

  [[nodiscard]] double height_of(std::size_t face) const {
    const std::span<const Point3> corner = faces_.of(face);
    double sum = 0;
    for (const Point3& of : corner) sum += of[up_];
    return sum / static_cast<double>(corner.size());
  }

  void find_frame() {
    lo_ = {0, 0};
    hi_ = {0, 0};
    bool is_first = true;
    for (const Box& box : faces_.objects) {
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t axis = i == 0 ? across_ : along_;
        lo_[i] = is_first ? box.lo[axis] : std::min(lo_[i], double{box.lo[axis]});
        hi_[i] = is_first ? box.hi[axis] : std::max(hi_[i], double{box.hi[axis]});
      }
      is_first = false;
    }
    const double units = std::max((hi_[0] - lo_[0]) / (map_width_ - 2 * margin), (hi_[1] - lo_[1]) / most_height);
    scale_ = units > 0 ? 1 / units : 1;
    left_ = (map_width_ - (hi_[0] - lo_[0]) * scale_) / 2;
  }

  /// Tenths of a pixel.
  [[nodiscard]] std::array<long, 2> on_page(const Point3& point) const {
    return {std::lround(10 * (left_ + (point[across_] - lo_[0]) * scale_)),
            std::lround(10 * (margin + (hi_[1] - point[along_]) * scale_))};
  }

  void add_map(const ShareMap& map, double legend_top) {
    double most = 0;
    for (const std::size_t i : shown_) most = std::max(most, map.shares[i]);
    add_patches(map, most);
    add_legend(map, most, legend_top);
  }

  void add_patches(const ShareMap& map, double most) {
    // Strokes close the gaps that smooth edges leave between neighbours.
    svg_ +=
        "  <g transform=\"scale(0.1)\" fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\"5\" "
        "stroke-linejoin=\"round\">\n";
    for (std::size_t first = 0; first < shown_.size();) {
      // Those of one height do not hide each other, so those of one colour become one path.
      std::size_t end = first + 1;
      while (end < shown_.size() && height_[shown_[end]] == height_[shown_[first]]) ++end;
      add_level(map, most, std::span(shown_).subspan(first, end - first));
      first = end;
    }
    svg_ += "  </g>\n";
  }

  void add_level(const ShareMap& map, double most, std::span<const std::size_t> patches) {
    std::array<std::string, shades> paths;
    for (const std::size_t i : patches) {
      const double place = most > 0 ? map.shares[i] / most : 0;
      std::string& path = paths[static_cast<std::size_t>(std::lround(place * (shades - 1)))];
      std::array<long, 2> before{};
      const std::span<const Point3> corner = faces_.of(i);
      for (std::size_t c = 0; c < corner.size(); ++c) {
        const std::array<long, 2> at = on_page(corner[c]);
        path += fmt::format("{}{} {}", c == 0 ? "M" : c == 1 ? "l" : " ", at[0] - before[0], at[1] - before[1]);
        before = at;
      }
      path += 'z';
    }
    for (std::size_t s = 0; s < shades; ++s) {
      if (paths[s].empty()) continue;
      svg_ += fmt::format("    <path color=\"{}\" d=\"{}\"/>\n", shade(map.ramp, s), paths[s]);
    }
  }

  void add_legend(const ShareMap& map, double most, double top) {
    svg_ += fmt::format("  <defs><linearGradient id=\"{}\">", map.name);
    for (std::size_t i = 0; i < map.ramp.size(); ++i) {
      const std::size_t number = i * (shades - 1) / (map.ramp.size() - 1);
      svg_ += fmt::format("<stop offset=\"{:.3f}\" stop-color=\"{}\"/>", static_cast<double>(number) / (shades - 1),
                          shade(map.ramp, number));
    }
    const double left = margin + 30;
    const double bar = bar_width / static_cast<double>(maps_.size());
    svg_ += fmt::format(
        "</linearGradient></defs>\n"
        "  <g fill=\"#495057\">\n"
        "    <text x=\"{0}\" y=\"{1:.2f}\" text-anchor=\"end\">0 %</text>\n"
        "    <rect x=\"{2}\" y=\"{3:.2f}\" width=\"{4}\" height=\"{5}\" rx=\"2\" fill=\"url(#{9})\"/>\n"
        "    <text x=\"{6}\" y=\"{1:.2f}\">{7:.{8}f} % {10}</text>\n"
        "  </g>\n",
        left - 6, top + 15, left, top + 4, bar, bar_height, left + bar + 6, 100 * most, most < 0.1 ? 1 : 0, map.name,
        map.words);
  }

  const PictureFaces& faces_;
  std::span<const ShareMap> maps_;
  double map_width_;
  std::size_t across_;
  std::size_t along_;
  std::size_t up_;
  std::vector<double> height_;      ///< of patches that are shown
  std::vector<std::size_t> shown_;  ///< by height
  Point2 lo_{};
  Point2 hi_{};
  double scale_ = 1;
  double left_ = 0;
  std::string svg_;
};

}  // namespace

std::string picture_of(const PictureFaces& faces, std::span<const ShareMap> maps, std::size_t up,
                       const std::string& title) {
  return PatchPicture(faces, maps, up).text(title);
}

}  // namespace shaftcull::cli
