// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "procs/supervisor/os/descriptor.hpp"

namespace adit {

/// A file that grows up to a bound and is then put aside as "name.1", what was there as "name.2"
/// and so on, up to a number of files. Goes on with a file that is there.
class RotatedFile {
 public:
  struct Limits {
    std::int64_t bytes_max = 4'000'000;  ///< of one file; what is written at once stays together
    int files = 5;                       ///< in all
  };

  RotatedFile(std::filesystem::path path, const Limits& limits)
      : path_(std::move(path)), limits_(limits) {}

  /// Never throws, since a full disk is to stop nobody; see trouble().
  void write(std::string_view text);

  /// Why the last writing failed, with the path; empty where it did not.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  bool open();
  void rotate();
  bool fail();

  std::filesystem::path path_;
  Limits limits_;
  Descriptor file_;
  std::int64_t bytes_ = 0;
  std::string trouble_;
};

}  // namespace adit
