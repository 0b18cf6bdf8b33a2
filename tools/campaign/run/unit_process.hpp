// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "procs/supervisor/os/child_process.hpp"
#include "procs/supervisor/os/file_descriptor.hpp"
#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/unit_result.hpp"

namespace adit {

/// A unit that runs, with all its processes, within the limits of the plan; they end with this
/// object and with this process, in any case. It writes to an attempt of its own,
/// DIR/units/.ID.HOST.PID, which becomes DIR/units/ID by one rename when the result is complete. Of
/// two attempts at one unit the first that is complete counts, on file systems of a network too.
class UnitProcess {
 public:
  /// Starts the unit. `plan` and `unit` must outlive this. `watcher`: path of adit-watch. Throws
  /// std::system_error or FileError if the folder cannot be written.
  UnitProcess(const CampaignPlan& plan, const CampaignUnit& unit, const CampaignFolder& folder,
              const std::filesystem::path& watcher);
  /// Kills a unit that runs, and removes its attempt.
  ~UnitProcess();
  UnitProcess(const UnitProcess&) = delete;
  UnitProcess& operator=(const UnitProcess&) = delete;

  /// The result once the unit has ended, as it is in DIR/units/ID. Kills it beyond its time limit.
  /// Does not block.
  std::optional<UnitResult> poll();

  /// Kills it if its processes take more memory than allowed.
  void check_memory();

  /// Readable when the unit has ended; −1 if it could not be started.
  [[nodiscard]] int descriptor() const { return ended_.get(); }
  /// Monotonic time at which the time limit is reached [µs].
  [[nodiscard]] std::int64_t deadline_us() const { return deadline_us_; }
  [[nodiscard]] const CampaignUnit& unit() const { return unit_; }

 private:
  void start(const std::filesystem::path& watcher);
  void kill_for(UnitState limit, double value, const std::string& reason);
  void describe_end(const ChildProcess::End& end);
  UnitResult publish();

  const CampaignPlan& plan_;
  const CampaignUnit& unit_;
  CampaignFolder folder_;
  std::filesystem::path attempt_;
  std::int64_t begin_us_;
  std::int64_t deadline_us_;
  UnitResult result_;
  bool was_killed_ = false;
  std::unique_ptr<ChildProcess> child_;
  FileDescriptor ended_;
};

}  // namespace adit
