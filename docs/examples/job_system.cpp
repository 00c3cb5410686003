// The library on a job system of your own: here, of the standard library.
#include <cstdio>
#include <future>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

// [[executor]]
class Jobs final : public sc::Executor {
 public:
  void run(std::size_t count, sc::FunctionRef<void(std::size_t)> task) override {
    std::vector<std::future<void>> jobs;
    for (std::size_t i = 1; i < count; ++i) {
      jobs.push_back(std::async(std::launch::async, [task, i] { task(i); }));
    }
    task(0);  // on this thread
    for (std::future<void>& job : jobs) job.wait();
  }
  std::size_t threads() const noexcept override { return 4; }
};
// [[end]]

int main() {
  Jobs jobs;
  sc::set_executor(&jobs);
  const std::vector<sc::Box> boxes(100000, sc::Box{{0, 0, 0}, {1, 1, 1}});
  const std::vector<sc::CompiledShaft> shafts(
      100, sc::compile(sc::Box{{0, 0, 0}, {1, 1, 1}}, sc::Box{{5, 0, 0}, {6, 1, 1}}));
  std::vector<std::uint64_t> counts(shafts.size());
  sc::count_many(shafts, sc::BoxTree(boxes), counts);
  std::printf("%d threads; each shaft keeps %llu boxes\n", sc::concurrency(),
              static_cast<unsigned long long>(counts[0]));
  sc::set_executor(nullptr);  // before jobs goes
}
