// SPDX-License-Identifier: MIT
/// The truth about every shaft and bound, one bound at a time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "instruction_sets.hpp"
#include "options/scenes.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// An answer for each shaft and bound.
class Truth {
 public:
  /// answer(s, i) is that of shaft s for bound i.
  template <class GetAnswer>
  Truth(std::size_t shafts, std::size_t bounds, const GetAnswer& answer) : bounds_(bounds), kept_(shafts) {
    answers_.reserve(shafts * bounds);
    for (std::size_t s = 0; s != shafts; ++s) {
      for (std::uint32_t i = 0; i != bounds; ++i) {
        answers_.push_back(answer(s, i));
        if (answers_.back() != Answer::outside) kept_[s].push_back(i);
      }
    }
  }

  [[nodiscard]] std::size_t shafts() const { return kept_.size(); }
  [[nodiscard]] std::size_t bounds() const { return bounds_; }
  [[nodiscard]] Answer operator()(std::size_t shaft, std::uint32_t bound) const {
    return answers_[shaft * bounds_ + bound];
  }
  /// Bounds that a shaft keeps, ascending.
  [[nodiscard]] const Indices& kept(std::size_t shaft) const { return kept_[shaft]; }

 private:
  std::size_t bounds_;
  std::vector<Answer> answers_;  // a row for each shaft
  std::vector<Indices> kept_;
};

/// The same shaft with closed contact, by which vertices of triangles are inside.
inline CompiledShaft closed(CompiledShaft shaft) {
  if (shaft.contact() == Contact::open) set_contact(shaft, Contact::closed);
  return shaft;
}

/// Answers of the scalar kernels, one bound at a time: other instruction sets are compared with them.
template <class Bound>
Truth truth_of(std::span<const CompiledShaft> shafts, const std::vector<Bound>& bounds,
               TriangleTest test = TriangleTest::exact) {
  const UseIsa scalar(Isa::scalar);
  if constexpr (std::is_same_v<Bound, Triangle>) {
    std::vector<CompiledShaft> for_vertices;
    for (const CompiledShaft& shaft : shafts) for_vertices.push_back(closed(shaft));
    return Truth(shafts.size(), bounds.size(), [&](std::size_t s, std::uint32_t i) {
      if (!keeps(shafts[s], bounds[i], test)) return Answer::outside;
      const bool is_inside = std::all_of(bounds[i].vertex.begin(), bounds[i].vertex.end(), [&](const Vec3& vertex) {
        return classify(for_vertices[s], Box{vertex, vertex}) == Answer::inside;
      });
      return is_inside ? Answer::inside : Answer::overlap;
    });
  } else {
    return Truth(shafts.size(), bounds.size(), [&](std::size_t s, std::uint32_t i) {
      const Answer answer = classify(shafts[s], bounds[i]);
      EXPECT_EQ(keeps(shafts[s], bounds[i]), answer != Answer::outside) << "shaft " << s << ", bound " << i;
      return answer;
    });
  }
}

}  // namespace shaftcull
