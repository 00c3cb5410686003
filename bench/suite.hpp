/// What is measured: named benchmarks, what each is compared with, and the ratios to be reached.
///
/// A family is one source file with a function that declares its benchmarks and, next to them, its targets.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "workload.hpp"

namespace shaftcull::bench {

/// A benchmark, and the name of the one of the paper's method that does the same job (empty if there is none).
struct Entry {
  std::string name;
  std::string paper;
};

/// A ratio to be reached: the speed of `measured` over that of `against`, both from the same run.
struct Target {
  std::string measured;
  std::string against;
  double ratio;
};

class Suite {
 public:
  /// `body` sets items_per_second of its state by state.SetItemsProcessed().
  void add(const std::string& name, const std::string& paper, std::function<void(benchmark::State&)> body);
  void reach(const std::string& measured, const std::string& against, double ratio);
  /// Something that the reader of the table should know.
  void note(const std::string& text);

  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
  [[nodiscard]] const std::vector<Target>& targets() const noexcept { return targets_; }
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

 private:
  std::vector<Entry> entries_;
  std::vector<Target> targets_;
  std::vector<std::string> notes_;
};

/// The families. `workload` must outlive the run.
void declare_paper(Suite& suite, const Workload& workload);  ///< paper/…: the method measured against
void declare_form(Suite& suite, const Workload& workload);   ///< form/…: from two boxes to a test-ready shaft
void declare_many(Suite& suite, const Workload& workload);   ///< test/…: many shafts × many bounds
void declare_exact(Suite& suite, const Workload& workload);  ///< exact/…: what exact answers cost

}  // namespace shaftcull::bench
