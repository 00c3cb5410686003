// SPDX-License-Identifier: MIT
#include "shaftcull/tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "dispatch/active_kernels.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "tree/build.hpp"
#include "tree/source.hpp"
#include "tree/tree_access.hpp"
#include "tree/update.hpp"

namespace shaftcull {
namespace {

/// `bounds`, or an exception.
template <class Bounds>
const Bounds& within_capacity(const Bounds& bounds) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  if (bounds.count <= most) return bounds;
  kernel::fail(InvalidArgument("a tree of " + std::to_string(bounds.count) + " bounds: one can hold " +
                               std::to_string(most) + "; build several"));
}

/// A tree's parts, built from `source`.
template <class Parts, class Bound, class Source>
std::unique_ptr<Parts> built_from(const Source& source) {
  return kernel::in_float_environment([&] { return std::make_unique<Parts>(Parts{kernel::build<Bound>(source)}); });
}

template <class Parts>
std::unique_ptr<Parts> copy_of(const std::unique_ptr<Parts>& parts) {
  return parts ? std::make_unique<Parts>(*parts) : nullptr;
}

/// Parts to update: those of an empty tree are made when needed.
template <class Parts>
Parts& of(std::unique_ptr<Parts>& parts) {
  if (!parts) parts = std::make_unique<Parts>();
  return *parts;
}

}  // namespace

template <class Bound>
BoundsTree<Bound>::BoundsTree() noexcept = default;
template <class Bound>
BoundsTree<Bound>::~BoundsTree() = default;
template <class Bound>
BoundsTree<Bound>::BoundsTree(BoundsTree&& other) noexcept = default;
template <class Bound>
BoundsTree<Bound>& BoundsTree<Bound>::operator=(BoundsTree&& other) noexcept = default;

template <class Bound>
BoundsTree<Bound>::BoundsTree(const View& bounds)
    : parts_(built_from<Parts, Bound>(kernel::ViewSource<Bound>(within_capacity(bounds)))) {}
template <class Bound>
BoundsTree<Bound>::BoundsTree(const Records& bounds)
    : parts_(built_from<Parts, Bound>(kernel::RecordSource<Bound>(within_capacity(bounds)))) {}
template <class Bound>
BoundsTree<Bound>::BoundsTree(std::span<const Bound> bounds) : BoundsTree(kernel::required_records(bounds, "bounds")) {}
template <class Bound>
BoundsTree<Bound>::BoundsTree(const CentreExtents& bounds)
    : parts_([&] {
        if constexpr (std::is_same_v<Bound, Box>) {  // there are none for spheres
          return built_from<Parts, Bound>(kernel::CentreExtentSource(within_capacity(bounds)));
        } else {
          return nullptr;
        }
      }()) {}
template <class Bound>
BoundsTree<Bound>::BoundsTree(const BoundsTree& other) : parts_(copy_of(other.parts_)) {}
template <class Bound>
BoundsTree<Bound>& BoundsTree<Bound>::operator=(const BoundsTree& other) {
  if (this != &other) parts_ = copy_of(other.parts_);
  return *this;
}

template <class Bound>
std::size_t BoundsTree<Bound>::size() const noexcept {
  return parts_ ? parts_->size : 0;
}

template <class Bound>
std::size_t BoundsTree<Bound>::memory_bytes() const noexcept {
  if (!parts_) return 0;
  return sizeof *parts_ + parts_->leaves.memory_bytes() + parts_->nodes.memory_bytes() + parts_->gaps.bytes() +
         sizeof(std::uint64_t) * parts_->dirty.capacity() + parts_->order.bytes() + parts_->least_index.bytes() +
         parts_->places.bytes() + parts_->layers.bytes();
}

template <class Bound>
auto BoundsTree<Bound>::leaves() const noexcept -> View {
  return parts_ ? parts_->leaves.view() : View();
}

template <class Bound>
Box BoundsTree<Bound>::box() const {
  static const kernel::TreeParts<Bound> empty;
  if (needs_refit()) kernel::fail(NeedsRefit("box() of a tree whose bounds were updated; call refit() first"));
  return kernel::in_float_environment(
      [&] { return kernel::box_around<Bound>(parts_ ? *parts_ : empty, kernel::active_kernels()); });
}

template <class Bound>
std::span<const std::uint32_t> BoundsTree<Bound>::order() const noexcept {
  if (!parts_) return {};
  return parts_->order;
}

template <class Bound>
void BoundsTree<Bound>::update(const View& all) {
  kernel::in_float_environment([&] { kernel::update_all(of(parts_), kernel::ViewSource<Bound>(all)); });
}
template <class Bound>
void BoundsTree<Bound>::update(const Records& all) {
  kernel::in_float_environment([&] { kernel::update_all(of(parts_), kernel::RecordSource<Bound>(all)); });
}
template <class Bound>
void BoundsTree<Bound>::update(std::span<const Bound> all) {
  update(kernel::required_records(all, "bounds"));
}

