// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/process_list/command_line.hpp"
#include "common/process_list/parser.hpp"
#include "procs/supervisor/supervisor_setup.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ADIT_SOURCE_DIR;

std::vector<std::string> our_programs() {
  std::vector<std::string> names{"adit", "adit-record"};
  for (const std::string& stage : stage_names()) names.push_back("adit-" + stage);
  for (const std::string& driver : driver_names()) names.push_back("adit-" + driver);
  return names;
}

TEST(ProcessLists, NameProgramsThatThereAreAndFilesThatThereAre) {
  int lists = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "deploy/processes")) {
    const ProcessList list = read_process_list(entry.path());
    EXPECT_FALSE(list.commands.empty()) << entry.path();
    for (const ListedCommand& command : list.commands) {
      const auto words = parse_command_line(command.exec)->arguments;
      EXPECT_THAT(our_programs(), testing::Contains(words.front()));
      const auto config = std::ranges::find(words, "--config");
      if (config == words.end()) continue;
      EXPECT_TRUE(fs::exists(kRoot / *(config + 1))) << command.exec;
    }
    ++lists;
  }
  EXPECT_GT(lists, 0);
}

SupervisorParams supervisor_of(const std::string& config) {
  return load_section<SupervisorParams>(ConfigFile::load(kRoot / "deploy/config" / config),
                                        "supervisor");
}

TEST(ProcessLists, AreWhatTheConfigurationOfTheSupervisorSays) {
  const auto simulated = supervisor_of("simulated.yaml");
  EXPECT_NE(read_process_list(kRoot / simulated.processes).find_script(simulated.start_script),
            nullptr);
  const auto robot = supervisor_of("robot.yaml");
  const fs::path file = fs::path(robot.processes).filename();
  EXPECT_NE(read_process_list(kRoot / "deploy/processes" / file).find_script(robot.start_script),
            nullptr);
}

TEST(ProcessLists, HaveEveryStageRunOnTheRobot) {
  const ProcessList list = read_process_list(kRoot / "deploy/processes/robot.cfg");
  EXPECT_EQ(list.find("guard"), nullptr);  // a service of its own; two guards would stop each other
  EXPECT_TRUE(fs::exists(kRoot / "deploy/systemd/adit-guard.service"));
  for (const std::string& stage : stage_names()) {
    if (stage == "supervisor" || stage == "guard") continue;
    const ListedCommand* const command = list.find(stage);
    ASSERT_NE(command, nullptr) << stage;
    EXPECT_EQ(command->exec, "adit-" + stage);
    EXPECT_TRUE(command->auto_respawn) << stage;
  }
}

/// A liveness channel that is published only on input would cause restarts of healthy processes.
TEST(ProcessLists, UseLivenessChannelsThatArePublishedWithoutInput) {
  const ProcessList list = read_process_list(kRoot / "deploy/processes/robot.cfg");
  std::vector<std::string> channels;
  for (const ListedCommand& command : list.commands) {
    if (command.alive) channels.push_back(command.alive->channel);
  }
  EXPECT_THAT(channels, testing::IsSubsetOf({"DRIVING_STATE", "PHASE"}));
  EXPECT_FALSE(channels.empty());
}

/// Text in which what is commented out by "#  " counts.
std::string with_comments_removed(const fs::path& path, const std::string& mark) {
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    text += (line.starts_with(mark) ? line.substr(1) : line) + "\n";
  }
  return text;
}

TEST(ProcessLists, HaveRowsOfDriversThatOnlyNeedTheirCommentSignsRemoved) {
  const ProcessList list = parse_process_list(
      with_comments_removed(kRoot / "deploy/processes/robot.cfg", "#  "), "robot.cfg");
  const std::map<std::string, std::string> channels{
      {"laser_front", "LASER_FRONT"}, {"laser_rear", "LASER_REAR"}, {"tilt_front", "TILT_FRONT"},
      {"tilt_rear", "TILT_REAR"},     {"base", "VEHICLE_STATE"},    {"imu", "IMU"}};
  for (const auto& [id, channel] : channels) {
    const ListedCommand* const command = list.find(id);
    ASSERT_NE(command, nullptr) << id;
    ASSERT_TRUE(command->alive) << id;
    const auto words = parse_command_line(command->exec)->arguments;
    EXPECT_THAT(our_programs(), testing::Contains(words.front()));
    std::string section = words.at(0).substr(5);
    if (words.size() > 1) section += "_" + words.at(1);
    EXPECT_THAT(config_sections(), testing::Contains(section));
    EXPECT_EQ(command->alive->channel, channel);
  }
}

/// The first row of a channel in the table of lcmtypes, in columns.
std::vector<std::string> row_of_channel(const std::string& channel) {
  std::ifstream file(kRoot / "lcmtypes/README.md");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| `" + channel + "` |")) continue;
    std::vector<std::string> columns;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, '|');) columns.push_back(part);
    return columns;
  }
  return {};
}

/// One that the stage does not publish, or does not receive, would cause restarts of a healthy one.
TEST(ProcessLists, ExpectAnswersOfStagesThatPublishThemAndReceiveTheirInput) {
  constexpr std::size_t kFrom = 5;
  constexpr std::size_t kTo = 6;
  const ProcessList list = read_process_list(kRoot / "deploy/processes/robot.cfg");
  int rules = 0;
  for (const ListedCommand& command : list.commands) {
    if (!command.answer) continue;
    ++rules;
    const auto answer = row_of_channel(command.answer->channel);
    ASSERT_GT(answer.size(), kTo) << command.answer->channel;
    EXPECT_THAT(answer[kFrom], testing::HasSubstr(command.id));
    for (const std::string& input : command.answer->inputs) {
      const auto row = row_of_channel(input);
      ASSERT_GT(row.size(), kTo) << input;
      EXPECT_THAT(row[kTo], testing::HasSubstr(command.id));
    }
  }
  EXPECT_GE(rules, 2);
}

}  // namespace
}  // namespace adit
