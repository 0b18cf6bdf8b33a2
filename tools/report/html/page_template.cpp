// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/page_template.hpp"

#include <cstddef>
#include <stdexcept>
#include <utility>

namespace adit {

std::string page_file(std::string_view name) {
  for (PageFile& file : page_files()) {
    if (file.name == name) return std::move(file.text);
  }
  throw std::invalid_argument("no embedded file " + std::string(name));
}

std::string fill_template(std::string_view text,
                          const std::map<std::string, std::string, std::less<>>& values) {
  std::string filled;
  while (true) {
    const std::size_t open = text.find("{{");
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = values.find(name);
    if (close == std::string_view::npos || value == values.end()) {
      throw std::invalid_argument("no value for the placeholder " + std::string(name));
    }
    filled += value->second;
    text.remove_prefix(close + 2);
  }
}

}  // namespace adit
