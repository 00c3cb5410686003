// SPDX-License-Identifier: MIT
/// What sees what, of all pairs of patches; and solid boxes for it.
#include "shaftcull/visibility.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <future>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "module.hpp"
#include "results.hpp"
#include "shaftcull/solids.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

namespace {

constexpr std::array<const char*, 4> sight_names = {"undecided", "clear", "blocked", "facing_away"};

Sight sight_in(const std::string& sight) {
  for (std::size_t i = 0; i != sight_names.size(); ++i) {
    if (sight == sight_names[i]) return static_cast<Sight>(i);
  }
  throw py::value_error("sight is '" + sight + "'; it must be 'undecided', 'clear', 'blocked' or 'facing_away'");
}

/// Boxes of an argument in streams. Errors name the argument.
class BoxesInStreams {
 public:
  BoxesInStreams(const py::object& given, const std::string& name) : in_(boxes_in(given, name)) {
    try {
      if (const BoxView* const view = std::get_if<BoxView>(&in_.where)) {
        view_ = *view;
      } else {
        packed_ = BoxStream(std::get<MinMaxRecords>(in_.where));
        view_ = packed_.view();
      }
    } catch (const BadBound& bad) {
      const std::string what = bad.what();
      // Streams also take the empty box, which can be no patch and no blocker.
      throw BadBound(bad.index(), name + ": " + what.substr(0, what.find(", or the box empty")));
    }
  }
  [[nodiscard]] const BoxView& view() const noexcept { return view_; }

