// SPDX-License-Identifier: MIT
#include "tree/image_header.hpp"

#include <algorithm>
#include <cstring>

#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/checksum.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/index_range.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::array<char, 16> image_name{'s', 'h', 'a', 'f', 't', 'c', 'u', 'l', 'l', ' ', 't', 'r', 'e', 'e'};
constexpr std::uint32_t image_format = 1;
constexpr std::uint32_t native_order = 0x01020304;

std::string text_of(ImageKind kind) {
  switch (kind) {
    case ImageKind::boxes:
      return "boxes";
    case ImageKind::spheres:
      return "spheres";
    case ImageKind::triangles:
      return "triangles";
    case ImageKind::dynamic_boxes:
      return "boxes that come and go";
    case ImageKind::dynamic_spheres:
      return "spheres that come and go";
  }
  return "unknown bounds";
}

}  // namespace

void refuse_image(const std::string& why) { fail(InvalidArgument("the image of a tree " + why)); }

void require_image_size(std::span<const std::byte> image, std::size_t bytes) {
  require_memory("image", image, "bytes");
  if (image.size() == bytes) return;
  fail(InvalidArgument("image has " + counted(image.size(), "byte") + "; that of this tree takes " +
                       std::to_string(bytes)));
}

ImageHeader image_header(ImageKind kind, std::size_t bytes) noexcept {
  return {image_name, image_format, native_order, kind, sizeof(std::uint32_t), bytes, {}, 0};
}

std::byte* copy_section(std::span<const std::byte> from, std::byte* to) {
  constexpr std::size_t piece = std::size_t{4} << 20U;
  parallel_for(chunk_count(from.size(), piece), 1, [&](std::size_t p, std::size_t) {
    const IndexRange range = chunk_at(from.size(), piece, p);
    std::memcpy(to + range.first, from.data() + range.first, range.size);
  });
  const std::size_t padding = in_lines(from.size()) - from.size();
  return std::fill_n(to + from.size(), padding, std::byte{0});
}

void seal_image(std::span<std::byte> image) noexcept {
  const std::uint64_t sum = checksum(image.subspan(image_line));
  std::memcpy(image.data() + offsetof(ImageHeader, checksum), &sum, sizeof sum);
}

ImageHeader checked_image_header(std::span<const std::byte> image, ImageKind kind) {
  require_memory("image", image, "bytes");
  if (image.size() < 2 * image_line) {
    refuse_image("has " + counted(image.size(), "byte") +
                 ", fewer than any image has: " + std::to_string(2 * image_line));
  }
  ImageHeader header;
  std::memcpy(&header, image.data(), sizeof header);
  if (header.name != image_name) refuse_image("does not begin as one does: this is something else");
  if (header.byte_order != native_order) refuse_image("was written by a machine that orders bytes otherwise");
  if (header.format != image_format) {
    refuse_image("has format " + std::to_string(header.format) + "; this version reads " +
                 std::to_string(image_format));
  }
  if (header.kind != kind) refuse_image("is of " + text_of(header.kind) + ", not of " + text_of(kind));
  if (header.bytes != image.size()) {
    refuse_image("has " + std::to_string(header.bytes) + " bytes; here are " + std::to_string(image.size()));
  }
  if (header.index_bytes != sizeof(std::uint32_t)) {
    refuse_image("has indices of " + std::to_string(header.index_bytes) + " bytes; this version reads those of 4");
  }
  if (header.unused != ImageHeader().unused) refuse_image("is damaged: its header has numbers where there are none");
  return header;
}

bool is_sealed(std::span<const std::byte> image, const ImageHeader& header) noexcept {
  return checksum(image.subspan(image_line)) == header.checksum;
}

}  // namespace shaftcull::kernel
