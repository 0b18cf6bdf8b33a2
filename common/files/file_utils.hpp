// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// Replaces the content of the file. Throws std::runtime_error with the path if the file cannot be
/// written.
void write_text_file(const std::string& text, const std::filesystem::path& path);

/// The path itself if it exists or is absolute; otherwise the installed file of the same name, in
/// ../share/adit/FOLDER relative to the program. The path itself if neither exists, so that opening
/// it reports the missing file. A path such as deploy/config/groundhog.yaml thus works in the
/// source tree and after installation.
std::filesystem::path find_installed_file(const std::filesystem::path& path,
                                          const std::string& folder);

}  // namespace adit