template <class Bound>
void BoundsTree<Bound>::update(const CentreExtents& all) {
  if constexpr (std::is_same_v<Bound, Box>) {  // as above
    kernel::in_float_environment([&] { kernel::update_all(of(parts_), kernel::CentreExtentSource(all)); });
  }
}

template <class Bound>
void BoundsTree<Bound>::update(std::span<const std::uint32_t> indices, const View& bounds) {
  kernel::in_float_environment([&] { kernel::update_some(of(parts_), indices, kernel::ViewSource<Bound>(bounds)); });
}
template <class Bound>
void BoundsTree<Bound>::update(std::span<const std::uint32_t> indices, const Records& bounds) {
  kernel::in_float_environment([&] { kernel::update_some(of(parts_), indices, kernel::RecordSource<Bound>(bounds)); });
}
template <class Bound>
void BoundsTree<Bound>::update(std::span<const std::uint32_t> indices, std::span<const Bound> bounds) {
  update(indices, kernel::required_records(bounds, "bounds"));
}

template <class Bound>
void BoundsTree<Bound>::update(std::span<const std::uint32_t> indices, const CentreExtents& bounds) {
  if constexpr (std::is_same_v<Bound, Box>) {  // as above
    kernel::in_float_environment([&] { kernel::update_some(of(parts_), indices, kernel::CentreExtentSource(bounds)); });
  }
}

template <class Bound>
void BoundsTree<Bound>::refit() {
  if (!needs_refit()) return;
  const kernel::Kernels& kernels = kernel::active_kernels();
  kernel::in_float_environment([&] {
    if (parts_->are_many_dirty()) {
      kernel::fit_all(*parts_, kernels);
    } else {
      kernel::fit_dirty(*parts_, kernels);
    }
  });
}

template <class Bound>
bool BoundsTree<Bound>::needs_refit() const noexcept {
  return parts_ && parts_->dirty_words != 0;
}

template <class Bound>
void BoundsTree<Bound>::set_layers(std::span<const std::uint32_t> layers) {
  kernel::require_memory("layers", layers, "layers");
  if (layers.size() != size()) {
    kernel::fail(InvalidArgument("set_layers() of a tree of " + kernel::counted(size(), "bound") + " got those of " +
                                 std::to_string(layers.size()) + "; give those of each"));
  }
  if (parts_) parts_->layers = kernel::layers_of<Bound>(*parts_, parts_->order, layers);
}

template <class Bound>
void BoundsTree<Bound>::set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers) {
  kernel::require_memory("layers", layers, "layers");
  if (indices.size() != layers.size()) {
    kernel::fail(InvalidArgument("set_layers() got " + kernel::counted_indices(indices.size()) + " and the layers of " +
                                 kernel::counted(layers.size(), "bound") + "; every index needs those of one bound"));
  }
  kernel::require_below("set_layers(): indices", indices, size());
  if (indices.empty()) return;
  if (!has_layers()) {
    kernel::fail(
        InvalidArgument("set_layers() of some bounds of a tree without layers; give those of all bounds first"));
  }
  const std::uint32_t* const place = parts_->places.of(parts_->order);
  for (std::size_t i = 0; i != indices.size(); ++i) {
    kernel::set_layers_of_leaf<Bound>(*parts_, place[indices[i]], layers[i]);
  }
}

template <class Bound>
void BoundsTree<Bound>::clear_layers() noexcept {
  if (parts_) parts_->layers = {};
}

template <class Bound>
bool BoundsTree<Bound>::has_layers() const noexcept {
  return parts_ && parts_->layers.exist();
}

template <class Bound>
std::span<const std::uint32_t> BoundsTree<Bound>::layers() const noexcept {
  if (!has_layers()) return {};
  return std::span(parts_->layers.leaves).first(parts_->size);
}

template <class Bound>
double BoundsTree<Bound>::sah_ratio() const {
  if (!parts_) return 1;
  if (needs_refit()) kernel::fail(NeedsRefit("sah_ratio() of a tree whose bounds were updated; call refit() first"));
  return kernel::in_float_environment([&] {
    const double now = kernel::surface(*parts_);
    return now == parts_->surface_when_built ? 1 : now / parts_->surface_when_built;
  });
}

template <class Bound>
void BoundsTree<Bound>::rebuild() {
  if (!parts_) return;
  *parts_ = Parts{kernel::in_float_environment([&] { return kernel::rebuild<Bound>(*parts_); })};
}

template <class Bound>
void BoundsTree<Bound>::reorder() noexcept {
  if (!parts_) return;
  std::iota(parts_->order.begin(), parts_->order.end(), std::uint32_t{0});
  for (std::size_t w = 0; w != parts_->least_index.size(); ++w) {
    parts_->least_index[w] = static_cast<std::uint32_t>(w * kernel::fanout);
  }
  parts_->places.reorder();
}

template class BoundsTree<Box>;
template class BoundsTree<Sphere>;

}  // namespace shaftcull
