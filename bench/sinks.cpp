/// sinks/…: counts and index lists of many shafts × many boxes, on one thread. test/boxes/cull/slab/… is the same work
/// with bits as its result.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "suite.hpp"

namespace shaftcull::bench {
namespace {

struct Sinks {
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(Workload::test_shafts);
  IndexLists lists;
};

}  // namespace

void declare_sinks(Suite& suite, const Workload& workload) {
  const auto sinks = std::make_shared<Sinks>();
  for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
    sinks->shafts.push_back(compile(Shaft(workload.a[i], workload.b[i])));
  }
  const BoxView boxes = workload.boxes.view();
  const auto items = static_cast<std::int64_t>(Workload::test_shafts * boxes.count);
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    const std::string set(name(isa));
    suite.add("sinks/counts/" + set, "paper/boxes_cull", [=](benchmark::State& state) {
      select_isa(isa);
      for (auto _ : state) {
        count_many(sinks->shafts, boxes, sinks->counts);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * items);
    });
    suite.add("sinks/lists/" + set, "paper/boxes_cull", [=](benchmark::State& state) {
      select_isa(isa);
      for (auto _ : state) {
        list_many(sinks->shafts, boxes, sinks->lists);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * items);
    });
    for (const char* sink : {"counts/", "lists/"}) {
      suite.reach("sinks/" + (sink + set), "test/boxes/cull/slab/" + set, 0.85);
    }
  }
}

}  // namespace shaftcull::bench
