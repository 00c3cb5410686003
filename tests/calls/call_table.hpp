// SPDX-License-Identifier: MIT
/// A table of public calls, what they are given, and their answers as words.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "forms.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// What a call answered, as words.
using AnswerWords = std::vector<std::uint64_t>;

/// Adds a value of any type that calls answer with.
template <class T>
void note(AnswerWords& words, const T& value) {
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
  } else if constexpr (requires { value.begin(); }) {
    for (const auto& each : value) note(words, each);
  } else {
    words.push_back(static_cast<std::uint64_t>(value));
  }
}

/// Notes what a shaft holds by its answers for a few boxes: members that are not in use may hold anything.
inline void note_shaft(AnswerWords& words, const CompiledShaft& shaft, const BoxView& boxes) {
  std::vector<std::uint64_t> kept(bit_words(boxes.count));
  std::vector<std::uint64_t> inside(kept.size());
  classify(in_form(shaft, Form::slab), boxes, kept, inside);
  note(words, kept);
  classify(in_form(shaft, Form::planes), boxes, kept, inside);
  note(words, kept);
  note(words, inside);
}

struct PublicCall {
  std::string name;
  bool asks_shafts;  ///< whether it gets the shafts that EveryCall was made with
  std::function<void(AnswerWords&)> call;
};

/// The calls, and all that they are given, which they refer to.
struct CallTable {
  CallTable() = default;
  CallTable(const CallTable&) = delete;
  CallTable& operator=(const CallTable&) = delete;

  void add(std::string name, bool asks_shafts, std::function<void(AnswerWords&)> call) {
    calls.push_back({std::move(name), asks_shafts, std::move(call)});
  }

  std::vector<CompiledShaft> shafts;   ///< what queries ask
  std::vector<CompiledShaft> between;  ///< those of them that are between two boxes, and one between polygons
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> candidates;
  std::vector<std::uint32_t> of_each;  ///< two bounds of each shaft
  std::vector<std::uint64_t> mask;     ///< one bit for each bound
  std::vector<std::uint32_t> layers;   ///< of the bounds
  std::vector<float> centres;          ///< with half extents
  BoxStream box_stream;
  SphereStream sphere_stream;
  std::vector<Triangle> triangles;
  TriangleStream triangle_stream;
  TriangleTree triangle_tree;
  BoxTree box_tree;
  SphereTree sphere_tree;
  std::vector<PublicCall> calls;
};

}  // namespace shaftcull
