// SPDX-License-Identifier: MIT
/// paper/…: the paper's method on workload W, bounds one by one.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "harness/suite.hpp"
#include "peers/paper/shaft.hpp"

namespace shaftcull::bench {
namespace {

/// A box as the paper's method takes it.
struct CornerBox {
  explicit CornerBox(const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[0][axis] = box.lo[axis];
      corners[1][axis] = box.hi[axis];
    }
  }
  paper::Corners corners;
};

struct Records {
  explicit Records(const Workload& workload)
      : boxes(workload.box_records.begin(), workload.box_records.end()),
        a(workload.a.begin(), workload.a.end()),
        b(workload.b.begin(), workload.b.end()) {
    for (const Sphere& sphere : workload.sphere_records) {
      const auto& [x, y, z] = sphere.centre;
      balls.push_back({{x, y, z}, sphere.radius});
    }
    for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
      shafts.emplace_back(a[i].corners, b[i].corners, paper::Options{});
    }
  }
  std::vector<CornerBox> boxes;
  std::vector<paper::Ball> balls;
  std::vector<CornerBox> a;
  std::vector<CornerBox> b;
  std::vector<paper::Shaft> shafts;
};

void set_items(benchmark::State& state, std::size_t items_per_iteration) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items_per_iteration));
}

/// Forms and frees the shaft of every pair: as cheap as the paper's method can be, unsorted and for boxes alone.
void form(benchmark::State& state, const Records& records, paper::Formation formation) {
  const paper::Options options{formation, false, false};
  for (auto _ : state) {
    for (std::size_t i = 0; i < records.a.size(); ++i) {
      const paper::Shaft shaft(records.a[i].corners, records.b[i].corners, options);
      benchmark::DoNotOptimize(shaft.first_plane());
    }
  }
  set_items(state, records.a.size());
}

}  // namespace

void declare_paper(Suite& suite, const Workload& workload) {
  const auto records = std::make_shared<const Records>(workload);

  suite.add("paper/form_runtime", "paper/form_table",
            [records](benchmark::State& state) { form(state, *records, paper::Formation::run_time); });
  suite.add("paper/form_table", "paper/form_table",
            [records](benchmark::State& state) { form(state, *records, paper::Formation::table); });

  suite.add("paper/boxes_cull", "paper/boxes_cull", [records](benchmark::State& state) {
    for (auto _ : state) {
      for (const paper::Shaft& shaft : records->shafts) {
        std::size_t kept = 0;
        for (const CornerBox& box : records->boxes) {
          if (!shaft.outside(box.corners)) ++kept;
        }
        benchmark::DoNotOptimize(kept);
      }
    }
    set_items(state, records->shafts.size() * records->boxes.size());
  });
  suite.add("paper/boxes_classify", "paper/boxes_classify", [records](benchmark::State& state) {
    for (auto _ : state) {
      for (const paper::Shaft& shaft : records->shafts) {
        std::size_t answers[3] = {};
        for (const CornerBox& box : records->boxes) ++answers[static_cast<std::size_t>(shaft.classify(box.corners))];
        benchmark::DoNotOptimize(answers);
      }
    }
    set_items(state, records->shafts.size() * records->boxes.size());
  });
  suite.add("paper/spheres_cull", "paper/spheres_cull", [records](benchmark::State& state) {
    for (auto _ : state) {
      for (const paper::Shaft& shaft : records->shafts) {
        std::size_t kept = 0;
        for (const paper::Ball& ball : records->balls) {
          if (!shaft.outside(ball)) ++kept;
        }
        benchmark::DoNotOptimize(kept);
      }
    }
    set_items(state, records->shafts.size() * records->balls.size());
  });
}

}  // namespace shaftcull::bench
