// Two of oneTBB's threads in an arena of your own, and a call from one of your own tasks.
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  std::vector<sc::Box> scene;
  for (int i = 0; i != 10'000; ++i) {
    const float x = static_cast<float>(i);
    scene.push_back({{x, 0, 0}, {x + 0.5F, 1, 1}});
  }
  const sc::BoxTree tree(scene);
  std::vector<sc::CompiledShaft> shafts;
  for (int s = 0; s != 100; ++s) {
    const float x = 90 * static_cast<float>(s);
    shafts.push_back(sc::swept(sc::Box{{x, 2, 0}, {x + 20, 3, 1}}, {0, -2, 0}));
  }

  // Calls run in the arena that they are made in, on its threads.
  std::vector<std::uint64_t> counts(shafts.size());
  // [[arena]]
  tbb::task_arena arena(2);
  arena.execute([&] { sc::count_many(shafts, tree, counts); });
  // [[end]]

  // A task may make calls, too. While it waits in one, its thread takes none of your other
  // tasks, so it may hold a lock.
  std::vector<std::uint64_t> again(shafts.size());
  arena.execute([&] {
    tbb::task_group group;
    group.run([&] { sc::count_many(shafts, tree, again); });
    group.wait();
  });
  std::printf("shaft 0 keeps %llu; %s\n", static_cast<unsigned long long>(counts[0]),
              counts == again ? "the same from a task" : "other counts from a task");
}
