// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace adit {

// Text for a page that people read, UTF-8.

/// Text as it may stand in HTML and XML, in an attribute too: what has a meaning there is escaped,
/// and what may not be there (control characters, bytes that are no UTF-8) is shown as U+FFFD.
std::string escaped(std::string_view text);

/// A number with so many digits behind the point; "–" where it is not finite.
std::string fixed(double number, int digits);
/// With a space that does not break before the unit: "12.3 m".
std::string metres(double length_m, int digits = 1);
std::string percent(double share);
/// "1 apple", "3 apples".
std::string count_text(std::size_t count, const std::string& one, const std::string& many = "");
/// "47 s", "3 min 05 s", "2 h 07 min".
std::string duration_text(double seconds);
/// "2003-05-30 00:12:07 UTC".
std::string date_text(std::int64_t utime);
/// "00:12:07", of the day, UTC.
std::string clock_text(std::int64_t utime);

/// With its first letter in upper case and a full stop; nothing stays nothing.
std::string sentence(std::string text);

}  // namespace adit
