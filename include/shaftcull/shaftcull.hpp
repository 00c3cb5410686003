// SPDX-License-Identifier: MIT
/// All public headers except paper.hpp: shafts and hulls; views, streams and trees of boxes, spheres and triangles;
/// queries; visibility and view factors of patches.
#pragma once

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/strided.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/tree_image.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/version.hpp"
#include "shaftcull/view_factors.hpp"
#include "shaftcull/visibility.hpp"
#include "shaftcull/volumes.hpp"
