#include <cmath>

#include "exact/added.hpp"
#include "exact/edge.hpp"
#include "exact/predicates.hpp"

namespace shaftcull::kernel {
namespace {

/// The stream opposite to `stream` on the same axis: lo ↔ hi.
unsigned opposite(unsigned stream) noexcept { return stream < 3 ? stream + 3 : stream - 3; }

}  // namespace

bool box_outside(const CompiledShaft& shaft, const float (&bound)[6], FacePairs pairs) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (bound[k + 3] < shaft_face(shaft, k) || bound[k] > shaft_face(shaft, k + 3)) return true;
  }
  // A lo face is tested against the bound's hi, its near corner, and a hi face against the bound's lo.
  const Faces faces(shaft.a, shaft.b);
  for (unsigned r = 0; r < faces.reds; ++r) {
    const float x = bound[opposite(faces.red[r])];
    if (!std::isfinite(x)) continue;
    for (unsigned b = 0; b < faces.blues; ++b) {
      if (pairs == FacePairs::neighbours && faces.blue[b] == opposite(faces.red[r])) continue;
      const float y = bound[opposite(faces.blue[b])];
      if (!std::isfinite(y)) continue;
      if (Edge(shaft.a, shaft.b, faces.red[r], faces.blue[b]).side(x, y) > 0) return true;
    }
  }
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    double near[3];
    bool bounded = true;
    for (unsigned k = 0; k < 3; ++k) {
      near[k] = bound[shaft.added_near[k][i]];
      bounded = bounded && (shaft.added_normal[k][i] == 0 || std::isfinite(near[k]));
    }
    if (bounded && added_side(shaft, i, near).sign() > 0) return true;
  }
  return false;
}

bool box_inside(const CompiledShaft& shaft, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!(bound[k] >= shaft_face(shaft, k) && bound[k + 3] <= shaft_face(shaft, k + 3))) return false;
  }
  const Faces faces(shaft.a, shaft.b);
  for (unsigned r = 0; r < faces.reds; ++r) {
    for (unsigned b = 0; b < faces.blues; ++b) {
      if (faces.blue[b] == opposite(faces.red[r])) continue;
      if (Edge(shaft.a, shaft.b, faces.red[r], faces.blue[b]).side(bound[faces.red[r]], bound[faces.blue[b]]) > 0)
        return false;
    }
  }
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    const double far[3] = {bound[shaft.added_far[0][i]], bound[shaft.added_far[1][i]], bound[shaft.added_far[2][i]]};
    if (added_side(shaft, i, far).sign() > 0) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
