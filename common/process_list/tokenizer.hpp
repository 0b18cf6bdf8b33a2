// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace adit {

/// A place in a text, both from 1; columns count bytes.
struct TextPosition {
  int line = 1;
  int column = 1;
};

struct ListToken {
  enum class Kind { kWord, kString, kNumber, kOpen, kClose, kAssign, kComma, kEnd, kEndOfFile };
  Kind kind = Kind::kEndOfFile;
  std::string text;  ///< of a word or number; of a string what it stands for
  TextPosition position;
};

/// Divides a process list into words (a letter or _, then letters, digits, _ and -), strings in
/// double or single quotes on one line (\n, \r, \t; before anything else a backslash goes), numbers
/// (digits, at most one point) and { } = , ; with comments from # to the end of the line left out.
class ListTokenizer {
 public:
  /// `name` stands for the file in messages. The text must outlive this.
  ListTokenizer(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// Throws ConfigError, with file, line and column, where no token begins or a string has no end.
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

/// Tokens one after the other, with the next one in sight. What is expected and not there throws
/// ConfigError with the place, what was expected and what stands there.
class TokenStream {
 public:
  using Kind = ListToken::Kind;

  TokenStream(std::string_view text, const std::string& name);

  [[nodiscard]] const ListToken& next() const { return next_; }
  ListToken take();
  bool take_if(Kind kind);
  ListToken expect(Kind kind, const std::string& what);

  /// The text of a token of the kind that is one of these.
  std::string expect_one_of(Kind kind, std::initializer_list<std::string_view> texts);

  /// A number, in quotes or not, of at least `least` and at most `most`.
  double expect_number(double min, double max);
  int expect_integer(int min, int max);

  [[noreturn]] void fail(const TextPosition& position, const std::string& what) const;
  [[noreturn]] void fail_next(const std::string& expected) const;

 private:
  ListTokenizer tokenizer_;
  ListToken next_;
};

}  // namespace adit
