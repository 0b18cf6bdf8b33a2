// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// A size that no text file of positions, graphs or settings reaches [bytes].
constexpr std::size_t kTextFileBytesMax = std::size_t{512} << 20;

/// The content of a file, a device or a pipe. Throws FileError with the path if it cannot
/// be read or has more than `bytes_max` bytes.
std::string read_text_file(const std::filesystem::path& path,
                           std::size_t bytes_max = kTextFileBytesMax);

/// The same of a file that may be compressed with gzip; `bytes_max` counts after decompression.
/// Damage of the compressed file throws, too.
std::string read_gzip_file(const std::filesystem::path& path,
                           std::size_t bytes_max = kTextFileBytesMax);

/// Replaces the content of the file, as a whole (NewFile). Throws FileError with the path
/// if the file cannot be written.
void write_text_file(std::string_view text, const std::filesystem::path& path);

/// ../share/adit/FOLDER/NAME relative to the program, if it exists.
std::optional<std::filesystem::path> installed_file(const std::string& folder,
                                                    const std::filesystem::path& name);

/// The path itself if it exists or is absolute; otherwise the installed file of the same name, in
/// ../share/adit/FOLDER relative to the program. The path itself if neither exists, so that opening
/// it reports the missing file. A path such as deploy/config/groundhog.yaml thus works in the
/// source tree and after installation.
std::filesystem::path find_installed_file(const std::filesystem::path& path,
                                          const std::string& folder);

/// Flushes standard output. Throws FileError if anything written to it was lost: a disk or
/// a device that is full. A program that ends without it can lose its result and exit with 0.
void finish_standard_output();

}  // namespace adit
