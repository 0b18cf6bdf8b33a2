// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// The folder of a run's results. They are written into a folder inside it and moved to their
/// places all at once, so that a run that fails leaves the results of an earlier one as they were,
/// and a run may read a file that it is about to replace.
class ResultFolder {
 public:
  /// Makes the folder where it is not there. Throws std::filesystem::filesystem_error.
  explicit ResultFolder(std::filesystem::path folder);
  /// Drops what was not published, and the folder if this made it for nothing.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Moves everything to its place, over what has the same name.
  void publish() const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  bool made_;
};

}  // namespace adit
