/// small/…: what a call costs that tests one shaft against 64 boxes.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "suite.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t call_boxes = 64;
/// Pieces of the boxes that calls take in turn, with each shaft: too many calls for a branch predictor to learn by
/// heart, few enough boxes for an L1 cache.
constexpr std::size_t pieces = 16;

}  // namespace

void declare_small(Suite& suite, const Workload& workload) {
  const auto shafts = std::make_shared<std::vector<CompiledShaft>>();
  for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
    shafts->push_back(compile(Shaft(workload.a[i], workload.b[i])));
  }
  const BoxView boxes = workload.boxes.view();
  for (const Isa isa : available_isas()) {
    suite.add("small/one_shaft_64_boxes/" + std::string(name(isa)), "", [=](benchmark::State& state) {
      select_isa(isa);
      std::uint64_t kept = 0;
      for (auto _ : state) {
        for (const CompiledShaft& shaft : *shafts) {
          for (std::size_t p = 0; p < pieces; ++p) {
            cull(shaft, boxes.slice(p * call_boxes, call_boxes), {&kept, 1});
            benchmark::DoNotOptimize(kept);
          }
        }
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts->size() * pieces));
    });
    if (isa == Isa::avx2) suite.reach_within("small/one_shaft_64_boxes/avx2", 60.0);
  }
  suite.note("small/… counts calls, not tests: a call's whole cost");
}

}  // namespace shaftcull::bench
