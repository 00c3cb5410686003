/// Every public call that computes something, in one table, for tests of what is promised of all of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "oracle/random.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// What a call answered, as words.
using AnswerWords = std::vector<std::uint64_t>;

struct PublicCall {
  std::string name;
  bool asks_shafts;  ///< whether it gets the shafts that EveryCall was made with
  std::function<void(AnswerWords&)> call;
};

/// The calls, and all that they are given. Calls may be made again and again; each leaves what it was given as it was.
/// They do no floating-point arithmetic of their own.
class EveryCall {
 public:
  /// `shafts` are what queries ask; a group of them and more if there are over 64. Must be at least 1. Bounds and
  /// shafts touch often, so that exact predicates run too.
  EveryCall(std::vector<CompiledShaft> shafts, std::size_t bounds) : shafts_(std::move(shafts)) {
    Random random(4711);
    for (std::size_t i = 0; i != bounds; ++i) {
      boxes_.push_back(i % 3 == 0 ? random.grid_box(-5, 5) : random.box(-5, 5, 0.05F, 1.0F));
      spheres_.push_back({boxes_.back().lo, i % 5 == 0 ? random.integer(0, 3) : random.uniform(0.01F, 0.5F)});
      if (i % 7 == 0) candidates_.push_back(static_cast<std::uint32_t>(i));
    }
    for (std::size_t s = 0; s != shafts_.size(); ++s) {
      if (!is_moving(s)) between_.push_back(shafts_[s]);
    }
    box_stream_ = BoxStream(boxes_);
    sphere_stream_ = SphereStream(spheres_);
    for (std::size_t i = 0; i != bounds; ++i) {
      const Box& box = boxes_[i];
      triangles_.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, i % 4 == 0 ? box.lo : box.hi}});
    }
    triangle_stream_ = TriangleStream(triangles_);
    triangle_tree_ = TriangleTree(triangle_stream_.view());
    box_tree_ = BoxTree(box_stream_.view());
    sphere_tree_ = SphereTree(sphere_stream_.view());
    form_calls();
    stream_calls();
    triangle_calls(" in a view", triangle_stream_.view());
    triangle_calls(" in a tree", triangle_tree_);
    view_calls<Box>(box_stream_, boxes_, box_tree_);
    view_calls<Sphere>(sphere_stream_, spheres_, sphere_tree_);
  }
  EveryCall(const EveryCall&) = delete;
  EveryCall& operator=(const EveryCall&) = delete;

  [[nodiscard]] const std::vector<PublicCall>& calls() const noexcept { return calls_; }

  /// Shafts of all kinds: in slab form, with purple faces, with added planes, with and without their planes, of moving
  /// boxes, and with open contact.
  static std::vector<CompiledShaft> shafts(std::size_t count) {
    Random random(4712);
    std::vector<CompiledShaft> shafts(count);
    for (std::size_t s = 0; s != count; ++s) {
      Shaft shaft(s % 2 == 0 ? random.grid_box(-5, 5) : random.box(-5, 5, 0.2F, 2.0F), random.grid_box(-5, 5));
      if (s % 4 == 0) shaft.add_plane({{1, 2, 3}, 4});
      if (is_moving(s)) {
        const Box& body = shaft.a();
        const Vec3 way{1, 0.25F, s % 2 == 0 ? 0.0F : -3.0F};
        const Vec3 light{body.hi[0] + 2, body.lo[1], body.lo[2]};
        shafts[s] = s % 3 == 0   ? swept(body, way)
                    : s % 3 == 1 ? swept_without_end(body, way)
                                 : shadow({light, light}, body);
      } else if (s % 3 != 0 || s % 4 == 0) {
        shafts[s] = compile(shaft);
      } else {
        compile_batch(BoxStream(std::span(&shaft.a(), 1)).view(), BoxStream(std::span(&shaft.b(), 1)).view(),
                      std::span(&shafts[s], 1));
      }
      if (s % 5 == 2) set_contact(shafts[s], Contact::open);
    }
    return shafts;
  }

 private:
  /// Whether a shaft of shafts() is that of a moving box, which has no two ends.
  static bool is_moving(std::size_t shaft) { return shaft % 7 == 6; }

  template <class T>
  static void note(AnswerWords& words, const T& value) {
    if constexpr (std::is_same_v<T, float>) {
      words.push_back(std::bit_cast<std::uint32_t>(value));
    } else if constexpr (std::is_same_v<T, double>) {
      words.push_back(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<T, Box>) {
      for (const float x : value.lo) note(words, x);
      for (const float x : value.hi) note(words, x);
    } else if constexpr (std::is_same_v<T, Sphere>) {
      for (const float x : value.centre) note(words, x);
      note(words, value.radius);
    } else if constexpr (std::is_same_v<T, KeptCounts>) {
      words.push_back(value.overlap);
      words.push_back(value.inside);
    } else if constexpr (requires { value.time; }) {
      words.push_back(value.index);
      note(words, value.time);
    } else if constexpr (requires { value.first; }) {
      words.push_back(value.first);
      words.push_back(value.size);
    } else if constexpr (requires { value.begin(); }) {
      for (const auto& each : value) note(words, each);
    } else {
      words.push_back(static_cast<std::uint64_t>(value));
    }
  }
  /// Notes what a shaft holds by its answers for a few boxes: members that are not in use may hold anything.
  static void note_shaft(AnswerWords& words, const CompiledShaft& shaft, const BoxView& boxes) {
    std::vector<std::uint64_t> kept(words_for(boxes.count));
    std::vector<std::uint64_t> inside(kept.size());
    classify(shaft, boxes, kept, inside, Form::slab);
    note(words, kept);
    classify(shaft, boxes, kept, inside, Form::planes);
    note(words, kept);
    note(words, inside);
  }
  void add(std::string name, bool asks_shafts, std::function<void(AnswerWords&)> call) {
    calls_.push_back({std::move(name), asks_shafts, std::move(call)});
  }

  void form_calls() {
    add("Shaft", false, [this](AnswerWords& words) {
      for (const PlaneOrder order : {PlaneOrder::unsorted, PlaneOrder::by_volume, PlaneOrder::by_added_volume}) {
        for (const Formation formation : {Formation::search, Formation::table64, Formation::table729}) {
          ShaftOptions options;
          options.order = order;
          options.formation = formation;
          Shaft shaft(boxes_[1], boxes_[2], options);
          shaft.add_plane({{1, 2, 3}, 4});
          for (const JoiningPlane& plane : shaft.joining_planes()) {
            note(words, plane.plane.normal);
            note(words, plane.plane.offset);
            note(words, culled_volume(shaft.box(), plane));
          }
        }
      }
    });
    add("compile", false, [this](AnswerWords& words) {
      note_shaft(words, compile(Shaft(boxes_[1], boxes_[2])), box_stream_.view().slice(0, 64));
    });
    add("compile of boxes", false, [this](AnswerWords& words) {
      note_shaft(words, compile(boxes_[1], boxes_[2]), box_stream_.view().slice(0, 64));
    });
    add("ConvexHull, frustum, casters, casters_towards", false, [this](AnswerWords& words) {
      constexpr float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};
      const ConvexHull view = frustum(matrix, ClipDepth::minus_one_to_one);
      const std::vector<Vec3> points = {{0, 0, 0}, {3, 1e-3F, 1}, {1, 2, 4}, {0.1F, 5, 1e-39F}};
      for (const ConvexHull& hull : {view, casters(view, {0.3F, 9, 5}), casters_towards(view, {0, 1, 0.1F}),
                                     ConvexHull(points), ConvexHull(points, std::span(points).last(1))}) {
        note_shaft(words, hull, box_stream_.view().slice(0, 64));
      }
    });
    add("swept, swept_without_end, shadow", false, [this](AnswerWords& words) {
      const std::vector<Plane> planes(2, Plane{{1, 2, 3}, 4});
      const Box light{{9, 9, 9}, {9.5F, 9, 9.25F}};
      for (const CompiledShaft& shaft :
           {swept(boxes_[1], {0.1F, 2, 1e-30F}), swept(boxes_[1], {0.1F, 2, 1e-30F}, planes),
            swept_without_end(boxes_[1], {0.3F, -1, 1e-40F}), swept_without_end(boxes_[1], {0, -1, 0}, planes),
            shadow(light, boxes_[1]), shadow(light, boxes_[1], 3.3F), shadow(light, boxes_[1], 1.1F, planes)}) {
        note_shaft(words, shaft, box_stream_.view().slice(0, 64));
      }
    });
    add("swept_batch, swept_without_end_batch, shadow_batch", false, [this](AnswerWords& words) {
      const Box body{{0, 0, 0}, {1, 1.5F, 2}};
      const Box light{{9, 9, 9}, {9.5F, 9, 9.25F}};
      const BoxStream bodies(std::span(&body, 1));
      const BoxStream lights(std::span(&light, 1));
      const Vec3 way{0.1F, 2, 1e-30F};
      const Plane plane{{1, 2, 3}, 4};
      const IndexPair pair{0, 0};
      CompiledShaft shaft;
      const std::span<CompiledShaft> out(&shaft, 1);
      const BoxView some = box_stream_.view().slice(0, 64);
      swept_batch(bodies.view(), std::span(&way, 1), out, std::span(&plane, 1));
      note_shaft(words, shaft, some);
      swept_without_end_batch(bodies.view(), std::span(&way, 1), out);
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
    add("compile and compile_batch with open contact, set_contact", false, [this](AnswerWords& words) {
      std::vector<CompiledShaft> out(3);
      const IndexPair pairs[] = {{0, 1}, {1, 2}, {3, 3}};
      const BoxView few = box_stream_.view().slice(0, 3);
      const auto note_all = [&] {
        for (const CompiledShaft& shaft : out) note_shaft(words, shaft, box_stream_.view().slice(0, 64));
      };
      compile_batch(few, box_stream_.view().slice(3, 3), out, {}, Contact::open);
      note_all();
      set_contact(out, Contact::closed);
      note_all();
      compile_batch(box_stream_, box_stream_, pairs, out, {}, Contact::open);
      note_all();
      out[0] = compile(boxes_[1], boxes_[2], Contact::open);
      set_contact(out[1], Contact::closed);
      note_all();
    });
    add("compile_batch, complete", false, [this](AnswerWords& words) {
      constexpr std::size_t pairs = 21;
      std::vector<CompiledShaft> out(pairs);
      compile_batch(box_stream_.view().slice(0, pairs), box_stream_.view().slice(pairs, pairs), out);
      for (CompiledShaft& shaft : out) {
        complete(shaft);
        note_shaft(words, shaft, box_stream_.view().slice(0, 64));
      }
    });
    add("compile_batch of pairs, with planes", false, [this](AnswerWords& words) {
      const IndexPair pairs[] = {{0, 1}, {1, 2}, {2, 2}, {5, 0}, {6, 3}};
      const std::vector<Plane> planes(8, Plane{{1, 2, 3}, 4});
      std::vector<CompiledShaft> out(std::size(pairs));
      const BoxView few = box_stream_.view().slice(0, 8);
      compile_batch(few, few, pairs, out, {.a = planes});
      for (const CompiledShaft& shaft : out) note_shaft(words, shaft, box_stream_.view().slice(0, 64));
    });
  }

  void stream_calls() {
    add("BoxStream", false, [this](AnswerWords& words) {
      BoxStream stream(boxes_);
      stream.update(3, std::span<const Box>(boxes_).first(9));
      for (std::size_t i = 0; i < stream.size(); i += 5) note(words, stream[i]);
      note(words, BoxStream(stream)[2]);
    });
    for (int i = 0; i != 70; ++i) {
      for (const float x : {0.1F, 0.3F, 1e-40F, 0.7F, 1e-30F, 3.3F}) centres_.push_back(x * static_cast<float>(i));
    }
    add("BoxStream and BoxTree of centres", false, [this](AnswerWords& words) {
      const BoxStream stream(CentreExtentRecords{centres_.data(), centres_.data() + 3, 6 * sizeof(float), 70});
      for (std::size_t i = 0; i != stream.size(); ++i) note(words, stream[i]);
      BoxTree tree(CentreExtentRecords{centres_.data(), centres_.data() + 3, 6 * sizeof(float), 70});
      tree.update(CentreExtentRecords{centres_.data(), centres_.data() + 3, 6 * sizeof(float), 70});
      for (std::size_t i = 0; i != tree.size(); ++i) note(words, tree.leaves()[i]);
    });
    add("SphereStream", false, [this](AnswerWords& words) {
      SphereStream stream(spheres_);
      stream.update(3, std::span<const Sphere>(spheres_).first(9));
      for (std::size_t i = 0; i < stream.size(); i += 5) note(words, stream[i]);
    });
  }

  /// Of a view or of a tree that the caller keeps.
  template <class Triangles>
  void triangle_calls(const std::string& of, const Triangles& triangles) {
    const std::size_t count = triangles_.size();
    const auto ask = [&](std::string name, auto call) {
      for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
        const std::string what = name + of + (test == TriangleTest::exact ? ", exactly" : ", by vertices");
        if constexpr (std::is_same_v<Triangles, TriangleView>) {
          add(what, true, [=, this](AnswerWords& words) { call(words, triangle_stream_.view(), test); });
        } else {
          add(what, true, [=, &triangles](AnswerWords& words) { call(words, triangles, test); });
        }
      }
    };
    ask("cull of triangles", [=, this](AnswerWords& words, const Triangles& all, TriangleTest test) {
      std::vector<std::uint64_t> kept(words_for(count));
      for (const CompiledShaft& shaft : shafts_) {
        cull(shaft, all, kept, test);
        note(words, kept);
        note(words, cull(shaft, triangles_[1], test));
      }
    });
    ask("count, any, list of triangles", [=, this](AnswerWords& words, const Triangles& all, TriangleTest test) {
      std::vector<std::uint32_t> kept(count);
      for (const CompiledShaft& shaft : shafts_) {
        note(words, shaftcull::count(shaft, all, test));
        note(words, any(shaft, all, test));
        note(words, std::span(kept).first(list(shaft, all, kept, test)));
      }
    });
    ask("cull_many, count_many, any_many of triangles",
        [=, this](AnswerWords& words, const Triangles& all, TriangleTest test) {
          std::vector<std::uint64_t> kept(shafts_.size() * words_for(count));
          cull_many(shafts_, all, kept, test);
          note(words, kept);
          std::vector<std::uint64_t> counts(shafts_.size());
          count_many(shafts_, all, counts, test);
          note(words, counts);
          std::vector<std::uint64_t> found(words_for(shafts_.size()));
          any_many(shafts_, all, found, test);
          note(words, found);
        });
    ask("list_many of triangles", [=, this](AnswerWords& words, const Triangles& all, TriangleTest test) {
      IndexLists lists;
      list_many(shafts_, all, lists, test);
      note(words, lists.offsets);
      note(words, lists.indices);
    });
    add("TriangleStream, TriangleTree" + of, false, [this](AnswerWords& words) {
      TriangleStream stream(triangles_);
      stream.update(3, std::span<const Triangle>(triangles_).first(9));
      const TriangleTree tree(stream.view());
      note(words, tree.order());
      note(words, tree.box());
    });
  }

  template <class Bound>
  void view_calls(const auto& stream, const std::vector<Bound>& bounds, BoundsTree<Bound>& tree) {
    const std::string of = std::is_same_v<Bound, Box> ? " of boxes" : " of spheres";
    const auto view = stream.view();
    const std::size_t words_a_row = words_for(view.count);
    for (const Form form : {Form::slab, Form::planes}) {
      const std::string how = of + (form == Form::slab ? ", slab form" : ", planes form");
      add("cull" + how, true, [=, this](AnswerWords& words) {
        std::vector<std::uint64_t> kept(words_a_row);
        for (const CompiledShaft& shaft : shafts_) {
          cull(shaft, view, kept, form);
          note(words, kept);
        }
      });
      add("classify" + how, true, [=, this](AnswerWords& words) {
        std::vector<std::uint64_t> kept(words_a_row);
        std::vector<std::uint64_t> inside(words_a_row);
        for (const CompiledShaft& shaft : shafts_) {
          classify(shaft, view, kept, inside, form);
          note(words, kept);
          note(words, inside);
        }
      });
      add("count, any" + how, true, [=, this](AnswerWords& words) {
        for (const CompiledShaft& shaft : shafts_) {
          note(words, count(shaft, view, form));
          note(words, count_classified(shaft, view, form));
          note(words, any(shaft, view, form));
          note(words, count_at_most(shaft, view, 5, form));
        }
      });
      add("list" + how, true, [=, this](AnswerWords& words) {
        std::vector<std::uint32_t> kept(view.count);
        for (const CompiledShaft& shaft : shafts_) {
          note(words, std::span(kept).first(list(shaft, view, kept, form)));
          const std::span<std::uint32_t> few = std::span(kept).first(view.count / 8);
          note(words, few.first(list_at_most(shaft, view, few, form)));
        }
      });
      add("list_classified" + how, true, [=, this](AnswerWords& words) {
        std::vector<std::uint64_t> overlap(view.count);
        std::vector<std::uint64_t> inside(view.count);
        for (const CompiledShaft& shaft : shafts_) {
          const KeptCounts counts = list_classified(shaft, view, overlap, inside, form);
          note(words, std::span(overlap).first(counts.overlap));
          note(words, std::span(inside).first(counts.inside));
        }
      });
      add("first_contact" + how, true, [=, this](AnswerWords& words) {
        std::vector<float> times(candidates_.size());
        for (const CompiledShaft& shaft : shafts_) {
          note(words, first_contact(shaft, view, form));
          entry_times(shaft, view, std::span<const std::uint32_t>(candidates_), times);
          note(words, times);
        }
      });
      for (const std::size_t some : {std::size_t{3}, shafts_.size()}) {
        const std::size_t count = std::min(some, shafts_.size());
        const std::string many = how + ", " + std::to_string(count) + " shafts";
        const auto asked = [this, count] { return std::span<const CompiledShaft>(shafts_).last(count); };
        add("cull_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint64_t> kept(count * words_a_row);
          cull_many(asked(), view, kept, form);
          note(words, kept);
        });
        add("classify_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint64_t> kept(count * words_a_row);
          std::vector<std::uint64_t> inside(kept.size());
          classify_many(asked(), view, kept, inside, form);
          note(words, kept);
          note(words, inside);
        });
        add("count_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint64_t> counts(count);
          count_many(asked(), view, counts, form);
          note(words, counts);
        });
        add("count_classified_many" + many, true, [=](AnswerWords& words) {
          std::vector<KeptCounts> counts(count);
          count_classified_many(asked(), view, counts, form);
          note(words, counts);
        });
        add("any_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint64_t> bits(words_for(count));
          any_many(asked(), view, bits, form);
          note(words, bits);
        });
        add("first_contact_many" + many, true, [=](AnswerWords& words) {
          std::vector<FirstContactOf<std::uint64_t>> contacts(count);
          first_contact_many(asked(), view, contacts, form);
          note(words, contacts);
        });
        add("count_at_most_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint64_t> counts(count);
          count_at_most_many(asked(), view, 5, counts, form);
          note(words, counts);
        });
        add("list_at_most_many" + many, true, [=](AnswerWords& words) {
          std::vector<std::uint32_t> kept(5 * count);
          std::vector<std::uint64_t> counts(count);
          list_at_most_many(asked(), view, 5, kept, counts, form);
          note(words, kept);
          note(words, counts);
        });
        add("list_many" + many, true, [=](AnswerWords& words) {
          IndexLists lists;
          list_many(asked(), view, lists, form);
          note(words, lists.offsets);
          note(words, lists.indices);
        });
        add("list_classified_many" + many, true, [=](AnswerWords& words) {
          IndexLists overlap;
          IndexLists inside;
          list_classified_many(asked(), view, overlap, inside, form);
          note(words, overlap.indices);
          note(words, inside.indices);
        });
        add("for_each_tile" + many, true, [=](AnswerWords& words) {
          for_each_tile(
              asked(), view, [&](const TileAnswers& answers) { note(words, answers.kept); }, form);
        });
        add("for_each_classified_tile" + many, true, [=](AnswerWords& words) {
          for_each_classified_tile(
              asked(), view, [&](const TileAnswers& answers) { note(words, answers.inside); }, form);
        });
      }
    }
    add("contained" + of, true, [=, this](AnswerWords& words) {
      std::vector<std::uint64_t> inside(words_a_row);
      for (const CompiledShaft& shaft : shafts_) {
        contained(shaft, view, inside);
        note(words, inside);
      }
    });
    add("contained_many" + of, true, [=, this](AnswerWords& words) {
      std::vector<std::uint64_t> inside(shafts_.size() * words_a_row);
      contained_many(shafts_, view, inside);
      note(words, inside);
    });
    add("classify one" + of, true, [=, this, &bounds](AnswerWords& words) {
      for (const CompiledShaft& shaft : shafts_) note(words, static_cast<unsigned>(classify(shaft, bounds[1])));
    });
    add("cull one" + of, true, [=, this, &bounds](AnswerWords& words) {
      for (const CompiledShaft& shaft : shafts_) note(words, cull(shaft, bounds[1]));
    });
    if constexpr (std::is_same_v<Bound, Box>) blocked_calls(view, bounds, tree);
    add("refine" + of, true, [=, this](AnswerWords& words) {
      std::vector<std::uint32_t> kept(candidates_.size());
      for (const CompiledShaft& shaft : shafts_) {
        note(words, std::span(kept).first(refine(shaft, view, std::span<const std::uint32_t>(candidates_), kept)));
      }
    });
    add("refine_many" + of, true, [=, this](AnswerWords& words) {
      IndexLists lists;
      refine_many(shafts_, view, candidates_, lists);
      note(words, lists.indices);
    });
    tree_calls<Bound>(of, view, bounds, tree);
  }

  void blocked_calls(const BoxView& view, const std::vector<Box>& boxes, const BoxTree& tree) {
    const std::vector<Vec3> corners = {{-9, -9, -9}, {9, -9, -8}, {9, 9, 8.5F}, {-9, 9, 8}};
    add("blocked", true, [=, this, &boxes, &tree](AnswerWords& words) {
      for (const CompiledShaft& shaft : between_) {
        note(words, blocked(shaft, boxes[1]));
        note(words, blocked(shaft, view));
        note(words, blocked(shaft, corners));
        note(words, blocked(shaft, tree, {.own = candidates_}));
        note(words, blocked_by(shaft, view).value_or(view.count));
        note(words, blocked_by(shaft, tree).value_or(999));
      }
    });
    add("list_blocking", true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint32_t> listed(view.count);
      std::vector<std::uint64_t> wide(view.count);
      for (const CompiledShaft& shaft : between_) {
        note(words, std::span(listed).first(list_blocking(shaft, view, listed)));
        note(words, std::span(wide).first(list_blocking(shaft, view, wide)));
        note(words, std::span(listed).first(list_blocking(shaft, tree, listed, {.own = candidates_})));
      }
    });
    add("list_blocking_many", true, [=, this, &tree](AnswerWords& words) {
      IndexLists lists;
      list_blocking_many(between_, view, lists);
      note(words, lists.offsets);
      note(words, lists.indices);
      list_blocking_many(between_, tree, lists);
      note(words, lists.indices);
    });
    add("blocked_many", true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint64_t> bits(words_for(between_.size()));
      blocked_many(between_, view, bits);
      note(words, bits);
      blocked_many(between_, tree, bits);
      note(words, bits);
    });
  }

  template <class Bound>
  void tree_calls(const std::string& of, const ViewOf<Bound>& view, const std::vector<Bound>& bounds,
                  BoundsTree<Bound>& tree) {
    const auto note_tree = [](AnswerWords& words, const BoundsTree<Bound>& built) {
      note(words, built.order());
      note(words, built.growth());
      for (std::size_t i = 0; i < built.size(); i += 9) note(words, built.leaves()[i]);
    };
    add("tree" + of, false, [=](AnswerWords& words) { note_tree(words, BoundsTree<Bound>(view)); });
    add("tree of records" + of, false, [=, &bounds](AnswerWords& words) {
      BoundsTree<Bound> built{std::span<const Bound>(bounds)};
      built.update(std::span<const Bound>(bounds));
      note_tree(words, built);
    });
    add("update, refit, rebuild, renumber of a tree" + of, false, [=, this, &bounds, &tree](AnswerWords& words) {
      BoundsTree<Bound> moved(tree);
      moved.update(std::span<const std::uint32_t>(candidates_), view.slice(0, candidates_.size()));
      moved.refit();
      note_tree(words, moved);
      moved.update(std::span<const std::uint32_t>(candidates_).first(2), std::span<const Bound>(bounds).first(2));
      moved.refit();
      moved.update(view);
      note_tree(words, moved);
      moved.rebuild();
      moved.renumber();
      note_tree(words, moved);
    });
    add("first_contact, first_contact_many in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<FirstContact> contacts(shafts_.size());
      std::vector<float> times(candidates_.size());
      for (const CompiledShaft& shaft : shafts_) {
        note(words, first_contact(shaft, tree, {.own = candidates_}));
        entry_times(shaft, tree, candidates_, times);
        note(words, times);
      }
      first_contact_many(shafts_, tree, contacts);
      note(words, contacts);
    });
    add("keep_layers" + of, true, [=, this](AnswerWords& words) {
      std::vector<std::uint64_t> kept(words_for(view.count));
      std::vector<std::uint32_t> layers(view.count);
      for (std::size_t i = 0; i != layers.size(); ++i) layers[i] = 1U << i % 5;
      for (const CompiledShaft& shaft : shafts_) {
        cull(shaft, view, kept);
        keep_layers(kept, layers, 9);
        note(words, kept);
      }
    });
    add("layers of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      BoundsTree<Bound> layered(tree);
      std::vector<std::uint32_t> layers(tree.size());
      for (std::size_t i = 0; i != layers.size(); ++i) layers[i] = 1U << i % 5;
      layered.set_layers(layers);
      layered.rebuild();
      layered.set_layers(std::span<const std::uint32_t>(candidates_), std::span(layers).first(candidates_.size()));
      note(words, layered.layers());
      std::vector<std::uint32_t> kept(tree.size());
      for (const CompiledShaft& shaft : shafts_) {
        note(words, std::span(kept).first(list(shaft, layered, std::span(kept), {.only_layers = {3}})));
      }
    });
    add("count_at_most, list_at_most and both of many in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint32_t> kept(tree.size() / 8);
      for (const CompiledShaft& shaft : shafts_) {
        note(words, count_at_most(shaft, tree, 5, {.own = candidates_}));
        note(words, std::span(kept).first(list_at_most(shaft, tree, std::span(kept))));
      }
      std::vector<std::uint64_t> counts(shafts_.size());
      count_at_most_many(shafts_, tree, 5, counts);
      note(words, counts);
      kept.assign(5 * shafts_.size(), 0);
      list_at_most_many(shafts_, tree, 5, kept, counts);
      note(words, kept);
      note(words, counts);
    });
    add("box of a tree" + of, false, [=, &tree](AnswerWords& words) { note(words, tree.box()); });
    add("cull, contained, classify of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint64_t> kept(words_for(tree.size()));
      std::vector<std::uint64_t> inside(kept.size());
      for (const CompiledShaft& shaft : shafts_) {
        cull(shaft, tree, kept, {.own = candidates_});
        contained(shaft, tree, inside);
        note(words, kept);
        note(words, inside);
        classify(shaft, tree, kept, inside);
        note(words, kept);
        note(words, inside);
      }
    });
    add("cull_many, contained_many, classify_many of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint64_t> kept(shafts_.size() * words_for(tree.size()));
      std::vector<std::uint64_t> inside(kept.size());
      cull_many(shafts_, tree, kept);
      contained_many(shafts_, tree, inside);
      note(words, kept);
      note(words, inside);
      classify_many(shafts_, tree, kept, inside);
      note(words, kept);
      note(words, inside);
    });
    add("any, any_many in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      for (const CompiledShaft& shaft : shafts_) note(words, any(shaft, tree));
      std::vector<std::uint64_t> found(words_for(shafts_.size()));
      any_many(shafts_, tree, found);
      note(words, found);
    });
    add("refine, refine_many of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint32_t> kept(candidates_.size());
      for (const CompiledShaft& shaft : shafts_) {
        note(words, std::span(kept).first(refine(shaft, tree, candidates_, kept)));
      }
      IndexLists lists;
      refine_many(shafts_, BoundsTree<Bound>(tree), candidates_, lists);  // looks up the leaves of indices
      note(words, lists.indices);
    });
    add("count in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      for (const CompiledShaft& shaft : shafts_) note(words, count(shaft, tree, {.own = candidates_}));
    });
    add("count_classified in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      for (const CompiledShaft& shaft : shafts_) note(words, count_classified(shaft, tree));
    });
    add("list of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint32_t> kept(tree.size());
      std::vector<LeafRange> ranges(tree.size());
      for (const CompiledShaft& shaft : shafts_) {
        note(words, std::span(kept).first(list(shaft, tree, std::span(kept))));
        note(words, std::span(ranges).first(list(shaft, tree, std::span(ranges))));
      }
    });
    add("list_classified of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint32_t> overlap(tree.size());
      std::vector<std::uint32_t> inside(tree.size());
      for (const CompiledShaft& shaft : shafts_) {
        const KeptCounts counts = list_classified(shaft, tree, std::span(overlap), std::span(inside));
        note(words, std::span(overlap).first(counts.overlap));
        note(words, std::span(inside).first(counts.inside));
      }
    });
    add("count_many in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<std::uint64_t> counts(shafts_.size());
      count_many(shafts_, tree, counts);
      note(words, counts);
    });
    add("count_classified_many in a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      std::vector<KeptCounts> counts(shafts_.size());
      count_classified_many(shafts_, tree, counts);
      note(words, counts);
    });
    add("list_many of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      IndexLists overlap;
      IndexLists inside;
      list_many(shafts_, tree, overlap);
      note(words, overlap.indices);
      list_classified_many(shafts_, tree, overlap, inside);
      note(words, overlap.indices);
      note(words, inside.indices);
      LeafRangeLists ranges;
      list_many(shafts_, tree, ranges);
      note(words, ranges.ranges);
    });
    add("for_each_kept of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      for_each_kept(shafts_, tree, [&](const KeptRanges& answers) { note(words, answers.kept); });
    });
    add("for_each_classified of a tree" + of, true, [=, this, &tree](AnswerWords& words) {
      for_each_classified(shafts_, tree, [&](const ClassifiedRanges& answers) {
        note(words, answers.overlap);
        note(words, answers.inside);
      });
    });
  }

  std::vector<CompiledShaft> shafts_;
  std::vector<CompiledShaft> between_;  ///< those of them that are between two boxes
  std::vector<Box> boxes_;
  std::vector<Sphere> spheres_;
  std::vector<std::uint32_t> candidates_;
  std::vector<float> centres_;  ///< with half extents
  BoxStream box_stream_;
  SphereStream sphere_stream_;
  std::vector<Triangle> triangles_;
  TriangleStream triangle_stream_;
  TriangleTree triangle_tree_;
  BoxTree box_tree_;
  SphereTree sphere_tree_;
  std::vector<PublicCall> calls_;
};

}  // namespace shaftcull
