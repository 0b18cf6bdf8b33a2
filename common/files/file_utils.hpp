// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// All that is in the file afterwards. Throws std::runtime_error with the path where the file
/// cannot be written.
void write_text_file(const std::string& text, const std::filesystem::path& path);

/// The file, or, where there is none at this relative path, the one of its name that came with this
/// program: ../share/adit/FOLDER from where it is installed. The path itself where that has none
/// either, so that who opens it says what is missing. So deploy/config/groundhog.yaml is what it is
/// in the tree of the sources, and is found after installation too.
std::filesystem::path find_installed_file(const std::filesystem::path& path,
                                          const std::string& folder);

}  // namespace adit
