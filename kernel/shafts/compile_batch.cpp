// SPDX-License-Identifier: MIT
/// compile_batch(): checks of its arguments, and gathering of boxes by index pairs.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "compiled/contact.hpp"
#include "compiled/shaft_data.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/compiled.hpp"
#include "shafts/batch_arguments.hpp"
#include "simd/baseline_four_floats.hpp"
#include "streams/rows.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

/// Pairs whose boxes are gathered at once: 3 KiB of floats.
constexpr std::size_t chunk = 64;

/// The boxes of a chunk's pairs, side by side.
struct GatheredBoxes {
  float row[6][chunk];

  [[nodiscard]] BoxView view() noexcept { return kernel::view_of<BoxView>(kernel::rows_in(row), chunk); }
};

/// Gathers the boxes of at most a chunk of pairs, four at a time.
template <std::uint32_t IndexPair::*side>
void gather(const BoxView& boxes, std::span<const IndexPair> pairs, GatheredBoxes& out) noexcept {
  const auto gather_four = [&](const IndexPair* four, std::size_t i) {
    const std::size_t box[4] = {four[0].*side, four[1].*side, four[2].*side, four[3].*side};
    for (std::size_t f = 0; f != 6; ++f) {
      const float* const stream = boxes.stream[f];
      kernel::FourFloats::of(stream[box[0]], stream[box[1]], stream[box[2]], stream[box[3]]).store(&out.row[f][i]);
    }
  };
  std::size_t i = 0;
  for (; i + 4 <= pairs.size(); i += 4) gather_four(&pairs[i], i);
  if (i == pairs.size()) return;
  IndexPair rest[4];  // the last one again where there are fewer than four
  for (std::size_t k = 0; k != 4; ++k) rest[k] = pairs[std::min(i + k, pairs.size() - 1)];
  gather_four(rest, i);
}

/// Throws what the constructor of Shaft throws for the pair, with its index, if it rejects the pair.
void require_pair(const Box& a, const Box& b, std::size_t index) {
  kernel::check_shaft(index, [&] { static_cast<void>(Shaft(a, b)); });
}

void require_memory(const BoxView& a, const BoxView& b, std::span<const CompiledShaft> out, const BatchPlanes& planes) {
  kernel::require_view(a);
  kernel::require_view(b);
  kernel::require_memory("out", out, "shafts");
  kernel::require_memory("planes.a", planes.a, "planes");
  kernel::require_memory("planes.b", planes.b, "planes");
}

/// Throws BadBound for the first pair with a box that is not finite or has lo > hi.
void require_pairs(const kernel::Kernels& kernels, const BoxView& a, const BoxView& b,
                   std::span<const IndexPair> pairs) {
  // Few boxes are checked once, though no pair may name those that are bad; of many those that pairs name.
  const auto all_finite = [&](const BoxView& boxes) {
    return boxes.count <= pairs.size() && kernels.all_finite(boxes.stream.data(), boxes.count);
  };
  const bool same_view = a.stream == b.stream && a.count == b.count;
  if (all_finite(a) && (same_view || all_finite(b))) return;
  GatheredBoxes gathered;
  const BoxView gathered_view = gathered.view();
  for (std::size_t first = 0; first < pairs.size(); first += chunk) {
    const auto some = pairs.subspan(first, std::min(chunk, pairs.size() - first));
    gather<&IndexPair::a>(a, some, gathered);
    bool finite = kernels.all_finite(gathered_view.stream.data(), some.size());
    gather<&IndexPair::b>(b, some, gathered);
    finite = finite && kernels.all_finite(gathered_view.stream.data(), some.size());
    if (finite) continue;
    for (std::size_t i = 0; i != some.size(); ++i) require_pair(a[some[i].a], b[some[i].b], first + i);
  }
}

/// Adds the planes of shafts between boxes in `a` and `b`; box_a(i) and box_b(i) are their positions in the user's
/// views.
template <class Position>
void add_planes(const kernel::Kernels& kernels, const kernel::PlanesOfPairs& planes, const float* const* a,
                const float* const* b, std::span<kernel::ShaftData> out, const Position& box_a, const Position& box_b) {
  const Plane* first[chunk];
  const auto add = [&](const kernel::PlanesOfBoxes& of, const Position& box) {
    if (of.each() == 0) return;
    for (std::size_t i = 0; i != out.size(); ++i) first[i] = of.of(box(i));
    kernels.add_planes(a, b, first, of.each(), out.size(), out.data());
  };
  add(planes.a, box_a);
  add(planes.b, box_b);
}

