// SPDX-License-Identifier: MIT
/// roofline/…: what this machine can do at most, and which of it limits each main path.
///
/// roofline/slab_arithmetic counts boxes: five multiply-adds and six minima or maxima each. So does
/// roofline/grid_arithmetic, with five multiplications of 16-bit integers and six minima or maxima. roofline/read_…
/// counts bytes, read as six streams that together fill half of a cache, or twice the largest one. roofline/divide
/// counts divisions, roofline/write_shafts shafts.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "families/roofline_kernels.hpp"
#include "harness/suite.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull::bench {

#ifdef SHAFTCULL_BENCH_WITH_AVX2
extern const RooflineKernels avx2_roofline_kernels;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX512
extern const RooflineKernels avx512_roofline_kernels;
#endif

const RooflineKernels* roofline_kernels(Isa isa) noexcept {
  const std::vector<Isa> available = available_isas();
  if (std::find(available.begin(), available.end(), isa) == available.end()) return nullptr;
  switch (isa) {
#ifdef SHAFTCULL_BENCH_WITH_AVX2
    case Isa::avx2:
      return &avx2_roofline_kernels;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX512
    case Isa::avx512:
      return &avx512_roofline_kernels;
#endif
    default:
      return nullptr;
  }
}

namespace {

/// Multiply-adds, minima and maxima that a box in slab form cannot do without, and that roofline/slab_arithmetic does
/// for each: one face's position is t itself.
constexpr double slab_operations = 11;

/// Likewise of roofline/grid_arithmetic, on vectors of twice as many lanes.
constexpr double grid_operations = 11;
constexpr double box_bytes = 24;
constexpr double sphere_bytes = 16;

/// A place to read from.
struct Level {
  std::string name;
  std::size_t bytes;  ///< read over and over
  /// Made when it is first read and then kept, for all instruction sets: memory is only needed if a benchmark is run.
  std::shared_ptr<BoxStream> stream = std::make_shared<BoxStream>();
};

/// Half of the L1 and L2 caches; of the L3 cache four times the L2, because on shared machines the rest is others';
/// and, for memory, twice the largest cache.
std::vector<Level> levels() {
  constexpr std::size_t most = std::size_t{1} << 30;
  std::array<std::size_t, 4> size{};
  for (const auto& cache : benchmark::CPUInfo::Get().caches) {
    if (cache.type != "Instruction" && cache.level >= 1 && cache.level <= 3) {
      size[static_cast<std::size_t>(cache.level)] = static_cast<std::size_t>(cache.size);
    }
  }
  std::vector<Level> found;
  if (size[1] != 0) found.push_back({.name = "l1", .bytes = size[1] / 2});
  if (size[2] != 0) found.push_back({.name = "l2", .bytes = size[2] / 2});
  if (size[3] != 0) found.push_back({.name = "l3", .bytes = std::min(size[3] / 2, 4 * size[2])});
  const std::size_t largest = *std::max_element(size.begin(), size.end());
  found.push_back({.name = "dram", .bytes = std::clamp(2 * largest, std::size_t{1} << 28, most)});
  return found;
}

void declare_arithmetic(Suite& suite, const RooflineKernels& kernels, const std::string& set) {
  constexpr std::size_t vectors = 100'000;
  const auto add = [&](const std::string& name, const std::string& paper, float (*kernel)(std::size_t) noexcept) {
    suite.add(name + set, paper, [=, width = kernels.width](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(kernel(vectors));
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(width * vectors));
    });
  };
  add("roofline/slab_arithmetic/", "paper/boxes_cull", kernels.slab_arithmetic);
  add("roofline/grid_arithmetic/", "paper/boxes_cull", kernels.grid_arithmetic);
  add("roofline/divide/", "", kernels.divide);
}

void declare_reading(Suite& suite, const RooflineKernels& kernels, const std::string& set,
                     const std::vector<Level>& levels) {
  for (const Level& level : levels) {
    const std::size_t boxes = std::max<std::size_t>(level.bytes / static_cast<std::size_t>(box_bytes) / 64, 1) * 64;
    suite.add(fmt::format("roofline/read_{}_bytes/{}", level.name, set), "",
              [=, &kernels, stream = level.stream](benchmark::State& state) {
                if (stream->size() == 0) *stream = BoxStream(boxes);
                for (auto _ : state) benchmark::DoNotOptimize(kernels.read(stream->view().stream.data(), boxes));
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boxes * sizeof(Box)));
              });
  }
}

void declare_writing(Suite& suite, const RooflineKernels& kernels, const std::string& set) {
  suite.add("roofline/write_shafts/" + set, "", [&kernels](benchmark::State& state) {
    std::vector<CompiledShaft> shafts(1024);  // as form/batch
    for (auto _ : state) {
      kernels.write_shafts(shafts.data(), shafts.size());
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts.size()));
  });
}

