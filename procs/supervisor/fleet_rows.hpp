// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "procs/supervisor/fleet.hpp"

namespace adit {

/// For people: a line for each process, in the order of the list, its words divided by tabs:
/// name, deputy, group, state, process id, cores in use, memory [bytes], restarts, trouble.
std::string rows_of(Fleet& fleet, std::int64_t now_us);

}  // namespace adit
