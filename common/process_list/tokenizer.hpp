// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace adit {

/// A position in a text. Line and column start at 1; the column counts bytes.
struct TextPosition {
  int line = 1;
  int column = 1;
};

struct ListToken {
  enum class Kind { kWord, kString, kNumber, kOpen, kClose, kAssign, kComma, kEnd, kEndOfFile };
  Kind kind = Kind::kEndOfFile;
  std::string text;  ///< of a string: without quotes, escapes resolved
  TextPosition position;
};

/// Splits a process list into words (a letter or _, then letters, digits, _ and -), strings in
/// double or single quotes on one line (escapes \n, \r, \t; a backslash before another character is
/// dropped), numbers (digits, at most one point) and { } = , ; and skips comments from # to the end
/// of the line.
class ListTokenizer {
 public:
  /// `name` is the file name in error messages. The text must outlive the tokenizer.
  ListTokenizer(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// Throws ConfigError, with file, line and column, at an unexpected character or an unterminated
  /// string.
  ListToken next();

  /// Throws ConfigError: `name:line:column: what`.
  [[noreturn]] void fail(const TextPosition& position, const std::string& what) const;

 private:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[at_]; }
  char take();
  void skip_blank();
  ListToken string_token(const TextPosition& position);

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  TextPosition position_;
};

/// The tokens of a process list, with one token of lookahead. The `expect` functions throw
/// ConfigError with the position, the expected and the actual token.
class TokenStream {
 public:
  using Kind = ListToken::Kind;

  TokenStream(std::string_view text, const std::string& name);

  [[nodiscard]] const ListToken& next() const { return next_; }
  ListToken take();
  bool take_if(Kind kind);
  ListToken expect(Kind kind, const std::string& what);

  /// Returns the text of the next token, which must be of the kind and one of `texts`.
  std::string expect_one_of(Kind kind, std::initializer_list<std::string_view> texts);

  /// Returns a number in [min, max], quoted or not.
  double expect_number(double min, double max);
  int expect_integer(int min, int max);

  [[noreturn]] void fail(const TextPosition& position, const std::string& what) const;
  [[noreturn]] void fail_next(const std::string& expected) const;

 private:
  ListTokenizer tokenizer_;
  ListToken next_;
};

}  // namespace adit
