// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/run/unit_process.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "common/service/wall_time.hpp"
#include "procs/supervisor/os/procfs.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMb = 1e6;

/// Removes outputs at any depth whose name or path below `out` matches a pattern.
void remove_outputs(const fs::path& out, const std::vector<std::string>& patterns) {
  if (patterns.empty()) return;
  std::vector<fs::path> matching;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    const std::string path = entry.path().lexically_relative(out).string();
    const bool matches = std::ranges::any_of(patterns, [&](const std::string& pattern) {
      return fnmatch(pattern.c_str(), name.c_str(), 0) == 0 ||
             fnmatch(pattern.c_str(), path.c_str(), 0) == 0;
    });
    if (matches) matching.push_back(entry.path());
  }
  for (const fs::path& path : matching) fs::remove_all(path);
}

}  // namespace

UnitProcess::UnitProcess(const CampaignPlan& plan, const CampaignUnit& unit,
                         const CampaignFolder& folder, const fs::path& watcher)
    : plan_(plan),
      unit_(unit),
      folder_(folder),
      attempt_(folder.units() / fmt::format(".{}.{}.{}", unit.id, host_name(), getpid())),
      begin_us_(steady_us()),
      deadline_us_(begin_us_ + std::llround(1e6 * plan.time_max_s)) {
  result_.id = unit.id;
  result_.began_utime = wall_utime();
  result_.host = host_name();
  fs::remove_all(attempt_);
  fs::create_directories(attempt_ / "out");
  for (const auto& [name, text] : unit.files) {
    const fs::path path = attempt_ / "out" / name;
    fs::create_directories(path.parent_path());
    write_text_file(with_output({text}, (attempt_ / "out").string()).front(), path);
  }
  start(watcher);
}

UnitProcess::~UnitProcess() {
  child_.reset();  // nothing writes to the attempt any more
  std::error_code ignored;
  fs::remove_all(attempt_, ignored);
}

void UnitProcess::start(const fs::path& watcher) try {
  const FileDescriptor output(
      open((attempt_ / "output.log").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!output) throw FileError((attempt_ / "output.log").string() + ": cannot be written");
  ChildStart start;
  start.line.environment = unit_.environment;
  start.line.arguments = with_output(unit_.arguments, (attempt_ / "out").string());
  start.stop_signal = SIGKILL;
  start.watcher = watcher;
  start.output = output.get();
  start.folder = plan_.folder;
  child_ = std::make_unique<ChildProcess>(start);
  ended_ = FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, child_->watcher(), 0)));
  if (!ended_) throw std::system_error(errno, std::generic_category(), "pidfd_open");
} catch (const FileError&) {
  throw;
} catch (const std::system_error&) {  // of this computer, not of the unit
  throw;
} catch (const std::runtime_error& error) {
  result_.reason = error.what();
}

std::optional<UnitResult> UnitProcess::poll() {
  if (!child_) return publish();  // not started
  if (!was_killed_ && steady_us() >= deadline_us_) {
    kill_for(UnitState::kTimeLimit, plan_.time_max_s,
             fmt::format("more than {:g} s", plan_.time_max_s));
  }
  const auto end = child_->poll();
  if (!end) return std::nullopt;
  describe_end(*end);
  return publish();
}

void UnitProcess::check_memory() {
  if (!child_ || was_killed_) return;
  const ProcessTable table = ProcessTable::read_descendants(child_->watcher());
  double memory_mb = 0.0;
  for (const pid_t pid : table.descendants_of(child_->watcher()))
    memory_mb += static_cast<double>(table.entries().at(pid).memory_bytes) / kBytesPerMb;
  result_.memory_mb = std::max(result_.memory_mb, memory_mb);
  if (memory_mb > plan_.memory_max_mb) {
    kill_for(UnitState::kMemoryLimit, plan_.memory_max_mb,
             fmt::format("more than {:g} MB", plan_.memory_max_mb));
  }
}

void UnitProcess::kill_for(UnitState limit, double value, const std::string& reason) {
  was_killed_ = true;
  result_.state = limit;
  result_.limit = value;
  result_.reason = reason;
  child_->send(SIGKILL);
}

void UnitProcess::describe_end(const ChildProcess::End& end) {
  result_.wall_s = 1e-6 * static_cast<double>(steady_us() - begin_us_);
  result_.cpu_s = end.cpu_s;
  result_.memory_mb =
      std::max(result_.memory_mb, static_cast<double>(end.memory_bytes) / kBytesPerMb);
  if (was_killed_) return;
  if (WIFEXITED(end.wait_status)) result_.exit_code = WEXITSTATUS(end.wait_status);
  const bool accepted =
      result_.exit_code && std::ranges::count(plan_.exit_codes, *result_.exit_code) > 0;
  result_.state = accepted ? UnitState::kEnded : UnitState::kCrashed;
  if (!accepted) result_.reason = end.text();
}

UnitResult UnitProcess::publish() {
  remove_outputs(attempt_ / "out", plan_.remove);
  write_result(result_, attempt_ / "result.json");
  std::error_code error;
  fs::rename(attempt_, folder_.unit(unit_.id), error);  // fails if another attempt was complete
  const auto result = read_result(folder_.result(unit_.id));
  if (result) return *result;
  throw FileError(
      fmt::format("{}: cannot be renamed to {}: {}", attempt_.string(), unit_.id, error.message()));
}

}  // namespace adit
