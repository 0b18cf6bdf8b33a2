// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/token_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/config/number_text.hpp"
#include "common/config/parse_number.hpp"

namespace adit {
namespace {

/// Step by step: GCC 12 warns of a sum of texts here, wrongly (its bug 105651).
std::string between_quotes(std::string_view text, char quote) {
  std::string result(1, quote);
  result += text;
  result += quote;
  return result;
}

std::string described(const ListToken& token) {
  using Kind = ListToken::Kind;
  if (token.kind == Kind::kEndOfFile) return "the end of the file";
  if (token.kind == Kind::kString) return between_quotes(token.text, '"');
  return between_quotes(token.text, '\'');
}

std::string listed(std::initializer_list<std::string_view> texts, bool in_quotes) {
  std::string text;
  for (const std::string_view* one = texts.begin(); one != texts.end(); ++one) {
    if (one != texts.begin()) text += one + 1 == texts.end() ? " or " : ", ";
    text += in_quotes ? between_quotes(*one, '"') : std::string(*one);
  }
  return text;
}

std::string range_text(double least, double most) {
  return number_text(least) + " to " + number_text(most);
}

}  // namespace

TokenStream::TokenStream(std::string_view text, const std::string& name)
    : tokenizer_(text, name), next_(tokenizer_.next()) {}

void TokenStream::fail(const TextPlace& place, const std::string& what) const {
  tokenizer_.fail(place, what);
}

void TokenStream::fail_next(const std::string& expected) const {
  fail(next_.place, "expected " + expected + ", not " + described(next_));
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
  if (!known) fail_next(listed(texts, kind == Kind::kString));
  return take().text;
}

double TokenStream::expect_number(double least, double most) {
  const std::string what = "a number, " + range_text(least, most);
  if (next_.kind != Kind::kNumber && next_.kind != Kind::kString) fail_next(what);
  const auto number = parse_number<double>(next_.text);
  if (!number || !(*number >= least && *number <= most)) fail_next(what);
  take();
  return *number;
}

int TokenStream::expect_integer(int least, int most) {
  const ListToken token = next_;
  const double number = expect_number(least, most);
  if (number != std::floor(number)) {
    fail(token.place, "expected a whole number, not " + described(token));
  }
  return static_cast<int>(number);
}

}  // namespace adit
