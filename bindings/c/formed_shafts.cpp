// SPDX-License-Identifier: MIT
/// One formed shaft, with its planes.
#include <algorithm>
#include <memory>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Shaft;
using shaftcull::ShaftOptions;

namespace {

ShaftOptions as_options(const shaftcull_shaft_options* options) {
  if (options == nullptr) return {};
  if (options->reserved[0] != 0) {
    refuse("options.reserved is not 0; shaftcull_default_shaft_options() makes options of this version");
  }
  ShaftOptions out;
  out.formation = as_enumerator(options->formation, shaftcull::Formation::table729, "options.formation",
                                "SHAFTCULL_FORMATION_SEARCH, SHAFTCULL_FORMATION_TABLE64 and "
                                "SHAFTCULL_FORMATION_TABLE729");
  out.order = as_enumerator(options->order, shaftcull::PlaneOrder::by_added_volume, "options.order",
                            "SHAFTCULL_ORDER_UNSORTED, SHAFTCULL_ORDER_BY_VOLUME and SHAFTCULL_ORDER_BY_ADDED_VOLUME");
  out.outside = as_bool(options->outside, "options.outside");
  out.inside = as_bool(options->inside, "options.inside");
  out.spheres = as_bool(options->spheres, "options.spheres");
  out.contact = as_contact(options->contact);
  out.form = as_form(options->form);
  return out;
}

shaftcull_shaft_options from_options(const ShaftOptions& options) {
  shaftcull_shaft_options out{};
  out.formation = static_cast<uint32_t>(options.formation);
  out.order = static_cast<uint32_t>(options.order);
  out.outside = options.outside ? 1 : 0;
  out.inside = options.inside ? 1 : 0;
  out.spheres = options.spheres ? 1 : 0;
  out.contact = static_cast<uint32_t>(options.contact);
  out.form = static_cast<uint32_t>(options.form);
  return out;
}

}  // namespace

extern "C" {

shaftcull_shaft_options shaftcull_default_shaft_options() { return from_options({}); }

shaftcull_status shaftcull_shaft_create(const shaftcull_box* a, const shaftcull_box* b,
                                        const shaftcull_shaft_options* options, shaftcull_shaft** shaft) {
  return guarded([&] {
    shaftcull_shaft*& out = given(shaft, "shaft");
    const Shaft formed(as_box(a, "a"), as_box(b, "b"), as_options(options));
    out = new shaftcull_shaft{formed};
  });
}

void shaftcull_shaft_free(shaftcull_shaft* shaft) { delete shaft; }

shaftcull_status shaftcull_shaft_add_plane(shaftcull_shaft* shaft, const shaftcull_plane* plane) {
  return guarded([&] { given(shaft, "shaft").formed.add_plane(converted<shaftcull::Plane>(given(plane, "plane"))); });
}

shaftcull_status shaftcull_shaft_describe(const shaftcull_shaft* shaft, shaftcull_shaft_info* info) {
  return guarded([&] {
    const Shaft& formed = given(shaft, "shaft").formed;
    shaftcull_shaft_info& out = given(info, "info");
    out = {};
    out.a = converted<shaftcull_box>(formed.a());
    out.b = converted<shaftcull_box>(formed.b());
    out.box = converted<shaftcull_box>(formed.box());
    out.options = from_options(formed.options());
    out.joining_planes = formed.joining_planes().size();
    out.added_planes = formed.added_planes().size();
  });
}

shaftcull_status shaftcull_shaft_joining_planes(const shaftcull_shaft* shaft, shaftcull_joining_plane planes[8],
                                                uint64_t* count) {
  static_assert(shaftcull::max_joining_planes == 8);
  return guarded([&] {
    const Shaft& formed = given(shaft, "shaft").formed;
    (void)given(planes, "planes");
    given(count, "count") = formed.joining_planes().size();
    std::transform(
        formed.joining_planes().begin(), formed.joining_planes().end(), planes,
        [](const shaftcull::JoiningPlane& joining) {
          return shaftcull_joining_plane{converted<shaftcull_plane>(joining.plane), joining.red, joining.blue};
        });
  });
}

shaftcull_status shaftcull_shaft_added_planes(const shaftcull_shaft* shaft, shaftcull_plane planes[16],
                                              uint64_t* count) {
  static_assert(shaftcull::max_added_planes == 16);
  return guarded([&] {
    const Shaft& formed = given(shaft, "shaft").formed;
    (void)given(planes, "planes");
    given(count, "count") = formed.added_planes().size();
    std::transform(formed.added_planes().begin(), formed.added_planes().end(), planes,
                   converted<shaftcull_plane, shaftcull::Plane>);
  });
}

shaftcull_status shaftcull_culled_volume(const shaftcull_box* box, const shaftcull_joining_plane* plane,
                                         double* volume) {
  return guarded([&] {
    double& out = given(volume, "volume");
    const shaftcull_joining_plane& joining = given(plane, "plane");
    if (joining.red > 5 || joining.blue > 5) {
      refuse("plane.red = " + std::to_string(joining.red) + " and plane.blue = " + std::to_string(joining.blue) +
             "; faces are 0 to 5");
    }
    out = shaftcull::culled_volume(
        as_box(box, "box"), {converted<shaftcull::Plane>(joining.plane), static_cast<shaftcull::Face>(joining.red),
                             static_cast<shaftcull::Face>(joining.blue)});
  });
}

}  // extern "C"
