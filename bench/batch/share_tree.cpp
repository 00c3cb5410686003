// SPDX-License-Identifier: MIT
#include "batch/share_tree.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "batch/parallel.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::size_t bounds_a_task = std::size_t{1} << 14;

/// The bounds of a share, copied from the file.
struct Kept {
  std::vector<float> floats;
  std::vector<std::uint64_t> positions;  ///< in the file
  Box box = box_around(std::span<const Vec3>());
};

Kept kept_of(const BoundsSource& bounds, const SharePlan& plan, std::size_t which, std::uint64_t size) {
  const std::size_t columns = bounds.array().columns();
  Kept kept;
  kept.floats.reserve(static_cast<std::size_t>(size) * columns);
  kept.positions.reserve(static_cast<std::size_t>(size));
  std::vector<std::vector<std::uint32_t>> found;
  bounds.for_pieces(0, bounds.size(), [&](std::uint64_t at, const float* floats, std::size_t some) {
    found.resize(some / bounds_a_task + 1);
    for_chunks(some, bounds_a_task, [&](std::size_t begin, std::size_t few) {
      std::vector<std::uint32_t>& here = found[begin / bounds_a_task];
      here.clear();
      for (std::size_t i = begin; i != begin + few; ++i) {
        const ShareKey key{middle_of(bounds.box_around(floats + i * columns)), at + i};
        if (plan.share_of(key) == which) here.push_back(static_cast<std::uint32_t>(i));
      }
    });
    for (std::size_t chunk = 0; chunk * bounds_a_task < some; ++chunk) {
      for (const std::uint32_t i : found[chunk]) {
        const float* const bound = floats + i * columns;
        kept.box = joined(kept.box, bounds.box_around(bound));
        kept.floats.insert(kept.floats.end(), bound, bound + columns);
        kept.positions.push_back(at + i);
      }
    }
  });
  return kept;
}

using AnyTree = std::variant<BoxTree, SphereTree, TriangleTree>;

/// A tree of the bounds that some floats are, whose positions in the file are these; or the same, if there are none.
AnyTree tree_of(const BoundsSource& bounds, std::span<const float> floats, std::span<const std::uint64_t> positions) {
  const std::size_t count = floats.size() / bounds.array().columns();
  const float* const data = floats.data();
  try {
    switch (bounds.kind()) {
      case BoundKind::box:
        return BoxTree(MinMaxRecords{data, data + 3, 6 * sizeof(float), count});
      case BoundKind::sphere:
        return SphereTree(SphereRecords{data, data + 3, 4 * sizeof(float), count});
      default:
        static_assert(sizeof(Triangle) == 9 * sizeof(float) && alignof(Triangle) == alignof(float));
        return TriangleTree(std::span(reinterpret_cast<const Triangle*>(data), count));
    }
  } catch (const BadBound& bad) {
    // "box 3: …" is of the share; rows are of the file.
    const std::string what = bad.what();
    const std::size_t colon = what.find(": ");
    throw InvalidArgument(fmt::format("{}: row {}: {}", bounds.array().name(),
                                      positions.empty() ? bad.index() : positions[bad.index()],
                                      colon == std::string::npos ? what : what.substr(colon + 2)));
  }
}

/// What the image of a share begins with. Positions follow, and then the image of the tree, both on lines of 64 bytes.
struct ImageHead {
  std::uint64_t positions;
  std::uint64_t several;
  Box box;
  std::uint64_t unused[3];
};
static_assert(sizeof(ImageHead) == 64);

std::size_t in_lines(std::size_t bytes) noexcept { return (bytes + 63) / 64 * 64; }

}  // namespace

std::uint64_t bytes_a_bound(BoundKind kind, bool several) noexcept {
  // A tree holds the floats, a position and some nodes, and has as much again under way while it is sorted. Of several
  // shares the floats and positions in the file are copied first.
  const std::uint64_t floats = kind == BoundKind::box ? 24 : kind == BoundKind::sphere ? 16 : 36;
  const std::uint64_t building = kind == BoundKind::triangle ? 110 : 2 * floats + 16;
  return floats + 8 + building + (several ? floats + 8 : 0);
}

struct ShareTree::Owned {
  AnyTree tree;
  std::vector<std::uint64_t> positions;
};

struct ShareTree::InImage {
  std::variant<TreeInImage<BoxTree>, TreeInImage<SphereTree>, TreeInImage<TriangleTree>> tree;
};

ShareTree::ShareTree(const BoundsSource& bounds, const SharePlan& plan, std::size_t which, std::uint64_t size)
    : several_(plan.shares() > 1), owned_(std::make_unique<Owned>()) {
  if (several_) {
    Kept kept = kept_of(bounds, plan, which, size);
    owned_->tree = tree_of(bounds, kept.floats, kept.positions);
    owned_->positions = std::move(kept.positions);
    box_ = kept.box;
  } else {
    std::vector<std::byte> scratch;
    owned_->tree = tree_of(bounds, bounds.read(0, bounds.size(), scratch), {});
  }
  positions_ = owned_->positions;
  std::visit([&](const auto& tree) { tree_ = &tree; }, owned_->tree);
}

ShareTree::ShareTree(BoundKind kind, std::span<const std::byte> image) {
  ImageHead head{};
  if (image.size() < sizeof(head)) throw InvalidArgument("the image of a share is too short");
  std::memcpy(&head, image.data(), sizeof(head));
  const std::span<const std::byte> rest = image.subspan(sizeof(head));
  if (head.positions > rest.size() / sizeof(std::uint64_t)) throw InvalidArgument("the image of a share is damaged");
  const auto positions = static_cast<std::size_t>(head.positions);
  const std::span<const std::byte> tree = rest.subspan(in_lines(positions * sizeof(std::uint64_t)));
  positions_ = {reinterpret_cast<const std::uint64_t*>(rest.data()), positions};
  several_ = head.several != 0;
  box_ = head.box;
  const auto lies_in = [&]<class Tree>(std::type_identity<Tree> /*kind*/) {
    in_image_ = std::make_unique<InImage>(InImage{TreeInImage<Tree>(tree, ImageCheck::header)});
    tree_ = &std::get<TreeInImage<Tree>>(in_image_->tree).tree();
  };
  switch (kind) {
    case BoundKind::box:
      lies_in(std::type_identity<BoxTree>());
      break;
    case BoundKind::sphere:
      lies_in(std::type_identity<SphereTree>());
      break;
    case BoundKind::triangle:
      lies_in(std::type_identity<TriangleTree>());
      break;
  }
}

ShareTree::~ShareTree() = default;

std::size_t ShareTree::image_bytes() const {
  return sizeof(ImageHead) + in_lines(positions_.size_bytes()) +
         visit([](const auto& tree) { return shaftcull::image_bytes(tree); });
}

void ShareTree::write_image(std::span<std::byte> image) const {
  const ImageHead head{positions_.size(), several_ ? std::uint64_t{1} : 0, box_, {}};
  std::memcpy(image.data(), &head, sizeof(head));
  const std::span<std::byte> rest = image.subspan(sizeof(head));
  std::ranges::copy(std::as_bytes(positions_), rest.begin());
  const std::size_t end = in_lines(positions_.size_bytes());
  std::ranges::fill(rest.first(end).subspan(positions_.size_bytes()), std::byte{0});
  visit([&](const auto& tree) { shaftcull::write_image(tree, rest.subspan(end)); });
}

}  // namespace shaftcull::batch
