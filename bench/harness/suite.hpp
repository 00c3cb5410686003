// SPDX-License-Identifier: MIT
/// What is measured: named benchmarks, what each is compared with, what is to be reached, and what limits it.
///
/// A family is one source file with a function that declares its benchmarks and, next to them, its targets and limits.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "scenes/workload.hpp"

namespace shaftcull::bench {

/// A benchmark, and the name of the one of the paper's method that does the same job (empty if there is none).
struct Entry {
  std::string name;
  std::string paper;
};

/// A figure to be reached, from one run.
struct Target {
  enum class Kind {
    speed_ratio,  ///< the speed of `measured` over that of `against`; at least `figure`
    time_ratio,   ///< the time of an item of `measured` over that of one of `against`; at most `figure`
    nanoseconds,  ///< the time that one item of `measured` takes; at most `figure`
  };
  std::string measured;
  std::string against;  ///< empty for nanoseconds
  double figure;
  Kind kind;

  [[nodiscard]] bool at_most() const noexcept { return kind != Kind::speed_ratio; }
};

/// `path` cannot be faster than `by` allows, because an item of it takes `units` items of `by`.
struct Limit {
  std::string path;
  std::string by;
  double units;
  std::string what;  ///< what the units are, for people
};

/// How a benchmark is run, where it is not like all others.
struct RunOptions {
  unsigned threads = 1;
  bool wall_clock = false;  ///< else processor time, which other programs disturb less but which counts one thread
  bool brief = false;       ///< a point of a curve: fewer and shorter repetitions
  bool once = false;        ///< takes seconds: a single run
};

class Suite {
 public:
  /// `quick` asks families for fewer points.
  explicit Suite(bool quick) : quick_(quick) {}
  [[nodiscard]] bool quick() const noexcept { return quick_; }

  /// `body` sets items_per_second of its state by state.SetItemsProcessed().
  void add(const std::string& name, const std::string& paper, std::function<void(benchmark::State&)> body,
           RunOptions options = {});
  /// Of speeds: `measured` at least `ratio` times that of `against`.
  void add_target(const std::string& measured, const std::string& against, double ratio);
  /// Of times: an item of `measured` at most `ratio` times that of one of `against`.
  void add_time_ratio_target(const std::string& measured, const std::string& against, double ratio);
  void add_time_target(const std::string& measured, double nanoseconds);
  void limit(const std::string& path, const std::string& by, double units, const std::string& what);
  /// Something that the reader of the table should know.
  void note(const std::string& text);

  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
  [[nodiscard]] const std::vector<Target>& targets() const noexcept { return targets_; }
  [[nodiscard]] const std::vector<Limit>& limits() const noexcept { return limits_; }
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

 private:
  bool quick_;
  std::vector<Entry> entries_;
  std::vector<Target> targets_;
  std::vector<Limit> limits_;
  std::vector<std::string> notes_;
};

/// The families: one function a file of families/, behind the beginning of the names that it declares. `workload` must
/// outlive the run.
///
/// paper/…: the method measured against
void declare_paper(Suite& suite, const Workload& workload);
/// form/…: from two boxes to a test-ready shaft
void declare_form(Suite& suite, const Workload& workload);
/// test/…: many shafts × many bounds
void declare_many(Suite& suite, const Workload& workload);
/// volumes/…: shafts of moving boxes × many boxes
void declare_volumes(Suite& suite, const Workload& workload);
/// contact/…: open contact, against closed
void declare_contact(Suite& suite, const Workload& workload);
/// hull/…: convex hulls × many boxes
void declare_hull(Suite& suite, const Workload& workload);
/// outputs/…: counts and index lists instead of bits
void declare_outputs(Suite& suite, const Workload& workload);
/// occluded/…: which solid boxes block shafts
void declare_occluded(Suite& suite, const Workload& workload);
/// triangles/…: triangles by vertices and exactly, and meshes
void declare_triangles(Suite& suite, const Workload& workload);
/// memory/…: one shaft × all bounds, and reading them
void declare_memory(Suite& suite, const Workload& workload);
/// small/…: one shaft × one word of bounds
void declare_small(Suite& suite, const Workload& workload);
/// single/…: one shaft or hull formed, one bound asked
void declare_single(Suite& suite, const Workload& workload);
/// sweep/…: by bounds, by shafts, by threads
void declare_sweep(Suite& suite, const Workload& workload);
/// roofline/…: what this machine can do at most
void declare_roofline(Suite& suite, const Workload& workload);
/// exact/…: what exact answers cost
void declare_exact(Suite& suite, const Workload& workload);
/// exact/touching/…: tests that floats cannot decide
void declare_touching(Suite& suite, const Workload& workload);
/// dynamic/…: bounds that come, go and move
void declare_dynamic(Suite& suite, const Workload& workload);
/// tree/…: bounds trees
void declare_tree(Suite& suite, const Workload& workload);
/// layers/…, tree/{list,count,any,at_most_10,first}/…: a part of what a tree would list
void declare_picking(Suite& suite, const Workload& workload);
/// tree/equal_short/…: short sweeps, against a uniform grid
void declare_short_sweeps(Suite& suite, const Workload& workload);
/// frame/…: moving bounds, updated and asked
void declare_frame(Suite& suite, const Workload& workload);
/// sees/…: which patches see each other, against shadow rays
void declare_sees(Suite& suite, const Workload& workload);
/// factors/…: view factors of all pairs, and rays
void declare_factors(Suite& suite, const Workload& workload);
/// origin/…: bounds in doubles, made floats
void declare_origin(Suite& suite, const Workload& workload);
/// flat_against_tree/…: flat scans and trees, by size and by what is found
void declare_flat_against_tree(Suite& suite, const Workload& workload);

}  // namespace shaftcull::bench
