// SPDX-License-Identifier: MIT
/// contact/…: shafts with open contact against many boxes, on one thread, results as bits. On workload W next to
/// nothing touches; on a grid of whole numbers about half of what closed contact keeps does.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

/// A box with integer corners and sides of `least` to `most`, in 0 … 40.
Box integer_box(Random& random, unsigned least, unsigned most) {
  constexpr unsigned size = 40;
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const unsigned side = least + random.below(most - least + 1);
    box.lo[k] = static_cast<float>(random.below(size - side + 1));
    box.hi[k] = box.lo[k] + static_cast<float>(side);
  }
  return box;
}

/// Shafts, and the rows of bits that benchmarks write to in turn.
struct Bench {
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> kept;

  Bench(const std::vector<Box>& a, const std::vector<Box>& b, Contact contact) {
    for (std::size_t i = 0; i != Workload::test_shafts; ++i) shafts.push_back(compile(a[i], b[i], contact));
  }
};

void add(Suite& suite, const std::string& name, const std::shared_ptr<Bench>& bench, const BoxView& boxes, Isa isa) {
  suite.add(name, "", [=](benchmark::State& state) {
    select_isa(isa);
    bench->kept.resize(bench->shafts.size() * bit_words(boxes.count));
    for (auto _ : state) {
      cull_many(bench->shafts, boxes, bench->kept);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bench->shafts.size() * boxes.count));
  });
}

/// A million boxes on the grid.
const BoxStream& grid_boxes() {
  static const BoxStream boxes = [] {
    constexpr std::size_t count = std::size_t{1} << 20U;
    Random random(3300);
    std::vector<Box> all(count);
    for (Box& box : all) box = integer_box(random, 0, 2);  // one in 27 is a point, most are flat
    return BoxStream(std::span<const Box>(all));
  }();
  return boxes;
}

}  // namespace

void declare_contact(Suite& suite, const Workload& workload) {
  std::vector<Box> a;
  std::vector<Box> b;
  Random random(3301);
  for (std::size_t i = 0; i != Workload::test_shafts; ++i) {
    a.push_back(integer_box(random, 1, 6));
    b.push_back(integer_box(random, 1, 6));
  }
  const auto on_w = std::make_shared<Bench>(workload.a, workload.b, Contact::open);
  const auto on_w_closed = std::make_shared<Bench>(workload.a, workload.b, Contact::closed);
  const auto on_grid = std::make_shared<Bench>(a, b, Contact::open);
  const auto on_grid_closed = std::make_shared<Bench>(a, b, Contact::closed);
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    const std::string set(name(isa));
    add(suite, "contact/closed/boxes/" + set, on_w_closed, workload.boxes.view(), isa);
    add(suite, "contact/open/boxes/" + set, on_w, workload.boxes.view(), isa);
    add(suite, "contact/closed/grid/" + set, on_grid_closed, grid_boxes().view(), isa);
    add(suite, "contact/open/grid/" + set, on_grid, grid_boxes().view(), isa);
    suite.add_target("contact/open/boxes/" + set, "contact/closed/boxes/" + set, 0.95);
    suite.add_target("contact/open/grid/" + set, "contact/closed/grid/" + set, 0.8);
  }
}

}  // namespace shaftcull::bench
