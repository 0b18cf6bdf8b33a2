// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// The folder for the results of a run. Results are written to a subfolder and moved when all are
/// complete, so that a failed run does not change earlier results, and a run can read a file that
/// it replaces.
class ResultFolder {
 public:
  /// Creates the folder if it does not exist. Throws std::filesystem::filesystem_error.
  explicit ResultFolder(std::filesystem::path folder);
  /// Removes unpublished files, and the folder if it was created here and is empty.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Subfolder to write to.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Moves all files of the subfolder into the folder, replacing files of the same name.
  void publish() const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  bool created_;
};

}  // namespace adit
