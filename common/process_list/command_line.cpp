// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/command_line.hpp"

#include <algorithm>
#include <optional>

namespace adit {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

bool is_blank(char c) { return kBlank.find(c) != std::string_view::npos; }

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

struct Word {
  std::string text;
  std::size_t unquoted = 0;  // leading bytes outside of quotes
};

/// Splits a line into words.
class WordReader {
 public:
  explicit WordReader(std::string_view text) : text_(text) {}

  bool find_next() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size();
  }

  Result<Word> take() {
    Word word;
    std::optional<std::size_t> unquoted;
    while (at_ < text_.size() && !is_blank(text_[at_])) {
      const char c = text_[at_++];
      const bool plain = c != '\'' && c != '"' && c != '\\';
      if (!plain && !unquoted) unquoted = word.text.size();
      if (plain) {
        word.text += c;
      } else if (c == '\\') {
        if (at_ == text_.size()) return Rejected{"trailing backslash"};
        word.text += text_[at_++];
      } else if (!take_quoted(c, word.text)) {
        return Rejected{"unterminated quote"};
      }
    }
    word.unquoted = unquoted.value_or(word.text.size());
    return word;
  }

 private:
  /// Reads up to the closing quote; false if there is none. Within double quotes a backslash
  /// escapes only " and the backslash, and is literal otherwise.
  bool take_quoted(char quote, std::string& text) {
    while (at_ < text_.size() && text_[at_] != quote) {
      const bool escapes = quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size() &&
                           (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\');
      if (escapes) ++at_;
      text += text_[at_++];
    }
    return at_++ < text_.size();
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Position of the = of `NAME=value`; nothing if the word is not an assignment.
std::optional<std::size_t> assignment(const Word& word) {
  const std::size_t sign = word.text.find('=');
  if (sign == std::string::npos || sign == 0 || sign >= word.unquoted) return std::nullopt;
  if (word.text[0] >= '0' && word.text[0] <= '9') return std::nullopt;
  const auto end = word.text.begin() + static_cast<std::ptrdiff_t>(sign);
  if (!std::all_of(word.text.begin(), end, is_name_letter)) return std::nullopt;
  return sign;
}

}  // namespace

Result<CommandLine> parse_command_line(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return Rejected{"NUL byte in the command line"};
  CommandLine line;
  WordReader words(text);
  while (words.find_next()) {
    const Result<Word> word = words.take();
    if (!word) return Rejected{word.rejection()};
    const auto sign = assignment(*word);
    if (sign && line.arguments.empty()) {
      line.environment.emplace_back(word->text.substr(0, *sign), word->text.substr(*sign + 1));
    } else {
      line.arguments.push_back(word->text);
    }
  }
  if (line.arguments.empty() || line.arguments.front().empty())
    return Rejected{"no program to run"};
  return line;
}

}  // namespace adit
