// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace adit {

/// The folder that holds the tree.
std::filesystem::path source_root();

/// The text of a file; empty where it cannot be read.
std::string text_of(const std::filesystem::path& path);

/// The headers and sources of all folders, tests included.
std::vector<std::filesystem::path> source_files();

/// As the rules write it: from the root, with slashes.
std::string name_in_tree(const std::filesystem::path& path);

/// What stands behind each `#include` of a text, with its quotes or brackets.
std::vector<std::string> includes_of(const std::string& text);

}  // namespace adit
