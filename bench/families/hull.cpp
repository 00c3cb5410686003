// SPDX-License-Identifier: MIT
/// hull/…: convex hulls, on one thread. hull/frustum/boxes: what some cameras see of many boxes, exactly; against the
/// usual six planes, which keep too much, in vectors by hand (six_planes) and box by box (array_of_structs).
/// hull/frustum/conservative: the same by conservative hulls, which cull by faces alone.
/// hull/casters/list: the hull of a view and a light is formed, and lists what it keeps of a tree; hull/view/list: the
/// view alone lists, formed before.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "peers/six_planes.hpp"
#include "scenes/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t cameras = 16;
constexpr std::size_t tree_boxes = std::size_t{1} << 20;

/// A camera at a random place of the world, [−5, 5]³, that looks along a random direction: rows of a matrix.
std::array<float, 16> camera(Random& random) {
  const double yaw = random.uniform(-3.14F, 3.14F);
  const double pitch = random.uniform(-0.5F, 0.5F);
  const double forward[3] = {std::cos(yaw) * std::cos(pitch), std::sin(pitch), std::sin(yaw) * std::cos(pitch)};
  const double right[3] = {-std::sin(yaw), 0, std::cos(yaw)};
  const double up[3] = {right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2],
                        right[0] * forward[1] - right[1] * forward[0]};
  const double eye[3] = {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
  constexpr double near = 0.1;
  constexpr double far = 6.0;
  constexpr double zoom[2] = {1.1, 1.7};
  const auto offset = [&](const double(&axis)[3]) { return -(axis[0] * eye[0] + axis[1] * eye[1] + axis[2] * eye[2]); };
  std::array<float, 16> matrix{};
  for (std::size_t k = 0; k != 3; ++k) {
    matrix[k] = static_cast<float>(zoom[0] * right[k]);
    matrix[4 + k] = static_cast<float>(zoom[1] * up[k]);
    matrix[8 + k] = static_cast<float>(far / (far - near) * forward[k]);
    matrix[12 + k] = static_cast<float>(forward[k]);
  }
  matrix[3] = static_cast<float>(zoom[0] * offset(right));
  matrix[7] = static_cast<float>(zoom[1] * offset(up));
  matrix[11] = static_cast<float>(far / (far - near) * (offset(forward) - near));
  matrix[15] = static_cast<float>(offset(forward));
  return matrix;
}

/// Cameras, in all the ways in which they are asked.
struct Cameras {
  std::vector<ConvexHull> hulls;
  std::vector<ConvexHull> conservative;
  std::vector<SixPlanes> planes;
  std::vector<CentreExtent> records;
  std::vector<std::uint64_t> kept;

  explicit Cameras(const BoxView& boxes) : kept(bit_words(boxes.count)) {
    Random random(3200);
    for (std::size_t i = 0; i != cameras; ++i) {
      const std::array<float, 16> matrix = camera(random);
      hulls.push_back(frustum(matrix, ClipDepth::zero_to_one));
      conservative.push_back(frustum(matrix, ClipDepth::zero_to_one, HullTest::conservative));
      SixPlanes six{};
      const ViewPlanes planes_of_view = view_planes(matrix, ClipDepth::zero_to_one);
      for (std::size_t p = 0; p != planes_of_view.count; ++p) six[p] = planes_of_view.plane[p];
      planes.push_back(six);
    }
    for (std::size_t i = 0; i != boxes.count; ++i) {
      const Box box = boxes[i];
      CentreExtent record{};
      for (std::size_t k = 0; k != 3; ++k) {
        record.centre[k] = 0.5F * (box.lo[k] + box.hi[k]);
        record.half_extent[k] = 0.5F * (box.hi[k] - box.lo[k]);
      }
      records.push_back(record);
    }
  }
};

struct Scene {
  std::vector<Box> boxes;
  BoxTree tree;

