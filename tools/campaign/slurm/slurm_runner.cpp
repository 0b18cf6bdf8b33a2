// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/slurm/slurm_runner.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <poll.h>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/seal/sha256.hpp"
#include "common/service/wall_time.hpp"
#include "tools/campaign/slurm/slurm_queue.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kResultPeriodS = 0.5;
constexpr std::size_t kArrayMax = 1000;  // MaxArraySize of Slurm is 1001 unless configured
constexpr int kSubmitsMax = 3;
constexpr int kAbsentMin = 3;  // queries of the queue: a file system of a network shows files late
constexpr double kTimeMarginS = 120.0;
constexpr double kMemoryMarginMb = 300.0;  // of adit and adit-watch

/// A unit without a result.
struct Missing {
  const CampaignUnit* unit = nullptr;
  int submits = 0;
  int absent = 0;          ///< successive queries in which no task worked on it
  std::string last_state;  ///< of its last task that ended
};

/// The arrays of a campaign in its folder: DIR/slurm/N.txt has the id of each task of array N.
class SlurmArrays {
 public:
  SlurmArrays(const SlurmRunner& runner, const CampaignPlan& plan, const CampaignFolder& folder)
      : runner_(runner), plan_(plan), folder_(folder) {
    fs::create_directories(folder.slurm());
    prefix_ = fmt::format("adit-{}-", sha256_hex(folder.path.string()).substr(0, 8));
    for (const auto& entry : fs::directory_iterator(folder.slurm())) {
      const auto number = parse_number<int>(entry.path().stem().string());
      if (entry.path().extension() == ".txt" && number) arrays_[*number] = read_ids(entry.path());
    }
  }

  /// The id of the unit of a task; nothing for a task of something else.
  [[nodiscard]] std::optional<std::string> unit_of(const SlurmTask& task) const {
    if (!task.name.starts_with(prefix_)) return std::nullopt;
    const auto number = parse_number<int>(task.name.substr(prefix_.size()));
    const auto array = number ? arrays_.find(*number) : arrays_.end();
    const std::size_t index = static_cast<std::size_t>(task.index) - 1;
    if (array == arrays_.end() || index >= array->second.size()) return std::nullopt;
    return array->second[index];
  }

  /// Writes the list and the script of a new array. Returns the script.
  fs::path write(const std::vector<std::string>& ids) {
    const int number = arrays_.empty() ? 1 : arrays_.rbegin()->first + 1;
    std::string list;
    for (const std::string& id : ids) list += id + "\n";
    const fs::path list_file = folder_.slurm() / fmt::format("{}.txt", number);
    fs::path script = folder_.slurm() / fmt::format("{}.sh", number);
    write_text_file(list, list_file);
    write_text_file(script_text(number, ids.size(), list_file), script);
    arrays_[number] = ids;
    return script;
  }

 private:
  static std::vector<std::string> read_ids(const fs::path& path) {
    std::vector<std::string> ids;
    std::istringstream lines(read_text_file(path));
    for (std::string line; std::getline(lines, line);) ids.push_back(line);
    return ids;
  }

  [[nodiscard]] std::string script_text(int number, std::size_t tasks, const fs::path& list) const {
    const double minutes = std::ceil((plan_.time_max_s + kTimeMarginS) / 60.0);
    return fmt::format(
        R"(#!/bin/sh
#SBATCH --job-name={}{}
#SBATCH --array=1-{}{}
#SBATCH --requeue
#SBATCH --time={:.0f}
#SBATCH --mem={:.0f}M
#SBATCH --cpus-per-task={}
#SBATCH --ntasks=1
#SBATCH --open-mode=append
#SBATCH --output="{}"
id=$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {})
exec {} campaign run-unit {} "$id"
)",
        prefix_, number, tasks, runner_.jobs > 0 ? fmt::format("%{}", runner_.jobs) : "", minutes,
        plan_.memory_max_mb + kMemoryMarginMb, runner_.cores,
        (folder_.slurm() / fmt::format("{}.log", number)).string(), shell_word(list.string()),
        shell_word((runner_.programs / "adit").string()), shell_word(folder_.path.string()));
  }

  const SlurmRunner& runner_;
  const CampaignPlan& plan_;
  const CampaignFolder& folder_;
  std::string prefix_;
  std::map<int, std::vector<std::string>> arrays_;
};

class SlurmRun {
 public:
  SlurmRun(const SlurmRunner& runner, const CampaignPlan& plan,
           const std::vector<const CampaignUnit*>& units, const CampaignFolder& folder,
           const LocalRunner::OnResult& on_result)
      : runner_(runner),
        plan_(plan),
        folder_(folder),
        on_result_(on_result),
        queue_(runner.programs / "adit-watch"),
        arrays_(runner, plan, folder) {
    for (const CampaignUnit* const unit : units) missing_[unit->id].unit = unit;
  }

  bool run() {
    std::int64_t queue_us = 0;
    const double period_s = std::min(kResultPeriodS, runner_.queue_period_s);
    while (collect() && !missing_.empty()) {
      if (steady_us() >= queue_us) {
        update_queue();
        queue_us = steady_us() + std::llround(1e6 * runner_.queue_period_s);
      }
      pollfd stop{runner_.stop_descriptor, POLLIN, 0};
      if (poll(&stop, 1, static_cast<int>(1e3 * period_s)) > 0) return false;
    }
    cancel_rest();
    return true;
  }

