// SPDX-License-Identifier: MIT
#include "families/candidate_rays_lanes.hpp"

namespace shaftcull::bench {
namespace {

struct Avx512;

}  // namespace

extern TraceCandidates* const avx512_trace_candidates;
TraceCandidates* const avx512_trace_candidates = CandidateRays<Avx512>::trace;

}  // namespace shaftcull::bench
