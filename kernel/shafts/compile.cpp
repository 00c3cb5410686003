// SPDX-License-Identifier: MIT
#include "compiled/answers.hpp"
#include "compiled/contact.hpp"
#include "compiled/joining_planes.hpp"
#include "compiled/shaft_data.hpp"
#include "dispatch/active_kernels.hpp"
#include "formation/join.hpp"
#include "formation/rule.hpp"
#include "kernels/forming/added_planes.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/paper.hpp"
#include "shafts/planes_of_one.hpp"
#include "simd/scalar.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

CompiledShaft compile_formed(const Shaft& shaft) noexcept {
  CompiledShaft formed;  // added planes stay unwritten past their count
  kernel::ShaftData& compiled = kernel::data_of(formed);
  const float* a[6];
  const float* b[6];
  for (unsigned k = 0; k < 3; ++k) {
    a[k] = &shaft.a().lo[k];
    a[k + 3] = &shaft.a().hi[k];
    b[k] = &shaft.b().lo[k];
    b[k + 3] = &shaft.b().hi[k];
  }
  kernel::compile_slabs<kernel::scalar::Floats>(a, b, 1, &compiled);
  kernel::JoinedEdges edges;
  for (const JoiningPlane& joining : shaft.joining_planes()) edges.add({joining.red, joining.blue});
  constexpr bool unit = true;  // for spheres; those of a Shaft have any length
  const kernel::JoinedPlanes planes =
      kernel::join(kernel::positions(shaft.a()), kernel::positions(shaft.b()), edges, unit);
  kernel::compile_joining_planes(edges, planes, compiled);
  const std::span<const Plane> added = shaft.added_planes();
  const Plane* const first_added = added.data();
  kernel::add_planes<kernel::scalar::Floats>(a, b, &first_added, added.size(), 1, &compiled);
  compiled.formed = true;
  return formed;
}

}  // namespace

CompiledShaft compile(const Shaft& shaft) noexcept {
  return kernel::in_float_environment([&] { return compile_formed(shaft); });
}

CompiledShaft compile(const Box& a, const Box& b, std::span<const Plane> planes, Contact contact) {
  kernel::require_contact(contact);
  CompiledShaft compiled;
  kernel::ShaftData& shaft = kernel::data_of(compiled);
  const bool is_formed = [&] {
    const kernel::FloatEnvironment environment;
    if (!planes.empty()) kernel::require_planes(planes);
    const kernel::Kernels& kernels = kernel::active_kernels();
    if (!kernels.compile_pair(a, b, shaft)) return false;
    kernel::add_planes(kernels, planes, shaft.b, shaft);
    if (contact != Contact::closed) kernel::apply_contact(shaft, contact);
    return true;
  }();
  if (!is_formed) static_cast<void>(Shaft(a, b));  // throws, and says why
  return compiled;
}

CompiledShaft compile(const Box& a, const Box& b, Contact contact) { return compile(a, b, {}, contact); }

void set_contact(CompiledShaft& shaft, Contact contact) { set_contact(std::span(&shaft, 1), contact); }

void set_contact(std::span<CompiledShaft> shafts, Contact contact) {
  kernel::require_contact(contact);
  kernel::require_memory("shafts", shafts, "shafts");
  const std::span<kernel::ShaftData> data = kernel::data_of(shafts);
  for (std::size_t s = 0; s != data.size(); ++s) kernel::require_formed(data[s], s);
  const kernel::FloatEnvironment environment;
  for (kernel::ShaftData& shaft : data) kernel::apply_contact(shaft, contact);
}

void set_form(CompiledShaft& shaft, Form form) { set_form(std::span(&shaft, 1), form); }

void set_form(std::span<CompiledShaft> shafts, Form form) {
  kernel::require_form(form);
  kernel::require_memory("shafts", shafts, "shafts");
  const std::span<kernel::ShaftData> data = kernel::data_of(shafts);
  for (std::size_t s = 0; s != data.size(); ++s) kernel::require_formed(data[s], s);
  for (std::size_t s = 0; s != data.size(); ++s) {
    if (data[s].is_hull()) continue;
    if (form == Form::planes) complete(shafts[s]);
    data[s].form = form;
  }
}

}  // namespace shaftcull
