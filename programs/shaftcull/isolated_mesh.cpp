// SPDX-License-Identifier: MIT
#include "isolated_mesh.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

/// Seconds of processor time that reading may take: far more than any sound file needs.
constexpr rlim_t seconds_for_any_file = 20;
constexpr rlim_t seconds_per_megabyte = 2;

/// How a message from the reading process begins. A process that crashes sends neither, or not all of it.
enum class Verdict : char { scene = 's', error = 'e' };

/// Values one behind the other in memory, each vector and string after its size.
class Message {
 public:
  Message() = default;
  explicit Message(std::string bytes) : bytes_(std::move(bytes)) {}

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <typename Sequence>
  void put_sequence(const Sequence& values) {
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  }

  template <typename T>
  T take() {
    T value{};
    take_bytes(&value, sizeof(T));
    return value;
  }
  template <typename Sequence>
  Sequence take_sequence() {
    const auto size = take<std::size_t>();
    if (size > (bytes_.size() - taken_) / sizeof(typename Sequence::value_type)) throw std::length_error("cut short");
    Sequence values(size, typename Sequence::value_type{});
    take_bytes(values.data(), size * sizeof(values[0]));
    return values;
  }

  [[nodiscard]] std::string_view bytes() const { return bytes_; }

 private:
  void take_bytes(void* to, std::size_t count) {
    if (count > bytes_.size() - taken_) throw std::length_error("cut short");
    if (count > 0) std::memcpy(to, bytes_.data() + taken_, count);
    taken_ += count;
  }

  std::string bytes_;
  std::size_t taken_ = 0;
};

Message rejection(const std::string& why) {
  Message message;
  message.put(Verdict::error);
  message.put_sequence(why);
  return message;
}

Message read_scene(const std::string& path, const MeshReading& reading) {
  Message message;
  try {
    const MeshScene scene = load_mesh(path, reading);
    message.put(Verdict::scene);
    message.put(scene.origin);
    message.put(scene.names.size());
    for (const std::string& name : scene.names) message.put_sequence(name);
    message.put_sequence(scene.boxes);
    message.put_sequence(scene.parts);
    message.put_sequence(scene.triangles);
  } catch (const InvalidArgument& error) {
    message = rejection(error.what());
  } catch (const std::exception& error) {
    message = rejection(fmt::format("{}: the reader of assimp failed on it: {}", path, error.what()));
  }
  return message;
}

void limit_reader(const std::string& path) {
  std::error_code unknown_size;
  const auto bytes = std::filesystem::file_size(path, unknown_size);
  const rlim_t seconds = seconds_for_any_file + (unknown_size ? 0 : bytes / 1'000'000 * seconds_per_megabyte);
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CPU, &time);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  // A crash has its own words, and so have some readers; the parent's one line says it all.
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
}

void write_all(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const ssize_t size = read(pipe, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

/// What the reading process sent, and how it ended (as waitpid tells it).
struct ReadResult {
  Message message;
  int status;
};

ReadResult read_in_child(const std::string& path, const MeshReading& reading) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "a pipe to the mesh reader");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "a process for the mesh reader");
  if (child == 0) {
    close(ends[0]);
    limit_reader(path);
    write_all(ends[1], read_scene(path, reading).bytes());
    // Not exit(): what the parent has open or buffered is not the child's to finish.
    _exit(0);
  }
  close(ends[1]);
  ReadResult result{Message(read_all(ends[0])), 0};
  close(ends[0]);
  while (waitpid(child, &result.status, 0) < 0 && errno == EINTR) continue;
  return result;
}

bool ran_out_of_time(int status) {
  return WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
}

}  // namespace

MeshScene load_mesh_isolated(const std::string& path, const MeshReading& reading) {
  auto [message, status] = read_in_child(path, reading);
  try {
    if (message.take<Verdict>() == Verdict::scene) {
      MeshScene scene;
      scene.origin = message.take<WorldPoint>();
      scene.names.resize(message.take<std::size_t>());
      for (std::string& name : scene.names) name = message.take_sequence<std::string>();
      scene.boxes = message.take_sequence<std::vector<Box>>();
      scene.parts = message.take_sequence<std::vector<MeshPart>>();
      scene.triangles = message.take_sequence<std::vector<MeshTriangle>>();
      return scene;
    }
    throw InvalidArgument(message.take_sequence<std::string>());
  } catch (const std::length_error&) {
    const std::string signal = WIFSIGNALED(status) ? fmt::format(" ({})", strsignal(WTERMSIG(status))) : "";
    throw InvalidArgument(fmt::format("{}: the reader of assimp {} it{}: the file is broken, or assimp has a fault",
                                      path, ran_out_of_time(status) ? "ran out of time or memory on" : "crashed on",
                                      signal));
  }
}

}  // namespace shaftcull::cli
