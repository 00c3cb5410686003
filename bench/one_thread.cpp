#include "one_thread.hpp"

#ifdef SHAFTCULL_BENCH_WITH_TBB
#include <tbb/global_control.h>
#endif

namespace shaftcull::bench {

struct OneThread::Limit {
#ifdef SHAFTCULL_BENCH_WITH_TBB
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, 1};
#endif
};

OneThread::OneThread() : limit_(std::make_unique<Limit>()) {}
OneThread::~OneThread() = default;

}  // namespace shaftcull::bench
