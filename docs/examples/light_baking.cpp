// Light baking: which pairs of patches see each other, and which rays must be traced?
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  // Two rooms side by side, 4 by 4 patches on the floor and on the ceiling of each. A wall
  // between them, a table in one.
  std::vector<sc::Box> patches;
  for (const float room : {0.0F, 5.0F}) {
    for (const float z : {0.0F, 3.0F}) {
      for (const float x : {0.0F, 1.0F, 2.0F, 3.0F}) {
        for (const float y : {0.0F, 1.0F, 2.0F, 3.0F}) {
          patches.push_back({{room + x, y, z}, {room + x + 1, y + 1, z}});
        }
      }
    }
  }
  const std::vector<sc::Box> walls = {{{4, -1, -1}, {5, 5, 4}}};
  std::vector<sc::Box> objects = walls;
  objects.push_back({{1, 1, 0.5F}, {2, 2, 1}});  // the box around the table
  const sc::BoxTree occluders(objects);          // all that may be in the way
  const sc::BoxTree solids(walls);  // boxes that are filled: a wall is, a table is not

  // One shaft for each pair of a floor patch and a ceiling patch. With open contact the floor
  // beside a patch, and the wall that it lies on, are not in its way.
  std::vector<sc::IndexPair> pairs;
  for (std::uint32_t a = 0; a != patches.size(); ++a) {
    for (std::uint32_t b = a + 1; b != patches.size(); ++b) {
      if (patches[a].lo[2] != patches[b].lo[2]) pairs.push_back({a, b});
    }
  }
  const sc::BoxStream stream(patches);
  std::vector<sc::CompiledShaft> shafts(pairs.size());
  sc::compile_batch(stream, stream, pairs, shafts, {}, sc::Contact::open);

  // Bits: which pairs one solid box hides, and for which anything at all is in the way.
  std::vector<std::uint64_t> hidden(sc::bit_words(pairs.size()));
  std::vector<std::uint64_t> obstructed(sc::bit_words(pairs.size()));
  sc::occluded_many(shafts, solids, hidden);
  sc::any_many(shafts, occluders, obstructed);

  int dark = 0;
  int clear = 0;
  int to_trace = 0;
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    if (sc::BitView(hidden)[i]) {
      ++dark;
    } else if (sc::BitView(obstructed)[i]) {
      ++to_trace;  // sc::list_many() lists the objects to trace rays against
    } else {
      ++clear;  // the form factor needs no visibility
    }
  }
  std::printf("%zu pairs: %d dark, %d clear, %d to trace\n", pairs.size(), dark, clear,
              to_trace);
}
