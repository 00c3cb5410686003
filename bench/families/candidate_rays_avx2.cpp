// SPDX-License-Identifier: MIT
#include "families/candidate_rays_lanes.hpp"

namespace shaftcull::bench {
namespace {

struct Avx2;

}  // namespace

extern TraceCandidates* const avx2_trace_candidates;
TraceCandidates* const avx2_trace_candidates = CandidateRays<Avx2>::trace;

}  // namespace shaftcull::bench
