// The boxes that a camera sees, and the boxes that must be drawn because their shadow falls
// into view.
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  const std::vector<sc::Box> scene = {
      {{-1, -1, 10}, {1, 1, 12}},   // 0: in front of the camera
      {{-1, 30, 20}, {1, 32, 22}},  // 1: high above the view
      {{30, -1, 5}, {32, 1, 7}},    // 2: to the right
      {{-1, -1, -9}, {1, 1, -7}},   // 3: behind it
      {{52, -5, 40}, {90, 5, 60}},  // 4: large, behind the far right corner
      {{0, -5, 45}, {9, -4, 49}}};  // 5: far away, on the ground
  const sc::BoxTree tree(scene);

  // Looks along z from the origin, a right angle wide and high, from 1 to 51. Row after row,
  // for column vectors; depth as in OpenGL. The floats of glm have to be transposed, those of
  // DirectXMath, too.
  const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};

  // A hull owns its planes: keep it while it is queried. About 1.4 µs each, once per frame.
  const sc::ConvexHull view = sc::frustum(matrix, sc::ClipDepth::minus_one_to_one);
  const sc::ConvexHull casters = sc::casters_towards(view, {0, 1, 0});  // sun at the zenith

  std::vector<std::uint64_t> seen(sc::bit_words(tree.size()));
  cull(view, tree, seen);
  for (const std::size_t i : sc::BitView(seen)) std::printf("box %zu is in view\n", i);

  std::vector<std::uint32_t> casting;
  list(casters, tree, casting, {.exclude_mask = seen});
  for (const std::uint32_t i : casting) std::printf("box %u only casts a shadow into it\n", i);

  // The six planes of the same view keep box 4: it is beyond none of them.
  const sc::CompiledShaft six_planes = sc::compile(
      tree.box(), tree.box(), sc::view_planes(matrix, sc::ClipDepth::minus_one_to_one));
  std::printf("box 4: six planes %s it, the hull %s it\n",
              keeps(six_planes, scene[4]) ? "keep" : "cull",
              keeps(view, scene[4]) ? "keeps" : "culls");
}
