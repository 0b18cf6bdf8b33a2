// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace adit {

/// The root of the source tree.
std::filesystem::path source_root();

/// The text of a file; empty if unreadable.
std::string text_of(const std::filesystem::path& path);

/// All headers and sources, including tests.
std::vector<std::filesystem::path> source_files();

/// Path relative to the root.
std::string name_in_tree(const std::filesystem::path& path);

/// The text after each `#include`, with its quotes or brackets.
std::vector<std::string> includes_of(const std::string& text);

}  // namespace adit
