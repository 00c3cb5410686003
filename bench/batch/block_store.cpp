// SPDX-License-Identifier: MIT
#include "batch/block_store.hpp"

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "batch/written_file.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::array<char, 8> magic{'S', 'H', 'C', 'B', 'L', 'K', '0', '1'};
constexpr std::size_t arrays = 7;

struct Header {
  std::array<char, 8> begins;
  Fingerprint job;
  std::uint64_t share;
  std::uint64_t block;
  std::array<std::uint64_t, arrays> bytes;  ///< of each array, in the order of `arrays_of`
  std::uint64_t answers;                    ///< checksum of all arrays
  std::uint64_t header;                     ///< checksum of what stands above
};
static_assert(sizeof(Header) == 8 * (7 + arrays), "no padding is written");

struct CloseStream {
  void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

std::array<std::span<const std::byte>, arrays> arrays_of(const BlockAnswer& answer) {
  return {bytes_of(answer.rows),
          bytes_of(answer.numbers),
          bytes_of(answer.times),
          bytes_of(answer.lists[0].sizes),
          bytes_of(answer.lists[0].indices),
          bytes_of(answer.lists[1].sizes),
          bytes_of(answer.lists[1].indices)};
}

std::uint64_t checksum_of(const Header& header) {
  return checksum(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, header)));
}

/// Reads an array of so many bytes. False if they are not there.
template <class T>
bool read_array(std::FILE* file, std::uint64_t bytes, std::vector<T>& values) {
  if (bytes % sizeof(T) != 0) return false;
  values.resize(bytes / sizeof(T));
  return std::fread(values.data(), sizeof(T), values.size(), file) == values.size();
}

/// Opens a block and reads its header. Null if that is not the one of this block.
Stream open_block(const std::string& path, const Fingerprint& job, std::uint64_t share, std::uint64_t block,
                  Header& header) {
  Stream file(std::fopen(path.c_str(), "rbe"));
  if (!file || std::fread(&header, sizeof(header), 1, file.get()) != 1) return nullptr;
  if (header.begins != magic || header.header != checksum_of(header) || header.job != job || header.share != share ||
      header.block != block) {
    return nullptr;
  }
  std::error_code error;
  std::uint64_t size = sizeof(header);
  for (const std::uint64_t bytes : header.bytes) size += bytes;
  if (std::filesystem::file_size(path, error) != size || error) return nullptr;
  return file;
}

}  // namespace

BlockStore::BlockStore(std::string folder, const Fingerprint& job, int rank)
    : folder_(std::move(folder)), job_(job), rank_(rank) {}

void BlockStore::make_folders(std::size_t shares) const {
  for (std::size_t share = 0; share != shares; ++share) {
    const std::string path = fmt::format("{}/share-{:04}", folder_, share);
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw std::runtime_error(fmt::format("{}: cannot be made: {}", path, error.message()));
  }
}

std::string BlockStore::path(std::uint64_t share, std::uint64_t block) const {
  return fmt::format("{}/share-{:04}/block-{:09}", folder_, share, block);
}

void BlockStore::write(std::uint64_t share, std::uint64_t block, const BlockAnswer& answer) const {
  Header header{magic, job_, share, block, {}, 0, 0};
  RunningChecksum sum;
  const auto bytes = arrays_of(answer);
  for (std::size_t i = 0; i != arrays; ++i) {
    header.bytes[i] = bytes[i].size();
    sum.add(bytes[i]);
  }
  header.answers = sum.value();
  header.header = checksum_of(header);
  const std::string temporary = fmt::format("{}/rank-{}", folder_, rank_);
  {
    WrittenFile file(temporary, true);
    file.write_at(0, std::as_bytes(std::span(&header, 1)));
    std::uint64_t at = sizeof(header);
    for (const std::span<const std::byte> array : bytes) {
      file.write_at(at, array);
      at += array.size();
    }
    file.close();
  }
  rename_file(temporary, path(share, block));
}

std::optional<BlockAnswer> BlockStore::read(std::uint64_t share, std::uint64_t block) const {
  Header header{};
  const Stream file = open_block(path(share, block), job_, share, block, header);
  if (!file) return std::nullopt;
  BlockAnswer answer;
  if (!read_array(file.get(), header.bytes[0], answer.rows) ||
      !read_array(file.get(), header.bytes[1], answer.numbers) ||
      !read_array(file.get(), header.bytes[2], answer.times)) {
    return std::nullopt;
  }
  for (std::size_t l = 0; l != 2; ++l) {
    if (!read_array(file.get(), header.bytes[3 + 2 * l], answer.lists[l].sizes) ||
        !read_array(file.get(), header.bytes[4 + 2 * l], answer.lists[l].indices)) {
      return std::nullopt;
    }
  }
  RunningChecksum sum;
  for (const std::span<const std::byte> array : arrays_of(answer)) sum.add(array);
  if (sum.value() != header.answers) return std::nullopt;
  return answer;
}

std::optional<std::array<std::uint64_t, 2>> BlockStore::list_totals(std::uint64_t share, std::uint64_t block) const {
  Header header{};
  if (!open_block(path(share, block), job_, share, block, header)) return std::nullopt;
  return std::array{header.bytes[4] / sizeof(std::uint64_t), header.bytes[6] / sizeof(std::uint64_t)};
}

}  // namespace shaftcull::batch
