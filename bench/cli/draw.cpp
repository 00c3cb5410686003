/// `shaftcull draw`: three slices through a shaft, in characters.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "box_text.hpp"
#include "instruction_set.hpp"
#include "number.hpp"
#include "shaftcull/shaftcull.hpp"
#include "subcommand.hpp"

namespace shaftcull::cli {
namespace {

struct DrawOptions {
  // The pair that the paper's harness shows first.
  std::string from = "0,0,0,1,1,1";
  std::string to = "-1,-1,0.5,-0.5,1.5,1.5";
  int columns = 48;
  InstructionSet isa;
};

/// A character is about twice as high as wide.
constexpr double character_aspect = 2.0;
/// Cells of outside drawn around the shaft box.
constexpr int margin = 2;

/// The cells of one slice: `across` and `up` are the axes of the picture, `through` the axis that is cut.
struct Slice {
  std::size_t across;
  std::size_t up;
  std::size_t through;
};

bool holds(const Box& box, std::size_t axis, double x) {
  return x >= static_cast<double>(box.lo[axis]) && x <= static_cast<double>(box.hi[axis]);
}

/// Draws slices of one shaft, all at one scale.
class Picture {
 public:
  Picture(const Box& a, const Box& b, int columns)
      : shaft_(a, b), compiled_(compile(shaft_)), cell_width_(widest(shaft_.box()) / (columns - 2 * margin)) {
    // A shaft that is a point has no extent to scale by.
    if (cell_width_ == 0) cell_width_ = 1;
  }

  std::string draw(const Slice& slice) const {
    const double cut = middle(slice.through);
    std::string text = fmt::format("{}{} slice at {} = {:.4g}  ({} to the right, {} up)\n", "xyz"[slice.across],
                                   "xyz"[slice.up], "xyz"[slice.through], cut, "xyz"[slice.across], "xyz"[slice.up]);
    const double cell_height = cell_width_ * character_aspect;
    const int columns = cells(slice.across, cell_width_);
    const int rows = cells(slice.up, cell_height);
    for (int row = rows - 1; row >= 0; --row) {
      const double y = middle(slice.up) + (row - (rows - 1) / 2.0) * cell_height;
      text += fmt::format("{:>8.3g} ", y);
      for (int column = 0; column < columns; ++column) {
        const double x = middle(slice.across) + (column - (columns - 1) / 2.0) * cell_width_;
        text += mark(slice, x, y, cut);
      }
      text += '\n';
    }
    const double left = middle(slice.across) - (columns - 1) / 2.0 * cell_width_;
    const double right = middle(slice.across) + (columns - 1) / 2.0 * cell_width_;
    text += fmt::format("{:9}{:<{}.3g}{:>{}.3g}\n", "", left, columns / 2, right, columns - columns / 2);
    return text;
  }

 private:
  static double widest(const Box& box) {
    double width = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      width = std::max(width, static_cast<double>(box.hi[axis]) - static_cast<double>(box.lo[axis]));
    }
    return width;
  }

  double middle(std::size_t axis) const {
    return (static_cast<double>(shaft_.box().lo[axis]) + static_cast<double>(shaft_.box().hi[axis])) / 2;
  }

  int cells(std::size_t axis, double size) const {
    const double extent = static_cast<double>(shaft_.box().hi[axis]) - static_cast<double>(shaft_.box().lo[axis]);
    return static_cast<int>(std::ceil(extent / size)) + 2 * margin;
  }

  /// The letter of a box in this cell: a capital where the slice cuts it, small where it lies before or behind
  /// the slice, 0 where it is not.
  static char box_mark(const Box& box, const Slice& slice, double x, double y, double cut, char letter) {
    if (!holds(box, slice.across, x) || !holds(box, slice.up, y)) return 0;
    return holds(box, slice.through, cut) ? letter : static_cast<char>(letter - 'A' + 'a');
  }

  char mark(const Slice& slice, double x, double y, double cut) const {
    const char a = box_mark(shaft_.a(), slice, x, y, cut, 'A');
    const char b = box_mark(shaft_.b(), slice, x, y, cut, 'B');
    // What the slice cuts hides what lies before or behind it.
    if (a != 0 && b != 0 && (a == 'A') == (b == 'B')) return '@';
    if (a == 'A' || (a != 0 && b == 0)) return a;
    if (b != 0) return b;
    const double half_height = cell_width_ * character_aspect / 2;
    Box cell{};
    set(cell, slice.across, x, cell_width_ / 2);
    set(cell, slice.up, y, half_height);
    // A cell has no thickness: with one, no cell could be inside a flat shaft.
    set(cell, slice.through, cut, 0);
    switch (classify(compiled_, cell)) {
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
    box.lo[axis] = static_cast<float>(centre - half_extent);
    box.hi[axis] = static_cast<float>(centre + half_extent);
  }

  Shaft shaft_;
  CompiledShaft compiled_;
  double cell_width_;
};

void run(const DrawOptions& options) {
  options.isa.select();
  const Box a = box_option("--from", options.from);
  const Box b = box_option("--to", options.to);
  const Picture picture(a, b, options.columns);
  fmt::print("A = [{}]\nB = [{}]\n", to_text(a), to_text(b));
  fmt::print(
      "{} joining planes. A B boxes (a b: before or behind the slice, @: both), # inside, + overlap, . outside\n",
      Shaft(a, b).joining_planes().size());
  for (const Slice& slice : {Slice{0, 1, 2}, Slice{0, 2, 1}, Slice{1, 2, 0}}) fmt::print("\n{}", picture.draw(slice));
}

}  // namespace

void add_draw(CLI::App& program) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App& draw = *program.add_subcommand("draw", "Draw three slices through the middle of a shaft");
  draw.add_option("--from", options->from, "Box A: lo x,lo y,lo z,hi x,hi y,hi z")->type_name("BOX");
  draw.add_option("--to", options->to, "Box B, likewise")->type_name("BOX");
  add_number(draw, "--size", options->columns, 12, 400,
             "Columns that the longest side of the picture takes (default: 48)")
      ->type_name("COLS");
  options->isa.add_option(draw);
  draw.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
