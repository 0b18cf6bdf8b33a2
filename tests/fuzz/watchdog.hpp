// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

namespace adit::fuzz {

/// Installs handlers that print the current case if it crashes, causes a sanitizer report or takes
/// more than `limit_s` seconds of the processor, or is blocked for thirty times as long; the last
/// two also end the process. The printed line starts with `command`, which must stay valid until
/// the process ends.
void start_watchdog(std::string_view command, int limit_s = 5);

/// Sets the number of the current case, which begins or makes progress.
void watch(std::int64_t number);

}  // namespace adit::fuzz