 private:
  BoxesIn in_;
  BoxStream packed_;
  BoxView view_;
};

/// One plane a patch: (n, 4), or (4,) for all.
std::vector<Plane> patch_planes_in(const py::object& given, const std::string& name, std::size_t patches) {
  if (given.is_none()) return {};
  const py::array_t<float> array = in_c_order(floats_in(given, name));
  const bool for_all = array.ndim() == 1 && array.shape(0) == 4;
  if (!for_all && (array.ndim() != 2 || array.shape(1) != 4 || static_cast<std::size_t>(array.shape(0)) != patches)) {
    throw py::value_error(name + " has shape " + shape_of(array) + "; it must be (" + std::to_string(patches) +
                          ", 4), a plane for each patch, or (4,) for all: normal x, y, z and offset");
  }
  std::vector<Plane> planes(patches);
  for (std::size_t i = 0; i != patches; ++i) {
    const float* const plane = array.data() + (for_all ? 0 : 4 * i);
    planes[i] = {{plane[0], plane[1], plane[2]}, plane[3]};
  }
  return planes;
}

PatchSet patches_in(const py::object& boxes, const py::object& planes, const std::string& name,
                    const std::string& planes_name) {
  if (py::isinstance<PatchSet>(boxes)) {
    if (!planes.is_none()) throw py::value_error(planes_name + " are given, but " + name + " are Patches already");
    return boxes.cast<PatchSet>();
  }
  const BoxesInStreams in(boxes, name);
  const std::vector<Plane> facing = patch_planes_in(planes, planes_name, in.view().count);
  const py::gil_scoped_release release;
  try {
    return PatchSet(in.view(), facing);
  } catch (const BadBound& bad) {
    throw BadBound(bad.index(), name + ": " + bad.what());
  }
}

/// Corners of hulls or polygons: an array (n, k, 3), or a sequence of arrays (k, 3).
struct CornersIn {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
};
CornersIn corners_in(const py::object& given, const std::string& name) {
  CornersIn in;
  if (py::isinstance<py::array>(given)) {
    const py::array_t<float> array = in_c_order(floats_in(given, name));
    if (array.ndim() != 3 || array.shape(2) != 3) {
      throw py::value_error(name + " has shape " + shape_of(array) +
                            "; it must be (n, k, 3), or a list of arrays (k, 3)");
    }
    const auto corners = static_cast<std::size_t>(array.shape(1));
    const float* at = array.data();
    for (py::ssize_t i = 0; i != array.shape(0); ++i) {
      for (std::size_t corner = 0; corner != corners; ++corner, at += 3) in.corners.push_back({at[0], at[1], at[2]});
      in.first.push_back(in.corners.size());
    }
    return in;
  }
  for (const py::handle& one : given) {
    const VectorsIn vectors =
        vectors_in(py::reinterpret_borrow<py::object>(one), name + "[" + std::to_string(in.first.size() - 1) + "]");
    in.corners.insert(in.corners.end(), vectors.vectors.begin(), vectors.vectors.end());
    in.first.push_back(in.corners.size());
  }
  return in;
}

/// What Python knows as shaftcull.Blockers. It never changes.
struct BlockersHolder {
  std::shared_ptr<const Blockers> all;
  std::vector<std::pair<std::string, std::size_t>> first;  ///< what each argument's first blocker is
};

/// The arguments that say what stands between.
struct BlockerArguments {
  const py::object& solids;
  const py::object& hulls;
  const py::object& polygons;
  const py::object& triangles;
  const py::object& faces;
  const py::object& groups;
};

BlockersHolder blockers_in(const py::object& boxes, const BlockerArguments& more) {
  if (py::isinstance<BlockersHolder>(boxes)) {
    for (const py::object* const other :
         {&more.solids, &more.hulls, &more.polygons, &more.triangles, &more.faces, &more.groups}) {
      if (!other->is_none()) throw py::value_error("blockers are Blockers already; nothing can be added to them");
    }
    return boxes.cast<BlockersHolder>();
  }
  Blockers all;
  BlockersHolder holder;
  const auto add = [&](const py::object& given, const char* name, auto&& to_all) {
    if (given.is_none()) return;
    try {
      holder.first.emplace_back(name, to_all(given, name));
    } catch (const BadBound& bad) {
      const std::string what = bad.what();
      throw BadBound(bad.index(), what.rfind(name, 0) == 0 ? what : std::string(name) + ": " + what);
    } catch (const InvalidArgument& bad) {
      throw InvalidArgument(std::string(name) + ": " + bad.what());
    }
  };
  add(boxes, "blockers", [&](const py::object& given, const char* name) {
    const BoxesInStreams in(given, name);
    const py::gil_scoped_release release;
    return all.add_boxes(in.view());
  });
  add(more.solids, "solids", [&](const py::object& given, const char* name) {
    const BoxesInStreams in(given, name);
    const py::gil_scoped_release release;
    return all.add_solids(in.view());
  });
  add(more.hulls, "hulls", [&](const py::object& given, const char* name) {
    const CornersIn in = corners_in(given, name);
    const py::gil_scoped_release release;
    return all.add_solid_hulls(in.corners, in.first);
  });
  add(more.polygons, "polygons", [&](const py::object& given, const char* name) {
    const CornersIn in = corners_in(given, name);
    const py::gil_scoped_release release;
    return all.add_polygons(in.corners, in.first);
  });
  add(more.triangles, "triangles", [&](const py::object& given, const char* name) {
    const TrianglesIn in = triangles_in(given, more.faces, name);
    std::vector<std::size_t> first;
    if (!more.groups.is_none()) {
      const IndicesIn groups = indices_in(more.groups, "groups", in.count + 1, "places where a group can begin or end");
      first.assign(groups.indices.begin(), groups.indices.end());
    }
    const py::gil_scoped_release release;
    return std::visit(
        [&]<class Where>(const Where& where) {
          if constexpr (std::is_same_v<Where, TriangleView>) {
            return all.add_triangles(where, first);
          } else {
            return all.add_triangles(TriangleStream(where).view(), first);
          }
        },
        in.where);
  });
  if (more.triangles.is_none() && (!more.faces.is_none() || !more.groups.is_none())) {
    throw py::value_error("faces and groups are of triangles, which are not given");
  }
  holder.all = std::make_shared<const Blockers>(std::move(all));
  return holder;
}

/// What is asked of whom.
struct Asked {
  PatchSet a;
  PatchSet b;
  bool of_one_set = false;
  BlockersHolder blockers;
  VisibilityOptions options;

