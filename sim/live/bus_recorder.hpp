// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "common/bus/bus.hpp"
#include "common/bus/log_writer.hpp"

namespace adit {

/// Writes what comes on every channel there is into an LCM log, stamped with the time at which it
/// is handled. Nothing is lost of a bus whose driver waits for its handlers.
class BusRecorder {
 public:
  using Clock = std::function<std::int64_t()>;  ///< [µs since the epoch], never goes back

  /// Throws as LogWriter does; so does the bus, where a message cannot be written.
  BusRecorder(Bus& bus, const std::filesystem::path& path, Clock clock);
  BusRecorder(const BusRecorder&) = delete;
  BusRecorder& operator=(const BusRecorder&) = delete;

  /// Ends the log.
  void close() { log_.close(); }

 private:
  LogWriter log_;
  Clock clock_;
};

}  // namespace adit
