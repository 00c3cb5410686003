// SPDX-License-Identifier: MIT
/// .npy files for tests of batches, and folders for them.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace shaftcull::test {

/// A folder of its own for one test, removed with everything in it at the end.
class BatchFolder {
 public:
  BatchFolder() {
    // In memory, where that is: nothing here depends on a disk, and other tests may keep it busy.
    const bool memory = access("/dev/shm", W_OK) == 0;
    const std::filesystem::path base = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
    std::string pattern = (base / "shaftcull-batch-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder " + pattern);
    folder_ = pattern;
  }
  BatchFolder(const BatchFolder&) = delete;
  BatchFolder& operator=(const BatchFolder&) = delete;
  ~BatchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

inline std::string bytes_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What an .npy file of version 1 begins with, of this dictionary.
inline std::string npy_header(std::string dictionary) {
  dictionary.append((64 - (10 + dictionary.size() + 1) % 64) % 64, ' ');
  dictionary += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(dictionary.size() & 0xff);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes + dictionary;
}

template <class T>
void write_npy(const std::string& path, const std::string& type, std::size_t columns, std::span<const T> values) {
  std::string bytes = npy_header("{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                                 std::to_string(values.size() / columns) + ", " + std::to_string(columns) + "), }");
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  write_file(path, bytes);
}

inline void write_floats(const std::string& path, std::size_t columns, const std::vector<float>& values) {
  write_npy<float>(path, "<f4", columns, values);
}

}  // namespace shaftcull::test
