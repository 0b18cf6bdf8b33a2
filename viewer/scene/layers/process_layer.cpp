// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/process_layer.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/procman.hpp"
#include "common/sensing/seconds.hpp"
#include "common/service/wait_status.hpp"
#include "viewer/scene/json_text.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

using nlohmann::json;

constexpr std::int64_t kProcessesPeriodUs = 1'000'000;
constexpr std::size_t kInfosQueued = 50;
constexpr std::size_t kHeartbeatsQueued = 200;

std::string key_of(const std::string& computer, const std::string& process) {
  return computer + '\n' + process;
}

const char* name_of(Health::Level level) {
  switch (level) {
    case Health::Level::kOk:
      return "ok";
    case Health::Level::kDegraded:
      return "degraded";
    case Health::Level::kFault:
      return "fault";
  }
  return "";
}

}  // namespace

ProcessLayer::ProcessLayer(Bus& bus, TopicBoard& board, std::function<std::int64_t()> now_utime)
    : board_(board), now_utime_(std::move(now_utime)) {
  topic_ = board.add(json_topic("/processes", "adit.Processes", kProcessesPeriodUs),
                     [this] { return processes_message(); });
  bus.subscribe(channels::kPmInfo, Delivery::queued(kInfosQueued),
                [this](const ReceivedMessage& received) -> std::string_view {
                  const auto message = decode<procman_lcm::deputy_info_t>(received.bytes);
                  if (!message) return message.rejection();
                  const auto info = from_message(*message);
                  if (info) on_info(*info);
                  return info.rejection();
                });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, Delivery::queued(kHeartbeatsQueued),
                         [this](const Heartbeat& heartbeat) {
                           if (stages_.size() >= kStagesMax && !stages_.contains(heartbeat.stage))
                             return;
                           stages_[heartbeat.stage] = heartbeat;
                           board_.set_changed(topic_, now_utime_());
                         });
}

void ProcessLayer::on_info(const ProcmanInfo& info) {
  if (computers_.size() >= kComputersMax && !computers_.contains(info.deputy)) return;
  computers_[info.deputy] = info;
  for (const ProcmanStatus& status : info.commands) {
    Process& process = processes_[key_of(info.deputy, status.command.id)];
    if (status.pid == 0 || status.pid == process.pid) continue;
    if (process.pid != 0) ++process.restarts;
    process.pid = status.pid;
  }
  board_.set_changed(topic_, now_utime_());
}

std::string ProcessLayer::processes_message() const {
  const std::int64_t now_utime = now_utime_();
  json computers = json::array();
  for (const auto& [name, info] : computers_) {
    json processes = json::array();
    for (const ProcmanStatus& status : info.commands) {
      const auto process = processes_.find(key_of(name, status.command.id));
      processes.push_back(
          {{"name", status.command.id},
           {"group", status.command.group},
           {"pid", status.pid},
           {"running", status.pid != 0},
           {"end", status.pid != 0 ? "" : wait_status_text(status.wait_status)},
           {"cpu_share", status.cpu_cores},
           {"memory_bytes", status.memory_bytes},
           {"restarts", process == processes_.end() ? 0 : process->second.restarts}});
    }
    computers.push_back({{"name", name},
                         {"cpu_load", info.load.cpu_share},
                         {"memory_total_bytes", info.load.memory_bytes},
                         {"memory_free_bytes", info.load.memory_free_bytes},
                         {"processes", std::move(processes)}});
  }
  json stages = json::array();
  for (const auto& [name, heartbeat] : stages_) {
    stages.push_back({{"name", name},
                      {"level", name_of(heartbeat.health.level)},
                      {"reason", heartbeat.health.reason},
                      {"handled", heartbeat.handled},
                      {"rejected", heartbeat.rejected},
                      {"dropped", heartbeat.dropped},
                      {"age_s", std::max(0.0, seconds(now_utime - heartbeat.utime))}});
  }
  return json_text({{"time_s", seconds(now_utime)},
                    {"computers", std::move(computers)},
                    {"stages", std::move(stages)}});
}

}  // namespace adit
