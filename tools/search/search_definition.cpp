// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/search_definition.hpp"

#include <fmt/format.h>

#include "common/config/config.hpp"

namespace adit {

SearchDefinition load_search(const ConfigFile& file) {
  const ConfigNode* const section = file.section("search");
  if (section == nullptr) throw ConfigError(file.name() + ": the section search is missing");
  SearchDefinition search = load_section<SearchDefinition>(file, "search");
  if (search.failure.empty()) {
    throw ConfigError(fmt::format("{}:{}: search.failure is missing", file.name(), section->line));
  }
  return search;
}

}  // namespace adit
