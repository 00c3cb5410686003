// SPDX-License-Identifier: MIT
/// What images of all trees begin with, and how they are checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace shaftcull::kernel {

inline constexpr std::size_t image_line = 64;

[[nodiscard]] constexpr std::size_t in_lines(std::size_t bytes) noexcept {
  return (bytes + image_line - 1) / image_line * image_line;
}

/// What is in an image.
enum class ImageKind : std::uint32_t {
  spheres = 4,  // the floats of a bound
  boxes = 6,
  triangles = 9,
  dynamic_spheres = 104,
  dynamic_boxes = 106,
};

/// The first line of an image. The second line has the numbers of its kind. Behind it are sections, each of which
/// begins a line.
struct ImageHeader {
  std::array<char, 16> name;
  std::uint32_t format;
  std::uint32_t byte_order;
  ImageKind kind;
  std::uint32_t index_bytes;            ///< of one index
  std::uint64_t bytes;                  ///< of the image
  std::array<std::uint64_t, 2> unused;  ///< 0
  std::uint64_t checksum;               ///< of all that follows
};
static_assert(sizeof(ImageHeader) == image_line && std::is_trivially_copyable_v<ImageHeader>);

[[noreturn]] void refuse_image(const std::string& why);

/// Throws InvalidArgument unless an image for writing has so many bytes.
void require_image_size(std::span<const std::byte> image, std::size_t bytes);

/// The header of an image of so many bytes, without its checksum.
[[nodiscard]] ImageHeader image_header(ImageKind kind, std::size_t bytes) noexcept;

/// Copies `from`, and zeros to the end of the line; returns where that is. Parallel, so that memory that nobody has
/// touched yet comes to where threads are that will read it.
std::byte* copy_section(std::span<const std::byte> from, std::byte* to);

/// Writes the checksum of an image that is complete otherwise.
void seal_image(std::span<std::byte> image) noexcept;

/// The header of what may be a whole image of this kind. Throws InvalidArgument if it cannot be one.
[[nodiscard]] ImageHeader checked_image_header(std::span<const std::byte> image, ImageKind kind);

/// Whether the checksum is right.
[[nodiscard]] bool is_sealed(std::span<const std::byte> image, const ImageHeader& header) noexcept;

}  // namespace shaftcull::kernel