  Scene() {
    Random random(3300);
    for (std::size_t i = 0; i != tree_boxes; ++i) boxes.push_back(random.box(0.002F, 0.02F));
    tree = BoxTree(std::span<const Box>(boxes));
  }
};

template <class Cull>
void run(benchmark::State& state, Cameras& all, std::size_t boxes, Cull cull_by) {
  for (auto _ : state) {
    for (std::size_t c = 0; c != cameras; ++c) {
      cull_by(c);
      benchmark::DoNotOptimize(all.kept.data());
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cameras * boxes));
}

}  // namespace

void declare_hull(Suite& suite, const Workload& workload) {
  // In the first-level cache, where arithmetic decides.
  const BoxView boxes = workload.boxes.view().slice(0, 2048);
  const auto all = std::make_shared<Cameras>(workload.boxes.view());
  all->records.resize(boxes.count);
  all->kept.resize(bit_words(boxes.count));
  suite.add("hull/array_of_structs/boxes", "", [=](benchmark::State& state) {
    run(state, *all, boxes.count,
        [&](std::size_t c) { cull_by_six_planes(all->planes[c], all->records, all->kept.data()); });
  });
#ifdef SHAFTCULL_BENCH_WITH_AVX2
  suite.add("hull/six_planes/boxes/avx2", "", [=](benchmark::State& state) {
    run(state, *all, boxes.count,
        [&](std::size_t c) { cull_by_six_planes_avx2(all->planes[c], boxes, all->kept.data()); });
    std::size_t kept = 0;
    std::size_t exactly = 0;
    for (std::size_t c = 0; c != cameras; ++c) {
      cull_by_six_planes_avx2(all->planes[c], boxes, all->kept.data());
      kept += BitView(all->kept).count();
      cull(all->hulls[c], boxes, all->kept);
      exactly += BitView(all->kept).count();
    }
    state.counters["kept_in_vain"] = static_cast<double>(kept - exactly) / static_cast<double>(kept);
    state.counters["kept"] = static_cast<double>(kept) / static_cast<double>(cameras * boxes.count);
  });
#endif
  static std::unique_ptr<Scene> scene;
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    const std::string set(name(isa));
    suite.add("hull/frustum/boxes/" + set, "", [=](benchmark::State& state) {
      select_isa(isa);
      run(state, *all, boxes.count, [&](std::size_t c) { cull(all->hulls[c], boxes, all->kept); });
    });
    suite.add("hull/frustum/conservative/" + set, "", [=](benchmark::State& state) {
      select_isa(isa);
      run(state, *all, boxes.count, [&](std::size_t c) { cull(all->conservative[c], boxes, all->kept); });
    });
    suite.add_target("hull/frustum/conservative/" + set, "hull/six_planes/boxes/avx2", 0.95);
    suite.add_target("hull/frustum/boxes/" + set, "hull/six_planes/boxes/avx2", 0.7);
    suite.add_target("hull/frustum/boxes/" + set, "hull/array_of_structs/boxes", 2.5);

    const auto add_list = [&](const char* what, auto hull_of) {
      std::string row = fmt::format("hull/{}/list/{}", what, set);
      suite.add(row, "", [=](benchmark::State& state) {
        select_isa(isa);
        if (!scene) scene = std::make_unique<Scene>();
        std::vector<std::uint32_t> found(tree_boxes);
        std::size_t listed = 0;
        for (auto _ : state) {
          for (std::size_t c = 0; c != cameras; ++c) listed += list(hull_of(c), scene->tree, std::span(found));
        }
        state.counters["found"] = static_cast<double>(listed) / static_cast<double>(state.iterations()) / cameras;
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cameras));
      });
      return row;
    };
    const std::string view = add_list("view", [=](std::size_t c) -> const ConvexHull& { return all->hulls[c]; });
    const std::string casters_of = add_list("casters", [=](std::size_t c) {
      return casters(all->hulls[c], {0, 6, 0});
    });
    suite.add_time_ratio_target(casters_of, view, 2);
  }
}

}  // namespace shaftcull::bench