 private:
  /// Reports new results. Returns whether to continue.
  bool collect() {
    for (auto it = missing_.begin(); it != missing_.end();) {
      const auto result = read_result(folder_.result(it->first));
      if (!result) {
        ++it;
        continue;
      }
      const CampaignUnit& unit = *it->second.unit;
      it = missing_.erase(it);
      if (!on_result_(unit, *result)) return false;
    }
    return true;
  }

  void update_queue() {
    const auto tasks = queue_.tasks();
    if (!tasks) return tell_once("the controller of Slurm does not answer; waiting for it");
    std::set<std::string> active;
    for (const SlurmTask& task : *tasks) {
      const auto id = arrays_.unit_of(task);
      const auto missing = id ? missing_.find(*id) : missing_.end();
      if (missing == missing_.end()) continue;
      if (task.has_ended()) {
        missing->second.last_state = task.state;
      } else {
        active.insert(*id);
        if (task.is_held()) queue_.release(task);
      }
    }
    submit_absent(active);
  }

  void submit_absent(const std::set<std::string>& active) {
    std::vector<Missing*> absent;
    for (auto& [id, missing] : missing_) {
      missing.absent = active.contains(id) ? 0 : missing.absent + 1;
      const bool is_new = missing.submits == 0 && !active.contains(id);
      if (is_new || missing.absent >= kAbsentMin) absent.push_back(&missing);
    }
    std::ranges::sort(absent, {}, [](const Missing* missing) { return missing->unit->number; });
    std::vector<std::string> ids;
    std::vector<std::pair<const CampaignUnit*, UnitResult>> lost;
    for (Missing* const missing : absent) {
      if (const auto result = lost_result(*missing)) {
        lost.emplace_back(missing->unit, *result);
      } else {
        ids.push_back(missing->unit->id);
      }
    }
    for (const auto& [unit, result] : lost) {
      missing_.erase(unit->id);
      on_result_(*unit, result);
    }
    submit(ids);
  }

  void submit(const std::vector<std::string>& ids) {
    for (std::size_t begin = 0; begin < ids.size(); begin += kArrayMax) {
      const std::size_t end = std::min(begin + kArrayMax, ids.size());
      const std::vector<std::string> part(ids.begin() + static_cast<std::ptrdiff_t>(begin),
                                          ids.begin() + static_cast<std::ptrdiff_t>(end));
      if (!queue_.submit(arrays_.write(part))) {
        return tell_once("the controller of Slurm does not answer; waiting for it");
      }
      for (const std::string& id : part) {
        ++missing_.at(id).submits;
        missing_.at(id).absent = 0;
      }
    }
  }

  /// The row of a unit that is not submitted again.
  [[nodiscard]] std::optional<UnitResult> lost_result(const Missing& missing) const {
    if (missing.submits == 0) return std::nullopt;
    UnitResult result;
    result.id = missing.unit->id;
    result.reason = "Slurm: " + missing.last_state;
    if (missing.last_state == "OUT_OF_MEMORY") {
      result.state = UnitState::kMemoryLimit;
      result.limit = plan_.memory_max_mb;
    } else if (missing.last_state == "TIMEOUT") {
      result.state = UnitState::kTimeLimit;
      result.limit = plan_.time_max_s;
    } else if (missing.last_state == "CANCELLED") {
      result.state = UnitState::kLost;
    } else if (missing.submits >= kSubmitsMax) {
      result.state = UnitState::kLost;
      result.reason =
          fmt::format("{} tasks of Slurm ended without a result{}{}", missing.submits,
                      missing.last_state.empty() ? "" : ", the last one: ", missing.last_state);
    } else {
      return std::nullopt;
    }
    return result;
  }

  /// Tasks that wait or run for nothing: a rate is known well enough, or their unit has a result.
  void cancel_rest() const {
    const auto tasks = queue_.tasks();
    std::set<std::string> jobs;
    for (const SlurmTask& task : tasks.value_or(std::vector<SlurmTask>{})) {
      if (!task.has_ended() && arrays_.unit_of(task)) jobs.insert(task.job);
    }
    queue_.cancel({jobs.begin(), jobs.end()});
  }

  void tell_once(const std::string& message) {
    if (!std::exchange(told_, true)) runner_.notify(message);
  }

  const SlurmRunner& runner_;
  const CampaignPlan& plan_;
  const CampaignFolder& folder_;
  const LocalRunner::OnResult& on_result_;
  SlurmQueue queue_;
  SlurmArrays arrays_;
  std::map<std::string, Missing> missing_;
  bool told_ = false;
};

}  // namespace

bool SlurmRunner::run(const CampaignPlan& plan, const std::vector<const CampaignUnit*>& units,
                      const CampaignFolder& folder, const LocalRunner::OnResult& on_result) const {
  if (units.empty()) return true;
  return SlurmRun(*this, plan, units, folder, on_result).run();
}

}  // namespace adit
