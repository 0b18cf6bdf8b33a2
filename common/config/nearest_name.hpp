// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// The known name that takes the fewest edits (letters put in, taken out, changed) to reach from
/// `name`; empty if none is near enough to have been meant.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace adit
