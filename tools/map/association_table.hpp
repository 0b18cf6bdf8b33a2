// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/map/whole_map.hpp"

namespace adit {

/// The record of lazy data association as a table with tabs, a line for each decision in the order
/// in which they were made: when, what, on which closure of which local maps, where the newer one
/// is taken to lie in the frame of the older one, and why. The first line names the columns.
std::string association_table(const WholeMap& map);

}  // namespace adit
