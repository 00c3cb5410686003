// SPDX-License-Identifier: MIT
#include "sees_arrays.hpp"

#include <type_traits>
#include <utility>

namespace shaftcull::cli {
namespace {

static_assert(sizeof(Box) == 6 * sizeof(float) && sizeof(Plane) == 4 * sizeof(float), "they are rows of arrays");
static_assert(sizeof(PatchPair) == 2 * sizeof(std::uint32_t), "it is a row of an array");

template <class Row>
SceneArray array_of(NpyFormat format, std::span<const Row> rows) {
  return {std::move(format), rows.size(), [rows](const auto& take) { take(std::as_bytes(rows)); }};
}

/// An array whose row i is row_of(i).
template <class RowOf>
SceneArray made_array(NpyFormat format, std::size_t rows, RowOf row_of) {
  return {std::move(format), rows, [rows, row_of](const auto& take) {
            for (std::size_t i = 0; i < rows; ++i) {
              const auto row = row_of(i);
              take(std::as_bytes(std::span(&row, 1)));
            }
          }};
}

}  // namespace

std::vector<AnswerArray> answer_arrays(const SightContent& content) {
  std::vector<AnswerArray> arrays{{AnswerKind::blocks, {"blocks", "<u4", {5}}},
                                  {AnswerKind::undecided, {"undecided", "<u4", {2}}}};
  if (content.rays != 0) arrays.push_back({AnswerKind::seen, {"seen", "<u4"}});
  if (content.candidates) {
    arrays.push_back({AnswerKind::first_candidate, {"first_candidate", "<u8"}});
    arrays.push_back({AnswerKind::candidates, {"candidates", "<u4"}});
  }
  return arrays;
}

std::vector<SceneArray> scene_arrays(const SeesScene& scene, std::span<const std::uint32_t> order,
                                     const SightContent& content) {
  std::vector<SceneArray> arrays;
  const std::uint32_t rays = content.rays;
  if (rays != 0) arrays.push_back(made_array({"rays", "<u4"}, 1, [rays](std::size_t) { return rays; }));
  if (scene.mesh.origin != WorldPoint{})
    arrays.push_back(array_of({"origin", "<f8"}, std::span<const double>(scene.mesh.origin)));
  arrays.push_back(array_of({"order", "<u4"}, order));
  arrays.push_back(array_of({"patch_boxes", "<f4", {2, 3}}, std::span<const Box>(scene.boxes)));
  arrays.push_back(array_of({"patch_planes", "<f4", {4}}, std::span<const Plane>(scene.planes)));
  arrays.push_back(made_array({"patch_corners", "<f8", {3, 3}}, scene.patches.size(),
                              [&scene](std::size_t i) { return scene.patches[i].corner; }));
  arrays.push_back(made_array({"patch_objects", "<u4"}, scene.patches.size(), [&scene](std::size_t i) {
    return scene.mesh.triangles[scene.patches[i].triangle].object;
  }));
  arrays.push_back(made_array({"occluder_boxes", "<f4", {2, 3}}, scene.occluders.size(),
                              [&scene](std::size_t i) { return scene.occluders.box(i); }));
  arrays.push_back(made_array({"occluder_objects", "<u4"}, scene.occluders.size(),
                              [&scene](std::size_t i) { return scene.object_of_occluder(i); }));
  return arrays;
}

}  // namespace shaftcull::cli
