// SPDX-License-Identifier: MIT
/// single/…: calls for one shaft or one bound, in turn: the times that headers and pages give. An item is a call.
///
/// single/form/WHAT forms a shaft or a hull: `hull_8` and `hull_32` of random points on a sphere, `frustum` from a
/// matrix, `casters` from a view and a point, `between_polygons` of the two ends of a view, `inscribed_box_8` and `_32`
/// within such points; an item of `swept_batch` and `shadow_batch` is a shaft. single/complete makes the joining planes
/// of a shaft, and single/open_contact changes its contact. single/ask/WHAT asks shafts of the workload about a bound:
/// a box that is outside, one within the box around the shaft, for which joining planes are there or pending, or a
/// triangle. single/view_factor/WHAT is that of two squares: opposite to each other at the distance of a side, of
/// two sides, far away, or with a common edge. single/entry_time/WHAT is an item a bound, all of them kept.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/view_factors.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull::bench {
namespace {

using Matrix = std::array<float, 16>;
using Square = std::array<Vec3, 4>;

/// What calls take in turn: enough that no branch predictor knows it by heart, and little enough for an L1 cache.
constexpr std::size_t turns = 64;
/// How many kept bounds a list has.
constexpr std::size_t listed = 16;

struct Single {
  std::vector<Box> a;
  std::vector<Box> b;
  std::vector<Box> lamps;  ///< above all of them
  std::vector<Vec3> ways;
  std::vector<Vec3> lights;
  std::vector<Matrix> matrices;
  std::vector<ConvexHull> views;
  std::vector<CompiledShaft> pending;
  std::vector<CompiledShaft> complete;
  std::vector<CompiledShaft> shafts;  ///< written by batches
  std::vector<Vec3> points;           ///< on a sphere
  std::vector<Box> outside;           ///< of shaft i
  std::vector<Box> within;            ///< the box around shaft i
  std::vector<Triangle> triangles;    ///< within that box
  BoxStream bodies;                   ///< a
  BoxStream lights_above;             ///< lamps
  BoxView boxes;
  SphereView spheres;
  std::vector<std::uint32_t> kept_boxes;    ///< `listed` of shaft i from listed · i on
  std::vector<std::uint32_t> kept_spheres;  ///< likewise
  std::vector<float> times;
};

/// Rows of a view from the origin turned by `angle` about y, a field of view of 90°, from 0.1 to 100, depths from 0.
Matrix view_matrix(float angle) {
  const float sine = std::sin(angle);
  const float cosine = std::cos(angle);
  const float depth = 100.0F / (100.0F - 0.1F);
  return {cosine,
          0,
          -sine,
          0,  //
          0,
          1,
          0,
          0,  //
          depth * sine,
          0,
          depth * cosine,
          -0.1F * depth,  //
          sine,
          0,
          cosine,
          0};
}

/// A square that faces down.
Square ceiling(float height) { return {{{0, 0, height}, {0, 1, height}, {1, 1, height}, {1, 0, height}}}; }

Vec3 on_sphere(Random& random) {
  const float height = random.uniform(-1, 1);
  const float turn = random.uniform(0, 2 * std::numbers::pi_v<float>);
  const float across = std::sqrt(1 - height * height);
  return {across * std::cos(turn), across * std::sin(turn), height};
}

std::shared_ptr<Single> make(const Workload& workload) {
  auto single = std::make_shared<Single>();
  Random random(4701);
  const auto vector = [&](float most) -> Vec3 {
    return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
  };
  for (std::size_t i = 0; i != turns; ++i) {
    const Box& a = workload.a[i];
    const Box& b = workload.b[i];
    single->a.push_back(a);
    single->b.push_back(b);
    single->ways.push_back(vector(5));
    single->lights.push_back(vector(50));
    single->matrices.push_back(view_matrix(random.uniform(-3, 3)));
    single->views.push_back(frustum(single->matrices.back(), ClipDepth::zero_to_one));
    single->pending.push_back(compile(a, b));
    single->complete.push_back(single->pending.back());
    complete(single->complete.back());
    for (int p = 0; p != 32; ++p) single->points.push_back(on_sphere(random));
    const auto box_at = [](const Vec3& at, float half) -> Box {
      return {{at[0] - half, at[1] - half, at[2] - half}, {at[0] + half, at[1] + half, at[2] + half}};
    };
    single->lamps.push_back(box_at({random.uniform(-5, 5), 30, random.uniform(-5, 5)}, 0.5F));
    single->outside.push_back(box_at({20 + random.uniform(0, 5), random.uniform(-5, 5), random.uniform(-5, 5)}, 0.05F));
    Vec3 middle{};
    for (std::size_t k = 0; k != 3; ++k) middle[k] = 0.25F * (a.lo[k] + a.hi[k] + b.lo[k] + b.hi[k]);
    single->within.push_back(box_at(middle, 0.05F));
    single->triangles.push_back(
        {middle, {middle[0] + 0.1F, middle[1], middle[2]}, {middle[0], middle[1] + 0.1F, middle[2]}});
  }
  single->bodies = BoxStream(std::span<const Box>(single->a));
  single->lights_above = BoxStream(std::span<const Box>(single->lamps));
  single->shafts.resize(turns);
  single->boxes = workload.boxes.view().slice(0, 4096);
  single->spheres = workload.spheres.view().slice(0, 4096);
  single->times.resize(listed);
  for (const CompiledShaft& shaft : single->complete) {
    const auto add_kept = [&](const Bounds& bounds, std::vector<std::uint32_t>& to) {
      std::vector<std::uint32_t> kept;
      list(shaft, bounds, kept);
      for (std::size_t i = 0; i != listed; ++i) to.push_back(kept.empty() ? 0 : kept[i % kept.size()]);
    };
    add_kept(single->boxes, single->kept_boxes);
    add_kept(single->spheres, single->kept_spheres);
  }
  return single;
}

}  // namespace

