// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/names.hpp"

#include <algorithm>
#include <sstream>

namespace adit {
namespace {

constexpr std::size_t kLongest = 200;
constexpr std::ptrdiff_t kDeepest = 16;

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= kLongest &&
         std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
}

}  // namespace

void require_name(const TokenStream& tokens, const ListToken& token) {
  if (is_name(token.text) && token.text.find('/') == std::string::npos) return;
  tokens.fail(token.place, "a name is 1 to 200 bytes, without slashes and control characters");
}

void require_names(const TokenStream& tokens, const TextPlace& place, const std::string& path) {
  if (std::ranges::count(path, '/') >= kDeepest) {
    tokens.fail(place, "groups lie more than sixteen deep in each other");
  }
  std::istringstream parts(path);
  bool good = !path.ends_with('/');
  for (std::string part; std::getline(parts, part, '/');) good = good && is_name(part);
  if (!good) tokens.fail(place, "\"" + path + "\" is no path of groups: names with / between");
}

}  // namespace adit
