// SPDX-License-Identifier: MIT
#include "batch/share_tree.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

using AnyTree = std::variant<BoxTree, SphereTree, TriangleTree>;

/// A tree of the bounds that some floats are, whose positions in the file are these; or the same, if there are none.
AnyTree tree_of(const BoundsSource& bounds, std::span<const float> floats, std::span<const std::uint64_t> positions) {
  const std::size_t count = floats.size() / bounds.array().columns();
  const float* const data = floats.data();
  try {
    switch (bounds.kind()) {
      case BoundKind::box:
        return BoxTree(StridedBoxes{data, data + 3, 6 * sizeof(float), count});
      case BoundKind::sphere:
        return SphereTree(StridedSpheres{data, data + 3, 4 * sizeof(float), count});
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

ShareTree::ShareTree(const BoundsSource& bounds) : owned_(std::make_unique<Owned>()) {
  std::vector<std::byte> scratch;
  owned_->tree = tree_of(bounds, bounds.read(0, bounds.size(), scratch), {});
  std::visit([&](const auto& tree) { tree_ = &tree; }, owned_->tree);
}

ShareTree::ShareTree(const BoundsSource& bounds, ShareBounds share)
    : several_(true), box_(share.box), owned_(std::make_unique<Owned>()) {
  owned_->tree = tree_of(bounds, share.floats, share.positions);
  owned_->positions = std::move(share.positions);
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
         std::visit([](const auto* tree) { return shaftcull::image_bytes(*tree); }, tree_);
}

void ShareTree::write_image(std::span<std::byte> image) const {
  const ImageHead head{positions_.size(), several_ ? std::uint64_t{1} : 0, box_, {}};
  std::memcpy(image.data(), &head, sizeof(head));
  const std::span<std::byte> rest = image.subspan(sizeof(head));
  std::ranges::copy(std::as_bytes(positions_), rest.begin());
  const std::size_t end = in_lines(positions_.size_bytes());
  std::ranges::fill(rest.first(end).subspan(positions_.size_bytes()), std::byte{0});
  std::visit([&](const auto* tree) { shaftcull::write_image(*tree, rest.subspan(end)); }, tree_);
}

}  // namespace shaftcull::batch