void declare_single(Suite& suite, const Workload& workload) {
  const auto single = make(workload);
  const std::string set(name(available_isas().back()));
  const auto add = [&](const std::string& row, std::size_t items, const auto& call) {
    suite.add("single/" + row + "/" + set, "",
              [single, items, call](benchmark::State& state) {
                select_isa(available_isas().back());
                for (auto _ : state) {
                  for (std::size_t i = 0; i != turns; ++i) {
                    auto result = call(*single, i);
                    benchmark::DoNotOptimize(result);
                  }
                }
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(turns * items));
              },
              {.brief = true});
  };
  add("form/swept", 1, [](const Single& of, std::size_t i) { return swept(of.a[i], of.ways[i]); });
  add("form/swept_infinite", 1, [](const Single& of, std::size_t i) { return swept_infinite(of.a[i], of.ways[i]); });
  add("form/shadow", 1, [](const Single& of, std::size_t i) { return shadow(of.lamps[i], of.a[i]); });
  add("form/shadow_with_reach", 1, [](const Single& of, std::size_t i) { return shadow(of.lamps[i], of.a[i], 4); });
  add("form/frustum", 1,
      [](const Single& of, std::size_t i) { return frustum(of.matrices[i], ClipDepth::zero_to_one); });
  add("form/casters", 1, [](const Single& of, std::size_t i) { return casters(of.views[i], of.lights[i]); });
  add("form/between_polygons", 1, [](const Single& of, std::size_t i) {
    const std::span<const Vec3> corners = of.views[i].points();
    return between_polygons(corners.first(4), corners.subspan(4));
  });
  for (const std::size_t count : {std::size_t{8}, std::size_t{32}}) {
    add("form/hull_" + std::to_string(count), 1,
        [count](const Single& of, std::size_t i) { return ConvexHull(std::span(of.points).subspan(32 * i, count)); });
  }
  for (const std::size_t count : {std::size_t{8}, std::size_t{32}}) {
    add("form/inscribed_box_" + std::to_string(count), 1, [count](const Single& of, std::size_t i) {
      return inscribed_box(std::span(of.points).subspan(32 * i, count));
    });
  }
  const auto add_view_factor = [&](const char* name, const Square& other) {
    constexpr Square floor{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    add(std::string("view_factor/") + name, 1, [=](const Single&, std::size_t) { return view_factor(floor, other); });
  };
  add_view_factor("opposite", ceiling(1));
  add_view_factor("edge", {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}});
  add_view_factor("near", ceiling(2));
  add_view_factor("far", ceiling(64));
  add("form/swept_batch", turns, [](Single& of, std::size_t) {
    swept_batch(of.bodies.view(), of.ways, of.shafts);
    return of.shafts.front().contact();
  });
  add("form/shadow_batch", turns, [](Single& of, std::size_t) {
    shadow_batch(of.lights_above.view(), of.bodies.view(), of.shafts);
    return of.shafts.front().contact();
  });
  add("complete", 1, [](const Single& of, std::size_t i) {
    CompiledShaft shaft = of.pending[i];
    complete(shaft);
    return shaft;
  });
  add("open_contact", 1, [](const Single& of, std::size_t i) {
    CompiledShaft shaft = of.complete[i];
    set_contact(std::span(&shaft, 1), Contact::open);
    return shaft;
  });
  add("ask/keeps_box", 1, [](const Single& of, std::size_t i) { return keeps(of.complete[i], of.within[i]); });
  add("ask/keeps_triangle", 1, [](const Single& of, std::size_t i) { return keeps(of.complete[i], of.triangles[i]); });
  add("ask/outside", 1, [](const Single& of, std::size_t i) { return classify(of.complete[i], of.outside[i]); });
  add("ask/within", 1, [](const Single& of, std::size_t i) { return classify(of.complete[i], of.within[i]); });
  add("ask/within_pending", 1, [](const Single& of, std::size_t i) { return classify(of.pending[i], of.within[i]); });
  add("ask/frustum", 1, [](const Single& of, std::size_t i) { return classify(of.views[i], of.within[i]); });
  add("entry_time/box", listed, [](Single& of, std::size_t i) {
    entry_times(of.complete[i], of.boxes, std::span(of.kept_boxes).subspan(listed * i, listed), of.times);
    return of.times.front();
  });
  add("entry_time/sphere", listed, [](Single& of, std::size_t i) {
    entry_times(of.complete[i], of.spheres, std::span(of.kept_spheres).subspan(listed * i, listed), of.times);
    return of.times.front();
  });
}

}  // namespace shaftcull::bench
