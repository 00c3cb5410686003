// SPDX-License-Identifier: MIT
/// memory/…: one shaft × all boxes, which reads each box once and is limited by how fast memory can be read; and
/// reading the same streams without testing anything.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "families/roofline_kernels.hpp"
#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

/// Boxes that a thread reads at a stretch when several do: what the library makes one task of for a single shaft.
constexpr std::size_t chunk = std::size_t{1} << 18;

/// Declares the pair …/read and …/cull on `threads` threads.
void declare_pair(Suite& suite, const Workload& workload, const RooflineKernels& kernels, Isa isa, unsigned threads,
                  const std::string& suffix) {
  const BoxView boxes = workload.boxes.view();
  const auto items = static_cast<std::int64_t>(boxes.count);
  const RunOptions options{.threads = threads, .wall_clock = threads > 1};
  suite.add(
      "memory/read/" + suffix, "",
      [=, &kernels](benchmark::State& state) {
        for (auto _ : state) {
          if (threads == 1) {
            benchmark::DoNotOptimize(kernels.read(boxes.stream.data(), boxes.count));
          } else {
            for_chunks(boxes.count, chunk, [&](std::size_t first, std::size_t size) {
              benchmark::DoNotOptimize(kernels.read(boxes.slice(first, size).stream.data(), size));
            });
          }
        }
        state.SetItemsProcessed(state.iterations() * items);
      },
      options);

  const auto shafts = std::make_shared<std::vector<CompiledShaft>>();
  for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
    shafts->push_back(compile(workload.a[i], workload.b[i]));
  }
  const auto kept = std::make_shared<std::vector<std::uint64_t>>(bit_words(boxes.count));
  suite.add(
      "memory/cull/" + suffix, "paper/boxes_cull",
      [=](benchmark::State& state) {
        select_isa(isa);
        std::size_t next = 0;
        for (auto _ : state) {
          const CompiledShaft& shaft = (*shafts)[next++ % shafts->size()];
          if (threads == 1) {
            cull(shaft, boxes, *kept);
          } else {
            cull_many({&shaft, 1}, boxes, *kept);
          }
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * items);
      },
      options);
  suite.add_target("memory/cull/" + suffix, "memory/read/" + suffix, 0.92);
  suite.limit("memory/cull/" + suffix, "memory/read/" + suffix, 1.0, "reading the same six streams");
}

}  // namespace

void declare_memory(Suite& suite, const Workload& workload) {
  for (const Isa isa : available_isas()) {
    const RooflineKernels* const kernels = roofline_kernels(isa);
    if (kernels == nullptr) continue;
    declare_pair(suite, workload, *kernels, isa, 1, std::string(name(isa)));
    const bool best = isa == available_isas().back();
    if (best && all_threads() > 1) {
      declare_pair(suite, workload, *kernels, isa, all_threads(), fmt::format("{}_threads", all_threads()));
    }
  }
}

}  // namespace shaftcull::bench
