// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/mission_facts.hpp"

namespace adit {

/// The phases over time, a lane each, with what led to them; and the same as a table that folds.
std::string timeline_html(const MissionRecords& records, const MissionFacts& facts);

}  // namespace adit
