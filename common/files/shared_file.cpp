// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/shared_file.hpp"

#include <system_error>

namespace adit {

namespace fs = std::filesystem;

fs::path shared_file(const fs::path& path, const std::string& folder) {
  std::error_code unknown;
  if (path.empty() || path.is_absolute() || fs::exists(path, unknown)) return path;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path share = program.parent_path().parent_path() / "share" / "adit";
  const fs::path ours = share / folder / path.filename();
  return fs::exists(ours, unknown) ? ours : path;
}

}  // namespace adit
