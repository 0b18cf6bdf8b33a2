// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

namespace adit::test {

/// What is wrong with a page or an SVG file: tags that do not close in order, an attribute without
/// quotes or twice, ids given twice, links to places of the page that are not there. Empty:
/// nothing.
std::vector<std::string> markup_errors(const std::string& text);

/// Values of all src and href of a page, in order.
std::vector<std::string> markup_links(const std::string& text);

}  // namespace adit::test
