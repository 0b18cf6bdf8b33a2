// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/tokenizer.hpp"

#include <optional>

#include "common/config/config_file.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;

// By hand and not <cctype>: the same for every locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::optional<Kind> sign_of(char c) {
  switch (c) {
    case '{':
      return Kind::kOpen;
    case '}':
      return Kind::kClose;
    case '=':
      return Kind::kAssign;
    case ',':
      return Kind::kComma;
    case ';':
      return Kind::kEnd;
    default:
      return std::nullopt;
  }
}

char unescaped(char c) {
  if (c == 'n') return '\n';
  if (c == 'r') return '\r';
  if (c == 't') return '\t';
  return c;
}

std::string printable(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte > 0x20 && byte < 0x7F) return std::string("'") + c + "'";
  return "byte " + std::to_string(byte);
}

}  // namespace

void ListTokenizer::fail(const TextPlace& place, const std::string& what) const {
  throw ConfigError(name_ + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                    ": " + what);
}

char ListTokenizer::take() {
  const char c = text_[at_++];
  if (c == '\n') {
    place_ = {place_.line + 1, 1};
  } else {
    ++place_.column;
  }
  return c;
}

void ListTokenizer::skip_blank() {
  while (!at_end() && (is_blank(peek()) || peek() == '#')) {
    if (take() != '#') continue;
    while (!at_end() && peek() != '\n') take();
  }
}

ListToken ListTokenizer::string_token(const TextPlace& place) {
  const char quote = take();
  ListToken token{Kind::kString, "", place};
  while (!at_end() && peek() != '\n') {
    const char c = take();
    if (c == quote) return token;
    if (c == '\\' && (at_end() || peek() == '\n')) break;
    token.text += c == '\\' ? unescaped(take()) : c;
  }
  fail(place, "a string that does not end on its line");
}

ListToken ListTokenizer::next() {
  skip_blank();
  const TextPlace place = place_;
  if (at_end()) return {Kind::kEndOfFile, "", place};
  const char c = peek();
  if (const auto sign = sign_of(c)) return {*sign, std::string(1, take()), place};
  if (c == '"' || c == '\'') return string_token(place);
  ListToken token{is_letter(c) ? Kind::kWord : Kind::kNumber, "", place};
  if (is_letter(c)) {
    while (is_letter(peek()) || is_digit(peek()) || peek() == '-') token.text += take();
  } else {
    while (is_digit(peek()) || (peek() == '.' && token.text.find('.') == std::string::npos)) {
      token.text += take();
    }
  }
  if (token.text.empty()) fail(place, printable(c) + " begins nothing that a process list has");
  return token;
}

}  // namespace adit
