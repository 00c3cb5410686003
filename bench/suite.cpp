#include "suite.hpp"

#include <utility>

namespace shaftcull::bench {

void Suite::add(const std::string& name, const std::string& paper, std::function<void(benchmark::State&)> body) {
  entries_.push_back({name, paper});
  benchmark::RegisterBenchmark(name.c_str(), [run = std::move(body)](benchmark::State& state) { run(state); });
}

void Suite::reach(const std::string& measured, const std::string& against, double ratio) {
  targets_.push_back({measured, against, ratio});
}

void Suite::note(const std::string& text) { notes_.push_back(text); }

}  // namespace shaftcull::bench