  Asked(const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
        const py::object& boxes, const BlockerArguments& more, const std::string& contact, bool solids_around_ends,
        std::size_t memory)
      : of_one_set(patches_b.is_none()) {
    a = patches_in(patches, planes, "patches", "planes");
    if (of_one_set) {
      if (!planes_b.is_none()) throw py::value_error("planes_b are given, but no patches_b");
      b = a;
    } else {
      b = patches_in(patches_b, planes_b, "patches_b", "planes_b");
    }
    blockers = blockers_in(boxes, more);
    options.contact = contact_in(contact);
    options.solids_around_ends = solids_around_ends;
    options.memory = memory;
  }
};

/// Runs a long call on a thread of its own, while this one hears signals and tells of progress. An exception of either
/// ends the call.
template <class Call>
auto while_hearing(VisibilityOptions options, const py::object& progress, Call&& call) {
  begin_parallel();
  std::atomic<std::uint64_t> done{0};
  std::atomic<std::uint64_t> total{0};
  std::atomic<bool> stop{false};
  options.progress = [&](const VisibilityProgress& come) {
    total = come.total;
    done = come.done;
    return !stop;
  };
  const auto tell = [&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(done.load(), total.load());
  };
  std::future<decltype(call(options))> answer;
  {
    const py::gil_scoped_release release;
    answer = std::async(std::launch::async, [&] { return call(options); });
  }
  const auto has_ended = [&] {
    const py::gil_scoped_release release;
    return answer.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready;
  };
  try {
    while (!has_ended()) tell();
  } catch (...) {
    stop = true;
    {
      const py::gil_scoped_release release;
      answer.wait();
    }
    throw;
  }
  auto result = answer.get();
  tell();
  return result;
}

py::dict counts_of(const SightCounts& counts) {
  py::dict dict;
  dict["undecided"] = counts.undecided;
  dict["clear"] = counts.clear;
  dict["blocked"] = counts.blocked;
  dict["facing_away"] = counts.facing_away;
  return dict;
}

/// What Python knows as shaftcull.Visibility.
struct Sights {
  Visibility all;
  PatchSet a;
  PatchSet b;
  bool of_one_set;
  bool has_candidates;
  BlockersHolder blockers;

