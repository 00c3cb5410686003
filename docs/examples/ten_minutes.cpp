// The snippets of docs/ten-minutes.md, in one program.
#include <array>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <span>
#include <vector>

namespace sc = shaftcull;

int main() {
  // [[first cull]]
  const sc::Box lamp{{0, 9, 0}, {1, 10, 1}};
  const sc::Box table{{4, 0, 4}, {6, 1, 6}};
  std::vector<sc::Box> scene = {
      {{2, 4, 2}, {3, 5, 3}}, {{8, 0, 0}, {9, 3, 1}}, {{4, -1, 4}, {6, 0, 6}}};

  sc::BoxStream boxes(scene);  // checked, aligned, one stream per coordinate
  const sc::CompiledShaft shaft = sc::compile(lamp, table);
  std::vector<std::uint64_t> kept(sc::bit_words(boxes.size()));
  cull(shaft, boxes, kept);  // bit i: box i may stand between
  for (std::size_t i = 0; i != scene.size(); ++i) {
    std::printf("box %zu %s\n", i, sc::BitView(kept)[i] ? "may" : "cannot");
  }
  // [[end]]

  // [[many shafts]]
  const std::vector<sc::Box> ends = {lamp, table, {{9, 9, 9}, {9, 9, 9}}};
  const std::vector<sc::IndexPair> pairs = {{0, 1}, {0, 2}, {1, 2}};
  const sc::BoxStream end_boxes(ends);
  std::vector<sc::CompiledShaft> shafts(pairs.size());
  sc::compile_batch(end_boxes, end_boxes, pairs, shafts);  // 5 to 9 ns per shaft

  sc::IndexLists lists;
  list_many(shafts, boxes, lists);  // in parallel
  for (std::size_t s = 0; s != lists.size(); ++s) {
    std::printf("shaft %zu keeps %zu\n", s, lists[s].size());
  }
  // [[end]]

  // [[tree]]
  sc::BoxTree tree(scene);                           // sorted once; takes the same queries
  list_many(shafts, tree, lists, {.exclude = {2}});  // box 2 is left out
  std::printf("%zu without box 2, %s\n", lists[0].size(),
              any(shafts[0], tree) ? "some with it" : "none with it");
  // [[end]]

  // [[frames]]
  for (int frame = 0; frame != 3; ++frame) {
    for (sc::Box& box : scene) box = sc::translated(box, {0.5F, 0, 0});
    tree.update(std::span<const sc::Box>(scene));            // allocates nothing, sorts nothing
    const sc::CompiledShaft now = sc::compile(lamp, table);  // form shafts again: nanoseconds
    std::printf("frame %d: %zu\n", frame, count(now, tree));
  }
  if (tree.sah_ratio() > 2) tree.rebuild();  // when much has moved far
  // [[end]]

  // [[kinds]]
  const sc::Box crate{{3, 8, 2}, {4, 9, 3}};
  const sc::CompiledShaft sweep = sc::swept(crate, {0, -6, 0});
  const sc::CompiledShaft sunlit = sc::swept_infinite(table, {-1, 2, -1});
  const sc::CompiledShaft hidden = sc::shadow(lamp, scene[0]);
  const std::array<sc::Vec3, 4> corners = {{{0, 0, 0}, {4, 0, 0}, {0, 9, 0}, {5, 5, 5}}};
  const sc::ConvexHull hull(corners);  // keep it while it is queried
  std::printf("%zu %zu %zu %zu\n", count(sweep, tree), count(sunlit, tree), count(hidden, tree),
              count(hull, tree));

  if (const auto contact = first_contact(sweep, tree)) {
    std::printf("first box %u, after %.2f of the way\n", contact.index, contact.time);
  }
  // [[end]]

  // [[contact]]
  const sc::Box floor{{-9, -1, -9}, {9, 0, 9}};  // the table stands on it
  std::printf("closed: %d, open: %d\n", keeps(sc::compile(lamp, table), floor),
              keeps(sc::compile(lamp, table, sc::Contact::open), floor));
  // [[end]]

  // [[occluded]]
  const sc::Box wall{{-9, 5, -9}, {9, 6, 9}};  // solid: it fills its box
  std::printf("%s\n", occluded(shaft, wall) ? "the lamp does not light the table" : "it may");
  // [[end]]

  // [[errors]]
  try {
    scene[1].lo[0] = 99;  // beyond hi
    boxes.update(0, scene);
  } catch (const sc::BadBound& error) {
    std::printf("%s\n", error.what());
  }
  // [[end]]
}
