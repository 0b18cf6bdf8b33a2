// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/process_list/process_list.hpp"
#include "common/procman/procman_values.hpp"
#include "procs/supervisor/keeping/publish_rate.hpp"
#include "procs/supervisor/keeping/script_run.hpp"

namespace adit {

/// The commands of other computers: how they are, as their deputies say, and how they are to be, as
/// the one in charge says. Orders are repeated, so that a lost message does no harm, and name only
/// commands about which somebody has decided; the others are left as they are. Times are those of a
/// clock that is never put back [µs].
class RemoteDeputies {
 public:
  /// All commands but those of `own`.
  RemoteDeputies(const ProcessList& list, const std::string& own);

  /// Those of this list from now on. What is known and ordered of a command stays, as long as it is
  /// the same computer's.
  void relist(const ProcessList& list);

  void heard(const ProcmanInfo& info, std::int64_t now_us);
  void heard(std::string_view channel, std::int64_t now_us);

  [[nodiscard]] bool has(const std::string& id) const { return commands_.contains(id); }
  void start(const std::string& id) { commands_.at(id).wish = Wish::kRun; }
  void stop(const std::string& id) { commands_.at(id).wish = Wish::kStop; }
  void restart(const std::string& id) { commands_.at(id).wish = Wish::kRunAnew; }

  /// What each deputy is to be told. A command whose deputy was not heard yet waits.
  std::vector<ProcmanOrders> orders(const std::string& sheriff, std::int64_t utime);

  /// Between, where it is on its way to what was ordered, or its deputy is silent.
  [[nodiscard]] Standing standing(const std::string& id, std::int64_t now_us) const;
  /// Whether it still runs and is to stop, as far as is heard.
  [[nodiscard]] bool is_ending(const std::string& id, std::int64_t now_us) const;
  /// The newest; nothing where the deputy has been silent for five seconds.
  [[nodiscard]] std::optional<ProcmanStatus> status(const std::string& id,
                                                    std::int64_t now_us) const;

 private:
  enum class Wish { kNone, kRun, kRunAnew, kStop };

  struct Command {
    ListedCommand listed;
    PublishRate rate;
    std::optional<ProcmanStatus> status;
    std::int64_t heard_us = 0;
    Wish wish = Wish::kNone;
    std::optional<ProcmanOrder> order;  // that is repeated
  };

  static Command begin(const ListedCommand& command);
  static void decide(Command& command);

  std::string own_;
  std::map<std::string, Command> commands_;
};

}  // namespace adit
