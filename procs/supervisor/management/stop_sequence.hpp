// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/process_list/process_list.hpp"

namespace adit {

/// Order in which processes are stopped: dependents before their dependencies, the reverse of the
/// start order. A process without dependents among the pending stops is stopped immediately, even
/// if other dependents continue to run. Pure logic: times are passed in, in µs of a monotonic
/// clock.
class StopSequence {
 public:
  /// A stop is due after this time in any case, since a remote deputy may not execute its order.
  static constexpr std::int64_t kTimeoutUs = 60'000'000;

  struct Stop {
    std::string id;
    bool and_start = false;  ///< restart
  };

  void add(const ListedCommand& command, bool and_start, std::int64_t now_us);
  /// Cancels the stop of a process, if there is one.
  void remove(const std::string& id);
  /// Whether its stop is not due yet.
  [[nodiscard]] bool is_pending(const std::string& id) const;

  /// Returns the stops that are due. `is_ending`: whether a process whose stop was issued still
  /// runs.
  std::vector<Stop> take_due(std::int64_t now_us,
                             const std::function<bool(const std::string& id)>& is_ending);

 private:
  struct Entry {
    Stop stop;
    std::vector<std::string> depends_on;
    std::int64_t since_us = 0;
    bool issued = false;
  };

  [[nodiscard]] bool has_dependents(const std::string& id) const;

  std::vector<Entry> entries_;
};

}  // namespace adit
