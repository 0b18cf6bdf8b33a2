// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/recordings.hpp"

#include <cstdlib>

namespace adit::test {

std::optional<std::filesystem::path> find_recording(std::string_view name) {
  const char* folder = std::getenv("ADIT_DATA");
  const std::filesystem::path data =
      folder != nullptr ? std::filesystem::path(folder)
                        : std::filesystem::path(ADIT_SOURCE_DIR) / "../shared/data";
  std::filesystem::path path = data / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

}  // namespace adit::test
