// SPDX-License-Identifier: MIT
#include "families/candidate_rays_lanes.hpp"
#include "simd/x86/avx2.hpp"

namespace shaftcull::bench {
namespace {

struct RayLanes : kernel::avx2::Floats {};

}  // namespace

extern TraceCandidates* const avx2_trace_candidates;
TraceCandidates* const avx2_trace_candidates = CandidateRays<RayLanes>::trace;

}  // namespace shaftcull::bench
