// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

namespace adit::test {

/// Errors of an HTML page or an SVG file: tags not closed in order, attributes without quotes or
/// duplicate, duplicate ids, links to missing targets in the page. Empty for a valid file.
std::vector<std::string> markup_errors(const std::string& text);

/// Values of all src and href attributes of a page, in order.
std::vector<std::string> markup_links(const std::string& text);

}  // namespace adit::test
