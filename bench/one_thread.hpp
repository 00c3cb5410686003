/// Keeps the library's parallel calls on the calling thread. The only place in the benchmarks that knows oneTBB.
#pragma once

#include <memory>

namespace shaftcull::bench {

/// For as long as it lives, nothing runs on other threads.
class OneThread {
 public:
  OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;
  ~OneThread();

 private:
  struct Limit;
  std::unique_ptr<Limit> limit_;
};

}  // namespace shaftcull::bench
