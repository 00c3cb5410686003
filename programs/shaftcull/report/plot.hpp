// SPDX-License-Identifier: MIT
/// What all plots of the report share: ink, marks and labels, as gnuplot takes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/summary_file.hpp"

namespace shaftcull::cli {

/// A script for gnuplot, and what each element of its plot command tells a reader who points at it; nothing if empty.
struct Drawing {
  std::string script;
  std::vector<std::string> tooltips;
};

/// A picture with its words.
struct Plot {
  std::string title;
  std::string caption;
  Drawing drawing;
  bool wide = false;
};

/// The plots; nothing where too little of what they show was measured.
[[nodiscard]] std::optional<Plot> plot_rates(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_ratios(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_bounds(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_shafts(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_threads(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_shares(const BenchSummary& summary);
[[nodiscard]] std::optional<Plot> plot_roofline(const BenchSummary& summary);

/// Colours are drawn as these numbers; the page turns them into its own, light or dark.
enum Ink : int {
  ink_text = 1,
  ink_muted,
  ink_grid,
  ink_scalar,
  ink_sse4_2,
  ink_avx2,
  ink_avx512,
  ink_portable128,
  ink_end
};

/// "#040404" for ink_scalar: what gnuplot is told.
[[nodiscard]] std::string colour(Ink ink);

/// An instruction set as plots show it.
struct Look {
  const char* isa;
  const char* label;
  Ink ink;
  int mark;  ///< gnuplot's point type; the shape differs too, for those who do not see colours
};
inline constexpr Look looks[] = {{"scalar", "scalar", ink_scalar, 7},
                                 {"portable128", "portable", ink_portable128, 11},
                                 {"sse4_2", "SSE4.2", ink_sse4_2, 5},
                                 {"avx2", "AVX2", ink_avx2, 9},
                                 {"avx512", "AVX-512", ink_avx512, 13}};

/// The look of that instruction set; nothing if the report does not know it.
[[nodiscard]] const Look* look_of(const std::string& isa);

/// The last instruction set of the machine that the report knows.
[[nodiscard]] const Look* best_look(const BenchSummary& summary);

/// What every script begins with; the area of the plot is [left, right] × [bottom, top] of the picture, from 0 to 1.
struct Frame {
  int width = 560;
  int height = 360;
  double left = 0.09;
  double right = 0.80;
  double bottom = 0.14;
  double top = 0.88;
};
[[nodiscard]] std::string preamble(const Frame& frame);

/// A point of a curve.
struct Point {
  double x;
  double y;
};

/// A curve with its name next to its end.
struct Curve {
  std::string name;
  Ink ink;
  int mark;
  bool dashed;
  std::vector<Point> points;  ///< ascending x
};

/// `script`, and after it datablocks, labels (moved apart where they would overlap) and the plot command for `curves`,
/// in 10⁹ tests a second on a linear y axis from 0 to `top`.
[[nodiscard]] Drawing draw_curves(std::string script, const std::vector<Curve>& curves, double top);

}  // namespace shaftcull::cli
