// SPDX-License-Identifier: MIT
#include "families/candidate_rays_lanes.hpp"
#include "simd/x86/avx512.hpp"

namespace shaftcull::bench {
namespace {

struct RayLanes : kernel::avx512::Floats {};

}  // namespace

extern TraceCandidates* const avx512_trace_candidates;
TraceCandidates* const avx512_trace_candidates = CandidateRays<RayLanes>::trace;

}  // namespace shaftcull::bench
