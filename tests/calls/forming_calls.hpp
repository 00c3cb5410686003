// SPDX-License-Identifier: MIT
/// Public calls that form shafts, of all kinds.
#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/paper.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

inline void add_forming_calls(CallTable& table) {
  table.add("joined, translated, inflated, view_planes", false, [&table](AnswerWords& words) {
    for (const Box& box : std::span(table.boxes).first(9)) {
      note(words, joined(box, table.boxes[1]));
      note(words, translated(box, {1e-40F, -1e-39F, 0.1F}));
      note(words, inflated(box, 1e-40F));
    }
    constexpr float matrix[16] = {1, 1e-40F, 0, 1e-39F, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};
    const ViewPlanes planes = view_planes(matrix, ClipDepth::zero_to_one);
    for (const Plane& plane : std::span(planes.plane).first(planes.count)) {
      note(words, plane.normal);
      note(words, plane.offset);
    }
  });
  // Made here, in the standard mode.
  std::vector<WorldBox> worlds;
  for (const Box& box : std::span(table.boxes).first(9)) {
    worlds.push_back({{box.lo[0] + 1e-9, box.lo[1] / 3.0, 1e-42}, {box.hi[0] + 1e-9, box.hi[1] / 3.0, 2e-42}});
  }
  table.add("Origin", false, [worlds](AnswerWords& words) {
    for (const WorldBox& world : worlds) {
      const Origin origin(Origin::for_world(world).at());
      const WorldSphere sphere{world.lo, 1e-42};
      Box around[1];
      Box within[1];
      Sphere spheres_around[1];
      Vec3 points[1];
      origin.around(std::span(&world, 1), around);
      origin.within(std::span(&world, 1), within);
      origin.around(std::span(&sphere, 1), spheres_around);
      const WorldPlane turned{{0x1.5555555555555p-2, 1e-42, 1}, 0x1.2492492492492p-3};
      Plane planes_around[1];
      origin.around(std::span(&turned, 1), world, planes_around);
      origin.nearest(std::span(&world.hi, 1), points);
      note(words, origin.at());
      note(words, around[0]);
      note(words, within[0]);
      note(words, spheres_around[0]);
      note(words, planes_around[0].normal);
      note(words, planes_around[0].offset);
      note(words, points[0]);
      note(words, origin.around(world));
      note(words, origin.within(world));
      note(words, origin.around(sphere));
      note(words, origin.nearest(world.lo));
      note(words, origin.to_world({0.1F, 1e-42F, 1}));
      const Plane plane = origin.around(turned, world);
      note(words, plane.normal);
      note(words, plane.offset);
    }
  });
  table.add("Shaft, compile of a Shaft", false, [&table](AnswerWords& words) {
    for (const PlaneOrder order : {PlaneOrder::unsorted, PlaneOrder::by_volume, PlaneOrder::by_added_volume}) {
      for (const Formation formation : {Formation::search, Formation::table64, Formation::table729}) {
        ShaftOptions options;
        options.order = order;
        options.formation = formation;
        Shaft shaft(table.boxes[1], table.boxes[2], options);
        shaft.add_plane({{1, 2, 3}, 4});
        for (const JoiningPlane& plane : shaft.joining_planes()) {
          note(words, plane.plane.normal);
          note(words, plane.plane.offset);
          note(words, culled_volume(shaft.box(), plane));
        }
        note_shaft(words, compile(shaft), table.box_stream.view().slice(0, 64));
      }
    }
  });
  table.add("compile", false, [&table](AnswerWords& words) {
    note_shaft(words, compile(table.boxes[1], table.boxes[2]), table.box_stream.view().slice(0, 64));
  });
  table.add("compile with planes", false, [&table](AnswerWords& words) {
    const std::vector<Plane> planes = {{{1, 2, 3}, 4}, {{-1, 0, 1e-40F}, 0.1F}};
    note_shaft(words, compile(table.boxes[1], table.boxes[2], planes), table.box_stream.view().slice(0, 64));
  });
  table.add("ConvexHull, frustum, casters, casters_towards", false, [&table](AnswerWords& words) {
    constexpr float matrix[16] = {1, 1e-40F, 0, 0, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};
    const ConvexHull view = frustum(matrix, ClipDepth::minus_one_to_one);
    const std::vector<Vec3> points = {{0, 0, 0}, {3, 1e-3F, 1}, {1, 2, 4}, {0.1F, 5, 1e-39F}};
    for (const ConvexHull& hull : {view, casters(view, {0.3F, 9, 1e-39F}), casters_towards(view, {0, 1, 1e-39F}),
                                   ConvexHull(points), ConvexHull(points, std::span(points).last(1)),
                                   between_polygons(std::span(points).first(2), std::span(points).last(2))}) {
      note_shaft(words, hull, table.box_stream.view().slice(0, 64));
      CompiledShaft open = hull;
      set_contact(open, Contact::open);
      note_shaft(words, open, table.box_stream.view().slice(0, 64));
    }
  });
  table.add("swept, swept_infinite, shadow", false, [&table](AnswerWords& words) {
    const std::vector<Plane> planes(2, Plane{{1, 2, 1e-40F}, 4});
    const Box light{{9, 1e-40F, 9}, {9.5F, 9, 9.25F}};
    for (const CompiledShaft& shaft :
         {swept(table.boxes[1], {0.1F, 2, 1e-30F}), swept(table.boxes[1], {0.1F, 2, 1e-30F}, planes),
          swept_infinite(table.boxes[1], {0.3F, -1, 1e-40F}), swept_infinite(table.boxes[1], {0, -1, 0}, planes),
          shadow(light, table.boxes[1]), shadow(light, table.boxes[1], 3.3F),
          shadow(light, table.boxes[1], 1.1F, planes)}) {
      note_shaft(words, shaft, table.box_stream.view().slice(0, 64));
    }
  });
  table.add("swept_batch, swept_infinite_batch, shadow_batch", false, [&table](AnswerWords& words) {
    const Box body{{0, 0, 0}, {1, 1.5F, 2}};
    const Box light{{9, 9, 9}, {9.5F, 9, 9.25F}};
    const BoxStream bodies(std::span(&body, 1));
    const BoxStream lights(std::span(&light, 1));
    const Vec3 way{0.1F, 2, 1e-30F};
    const Plane plane{{1, 2, 3}, 4};
    const IndexPair pair{0, 0};
    CompiledShaft shaft;
    const std::span<CompiledShaft> out(&shaft, 1);
    const BoxView some = table.box_stream.view().slice(0, 64);
    swept_batch(bodies.view(), std::span(&way, 1), out, std::span(&plane, 1));
    note_shaft(words, shaft, some);
    swept_infinite_batch(bodies.view(), std::span(&way, 1), out);
    note_shaft(words, shaft, some);
    shadow_batch(lights.view(), bodies.view(), out, {.a = std::span(&plane, 1)});
    note_shaft(words, shaft, some);
    shadow_batch(lights.view(), bodies.view(), 3.3F, out);
    note_shaft(words, shaft, some);
    shadow_batch(lights.view(), bodies.view(), std::span(&pair, 1), out);
    note_shaft(words, shaft, some);
    shadow_batch(lights.view(), bodies.view(), std::span(&pair, 1), 3.3F, out, {.b = std::span(&plane, 1)});
    note_shaft(words, shaft, some);
  });
  table.add("compile and compile_batch with open contact, set_contact", false, [&table](AnswerWords& words) {
    std::vector<CompiledShaft> out(3);
    const IndexPair pairs[] = {{0, 1}, {1, 2}, {3, 3}};
    const BoxView few = table.box_stream.view().slice(0, 3);
    const auto note_all = [&] {
      for (const CompiledShaft& shaft : out) note_shaft(words, shaft, table.box_stream.view().slice(0, 64));
    };
    compile_batch(few, table.box_stream.view().slice(3, 3), out, {}, Contact::open);
    note_all();
    set_contact(out, Contact::closed);
    note_all();
    compile_batch(table.box_stream, table.box_stream, pairs, out, {}, Contact::open);
    note_all();
    out[0] = compile(table.boxes[1], table.boxes[2], Contact::open);
    set_contact(out[1], Contact::closed);
    note_all();
  });
  table.add("compile_batch, complete", false, [&table](AnswerWords& words) {
    constexpr std::size_t pairs = 21;
    std::vector<CompiledShaft> out(pairs);
    compile_batch(table.box_stream.view().slice(0, pairs), table.box_stream.view().slice(pairs, pairs), out);
    for (CompiledShaft& shaft : out) {
      complete(shaft);
      note_shaft(words, shaft, table.box_stream.view().slice(0, 64));
    }
  });
  table.add("compile_batch of pairs, with planes", false, [&table](AnswerWords& words) {
    const IndexPair pairs[] = {{0, 1}, {1, 2}, {2, 2}, {5, 0}, {6, 3}};
    const std::vector<Plane> planes(8, Plane{{1, 2, 1e-40F}, 4});
    std::vector<CompiledShaft> out(std::size(pairs));
    const BoxView few = table.box_stream.view().slice(0, 8);
    compile_batch(few, few, pairs, out, {.a = planes});
    for (const CompiledShaft& shaft : out) note_shaft(words, shaft, table.box_stream.view().slice(0, 64));
  });
}

}  // namespace shaftcull
