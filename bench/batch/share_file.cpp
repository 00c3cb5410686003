// SPDX-License-Identifier: MIT
#include "batch/share_file.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "batch/written_file.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::array<char, 8> magic{'S', 'H', 'C', 'S', 'H', 'R', '0', '1'};
struct Header {
  std::array<char, 8> begins;
  Fingerprint job;
  std::uint64_t which;
  std::uint64_t bytes;   ///< of the image behind this
  std::uint64_t image;   ///< its checksum
  std::uint64_t none;    ///< so that the image begins a line
  std::uint64_t header;  ///< checksum of what stands above
};
static_assert(sizeof(Header) == 64);

std::uint64_t checksum_of(const Header& header) {
  return checksum(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, header)));
}

/// Whether a file of `size` bytes that begins like this is whole.
bool is_header_of(const Header& header, std::uint64_t size, const Fingerprint& job, std::uint64_t which) {
  return header.begins == magic && header.header == checksum_of(header) && header.job == job && header.which == which &&
         size == sizeof(header) + header.bytes;
}

}  // namespace

void write_share(const std::string& path, const std::string& temporary, const Fingerprint& job, std::uint64_t which,
                 const ShareTree& share) {
  // Tree and image take less than building the tree did.
  const std::size_t bytes = share.image_bytes();
  const auto memory = std::make_unique_for_overwrite<std::byte[]>(bytes);
  const std::span<std::byte> image(memory.get(), bytes);
  share.write_image(image);
  Header header{magic, job, which, bytes, checksum(image), 0, 0};
  header.header = checksum_of(header);
  {
    WrittenFile file(temporary, true);
    file.write_at(0, std::as_bytes(std::span(&header, 1)));
    file.write_at(sizeof(header), image);
    file.close();
  }
  rename_file(temporary, path);
}

bool is_share_there(const std::string& path, const Fingerprint& job, std::uint64_t which) {
  Header header{};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"),
                                                             [](std::FILE* open) { return std::fclose(open); });
  if (!file || std::fread(&header, sizeof(header), 1, file.get()) != 1) return false;
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  return !error && is_header_of(header, size, job, which);
}

MappedShare::MappedShare(const std::string& path, const Fingerprint& job, std::uint64_t which, BoundKind kind) {
  try {
    file_ = std::make_unique<MappedFile>(path);
    Header header{};
    if (file_->size() >= sizeof(header)) std::memcpy(&header, file_->data(), sizeof(header));
    if (is_header_of(header, file_->size(), job, which)) {
      const std::span<const std::byte> image(file_->data() + sizeof(header), static_cast<std::size_t>(header.bytes));
      if (checksum(image) == header.image) {
        tree_ = std::make_unique<ShareTree>(kind, image);
        return;
      }
    }
  } catch (const std::invalid_argument&) {
    // It cannot be read, or is no image: as if it were damaged.
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw std::runtime_error(fmt::format("{}: is damaged; the same command does it again", path));
}

}  // namespace shaftcull::batch