  /// Calls use(i, j) for each pair of a kind, by the user's indices.
  template <class Use>
  void for_each(Sight sight, Use&& use) const {
    for (const SightProduct& product : all.products) {
      if (product.sight != sight) continue;
      for (const std::uint32_t i : a.order().subspan(product.a.first, product.a.count)) {
        for (const std::uint32_t j : b.order().subspan(product.b.first, product.b.count)) use(i, j);
      }
    }
    if (sight != Sight::undecided) return;
    for (const PatchPair& pair : all.undecided) use(pair.a, pair.b);
  }
};

/// An array in the memory of an object, which it keeps alive. It is not written to.
template <class Number>
py::array seen_in(const py::object& owner, const Number* first, std::vector<py::ssize_t> shape,
                  std::vector<py::ssize_t> strides) {
  static constexpr Number none{};
  py::array_t<Number> array(std::move(shape), std::move(strides), first == nullptr ? &none : first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array order_of(const PatchSet& set) {
  return array_of(std::vector<std::uint32_t>(set.order().begin(), set.order().end()));
}

py::array pairs_of(const Sights& sights, const std::string& name) {
  const Sight sight = sight_in(name);
  const SightCounts& counts = sights.all.counts;
  const std::array<std::uint64_t, 4> numbers = {counts.undecided, counts.clear, counts.blocked, counts.facing_away};
  py::array_t<std::uint32_t> array(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(numbers[static_cast<std::size_t>(sight)]), 2});
  std::uint32_t* to = array.mutable_data();
  const py::gil_scoped_release release;
  sights.for_each(sight, [&to](std::uint32_t i, std::uint32_t j) {
    *to++ = i;
    *to++ = j;
  });
  return array;
}

py::array bits_of(const Sights& sights, const std::string& name, bool packed) {
  const Sight sight = sight_in(name);
  const std::size_t rows = sights.a.size();
  const std::size_t words = words_for(sights.b.size());
  const std::size_t row = packed ? words : sights.b.size();
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(row)};
  const auto fill = [&](auto* to, auto&& set) {
    std::fill_n(to, rows * row, 0);
    sights.for_each(sight, [&](std::uint32_t i, std::uint32_t j) {
      set(to + i * row, j);
      if (sights.of_one_set) set(to + j * row, i);
    });
  };
  if (packed) {
    py::array_t<std::uint64_t> array(shape);
    std::uint64_t* const to = array.mutable_data();
    const py::gil_scoped_release release;
    fill(to, [](std::uint64_t* at, std::uint32_t j) { at[j / 64] |= std::uint64_t{1} << j % 64; });
    return array;
  }
  py::array_t<bool> array(shape);
  bool* const to = array.mutable_data();
  const py::gil_scoped_release release;
  fill(to, [](bool* at, std::uint32_t j) { at[j] = true; });
  return array;
}

void add_blockers(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  py::class_<BlockersHolder>(module, "Blockers", R"(
What stands between patches, for several calls of visibility(). It never changes. Blockers are numbered from 0 on: first
those of `boxes`, then solids, hulls, polygons, and groups of triangles.

boxes: what may hide something: float32 (n, 6), as everywhere.
solids: boxes that are solid, as walls are. They make pairs 'blocked', also where several are one larger box together.
hulls: convex hulls that are solid: (n, k, 3), or a list of (k, 3), of 4 to 32 corners each.
polygons: flat convex polygons without thickness, by their corners in order: likewise, of 3 corners or more.
triangles, faces: a mesh, (n, 3, 3), or vertices (v, 3) with faces (f, 3).
groups: integers (g + 1,): group i has triangles groups[i] to groups[i + 1]. Without it the library makes groups.)")
      .def(py::init([](const py::object& boxes, const py::object& solids, const py::object& hulls,
                       const py::object& polygons, const py::object& triangles, const py::object& faces,
                       const py::object& groups) {
             return blockers_in(boxes, {solids, hulls, polygons, triangles, faces, groups});
           }),
           arg("boxes") = none, py::kw_only(), arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
           arg("triangles") = none, arg("faces") = none, arg("groups") = none)
      .def("__len__", [](const BlockersHolder& self) { return self.all->size(); })
      .def_property_readonly(
          "first",
          [](const BlockersHolder& self) {
            py::dict dict;
            for (const auto& [name, number] : self.first) dict[name.c_str()] = number;
            return dict;
          },
          "The number of the first blocker of each argument that was given: {'solids': 0, 'triangles': 12}, say; "
          "boxes are 'blockers'.")
      .def(
          "box",
          [](const BlockersHolder& self, const py::object& blocker) {
            const auto at = indices_in(blocker, "blocker", self.all->size(), "blockers");
            if (at.indices.size() != 1) throw py::value_error("blocker must be one number");
            return array_of(self.all->box(at.indices[0]));
          },
          arg("blocker"), "The box around one blocker: float32 (6,).")
      .def(
          "triangles",
          [](const BlockersHolder& self, const py::object& blocker) {
            const auto at = indices_in(blocker, "blocker", self.all->size(), "blockers");
            if (at.indices.size() != 1) throw py::value_error("blocker must be one number");
            const auto found = self.all->triangles(at.indices[0]);
            return array_of(std::vector<std::uint32_t>(found.begin(), found.end()));
          },
          arg("blocker"), "Which triangles one blocker has: uint32, none if it is no group of triangles.")
      .def("__repr__", [](const BlockersHolder& self) {
        return "<shaftcull.Blockers, " + std::to_string(self.all->size()) + " of them>";
      });
}

void add_answers(py::module_& module) {
  using py::arg;
  py::class_<Sights>(module, "Visibility", R"(
What visibility() found, of every pair. Arrays that it gives are read-only, and keep it alive.)")
      .def_property_readonly(
          "counts", [](const Sights& self) { return counts_of(self.all.counts); },
          "How many pairs are 'undecided', 'clear', 'blocked' and 'facing_away': a dict.")
      .def_property_readonly(
          "products",
          [](const py::object& self) {
            const auto& products = self.cast<const Sights&>().all.products;
            const auto stride = static_cast<py::ssize_t>(sizeof(SightProduct));
            return seen_in(self, products.empty() ? nullptr : &products.data()->a.first,
                           {static_cast<py::ssize_t>(products.size()), 4}, {stride, 4});
          },
          R"(
What is decided: uint32 (p, 4). A row is first_a, count_a, first_b, count_b: all patches of
order_a[first_a:first_a + count_a] and all of order_b[first_b:first_b + count_b] are as `sights` says.)")
      .def_property_readonly(
          "sights",
          [](const py::object& self) {
            const auto& products = self.cast<const Sights&>().all.products;
            const auto stride = static_cast<py::ssize_t>(sizeof(SightProduct));
            return seen_in(self,
                           products.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(&products.data()->sight),
                           {static_cast<py::ssize_t>(products.size())}, {stride});
          },
          "What is said of each product: uint8 (p,): 1 clear, 2 blocked, 3 facing away.")
      .def_property_readonly(
          "undecided",
          [](const py::object& self) {
            const auto& pairs = self.cast<const Sights&>().all.undecided;
            return seen_in(self, pairs.empty() ? nullptr : &pairs.data()->a,
                           {static_cast<py::ssize_t>(pairs.size()), 2}, {8, 4});
          },
          "What is undecided: uint32 (n, 2), indices of patches.")
      .def_property_readonly(
          "offsets",
          [](const py::object& self) -> py::object {
            const auto& sights = self.cast<const Sights&>();
            if (!sights.has_candidates) return py::none();
            const auto& first = sights.all.first_candidate;
            static_assert(sizeof(std::size_t) == 8 || sizeof(std::size_t) == 4);
            using Number = std::conditional_t<sizeof(std::size_t) == 8, std::int64_t, std::int32_t>;
            return seen_in(self, reinterpret_cast<const Number*>(first.data()),
                           {static_cast<py::ssize_t>(first.size())}, {sizeof(Number)});
          },
          "The candidates of undecided pair i are candidates[offsets[i]:offsets[i + 1]]: int64 (n + 1,), or None "
          "without candidates.")
      .def_property_readonly(
          "candidates",
          [](const py::object& self) -> py::object {
            const auto& sights = self.cast<const Sights&>();
            if (!sights.has_candidates) return py::none();
            const auto& candidates = sights.all.candidates;
            return seen_in(self, candidates.empty() ? nullptr : candidates.data(),
                           {static_cast<py::ssize_t>(candidates.size())}, {4});
          },
          "Numbers of blockers, ascending for each pair: uint32, or None.")
      .def_property_readonly(
          "order_a", [](const Sights& self) { return order_of(self.a); },
          "The order that products refer to: uint32 (a,), indices of patches. A copy.")
      .def_property_readonly(
          "order_b", [](const Sights& self) { return order_of(self.b); },
          "The same of patches_b; of one set with itself it is order_a.")
      .def_property_readonly(
          "blockers", [](const Sights& self) { return self.blockers; }, "What stood between: Blockers.")
      .def("pairs", &pairs_of, arg("sight"), R"(
All pairs of one kind: uint32 (n, 2), indices of patches, of one set with itself each pair once.

sight: 'undecided', 'clear', 'blocked' or 'facing_away'.)")
      .def("bits", &bits_of, arg("sight"), py::kw_only(), arg("packed") = false, R"(
Which pairs are of one kind: bool (a, b). With packed=True uint64 of (b + 63) // 64 words a row instead. Of one set with
itself both bits of a pair are set.

sight: 'undecided', 'clear', 'blocked' or 'facing_away'.)")
      .def("__repr__", [](const Sights& self) {
        const SightCounts& counts = self.all.counts;
        return "<shaftcull.Visibility of " + std::to_string(counts.total()) + " pairs, " +
               std::to_string(counts.undecided) + " undecided>";
      });
}

}  // namespace

