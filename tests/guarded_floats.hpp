// SPDX-License-Identifier: MIT
/// Memory that ends where the process may not read.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <tuple>
#include <vector>

namespace shaftcull {

/// A copy of some floats whose last one lies just before a page that cannot be touched.
class GuardedFloats {
 public:
  explicit GuardedFloats(const std::vector<float>& floats) {
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t bytes = floats.size() * sizeof(float);
    const std::size_t room = (bytes + page - 1) / page * page;
    size_ = room + page;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    char* const end = static_cast<char*>(memory_) + room;
    mprotect(end, page, PROT_NONE);
    floats_ = reinterpret_cast<float*>(end - bytes);
    if (bytes != 0) std::memcpy(floats_, floats.data(), bytes);
  }
  ~GuardedFloats() { munmap(memory_, size_); }
  GuardedFloats(const GuardedFloats&) = delete;
  GuardedFloats& operator=(const GuardedFloats&) = delete;

  [[nodiscard]] const float* floats() const noexcept { return floats_; }

 private:
  void* memory_;
  std::size_t size_;
  float* floats_;
};

/// A copy of a view whose streams all end just before such a page: a read past its count would crash.
template <class View>
class GuardedView {
 public:
  explicit GuardedView(const View& view) : view_(view) {
    for (std::size_t k = 0; k != memory_.size(); ++k) {
      memory_[k] = std::make_unique<GuardedFloats>(std::vector<float>(view.stream[k], view.stream[k] + view.count));
      view_.stream[k] = memory_[k]->floats();
    }
  }

  [[nodiscard]] const View& view() const noexcept { return view_; }

 private:
  std::array<std::unique_ptr<GuardedFloats>, std::tuple_size_v<decltype(View::stream)>> memory_;
  View view_;
};

}  // namespace shaftcull
