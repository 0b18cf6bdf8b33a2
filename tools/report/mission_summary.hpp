// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/mission_facts.hpp"

namespace adit {

/// The figures of a mission as JSON, for summary.json. What the log does not tell is null.
std::string mission_summary_json(const MissionFacts& facts, const LogCensus& census);

}  // namespace adit
