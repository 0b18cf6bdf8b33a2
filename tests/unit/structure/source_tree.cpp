// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/structure/source_tree.hpp"

#include <fstream>
#include <iterator>
#include <regex>

namespace adit {

namespace fs = std::filesystem;

fs::path source_root() { return ADIT_SOURCE_DIR; }

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> source_files() {
  std::vector<fs::path> paths;
  for (const char* folder : {"common", "procs", "drivers", "sim", "tools", "viewer", "tests"}) {
    if (!fs::is_directory(source_root() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(source_root() / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") paths.push_back(entry.path());
    }
  }
  return paths;
}

std::string name_in_tree(const fs::path& path) {
  return path.lexically_relative(source_root()).generic_string();
}

std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex pattern(R"re((?:^|\n)#include\s+(<[^>]+>|"[^"]+"))re");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

}  // namespace adit
