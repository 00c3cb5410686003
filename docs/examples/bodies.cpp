// Bodies that come, go and move; a second thread looks at snapshots meanwhile.
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <thread>
#include <vector>

namespace sc = shaftcull;

int main() {
  sc::DynamicBoxTree tree;
  std::vector<const char*> names;  // by index
  const auto add = [&](const char* name, const sc::Box& box) {
    const sc::BoundId id = tree.insert(box);
    if (id.index >= names.size()) names.resize(id.index + 1);
    names[id.index] = name;
    return id;
  };
  const sc::BoundId door = add("door", {{4, 0, 0}, {4.1F, 1, 2}});
  const sc::BoundId cart = add("cart", {{7, 0, 0}, {8, 1, 1}});
  add("wall", {{10, -5, 0}, {11, 5, 3}});
  tree.commit();

  // What hits this ball on its way?
  const sc::CompiledShaft way = sc::swept({{0, 0.4F, 0.4F}, {0.2F, 0.6F, 0.6F}}, {20, 0, 0});
  const auto report = [&](const char* when) {
    const sc::FirstContact hit = sc::first_contact(way, tree);
    std::printf("%s: the ball hits the %s first, of %zu\n", when, names[hit.index],
                sc::count(way, tree));
  };
  report("at first");

  tree.erase(door);
  tree.move_by(cart, {-2, 0, 0});
  report("before the commit");  // nothing has changed yet
  const sc::BoxTreeSnapshot before = tree.snapshot();
  tree.commit();
  report("after it");

  // Another thread queries its snapshot while this thread changes the tree.
  std::size_t seen = 0;
  std::thread reader([&] { seen = sc::count(way, before); });
  tree.move(cart, {{7, 3, 0}, {8, 4, 1}});
  add("crate", {{2, 0, 0}, {3, 1, 1}});  // with the index that the door had
  tree.commit();
  reader.join();
  report("with a crate");
  std::printf("the reader saw %zu; the door %s\n", seen,
              tree.has(door) ? "is there" : "is gone");
}
