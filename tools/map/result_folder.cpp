// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/result_folder.hpp"

#include <system_error>
#include <utility>

namespace adit {

namespace fs = std::filesystem;

ResultFolder::ResultFolder(fs::path folder)
    : folder_(std::move(folder)),
      unfinished_(folder_ / ".unfinished"),
      created_(fs::create_directories(folder_)) {
  fs::remove_all(unfinished_);  // left by a killed run
  fs::create_directory(unfinished_);
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  fs::remove_all(unfinished_, ignored);
  if (created_) fs::remove(folder_, ignored);  // fails if the folder has results, as intended
}

void ResultFolder::publish() const {
  for (const auto& entry : fs::directory_iterator(unfinished_)) {
    fs::rename(entry.path(), folder_ / entry.path().filename());
  }
}

}  // namespace adit
