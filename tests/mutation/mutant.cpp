// SPDX-License-Identifier: MIT
/// Makes test_cull, test_hull and test_visibility a mutant: the environment variable SHAFTCULL_MUTANT names the fault
/// to put into the library.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "compiled/shaft_data.hpp"
#include "cull/agreement.hpp"
#include "support/mutant.hpp"

namespace shaftcull {
namespace kernel {

bool drops_exact_step = false;
bool keeps_touching_faces = false;
float accept_margin_factor = 1.0F;
float bound_margin_factor = 1.0F;
float radius_margin_factor = 1.0F;
float grid_slack_factor = 1.0F;
float grid_limit_factor = 1.0F;
float blocking_margin_factor = 1.0F;
float sibling_margin_factor = 1.0F;
bool drops_touching_flats = false;
float triangle_margin_factor = 1.0F;
float measured_error_factor = 1.0F;
float hull_margin_factor = 1.0F;
float open_hull_margin_factor = 1.0F;
float hull_radius_factor = 1.0F;
float entry_margin_factor = 1.0F;

}  // namespace kernel

namespace {

constexpr float weak = 0.1F;

void weaken_slab(CompiledShaft& shaft) { kernel::data_of(shaft).slab_margin *= weak; }
void weaken_relative(CompiledShaft& shaft) {
  if (kernel::data_of(shaft).slab_form == kernel::ShaftData::SlabForm::relative) weaken_slab(shaft);
}
void weaken_endless(CompiledShaft& shaft) {
  if (kernel::data_of(shaft).slab_form == kernel::ShaftData::SlabForm::endless) kernel::data_of(shaft).slab_margin = 0;
}
void weaken_joining(CompiledShaft& shaft) { kernel::data_of(shaft).joining_margin *= weak; }
void weaken_added(CompiledShaft& shaft) {
  kernel::ShaftData& data = kernel::data_of(shaft);
  for (unsigned i = 0; i != data.added_count; ++i) {
    data.added[i].margin *= weak;
    data.added[i].slack *= weak;
  }
}

void close(CompiledShaft& shaft) { set_contact(shaft, Contact::closed); }

bool apply(std::string_view fault) {
  if (fault == "slab_margin") {
    mutate = weaken_slab;
  } else if (fault == "relative_margin") {
    mutate = weaken_relative;
  } else if (fault == "endless_margin") {
    mutate = weaken_endless;
  } else if (fault == "joining_margin") {
    mutate = weaken_joining;
  } else if (fault == "added_margin") {
    mutate = weaken_added;
  } else if (fault == "accept_margin") {
    kernel::accept_margin_factor = weak;
  } else if (fault == "bound_margin") {
    kernel::bound_margin_factor = weak;
  } else if (fault == "radius_margin") {
    kernel::radius_margin_factor = weak;
  } else if (fault == "grid_slack") {
    kernel::grid_slack_factor = weak;
  } else if (fault == "grid_limit") {
    kernel::grid_limit_factor = weak;
  } else if (fault == "blocking_margin") {
    kernel::blocking_margin_factor = weak;
  } else if (fault == "sibling_margin") {
    kernel::sibling_margin_factor = weak;
  } else if (fault == "no_touching_flats") {
    kernel::drops_touching_flats = true;
  } else if (fault == "triangle_margin") {
    kernel::triangle_margin_factor =
        weak * weak;  // which is as many units as errors add up to, by far not the worst ones
  } else if (fault == "measured_error") {
    kernel::measured_error_factor = weak;
  } else if (fault == "hull_margin") {
    kernel::hull_margin_factor = 0;  // errors stay within a tenth of it in all cases tried
  } else if (fault == "open_hull_margin") {
    kernel::open_hull_margin_factor = 0;
  } else if (fault == "hull_radius") {
    kernel::hull_radius_factor = 0;
  } else if (fault == "entry_margin") {
    kernel::entry_margin_factor = 0;
  } else if (fault == "no_exact_step") {
    kernel::drops_exact_step = true;
  } else if (fault == "no_face_contact") {
    kernel::keeps_touching_faces = true;
  } else if (fault == "closed_contact") {
    mutate = close;
  } else if (fault != "none") {
    std::cerr << "SHAFTCULL_MUTANT=" << fault << " names no fault\n";
    std::exit(2);
  }
  return true;
}

const char* const fault = std::getenv("SHAFTCULL_MUTANT");
[[maybe_unused]] const bool applied = apply(fault == nullptr ? "none" : fault);

}  // namespace
}  // namespace shaftcull
