// SPDX-License-Identifier: MIT
#include "batch/block_store.hpp"

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "batch/written_file.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::array<char, 8> block_magic{'S', 'H', 'C', 'B', 'L', 'K', '0', '2'};
struct Header {
  std::array<char, 8> begins;
  Fingerprint job;
  std::uint64_t share;
  std::uint64_t block;
  BlockStore::Sizes bytes;  ///< of each array
  std::uint64_t answers;    ///< checksum of all arrays
  std::array<std::uint64_t, 2> unused;
  std::uint64_t header;  ///< checksum of what stands above
};
static_assert(sizeof(Header) == 128, "no padding is written, and arrays begin at a multiple of 64 bytes");

struct CloseStream {
  void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

std::uint64_t checksum_of(const Header& header) {
  return checksum(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, header)));
}

/// Whether a file of so many bytes that begins like this is that of a block, and whole.
bool is_header_of(const Header& header, std::uint64_t file_bytes, const Fingerprint& job, std::uint64_t share,
                  std::uint64_t block) {
  return header.begins == block_magic && header.header == checksum_of(header) && header.job == job &&
         header.share == share && header.block == block &&
         file_bytes == std::accumulate(header.bytes.begin(), header.bytes.end(), std::uint64_t{sizeof(header)});
}

/// Opens a block and reads its header. Null if that is not the one of this block.
Stream open_block(const std::string& path, const Fingerprint& job, std::uint64_t share, std::uint64_t block,
                  Header& header) {
  Stream file(std::fopen(path.c_str(), "rbe"));
  if (!file || std::fread(&header, sizeof(header), 1, file.get()) != 1) return nullptr;
  std::error_code error;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, error);
  if (error || !is_header_of(header, file_bytes, job, share, block)) return nullptr;
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

void BlockStore::write_arrays(std::uint64_t share, std::uint64_t block,
                              std::span<const std::span<const std::byte>> arrays) const {
  Header header{block_magic, job_, share, block, {}, 0, {}, 0};
  RunningChecksum sum;
  for (std::size_t i = 0; i != arrays.size(); ++i) {
    header.bytes[i] = arrays[i].size();
    sum.add(arrays[i]);
  }
  header.answers = sum.value();
  header.header = checksum_of(header);
  const std::string temporary = fmt::format("{}/rank-{}", folder_, rank_);
  {
    WrittenFile file(temporary, true);
    file.write_at(0, std::as_bytes(std::span(&header, 1)));
    std::uint64_t at = sizeof(header);
    for (const std::span<const std::byte> array : arrays) {
      file.write_at(at, array);
      at += array.size();
    }
    file.close();
  }
  rename_file(temporary, path(share, block));
}

bool BlockStore::read_arrays(std::uint64_t share, std::uint64_t block, std::span<const MakeRoom> rooms) const {
  Header header{};
  const Stream file = open_block(path(share, block), job_, share, block, header);
  if (!file) return false;
  RunningChecksum sum;
  for (std::size_t i = 0; i != header.bytes.size(); ++i) {
    const auto bytes = static_cast<std::size_t>(header.bytes[i]);
    if (bytes == 0 && i >= rooms.size()) continue;
    std::byte* const room = i < rooms.size() ? rooms[i](bytes) : nullptr;
    if (bytes != 0 && (room == nullptr || std::fread(room, 1, bytes, file.get()) != bytes)) return false;
    sum.add({room, bytes});
  }
  return sum.value() == header.answers;
}

std::optional<MappedBlock> BlockStore::map(std::uint64_t share, std::uint64_t block, Check check) const {
  MappedBlock mapped;
  try {
    mapped.file_ = std::make_unique<MappedFile>(path(share, block));
  } catch (const InvalidArgument&) {
    return std::nullopt;  // it is not there
  }
  const std::span<const std::byte> file(mapped.file_->data(), static_cast<std::size_t>(mapped.file_->size()));
  Header header{};
  if (file.size() < sizeof(header)) return std::nullopt;
  std::memcpy(&header, file.data(), sizeof(header));
  std::span<const std::byte> arrays = file.subspan(sizeof(header));
  if (!is_header_of(header, file.size(), job_, share, block)) return std::nullopt;
  if (check == Check::all && checksum(arrays) != header.answers) return std::nullopt;
  for (std::size_t i = 0; i != most_arrays; ++i) {
    const auto bytes = static_cast<std::size_t>(header.bytes[i]);
    mapped.arrays_[i] = arrays.first(bytes);
    arrays = arrays.subspan(bytes);
  }
  return mapped;
}

void BlockStore::give_up(std::uint64_t share, std::uint64_t block) const {
  const std::string damaged = path(share, block);
  std::error_code ignored;
  std::filesystem::remove(damaged, ignored);
  throw std::runtime_error(fmt::format("{}: is damaged; run the same command again to recompute it", damaged));
}

std::optional<BlockStore::Sizes> BlockStore::sizes(std::uint64_t share, std::uint64_t block) const {
  Header header{};
  if (!open_block(path(share, block), job_, share, block, header)) return std::nullopt;
  return header.bytes;
}

std::vector<std::uint64_t> missing_blocks(const BlockStore& store, std::span<const std::uint64_t> blocks,
                                          Ranks& ranks) {
  std::vector<std::uint64_t> is_missing(blocks.size());
  on_first(ranks, [&] {
    store.make_folders(1);
    for (std::size_t i = 0; i != blocks.size(); ++i) is_missing[i] = store.sizes(0, blocks[i]) ? 0 : 1;
  });
  ranks.sum(is_missing);
  std::vector<std::uint64_t> missing;
  for (std::size_t i = 0; i != blocks.size(); ++i) {
    if (is_missing[i] != 0) missing.push_back(blocks[i]);
  }
  return missing;
}

}  // namespace shaftcull::batch
