#include "compiled/joining_planes.hpp"
#include "formation/join.hpp"
#include "formation/rule.hpp"
#include "formation/table.hpp"
#include "shaftcull/compiled.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

/// The joining planes of a shaft that has none yet.
void complete_formed(CompiledShaft& shaft) noexcept {
  const kernel::Faces6 a = kernel::positions(shaft.a);
  const kernel::Faces6 b = kernel::positions(shaft.b);
  const kernel::JoinedEdges& edges = kernel::table729_edges(a, b);
  kernel::compile_joining_planes(edges, kernel::join(a, b, edges, ShaftOptions{}.spheres), shaft);
}

}  // namespace

void complete(CompiledShaft& shaft) noexcept {
  if (shaft.has_planes()) return;
  kernel::in_float_environment([&] { complete_formed(shaft); });
}

}  // namespace shaftcull
