// SPDX-License-Identifier: MIT
/// outputs/…: counts and index lists of many shafts × many boxes, on one thread. test/boxes/cull/slab/… is the same
/// work with bits as its result.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

struct Outputs {
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(Workload::test_shafts);
  IndexLists lists;
};

}  // namespace

void declare_outputs(Suite& suite, const Workload& workload) {
  const auto outputs = std::make_shared<Outputs>();
  for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
    outputs->shafts.push_back(compile(workload.a[i], workload.b[i]));
  }
  const BoxView boxes = workload.boxes.view();
  const auto items = static_cast<std::int64_t>(Workload::test_shafts * boxes.count);
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    const std::string set(name(isa));
    suite.add("outputs/counts/" + set, "paper/boxes_cull", [=](benchmark::State& state) {
      select_isa(isa);
      for (auto _ : state) {
        count_many(outputs->shafts, boxes, outputs->counts);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * items);
    });
    suite.add("outputs/lists/" + set, "paper/boxes_cull", [=](benchmark::State& state) {
      select_isa(isa);
      for (auto _ : state) {
        list_many(outputs->shafts, boxes, outputs->lists);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * items);
    });
    for (const char* output : {"counts/", "lists/"}) {
      suite.add_target("outputs/" + (output + set), "test/boxes/cull/slab/" + set, 0.85);
    }
  }
}

}  // namespace shaftcull::bench
