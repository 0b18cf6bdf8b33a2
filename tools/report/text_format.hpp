// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace adit {

// Text for the page of a mission, in UTF-8. Spaces before units do not break.

/// Text escaped for HTML and XML, attributes included. Control characters and bytes that are not
/// UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// A number with a fixed number of decimals; "–" if it is not finite, no minus sign before zero.
std::string fixed(double number, int digits);
/// "12.3 m".
std::string metres(double length_m, int digits = 1);
/// "2.1 %" below 10 %, "50 %" above.
std::string percent(double share);
/// "1 scan", "3 scans".
std::string count_text(std::size_t count, const std::string& singular);
/// "47 s", "3 min 05 s", "2 h 07 min".
std::string duration_text(double seconds);
/// "2003-05-30 00:12:07 UTC".
std::string date_text(std::int64_t utime);
/// "00:12:07", UTC.
std::string clock_text(std::int64_t utime);

/// The text with its first letter in upper case and a full stop; empty stays empty.
std::string sentence(std::string text);

}  // namespace adit
