// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/file_utils.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace adit {

namespace fs = std::filesystem;

void write_text_file(const std::string& text, const fs::path& path) {
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

fs::path find_installed_file(const fs::path& path, const std::string& folder) {
  std::error_code ignored;
  if (path.empty() || path.is_absolute() || fs::exists(path, ignored)) return path;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path share = program.parent_path().parent_path() / "share" / "adit";
  const fs::path installed = share / folder / path.filename();
  return fs::exists(installed, ignored) ? installed : path;
}

}  // namespace adit
