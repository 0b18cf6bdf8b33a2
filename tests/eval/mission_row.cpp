// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mission_row.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/world/build_world.hpp"
#include "tests/support/mission_log.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace test {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MissionScore, outcome, reason, home_off_m, farthest_m,
                                   corridor_m, seen_share, missed_m, sure_missed_m, travelled_m,
                                   simulated_s, wall_s, scans, rmse_m, rmse_believed_m,
                                   length_ratio, verdicts, false_verdicts, doubtful, home_verdicts,
                                   complete, other_laser, back_offs, guard_stops)

}  // namespace test

namespace {

std::filesystem::path folder_of(const MissionRow& row, const MissionRowOptions& options) {
  std::string name = row.name;
  std::replace(name.begin(), name.end(), ':', '_');
  return options.folder / name;
}

/// What a child does; its words are in a file.
[[noreturn]] void be_child(const MissionRow& row, const MissionRowOptions& options) {
  int code = 0;
  try {
    const nlohmann::json score = run_row(row, options);
    std::ofstream(folder_of(row, options) / "score.json") << score.dump(2) << "\n";
  } catch (const std::exception& error) {
    std::cerr << row.name << ": " << error.what() << "\n";
    code = 2;
  }
  std::_Exit(code);
}

void take_score(int status, MissionRow& row, const MissionRowOptions& options) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    std::ifstream file(folder_of(row, options) / "score.json");
    row.score = nlohmann::json::parse(file).get<test::MissionScore>();
  } else {
    row.score.outcome = "crashed";
    row.score.reason =
        WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "see standard error";
  }
  std::cerr << row.name << ": " << row.score.outcome << ", " << row.score.reason << "\n";
}

}  // namespace

test::MissionScore run_row(const MissionRow& row, const MissionRowOptions& options) {
  MissionRunOptions run;
  run.world = row.world;
  run.folder = folder_of(row, options);
  run.config = options.config;
  run.time_max_s = options.time_max_s;
  std::filesystem::remove_all(run.folder);
  const MissionRunResult result = run_mission(run);
  const test::MissionLog log = test::read_mission(run.folder / "run.lcmlog");
  test::MissionScore score = test::MissionTruth(build_world(describe(row.world))).score(log);
  score.wall_s = result.wall_s;
  if (!options.keep_log) std::filesystem::remove(run.folder / "run.lcmlog");
  return score;
}

void run_rows(std::vector<MissionRow>& rows, const MissionRowOptions& options, int jobs) {
  std::map<pid_t, MissionRow*> running;
  std::filesystem::create_directories(options.folder);
  const auto wait_for_one = [&] {
    int status = 0;
    const auto child = running.find(waitpid(-1, &status, 0));
    if (child == running.end()) return;
    take_score(status, *child->second, options);
    running.erase(child);
  };
  for (MissionRow& row : rows) {
    if (static_cast<int>(running.size()) >= jobs) wait_for_one();
    const pid_t pid = fork();
    if (pid == 0) be_child(row, options);
    if (pid > 0) running[pid] = &row;
  }
  while (!running.empty()) wait_for_one();
}

}  // namespace adit
