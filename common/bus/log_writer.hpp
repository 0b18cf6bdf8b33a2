// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/bus/log_event.hpp"

namespace adit {

/// Writes an LCM log, events numbered from 0. Throws std::runtime_error with the path where it
/// cannot write; what is still buffered is only known to be written after `close`.
class LogWriter {
 public:
  explicit LogWriter(const std::filesystem::path& path);

  void write(const LogEventView& event);

  /// Ends the log.
  void close();

  [[nodiscard]] std::int64_t events() const { return events_; }

 private:
  void require_good() const;

  std::string path_;
  std::ofstream file_;
  std::int64_t events_ = 0;
};

}  // namespace adit
