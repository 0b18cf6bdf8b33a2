// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/process_list/process_list.hpp"

namespace adit {

/// When to stop whom, where several are to be stopped: what depends on others before these, in the
/// reverse of the order in which they start. One that nobody who is to be stopped depends on is
/// stopped at once; that others depend on it which are to run on does not hold it. Knows no clock
/// and no process: times are given, in µs of a clock that is never put back.
class StopSequence {
 public:
  /// After so long it is its turn in any case: another computer may not do what it is told.
  static constexpr std::int64_t kTimeoutUs = 60'000'000;

  struct Stop {
    std::string id;
    bool and_start = false;  ///< again
  };

  void add(const ListedCommand& command, bool and_start, std::int64_t now_us);
  /// Somebody wants it to run after all; nothing where it is not in here.
  void remove(const std::string& id);
  /// Whether it is to be stopped and its turn has not come.
  [[nodiscard]] bool is_pending(const std::string& id) const;

  /// Those whose turn has come. `is_ending`: whether one that was handed out is still on its way.
  std::vector<Stop> take_due(std::int64_t now_us,
                             const std::function<bool(const std::string& id)>& is_ending);

 private:
  struct Entry {
    Stop stop;
    std::vector<std::string> depends_on;
    std::int64_t since_us = 0;
    bool issued = false;
  };

  [[nodiscard]] bool is_needed(const std::string& id) const;

  std::vector<Entry> entries_;
};

}  // namespace adit
