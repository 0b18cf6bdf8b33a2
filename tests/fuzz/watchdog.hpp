// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

namespace adit::fuzz {

/// Ends the process with a line that names the case when one takes more than five seconds, crashes,
/// or is what a sanitizer complains of. `command` starts such a line; both must outlive the
/// process.
void start_watchdog(std::string_view command);

/// Tells the watchdog which case is on.
void watch(std::int64_t number);

}  // namespace adit::fuzz
