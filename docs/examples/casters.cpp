// What can cast a shadow on a receiver: of the sun, of a bulb, of a lamp with a size.
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

namespace {

void print(const char* light, const sc::CompiledShaft& shaft, const sc::BoxTree& tree) {
  std::vector<std::uint32_t> casters;
  list(shaft, tree, casters);
  std::printf("%s:", light);
  for (const std::uint32_t caster : casters) std::printf(" %u", caster);
  std::printf("\n");
}

}  // namespace

int main() {
  const sc::Box receiver{{0, 0, 0}, {4, 4, 0}};  // a patch of floor
  const std::vector<sc::Box> scene = {
      {{1, 1, 2}, {2, 2, 3}},        // 0: above the floor
      {{6, 1, 5}, {7, 3, 6}},        // 1: towards the sun
      {{1, 1, 12}, {3, 3, 13}},      // 2: above the lamps
      {{3.2F, 1, 5}, {3.4F, 2, 6}},  // 3: shadows the floor from a part of the lamp only
      {{-9, -9, 7}, {9, 9, 7}}};     // 4: a ceiling below the lamps
  const sc::BoxTree tree(scene);

  const sc::Vec3 towards_sun{1, 0, 1};
  print("sun", sc::swept_infinite(receiver, towards_sun), tree);

  const sc::Vec3 bulb{2, 2, 10};
  print("point light", sc::compile(sc::Box{bulb, bulb}, receiver), tree);

  // The shaft between an area light and a receiver holds every ray between them. Closed contact
  // would keep objects that stand on the floor beside the receiver, or hang beside the lamp;
  // open contact leaves out objects that only touch the shaft.
  const sc::Box lamp{{1, 1, 10}, {3, 3, 10}};
  const sc::CompiledShaft lit = sc::compile(lamp, receiver, sc::Contact::open);
  print("area light", lit, tree);

  // Query only solid boxes. The ceiling is solid, and the box around a tree is not.
  std::printf("the ceiling alone takes all light: %s\n",
              sc::occluded(lit, scene[4]) ? "yes" : "no");
}