void add_visibility(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  const std::size_t memory = VisibilityOptions().memory;

  py::class_<PatchSet>(module, "Patches", R"(
Patches for several calls of visibility(), in a tree. They never change.

boxes: float32 (n, 6), as everywhere: around facets, points, or cells of a volume.
planes: float32 (n, 4), or (4,) for all: normal and offset. A patch faces where its normal points.)")
      .def(py::init([](const py::object& boxes, const py::object& planes) {
             return patches_in(boxes, planes, "boxes", "planes");
           }),
           arg("boxes"), arg("planes") = none)
      .def("__len__", &PatchSet::size)
      .def_property_readonly("has_planes", &PatchSet::has_planes, "Whether the patches have planes.")
      .def_property_readonly(
          "order", [](const PatchSet& self) { return order_of(self); },
          "uint32 (n,): the indices of the patches in the order of the tree, neighbours in space together. A copy.")
      .def("__repr__",
           [](const PatchSet& self) { return "<shaftcull.Patches, " + std::to_string(self.size()) + " of them>"; });
  add_blockers(module);
  add_answers(module);

  const std::string arguments = R"(

patches, patches_b: boxes, float32 (n, 6), or Patches. Without patches_b, of each two of the patches once.
planes, planes_b: of patches that have a side: float32 (n, 4), or (4,) for all; normal and offset.
blockers: boxes of what may hide something; or Blockers, and then none of the five that follow.
solids, hulls, polygons, triangles with faces, groups: what else stands between, as Blockers say.
contact: 'open' leaves out what only touches a shaft, so a patch may lie on a blocker; 'closed' does not.
solids_around_ends: whether a solid that reaches around a patch makes its pairs 'blocked'.
memory: bytes that answers under way may take, 1 MB or more.
progress: is called as progress(done, total) some times a second, on this thread; if it raises, the call ends.)";
  module.def(
      "visibility",
      [](const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
         const py::object& blockers, const py::object& solids, const py::object& hulls, const py::object& polygons,
         const py::object& triangles, const py::object& faces, const py::object& groups, const std::string& contact,
         bool solids_around_ends, bool candidates, std::size_t at_most, const py::object& progress) {
        Asked asked(patches, patches_b, planes, planes_b, blockers, {solids, hulls, polygons, triangles, faces, groups},
                    contact, solids_around_ends, at_most);
        asked.options.candidates = candidates;
        Visibility all = while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          const Blockers& between = *asked.blockers.all;
          return asked.of_one_set ? collect_visibility(asked.a, between, options)
                                  : collect_visibility(asked.a, asked.b, between, options);
        });
        return std::make_unique<Sights>(
            Sights{std::move(all), asked.a, asked.b, asked.of_one_set, candidates, asked.blockers});
      },
      arg("patches"), arg("patches_b") = none, py::kw_only(), arg("planes") = none, arg("planes_b") = none,
      arg("blockers") = none, arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
      arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("contact") = "open",
      arg("solids_around_ends") = true, arg("candidates") = true, arg("memory") = memory, arg("progress") = none,
      (R"(
What sees what: of every pair of patches, whether nothing stands between ('clear'), one solid hides all ('blocked'), one
lies behind the plane of the other ('facing_away'), or none of these ('undecided'): those come with their candidates,
the blockers that reach between. All are exact for the float32 given. Returns a Visibility.)" +
       arguments + R"(
