// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <system_error>
#include <utility>

namespace adit {

/// The folder for the results of a run. Results are written to a subfolder and moved when all are
/// complete, so that a failed run does not change earlier results, and a run can read a file that
/// it replaces.
class ResultFolder {
 public:
  /// Creates the folder if it does not exist. Throws std::filesystem::filesystem_error.
  explicit ResultFolder(std::filesystem::path folder)
      : folder_(std::move(folder)),
        unfinished_(folder_ / ".unfinished"),
        created_(std::filesystem::create_directories(folder_)) {
    std::filesystem::remove_all(unfinished_);  // left by a killed run
    std::filesystem::create_directory(unfinished_);
  }
  /// Removes unpublished files, and the folder if it was created here and is empty.
  ~ResultFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(unfinished_, ignored);
    if (created_) std::filesystem::remove(folder_, ignored);  // fails if the folder has results
  }
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Subfolder to write to.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Moves all files of the subfolder into the folder, replacing files of the same name.
  void publish() const {
    for (const auto& entry : std::filesystem::directory_iterator(unfinished_)) {
      std::filesystem::rename(entry.path(), folder_ / entry.path().filename());
    }
  }

 private:
  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  bool created_;
};

}  // namespace adit
