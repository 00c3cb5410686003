// SPDX-License-Identifier: MIT
/// What sees what, of all pairs of patches: the calls.
#include "shaftcull/visibility.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "interrupts.hpp"
#include "module.hpp"
#include "patches.hpp"
#include "shafts.hpp"
#include "sights.hpp"

namespace shaftcull::python {

namespace {

/// What is asked of whom.
struct Asked {
  PatchSet a;
  PatchSet b;
  bool of_one_set = false;
  OccludersHolder occluders;
  VisibilityOptions options;

  Asked(const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
        const py::object& boxes, const OccluderArguments& more, const std::string& contact, bool solids_around_ends,
        std::size_t memory)
      : of_one_set(patches_b.is_none()) {
    a = patches_in(patches, planes, "patches", "planes");
    if (of_one_set) {
      if (!planes_b.is_none()) throw py::value_error("planes_b are given, but no patches_b");
      b = a;
    } else {
      b = patches_in(patches_b, planes_b, "patches_b", "planes_b");
    }
    occluders = occluders_in(boxes, more);
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

/// Of all calls that ask of pairs.
constexpr const char* asked_arguments = R"(

patches, patches_b: boxes, float32 (n, 6), or Patches. Without patches_b, of each two of the patches once.
planes, planes_b: of patches that have a side: float32 (n, 4), or (4,) for all; normal and offset.
occluders: boxes of what may hide something; or Occluders, and then none of the five that follow.
solids, hulls, polygons, triangles with faces, groups: what else stands between, as Occluders say.
contact: 'open' leaves out what only touches a shaft, so a patch may lie on an occluder; 'closed' does not.
solids_around_ends: whether a solid that reaches around a patch makes its pairs 'occluded'.
memory: bytes that answers under way may take, 1 MB or more.
progress: is called as progress(done, total) some times a second, on this thread; if it raises, the call ends.)";

void add_collecting(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  module.def(
      "visibility",
      [](const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
         const py::object& occluders, const py::object& solids, const py::object& hulls, const py::object& polygons,
         const py::object& triangles, const py::object& faces, const py::object& groups, const std::string& contact,
         bool solids_around_ends, bool candidates, std::size_t at_most, const py::object& progress) {
        Asked asked(patches, patches_b, planes, planes_b, occluders,
                    {solids, hulls, polygons, triangles, faces, groups}, contact, solids_around_ends, at_most);
        asked.options.candidates = candidates;
        Visibility all = while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          const Occluders& between = *asked.occluders.all;
          return asked.of_one_set ? collect_visibility(asked.a, between, options)
                                  : collect_visibility(asked.a, asked.b, between, options);
        });
        return std::make_unique<Sights>(
            Sights{std::move(all), asked.a, asked.b, asked.of_one_set, candidates, asked.occluders});
      },
      arg("patches"), arg("patches_b") = none, py::kw_only(), arg("planes") = none, arg("planes_b") = none,
      arg("occluders") = none, arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
      arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("contact") = "open",
      arg("solids_around_ends") = true, arg("candidates") = true, arg("memory") = VisibilityOptions().memory,
      arg("progress") = none,
      (std::string(R"(
What sees what: of every pair of patches, whether nothing stands between ('clear'), one solid hides all ('occluded'), one
lies behind the plane of the other ('facing_away'), or none of these ('undecided'): those come with their candidates,
the occluders that reach between. All are exact for the float32 given. Returns a Visibility.)") +
       asked_arguments + R"(
candidates: whether undecided pairs come with candidates.)")
          .c_str());
}

void add_counting(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  module.def(
      "count_visibility",
      [](const py::object& patches, const py::object& patches_b, const py::object& planes, const py::object& planes_b,
         const py::object& occluders, const py::object& solids, const py::object& hulls, const py::object& polygons,
         const py::object& triangles, const py::object& faces, const py::object& groups, const std::string& contact,
         bool solids_around_ends, std::size_t at_most, const py::object& progress) {
        const Asked asked(patches, patches_b, planes, planes_b, occluders,
                          {solids, hulls, polygons, triangles, faces, groups}, contact, solids_around_ends, at_most);
        return counts_of(while_hearing(asked.options, progress, [&asked](const VisibilityOptions& options) {
          const Occluders& between = *asked.occluders.all;
          return asked.of_one_set ? count_visibility(asked.a, between, options)
                                  : count_visibility(asked.a, asked.b, between, options);
        }));
      },
      arg("patches"), arg("patches_b") = none, py::kw_only(), arg("planes") = none, arg("planes_b") = none,
      arg("occluders") = none, arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
      arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("contact") = "open",
      arg("solids_around_ends") = true, arg("memory") = VisibilityOptions().memory, arg("progress") = none,
      (std::string(R"(
How many pairs are 'undecided', 'clear', 'occluded' and 'facing_away': a dict, as the counts of visibility(). It keeps
nothing of any pair.)") +
       asked_arguments)
          .c_str());
}

}  // namespace

void add_visibility(py::module_& module) {
  add_patches(module);
  add_occluders(module);
  add_sights(module);
  add_collecting(module);
  add_counting(module);
}

}  // namespace shaftcull::python
