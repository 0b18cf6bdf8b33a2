// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_folder.hpp"

#include <optional>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/pose.hpp"
#include "procs/mission/mission_journal.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

fs::path log_of_life(const fs::path& folder, int life) {
  return folder / (life == 1 ? "run.lcmlog" : "run_" + std::to_string(life) + ".lcmlog");
}

std::optional<MissionStand> stand_in(const LogEventView& event) {
  if (event.channel != channels::kTruth) return std::nullopt;
  const auto message = decode<pose_t>(event.data);
  if (!message) return std::nullopt;
  const auto pose = from_message(*message);  // of TRUTH: in world
  if (!pose) return std::nullopt;
  return MissionStand{pose->utime, pose->T_odom_body};
}

std::optional<MissionStand> last_stand_in(const fs::path& log) {
  if (fs::file_size(log) == 0) return std::nullopt;
  const LogFile file(log);
  const auto events = file.events();
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    if (const auto stand = stand_in(*event)) return stand;
  }
  return std::nullopt;
}

}  // namespace

MissionFolder::MissionFolder(const fs::path& path) {
  fs::create_directories(path);
  path_ = fs::canonical(path);
}

std::vector<fs::path> MissionFolder::logs() const {
  std::vector<fs::path> found;
  for (int life = 1; fs::exists(log_of_life(path_, life)); ++life) {
    found.push_back(log_of_life(path_, life));
  }
  return found;
}

fs::path MissionFolder::next_log() const {
  return log_of_life(path_, static_cast<int>(logs().size()) + 1);
}

bool MissionFolder::holds_a_mission() const { return fs::exists(journal()) || !logs().empty(); }

void MissionFolder::require_new() const {
  if (!holds_a_mission()) return;
  throw std::runtime_error(path_.string() +
                           " holds a mission already: go on with it by --resume, or name another "
                           "folder");
}

void MissionFolder::require_unfinished() const {
  if (!holds_a_mission() || !fs::exists(world()) || !fs::exists(config())) {
    throw std::runtime_error(path_.string() + " holds no mission to go on with");
  }
  if (!fs::exists(journal())) return;  // it was cut off before it began
  const MissionJournal journal(this->journal());
  if (journal.last() && journal.last()->phase == Phase::kEnded) {
    throw std::runtime_error("the mission in " + path_.string() +
                             " has ended: " + journal.last()->reason);
  }
}

MissionStand MissionFolder::last_stand() const {
  const std::vector<fs::path> logs = this->logs();
  for (auto log = logs.rbegin(); log != logs.rend(); ++log) {
    if (const auto stand = last_stand_in(*log)) return *stand;
  }
  throw std::runtime_error(path_.string() + ": no log says where the robot is");
}

}  // namespace adit