/// Of shafts that were formed with closed contact.
void apply_contact(std::span<kernel::ShaftData> shafts, Contact contact) noexcept {
  if (contact == Contact::closed) return;
  for (kernel::ShaftData& shaft : shafts) kernel::apply_contact(shaft, contact);
}

}  // namespace

void compile_batch(const BoxView& a, const BoxView& b, std::span<CompiledShaft> out, const BatchPlanes& planes,
                   Contact contact) {
  if (a.count != b.count || a.count != out.size()) {
    kernel::fail(InvalidArgument("compile_batch needs as many boxes a as boxes b and shafts to write, not " +
                                 std::to_string(a.count) + ", " + std::to_string(b.count) + " and " +
                                 std::to_string(out.size())));
  }
  require_memory(a, b, out, planes);
  kernel::require_contact(contact);
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  const kernel::PlanesOfPairs added(kernels, planes, a.count, b.count);
  const std::span<kernel::ShaftData> data = kernel::data_of(out);
  if (!kernels.all_finite(a.stream.data(), a.count) || !kernels.all_finite(b.stream.data(), b.count)) {
    for (std::size_t i = 0; i != a.count; ++i) require_pair(a[i], b[i], i);
  }
  const std::size_t at_once = added.empty() ? out.size() : chunk;
  for (std::size_t first = 0; first < out.size(); first += at_once) {
    const std::size_t size = std::min(at_once, out.size() - first);
    const BoxView some_a = a.slice(first, size);
    const BoxView some_b = b.slice(first, size);
    const auto shafts = data.subspan(first, size);
    kernels.compile_finite(some_a.stream.data(), some_b.stream.data(), size, shafts.data());
    const auto position = [=](std::size_t i) { return first + i; };
    add_planes(kernels, added, some_a.stream.data(), some_b.stream.data(), shafts, position, position);
  }
  apply_contact(data, contact);
}

void compile_batch(const BoxView& a, const BoxView& b, std::span<const IndexPair> pairs, std::span<CompiledShaft> out,
                   const BatchPlanes& planes, Contact contact) {
  if (pairs.size() != out.size()) {
    kernel::fail(InvalidArgument("compile_batch needs as many pairs as shafts to write, not " +
                                 std::to_string(pairs.size()) + " and " + std::to_string(out.size())));
  }
  require_memory(a, b, out, planes);
  kernel::require_memory("pairs", pairs, "pairs");
  kernel::require_indices(pairs, a.count, b.count);
  kernel::require_contact(contact);
  const kernel::FloatEnvironment environment;
  const kernel::Kernels& kernels = kernel::active_kernels();
  const kernel::PlanesOfPairs added(kernels, planes, a.count, b.count);
  require_pairs(kernels, a, b, pairs);
  const std::span<kernel::ShaftData> data = kernel::data_of(out);
  GatheredBoxes from;
  GatheredBoxes to;
  const BoxView some_a = from.view();
  const BoxView some_b = to.view();
  for (std::size_t first = 0; first < pairs.size(); first += chunk) {
    const auto some = pairs.subspan(first, std::min(chunk, pairs.size() - first));
    const auto shafts = data.subspan(first, some.size());
    gather<&IndexPair::a>(a, some, from);
    gather<&IndexPair::b>(b, some, to);
    kernels.compile_finite(some_a.stream.data(), some_b.stream.data(), some.size(), shafts.data());
    if (added.empty()) continue;
    const auto position = [=](std::uint32_t IndexPair::*side) {
      return [=](std::size_t i) { return std::size_t{some[i].*side}; };
    };
    add_planes(kernels, added, some_a.stream.data(), some_b.stream.data(), shafts, position(&IndexPair::a),
               position(&IndexPair::b));
  }
  apply_contact(data, contact);
}

}  // namespace shaftcull
