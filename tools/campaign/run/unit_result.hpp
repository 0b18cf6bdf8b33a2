// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace adit {

/// How a unit ended.
enum class UnitState {
  kEnded,        ///< with an accepted exit code
  kCrashed,      ///< by a signal or with another exit code
  kTimeLimit,    ///< killed: ran longer than allowed
  kMemoryLimit,  ///< killed: its processes took more memory than allowed
  kNotStarted,   ///< the program cannot be started
  kNoScore,      ///< ended, but a file of scores cannot be read
  kLost          ///< its Slurm jobs ended without a result
};

/// "ended", "crashed", "time limit", ...: as in the table of results.
std::string name_of(UnitState state);

struct UnitResult {
  std::string id;
  UnitState state = UnitState::kNotStarted;
  std::string reason;            ///< "killed by SIGSEGV", "more than 600 s"; empty if it ended
  std::optional<int> exit_code;  ///< none if it was killed
  std::int64_t began_utime = 0;  ///< [µs since the epoch]
  double wall_s = 0.0;
  double cpu_s = 0.0;      ///< of all its processes
  double memory_mb = 0.0;  ///< largest observed sum of the resident sets of its processes
  double limit = 0.0;      ///< that was exceeded [s or MB]
  std::string host;
};

/// result.json. Throws FileError.
void write_result(const UnitResult& result, const std::filesystem::path& path);
/// Nothing if there is no such file. Throws FileError if it is not a result.
std::optional<UnitResult> read_result(const std::filesystem::path& path);

/// The name of this computer.
std::string host_name();

}  // namespace adit
