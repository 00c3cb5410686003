// SPDX-License-Identifier: MIT
#include "triangle_answer.hpp"

#include <algorithm>

namespace shaftcull::cli {

bool all_inside(const CompiledShaft& closed, std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [&](const Vec3& point) {
    return classify(closed, Box{point, point}) == Answer::inside;
  });
}

Answer answer_of(const Triangle& triangle, const ShaftChoice& choice, const Box& from, const Box& to) {
  if (!cull(choice.form(from, to).compiled(), triangle, TriangleTest::exact)) return Answer::outside;
  const FormedShaft closed = choice.form(from, to, Contact::closed);
  return all_inside(closed.compiled(), triangle.vertex) ? Answer::inside : Answer::overlap;
}

}  // namespace shaftcull::cli
