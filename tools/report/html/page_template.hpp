// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A file of tools/report that cmake/AditEmbed compiles into the program.
struct PageFile {
  std::string name;  ///< without extension: "page", "style", "script", "map"
  std::string text;
};

/// page.html, style.css, script.js and map.css. Generated.
std::vector<PageFile> page_files();

/// Text of one of these files. Throws std::invalid_argument for an unknown name.
std::string page_file(std::string_view name);

/// Replaces each `{{name}}` of a template by its value; values are inserted as they are and not
/// searched again. Throws std::invalid_argument for a placeholder without a value.
std::string fill_template(std::string_view text,
                          const std::map<std::string, std::string, std::less<>>& values);

}  // namespace adit
