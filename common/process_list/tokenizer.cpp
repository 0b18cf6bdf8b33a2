// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/tokenizer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/config/config_file.hpp"
#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Kind = ListToken::Kind;

// Not <cctype>, which depends on the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::optional<Kind> punctuation_kind(char c) {
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

void ListTokenizer::fail(const TextPosition& position, const std::string& what) const {
  throw ConfigError(name_ + ":" + std::to_string(position.line) + ":" +
                    std::to_string(position.column) + ": " + what);
}

char ListTokenizer::take() {
  const char c = text_[at_++];
  if (c == '\n') {
    position_ = {position_.line + 1, 1};
  } else {
    ++position_.column;
  }
  return c;
}

void ListTokenizer::skip_blank() {
  while (!at_end() && (is_blank(peek()) || peek() == '#')) {
    if (take() != '#') continue;
    while (!at_end() && peek() != '\n') take();
  }
}

ListToken ListTokenizer::string_token(const TextPosition& position) {
  const char quote = take();
  ListToken token{Kind::kString, "", position};
  while (!at_end() && peek() != '\n') {
    const char c = take();
    if (c == quote) return token;
    if (c == '\\' && (at_end() || peek() == '\n')) break;
    token.text += c == '\\' ? unescaped(take()) : c;
  }
  fail(position, "unterminated string");
}

ListToken ListTokenizer::next() {
  skip_blank();
  const TextPosition position = position_;
  if (at_end()) return {Kind::kEndOfFile, "", position};
  const char c = peek();
  if (const auto sign = punctuation_kind(c)) return {*sign, std::string(1, take()), position};
  if (c == '"' || c == '\'') return string_token(position);
  ListToken token{is_letter(c) ? Kind::kWord : Kind::kNumber, "", position};
  if (is_letter(c)) {
    while (is_letter(peek()) || is_digit(peek()) || peek() == '-') token.text += take();
  } else {
    while (is_digit(peek()) || (peek() == '.' && token.text.find('.') == std::string::npos)) {
      token.text += take();
    }
  }
  if (token.text.empty()) fail(position, "unexpected " + printable(c));
  return token;
}

namespace {

std::string description_of(const ListToken& token) {
  if (token.kind == Kind::kEndOfFile) return "the end of the file";
  if (token.kind == Kind::kString) return quote(token.text, '"');
  return quote(token.text);
}

std::string alternatives(std::initializer_list<std::string_view> texts, bool in_quotes) {
  std::string text;
  for (const std::string_view* item = texts.begin(); item != texts.end(); ++item) {
    if (item != texts.begin()) text += item + 1 == texts.end() ? " or " : ", ";
    text += in_quotes ? quote(*item, '"') : std::string(*item);
  }
  return text;
}

std::string range_text(double min, double max) {
  return number_text(min) + " to " + number_text(max);
}

}  // namespace

TokenStream::TokenStream(std::string_view text, const std::string& name)
    : tokenizer_(text, name), next_(tokenizer_.next()) {}

void TokenStream::fail(const TextPosition& position, const std::string& what) const {
  tokenizer_.fail(position, what);
}

void TokenStream::fail_next(const std::string& expected) const {
  fail(next_.position, "expected " + expected + ", not " + description_of(next_));
}

ListToken TokenStream::take() { return std::exchange(next_, tokenizer_.next()); }

bool TokenStream::take_if(Kind kind) {
  if (next_.kind != kind) return false;
  take();
  return true;
}

ListToken TokenStream::expect(Kind kind, const std::string& what) {
  if (next_.kind != kind) fail_next(what);
  return take();
}

std::string TokenStream::expect_one_of(Kind kind, std::initializer_list<std::string_view> texts) {
  const bool known = next_.kind == kind && std::ranges::find(texts, next_.text) != texts.end();
  if (!known) fail_next(alternatives(texts, kind == Kind::kString));
  return take().text;
}

double TokenStream::expect_number(double min, double max) {
  const std::string what = "a number, " + range_text(min, max);
  if (next_.kind != Kind::kNumber && next_.kind != Kind::kString) fail_next(what);
  const auto number = parse_number<double>(next_.text);
  if (!number || !(*number >= min && *number <= max)) fail_next(what);
  take();
  return *number;
}

int TokenStream::expect_integer(int min, int max) {
  const ListToken token = next_;
  const double number = expect_number(min, max);
  if (number != std::floor(number)) {
    fail(token.position, "expected an integer, not " + description_of(token));
  }
  return static_cast<int>(number);
}

}  // namespace adit
