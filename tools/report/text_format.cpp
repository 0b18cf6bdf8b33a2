// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/text_format.hpp"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace adit {
namespace {

constexpr const char* kReplacement = "\xEF\xBF\xBD";
constexpr const char* kNoBreak = "\xC2\xA0";

bool is_continuation_byte(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Length of the UTF-8 character at the start of a text [bytes]; 0 for an invalid one.
std::size_t character_bytes(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80U) return 1;
  const std::size_t length = first < 0xC2U ? 0 : first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
  if (length == 0 || first > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation_byte(text[i])) return 0;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const bool overlong = (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
  const bool out_of_range =
      (first == 0xEDU && second > 0x9FU) || (first == 0xF4U && second > 0x8FU);
  return overlong || out_of_range ? 0 : length;
}

std::string escaped_byte(char byte) {
  switch (byte) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      break;
  }
  const auto code = static_cast<unsigned char>(byte);
  const bool control = (code < 0x20U && byte != '\n' && byte != '\t') || code == 0x7FU;
  return control ? kReplacement : std::string(1, byte);
}

std::tm calendar(std::int64_t utime) {
  const auto seconds = static_cast<std::time_t>(utime / 1'000'000);
  std::tm time{};
  gmtime_r(&seconds, &time);
  return time;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = character_bytes(text);
    if (length == 0) safe += kReplacement;
    if (length == 1) safe += escaped_byte(text.front());
    if (length > 1) safe += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

std::string fixed(double number, int digits) {
  if (!std::isfinite(number)) return "–";
  const std::string text = fmt::format("{:.{}f}", number, digits);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

std::string metres(double length_m, int digits) {
  return fmt::format("{}{}m", fixed(length_m, digits), kNoBreak);
}

std::string percent(double share) {
  const int digits = share > 0.0 && share < 0.0995 ? 1 : 0;
  return fmt::format("{}{}%", fixed(100.0 * share, digits), kNoBreak);
}

std::string count_text(std::size_t count, const std::string& singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  const long long rounded = std::llround(std::fmax(seconds, 0.0));
  if (rounded < 60) return fmt::format("{}{}s", rounded, kNoBreak);
  if (rounded < 3600) {
    return fmt::format("{0}{2}min {1:02}{2}s", rounded / 60, rounded % 60, kNoBreak);
  }
  const long long minutes = (rounded + 30) / 60;
  return fmt::format("{0}{2}h {1:02}{2}min", minutes / 60, minutes % 60, kNoBreak);
}

std::string date_text(std::int64_t utime) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", calendar(utime));
}
std::string clock_text(std::int64_t utime) { return fmt::format("{:%H:%M:%S}", calendar(utime)); }

std::string sentence(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (std::string_view(".!?").find(text.back()) == std::string_view::npos) text += '.';
  return text;
}

}  // namespace adit
