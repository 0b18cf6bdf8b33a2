// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tools/search/search_space.hpp"

namespace adit {

/// Whether each of the points fails as the one that is shrunk; nothing if the run is stopped.
using Reproduces = std::function<std::optional<std::vector<bool>>(const std::vector<SearchPoint>&)>;

struct ShrunkPoint {
  SearchPoint point;
  int evaluated = 0;        ///< points
  bool is_minimal = false;  ///< false if the limit was reached, or the run was stopped
};

/// Makes a failure simple, as property-based tests do (Claessen and Hughes 2000): sets parameters
/// to their simple values, alone and together, then bisects ranges, tries simpler choices and
/// smaller seeds, again until nothing changes. Each step is verified; the result is a point that
/// fails. It evaluates at most `evaluated_max` points, in batches that depend on the earlier
/// results alone.
ShrunkPoint shrink(const SearchSpace& space, const SearchPoint& failing, int evaluated_max,
                   const Reproduces& reproduces);

}  // namespace adit
