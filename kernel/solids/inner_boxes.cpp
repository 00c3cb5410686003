// SPDX-License-Identifier: MIT
#include "solids/inner_boxes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "solids/bodies.hpp"

namespace shaftcull::kernel {
namespace {

/// Cells are counted by triangles, so that time is about proportional to these.
constexpr std::size_t cells_of_a_part = 64;
constexpr std::size_t cells_of_a_triangle = 2;
constexpr std::size_t most_cells = 4096;

double volume(const Box& box) noexcept {
  double product = 1;
  for (std::size_t k = 0; k != 3; ++k) product *= double{box.hi[k]} - box.lo[k];
  return product;
}

/// Coordinates on each axis.
using Grid = std::array<std::vector<float>, 3>;

std::size_t cells(const Grid& grid) {
  std::size_t product = 1;
  for (const std::vector<float>& lines : grid) product *= lines.size() - 1;
  return product;
}

/// Leaves out every other line within.
void thin_out(std::vector<float>& lines) {
  std::size_t kept = 1;
  for (std::size_t i = 2; i + 1 < lines.size(); i += 2) lines[kept++] = lines[i];
  lines[kept++] = lines.back();
  lines.resize(kept);
}

/// Adds a line in the middle of the widest gap; false if none fits, or if there were too many cells.
bool halve_widest_gap(Grid& grid, std::size_t most) {
  unsigned axis = 0;
  std::size_t at = 0;
  const auto gap = [&](unsigned k, std::size_t i) { return double{grid[k][i + 1]} - grid[k][i]; };
  for (unsigned k = 0; k != 3; ++k) {
    for (std::size_t i = 0; i + 1 != grid[k].size(); ++i) {
      if (gap(k, i) <= gap(axis, at)) continue;
      axis = k;
      at = i;
    }
  }
  std::vector<float>& lines = grid[axis];
  const auto middle = static_cast<float>(lines[at] + gap(axis, at) / 2);
  if (middle <= lines[at] || middle >= lines[at + 1]) return false;
  if (cells(grid) / (lines.size() - 1) * lines.size() > most) return false;
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at + 1), middle);
  return true;
}

/// Whether the faces of a part are at right angles to axes.
bool is_upright(const WeldedMesh& mesh, const WeldedMesh::Part& part) {
  for (std::uint32_t triangle = part.first; triangle != part.end; ++triangle) {
    const SpannedPlane plane = mesh.plane(triangle);
    if ((plane.normal(0) != 0) + (plane.normal(1) != 0) + (plane.normal(2) != 0) > 1) return false;
  }
  return true;
}

/// The coordinates of a part's vertices, or some of them if there are many; others between them if faces are aslant.
Grid grid_of(const WeldedMesh& mesh, const WeldedMesh::Part& part) {
  Grid grid;
  for (unsigned k = 0; k != 3; ++k) {
    std::vector<float>& lines = grid[k];
    for (std::uint32_t edge = 3 * part.first; edge != 3 * part.end; ++edge) {
      const bool is_excluded = part.open_at && part.open_at->axis == k && part.open_at->excludes(mesh.start(edge));
      lines.push_back(is_excluded ? part.open_at->coordinate : mesh.start(edge)[k]);
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    if (lines.size() < 2) return {};
  }
  const std::size_t most = std::min(most_cells, cells_of_a_part + cells_of_a_triangle * (part.end - part.first));
  while (cells(grid) > most) {
    thin_out(
        *std::max_element(grid.begin(), grid.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); }));
  }
  if (!is_upright(mesh, part)) {
    while (halve_widest_gap(grid, most)) continue;
  }
  return grid;
}

class Cells {
 public:
  Cells(const WeldedMesh& mesh, const WeldedMesh::Part& part) : mesh_(mesh), part_(part), lines_(grid_of(mesh, part)) {
    std::vector<Triangle> triangles;
    for (std::uint32_t t = part.first; t != part.end; ++t) {
      triangles.push_back({{mesh.start(3 * t), mesh.start(3 * t + 1), mesh.start(3 * t + 2)}});
    }
    triangles_ = TriangleTree(std::span<const Triangle>(triangles));
  }

  /// The cells that the part surrounds.
  [[nodiscard]] std::vector<Box> inside() {
    if (lines_[0].empty()) return {};
    state_.assign(count(0) * count(1) * count(2), State::unknown);
    std::vector<Box> found;
    for (std::size_t cell = 0; cell != state_.size(); ++cell) {
      if (state_[cell] == State::unknown) spread(cell);
      if (state_[cell] == State::inside) found.push_back(box(cell));
    }
    return found;
  }

 private:
  enum class State : std::uint8_t { unknown, crossed, outside, inside };

  [[nodiscard]] std::size_t count(unsigned k) const { return lines_[k].size() - 1; }
  [[nodiscard]] std::size_t stride(unsigned k) const { return k == 0 ? 1 : k == 1 ? count(0) : count(0) * count(1); }
  [[nodiscard]] std::size_t place(std::size_t cell, unsigned k) const { return cell / stride(k) % count(k); }
  [[nodiscard]] Box box(std::size_t cell) const {
    Box box{};
    for (unsigned k = 0; k != 3; ++k) {
      box.lo[k] = lines_[k][place(cell, k)];
      box.hi[k] = lines_[k][place(cell, k) + 1];
    }
    return box;
  }
  /// Whether no triangle reaches into the box.
  [[nodiscard]] bool is_free(const Box& box) const {
    return !any(compile(box, box, Contact::open), triangles_, {.triangle_test = TriangleTest::exact});
  }
  [[nodiscard]] bool is_surrounded(const Box& box) const {
    Vec3 middle{};
    for (std::size_t k = 0; k != 3; ++k) {
      middle[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
      if (!(middle[k] > box.lo[k] && middle[k] < box.hi[k])) return false;
    }
    const std::optional<int> turns = winding(mesh_, part_, middle);
    return turns && *turns > 0;
  }

  /// Gives a cell its state, and all others that no triangle parts from it.
  void spread(std::size_t seed) {
    if (!is_free(box(seed))) {
      state_[seed] = State::crossed;
      return;
    }
    const State state = is_surrounded(box(seed)) ? State::inside : State::outside;
    state_[seed] = state;
    std::vector<std::size_t> open{seed};
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      for (unsigned k = 0; k != 3; ++k) {
        for (const bool up : {false, true}) {
          if (up ? place(cell, k) + 1 == count(k) : place(cell, k) == 0) continue;
          const std::size_t beside = up ? cell + stride(k) : cell - stride(k);
          if (state_[beside] != State::unknown) continue;
          const Box one = box(cell);
          const Box other = box(beside);
          if (!is_free({up ? one.lo : other.lo, up ? other.hi : one.hi})) continue;
          state_[beside] = state;
          open.push_back(beside);
        }
      }
    }
  }

  const WeldedMesh& mesh_;
  const WeldedMesh::Part& part_;
  Grid lines_;
  TriangleTree triangles_;
  std::vector<State> state_;
};

}  // namespace

std::vector<Box> inner_boxes(const WeldedMesh& mesh, const WeldedMesh::Part& part) {
  if (!part.is_closed) return {};
  Cells cells(mesh, part);
  std::vector<Box> boxes = merged_boxes(cells.inside());
  std::stable_sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return volume(a) > volume(b); });
  return boxes;
}

}  // namespace shaftcull::kernel
