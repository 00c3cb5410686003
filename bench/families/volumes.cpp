// SPDX-License-Identifier: MIT
/// volumes/…: shafts of moving boxes against many boxes, on one thread, results as bits: swept bodies, bodies swept
/// without end (sun), and shadows of lights. test/boxes/cull/slab/… is the same for shafts between two boxes.
///
/// Bodies and occluders are of a size at which about as many boxes are kept as there.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull::bench {
namespace {

struct Kind {
  const char* name;
  double ratio;  ///< of the speed of shafts between two boxes
  std::function<CompiledShaft(Random& random)> shaft;
};

Vec3 direction(Random& random, float length) {
  return {random.uniform(-length, length), random.uniform(-length, length), random.uniform(-length, length)};
}

CompiledShaft shadow_of(Random& random) {
  for (;;) {
    const Box light = random.box(0.05F, 0.2F);
    const Box occluder = random.box(0.3F, 1.2F);
    for (std::size_t k = 0; k != 3; ++k) {
      if (light.hi[k] + 1 < occluder.lo[k] || occluder.hi[k] + 1 < light.lo[k]) return shadow(light, occluder);
    }
  }
}

const Kind kinds[] = {
    {"swept", 0.95,
     [](Random& random) {
       const Box body = random.box(0.3F, 1.4F);
       return swept(body, direction(random, 7.0F));
     }},
    {"sun", 0.95,
     [](Random& random) {
       const Box receiver = random.box(0.3F, 1.3F);
       return swept_infinite(receiver, direction(random, 1.0F));
     }},
    {"shadow", 0.95, shadow_of},
};

/// The shafts of a kind, and their rows of bits.
struct Bench {
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> kept;
};

}  // namespace

void declare_volumes(Suite& suite, const Workload& workload) {
  const BoxView boxes = workload.boxes.view();
  for (const Kind& kind : kinds) {
    const auto bench = std::make_shared<Bench>();
    Random random(3100);
    for (std::size_t i = 0; i != Workload::test_shafts; ++i) bench->shafts.push_back(kind.shaft(random));
    for (const Isa isa : available_isas()) {
      if (isa != Isa::avx2 && isa != Isa::avx512) continue;
      const std::string set(name(isa));
      const std::string name_of = "volumes/" + std::string(kind.name) + "/boxes/" + set;
      suite.add(name_of, "", [=](benchmark::State& state) {
        select_isa(isa);
        bench->kept.resize(bench->shafts.size() * bit_words(boxes.count));
        for (auto _ : state) {
          cull_many(bench->shafts, boxes, bench->kept);
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bench->shafts.size() * boxes.count));
      });
      suite.add_target(name_of, "test/boxes/cull/slab/" + set, kind.ratio);
    }
  }
}

}  // namespace shaftcull::bench
