// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// The known name with the smallest edit distance (insertions, deletions, substitutions) from
/// `name`; empty if none is close enough to be a likely misspelling.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace adit
