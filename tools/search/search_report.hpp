// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/search/search_run.hpp"

namespace adit {

/// The result as Markdown: a table with a row for each kind of failure, then the commands that
/// repeat them.
std::string search_report(const SearchResult& result);

}  // namespace adit
