/// Everything: two boxes → Shaft → CompiledShaft → cull / classify against views → bits, counts, lists.
#pragma once

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/index.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/refine.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/version.hpp"
