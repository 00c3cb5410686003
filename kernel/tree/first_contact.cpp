// SPDX-License-Identifier: MIT
/// first_contact() and first_contact_many() of trees.
#include "tree/first_contact.hpp"

#include "compiled/answers.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/index_range.hpp"
#include "tree/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Question;
using kernel::task_shafts;

template <class Bound>
FirstContact contact_of(const kernel::Query<Bound>& query, std::size_t s) {
  return query.template walk_with<kernel::FirstContactWalk<Bound>>(s, [](auto& walk) { return walk.run().contact(); });
}

}  // namespace

template <class Bound>
FirstContact first_contact(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::require_motion(kernel::data_of(shaft), 0);
  return contact_of(query, 0);
}

template <class Bound>
void first_contact_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                        std::span<FirstContact> contacts, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  for (std::size_t s = 0; s != shafts.size(); ++s) kernel::require_motion(kernel::data_of(shafts)[s], s);
  kernel::require_counts("contacts", contacts, shafts.size());
  query.require_apart("first_contact_many", "contacts", kernel::bytes_of(contacts));
  kernel::parallel_for(kernel::chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) contacts[s] = contact_of(query, s);
  });
}

#define SHAFTCULL_FIRST_CONTACT(Bound)                                                                                \
  template FirstContact first_contact(const CompiledShaft&, const BoundsTree<Bound>&, const Excluding&);              \
  template void first_contact_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<FirstContact>, \
                                   const Excluding&);
SHAFTCULL_FIRST_CONTACT(Box)
SHAFTCULL_FIRST_CONTACT(Sphere)
#undef SHAFTCULL_FIRST_CONTACT

}  // namespace shaftcull