/// What a test cannot do without depends on how far bounds get: shares of workload W.
struct Shares {
  double in_shaft_box = 0;  ///< boxes that meet the shaft box
  double planes_there = 0;  ///< joining planes of the shaft, for each of these, over all boxes
  double kept = 0;          ///< boxes that are not outside
  double kept_planes = 0;   ///< joining planes of the shaft, for each of these, over all boxes
  double kept_spheres = 0;  ///< spheres that are not outside

  explicit Shares(const Workload& workload) {
    constexpr std::size_t sample = 8192;
    const BoxView boxes = workload.boxes.view().slice(0, std::min(sample, workload.boxes.size()));
    const SphereView spheres = workload.spheres.view().slice(0, boxes.count);
    for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
      const Shaft shaft(workload.a[i], workload.b[i]);
      const CompiledShaft compiled = compile(shaft);
      const auto planes = static_cast<double>(shaft.joining_planes().size());
      const auto kept_boxes = static_cast<double>(count(compiled, boxes));
      double met = 0;
      for (std::size_t b = 0; b < boxes.count; ++b) met += meets(shaft.box(), boxes[b]) ? 1 : 0;
      in_shaft_box += met;
      planes_there += met * planes;
      kept += kept_boxes;
      kept_planes += kept_boxes * planes;
      kept_spheres += static_cast<double>(count(compiled, spheres));
    }
    const auto tests = static_cast<double>(Workload::test_shafts * boxes.count);
    for (double* share : {&in_shaft_box, &planes_there, &kept, &kept_planes, &kept_spheres}) *share /= tests;
  }

  static bool meets(const Box& a, const Box& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (a.lo[axis] > b.hi[axis] || b.lo[axis] > a.hi[axis]) return false;
    }
    return true;
  }
};

/// Limits of the main paths: multiplications, multiply-adds, minima, maxima and comparisons that their methods cannot
/// do without, at the rate of roofline/slab_arithmetic or roofline/grid_arithmetic, and bytes. Additions are left out:
/// some processors have ports of their own for them.
void declare_paths(Suite& suite, const Shares& shares, const std::string& set) {
  constexpr double shafts = Workload::test_shafts;
  const auto path = [&](const std::string& name, const std::string& arithmetic, double units, const std::string& what,
                        double bytes, double from_memory = box_bytes) {
    suite.limit(name + set, arithmetic + set, units, what);
    suite.limit(name + set, "roofline/read_l1_bytes/" + set, bytes,
                fmt::format("{:.0f} bytes from the L1 cache", bytes));
    suite.limit(name + set, "memory/read/" + set, from_memory / box_bytes / shafts,
                fmt::format("{:.2f} bytes from memory, shared by {:.0f} shafts", from_memory / shafts, shafts));
  };
  // A float operation takes as long as one on twice as many 16-bit integers.
  const auto grid_path = [&](const std::string& name, double floats, const std::string& what, double from_memory) {
    path(name, "roofline/grid_arithmetic/", (grid_operations + 2 * floats) / grid_operations,
         fmt::format("{:.1f} operations, half of those on 16-bit integers counted: {}", grid_operations / 2 + floats,
                     what),
         box_bytes / 2, from_memory);
  };
  const double planes = 6 + 3 * shares.planes_there;
  path("test/boxes/cull/planes/", "roofline/slab_arithmetic/", planes / slab_operations,
       fmt::format("{:.1f} operations: 6 comparisons, and 3 a plane for the {:.0f} % that meet the shaft box", planes,
                   100 * shares.in_shaft_box),
       box_bytes);
  const std::string culling = "5 multiplications, 6 minima or maxima in 16 bits";
  grid_path("test/boxes/cull/slab/", 0, culling, box_bytes);
  grid_path("test/boxes/classify/slab/", 6 * shares.kept + 3 * shares.kept_planes,
            fmt::format("{}; 6 comparisons and 3 a plane for the {:.1f} % kept", culling, 100 * shares.kept),
            box_bytes);
  grid_path("test/spheres/cull/slab/", 15 * shares.kept_spheres,
            fmt::format("{} for the sphere's box; 15 of the distance for the {:.1f} % kept", culling,
                        100 * shares.kept_spheres),
            sphere_bytes);
}

}  // namespace

void declare_roofline(Suite& suite, const Workload& workload) {
  const Shares shares(workload);
  const std::vector<Level> read_levels = levels();
  for (const Isa isa : available_isas()) {
    const RooflineKernels* const kernels = roofline_kernels(isa);
    if (kernels == nullptr) continue;
    const std::string set(name(isa));
    declare_arithmetic(suite, *kernels, set);
    declare_reading(suite, *kernels, set, read_levels);
    declare_paths(suite, shares, set);
    if (isa != Isa::avx2) continue;
    declare_writing(suite, *kernels, set);
    suite.limit("form/batch", "roofline/divide/" + set, 6.0, "6 divisions a shaft");
    suite.limit("form/batch", "roofline/write_shafts/" + set, 1.0, "writing 2 cache lines a shaft");
  }
  suite.note("roofline/read_…_bytes counts bytes, roofline/divide single divisions");
}

}  // namespace shaftcull::bench
