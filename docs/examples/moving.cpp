// Two bodies move at once. Seen from the one, the other moves by the difference of both.
#include <cmath>
#include <cstdio>
#include <limits>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

namespace {

struct Body {
  sc::Box box;
  sc::Vec3 travel;  // in this frame
};

// The space that body a sweeps over, as seen from body b. The box of a is made larger by the
// rounding error of the difference.
sc::CompiledShaft seen_from(const Body& b, const Body& a) {
  sc::Vec3 travel{};
  float error = 0;
  for (std::size_t axis = 0; axis != 3; ++axis) {
    travel[axis] = a.travel[axis] - b.travel[axis];
    error = std::fmax(error, std::fabs(travel[axis]) * std::numeric_limits<float>::epsilon());
  }
  return sc::swept(sc::inflated(a.box, error), travel);
}

}  // namespace

int main() {
  const std::vector<Body> bodies = {
      {{{0, 0, 0}, {1, 1, 1}}, {8, 0, 0}},     // 0: to the right
      {{{9, 0, 0}, {10, 1, 1}}, {-8, 0, 0}},   // 1: towards it
      {{{0, 4, 0}, {1, 5, 1}}, {8, 0, 0}},     // 2: beside, with the first
      {{{5, -6, 0}, {6, -5, 1}}, {0, 9, 0}}};  // 3: across

  // Pairs that may meet: all sweeps query a tree of boxes around the whole path of each body.
  std::vector<sc::Box> starts;
  std::vector<sc::Box> ways;
  std::vector<sc::CompiledShaft> sweeps;
  for (const Body& body : bodies) {
    starts.push_back(body.box);
    ways.push_back(sc::joined(body.box, sc::translated(body.box, body.travel)));
    sweeps.push_back(sc::swept(body.box, body.travel));
  }
  const sc::BoxStream at_start(starts);
  sc::IndexLists candidates;
  sc::list_many(sweeps, sc::BoxTree(ways), candidates);

  for (std::uint32_t a = 0; a != bodies.size(); ++a) {
    for (const std::uint32_t b : candidates[a]) {
      if (b <= a) continue;  // each pair once, and no body with itself
      float time = 0;
      sc::entry_times(seen_from(bodies[b], bodies[a]), at_start, std::span(&b, 1), {&time, 1});
      std::printf("%u and %u: %.3f\n", a, b, time);  // infinite if they pass each other
    }
  }
}
