// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "dispatch/active_kernels.hpp"
#include "dynamic/bound_rows.hpp"
#include "shaftcull/dynamic_tree.hpp"
#include "shaftcull/error.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull {

template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot() noexcept = default;
template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot(const TreeSnapshot& other) noexcept : state_(other.state_) {
  if (state_ != nullptr) state_->add_owner();
}
template <class Bound>
TreeSnapshot<Bound>& TreeSnapshot<Bound>::operator=(const TreeSnapshot& other) noexcept {
  TreeSnapshot copy(other);
  std::swap(state_, copy.state_);
  return *this;
}
template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot(TreeSnapshot&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}
template <class Bound>
TreeSnapshot<Bound>& TreeSnapshot<Bound>::operator=(TreeSnapshot&& other) noexcept {
  TreeSnapshot moved(std::move(other));
  std::swap(state_, moved.state_);
  return *this;
}
template <class Bound>
TreeSnapshot<Bound>::~TreeSnapshot() {
  if (state_ != nullptr && state_->remove_owner()) delete state_;
}

template <class Bound>
std::size_t TreeSnapshot<Bound>::bound_count() const noexcept {
  return state_ == nullptr ? 0 : state_->count;
}
template <class Bound>
std::size_t TreeSnapshot<Bound>::index_end() const noexcept {
  return state_ == nullptr ? 0 : state_->index_end;
}
template <class Bound>
bool TreeSnapshot<Bound>::has(std::uint32_t index) const noexcept {
  return state_ != nullptr && state_->has(index);
}
template <class Bound>
Bound TreeSnapshot<Bound>::operator[](std::uint32_t index) const {
  if (!has(index)) kernel::fail(InvalidArgument("no bound has index " + std::to_string(index)));
  float row[kernel::rows_of<Bound>];
  state_->read(index, row);
  return kernel::bound_of(row);
}
template <class Bound>
Box TreeSnapshot<Bound>::box() const noexcept {
  return kernel::in_float_environment(
      [&] { return kernel::box_around<Bound>(DynamicAccess::parts(*this), kernel::active_kernels()); });
}

template class TreeSnapshot<Box>;
template class TreeSnapshot<Sphere>;

}  // namespace shaftcull
