// SPDX-License-Identifier: MIT
/// How long a run of `shaftcull sees` will take, and how large its file will be.
#pragma once

#include <cstdint>
#include <string>

#include "sees_run.hpp"

namespace shaftcull::cli {

/// What a run begins with: how many patches and pairs there are; in a second line, if the scene is so far from the
/// origin that floats lose thin things there, by how much.
[[nodiscard]] std::string announcement(const std::string& source, const SeesScene& scene, const PatchSet& patches);

/// A line that says how long a run is likely to take, and how large its file will be, from a sample of its pairs that
/// the caller's threads answer; empty if the run is short. `out` is the file of answers, empty without. With `delivers`
/// answers go somewhere; otherwise they are counted. There are `ranks` processes like this one.
[[nodiscard]] std::string estimate(const SeesScene& scene, const PatchSet& patches, const SeesWork& work,
                                   const std::string& out, bool delivers, int ranks);

}  // namespace shaftcull::cli
