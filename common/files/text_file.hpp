// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace adit {

/// All that is in the file afterwards. Throws std::runtime_error with the path where the file
/// cannot be written.
void write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace adit
