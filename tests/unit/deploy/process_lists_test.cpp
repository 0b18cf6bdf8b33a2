// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/stages.hpp"
#include "common/config/config.hpp"
#include "common/process_list/command_line.hpp"
#include "common/process_list/parser.hpp"
#include "procs/supervisor/supervisor_params.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ADIT_SOURCE_DIR;

std::vector<std::string> our_programs() {
  std::vector<std::string> names{"adit"};
  for (const std::string& stage : stage_names()) names.push_back("adit-" + stage);
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

TEST(ProcessLists, AreWhatTheConfigurationOfTheSupervisorSays) {
  const fs::path path = kRoot / "deploy/config/simulated.yaml";
  const auto params = load_section<SupervisorParams>(ConfigFile::load(path), "supervisor");
  EXPECT_NE(read_process_list(kRoot / params.processes).find_script(params.start_script), nullptr);
}

}  // namespace
}  // namespace adit
