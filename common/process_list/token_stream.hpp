// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "common/process_list/tokenizer.hpp"

namespace adit {

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
  double expect_number(double least, double most);
  int expect_integer(int least, int most);

  [[noreturn]] void fail(const TextPlace& place, const std::string& what) const;
  [[noreturn]] void fail_next(const std::string& expected) const;

 private:
  ListTokenizer tokenizer_;
  ListToken next_;
};

}  // namespace adit