candidates: whether undecided pairs come with candidates.)")
          .c_str());
  module.def(
      "count_visibility",
      [](const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
         const py::object& blockers, const py::object& solids, const py::object& hulls, const py::object& polygons,
         const py::object& triangles, const py::object& faces, const py::object& groups, const std::string& contact,
         bool solids_around_ends, std::size_t at_most, const py::object& progress) {
        const Asked asked(patches, patches_b, planes, planes_b, blockers,
                          {solids, hulls, polygons, triangles, faces, groups}, contact, solids_around_ends, at_most);
        return counts_of(while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          const Blockers& between = *asked.blockers.all;
          return asked.of_one_set ? count_visibility(asked.a, between, options)
                                  : count_visibility(asked.a, asked.b, between, options);
        }));
      },
      arg("patches"), arg("patches_b") = none, py::kw_only(), arg("planes") = none, arg("planes_b") = none,
      arg("blockers") = none, arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
      arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("contact") = "open",
      arg("solids_around_ends") = true, arg("memory") = memory, arg("progress") = none,
      (R"(
How many pairs are 'undecided', 'clear', 'blocked' and 'facing_away': a dict, as the counts of visibility(). It keeps
nothing of any pair.)" +
       arguments)
          .c_str());
  module.def(
      "merged_boxes",
      [](const py::object& boxes) {
        const BoxesInStreams in(boxes, "boxes");
        std::vector<Box> merged;
        {
          const py::gil_scoped_release release;
          std::vector<Box> all(in.view().count);
          for (std::size_t i = 0; i != all.size(); ++i) all[i] = in.view()[i];
          merged = merged_boxes(all);
        }
        py::array_t<float> out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(merged.size()), 6});
        float* to = out.mutable_data();
        for (const Box& box : merged) {
          for (const float coordinate : box.lo) *to++ = coordinate;
          for (const float coordinate : box.hi) *to++ = coordinate;
        }
        return out;
      },
      arg("boxes"), R"(
Larger solid boxes that cover nothing but what the given ones cover: pieces of a wall that share a face become one.
float32 (m, 6); they may overlap.)");
  module.def(
      "inscribed_box",
      [](const py::object& corners) {
        const VectorsIn in = vectors_in(corners, "corners");
        return array_of(inscribed_box(in.vectors));
      },
      arg("corners"), R"(
A large box inside the convex hull of 4 to 32 points (k, 3): float32 (6,). No coordinate is rounded outwards.)");
}

}  // namespace shaftcull::python
