// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// damaged_journals_table: interrupts missions in random mines, damages one journal and resumes
// them, as tables in Markdown: the stages alone (--cases), and whole missions (--missions).
// Succeeds if nothing is lost unreported and no robot is said to be at home that is not.
#include <array>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/support/journals/damaged_stages.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using test::DamagedCase;
using test::DamageOutcome;
using test::JournalDamage;

constexpr double kHomeM = 0.5;        // from the start, by the truth
constexpr int kVariants = 5;          // of an interrupted mission
constexpr double kResumedMaxS = 900;  // simulated time after the interruption

struct Options {
  int cases = 10'000;
  int missions = 200;
  int first = 0;  // number of the first mission
  unsigned seed = 1;
  double length_m = 60.0;
  bool show = false;  // each case
};

WorldChoice mine(int seed, double length_m) {
  WorldChoice choice;
  choice.name = "random";
  choice.seed = seed;
  choice.length_m = length_m;
  return choice;
}

/// A mission that loses power after some minutes, still in progress.
struct Interrupted {
  fs::path folder;
  MissionRunOptions options;
};

Interrupted interrupt(unsigned seed, double length_m, const fs::path& folder) {
  std::mt19937 random(seed);
  Interrupted interrupted{folder, {}};
  interrupted.options.world = mine(static_cast<int>(seed), length_m);
  interrupted.options.folder = folder;
  interrupted.options.time_max_s = std::uniform_real_distribution<double>(60.0, 240.0)(random);
  run_mission(interrupted.options);
  return interrupted;
}

using Counts = std::array<int, 6>;

bool is_wrong(DamageOutcome outcome) {
  return outcome == DamageOutcome::kUnreportedLoss || outcome == DamageOutcome::kFalseHome;
}

int run_cases(const Options& options, const fs::path& folder) {
  const Interrupted mission = interrupt(options.seed, options.length_m, folder / "mission");
  test::DamagedStages stages(mission.folder, folder / "cases");
  std::map<std::string, Counts> rows;
  int wrong = 0;
  for (int i = 0; i < options.cases; ++i) {
    const DamagedCase result = stages.run(options.seed * 1'000'000 + static_cast<unsigned>(i));
    const auto outcome = static_cast<std::size_t>(result.outcome);
    ++rows[result.stage][outcome];
    ++rows["all"][outcome];
    wrong += is_wrong(result.outcome) ? 1 : 0;
    if (options.show || is_wrong(result.outcome)) {
      std::cerr << fmt::format("{} {}, {}: {} {}\n", i, result.stage, text_of(result.damage),
                               outcome, result.report);
    }
  }
  std::cout << "| journal | cases | unchanged | nothing lost | lost and reported | both copies "
               "older | unreported loss | false home |\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& [stage, counts] : rows) {
    int sum = 0;
    for (const int count : counts) sum += count;
    std::cout << fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", stage, sum, counts[0],
                             counts[1], counts[2], counts[3], counts[4], counts[5]);
  }
  return wrong;
}

/// Of the stages that the return depends on; every second damage hits both copies, as one of a
/// single copy loses nothing.
JournalDamage damage_journals(const fs::path& folder, std::mt19937& random, std::string& stage) {
  constexpr std::array kStages = {"mapping", "mapping", "mission", "exploration"};
  stage = kStages[random() % kStages.size()];
  JournalDamage damage = test::random_damage(random);
  if (random() % 2 == 0) damage.files = JournalDamage::Files::kBoth;
  apply(damage, folder / (stage + ".journal"), random);
  return damage;
}

int run_missions(const Options& options, const fs::path& folder) {
  std::cout << "| mine | journal | damage | lines | outcome | from the start [m] |\n"
               "|---|---|---|---|---|---|\n";
  std::map<std::string, int> counts;
  int wrong = 0;
  for (int i = options.first; i < options.first + options.missions;) {
    const auto seed = options.seed + static_cast<unsigned>(i / kVariants);
    const Interrupted mission = interrupt(seed, options.length_m, folder / "mission");
    for (int k = i % kVariants; k < kVariants && i < options.first + options.missions; ++k, ++i) {
      std::mt19937 random(options.seed * 1'000'000 + static_cast<unsigned>(i));
      MissionRunOptions resumed = mission.options;
      resumed.folder = folder / "resumed";
      resumed.resume = true;
      resumed.time_max_s = kResumedMaxS;
      test::copy_mission(mission.folder, resumed.folder);
      std::string stage;
      const JournalDamage damage = damage_journals(resumed.folder, random, stage);
      const auto lines = journal_reports(MissionFolder(resumed.folder));
      const MissionRunResult result = run_mission(resumed);
      const MissionPhase& last = result.last.phase;
      const bool home = last.phase == Phase::kEnded && last.outcome == MissionOutcome::kHome;
      const bool is_false = home && result.distance_from_start_m > kHomeM;
      wrong += is_false ? 1 : 0;
      ++counts[is_false ? "false home" : home ? "home" : "not home, and said so"];
      std::cout << fmt::format("| {} | {} | {} | {} | {} | {:.2f} |\n", seed, stage,
                               text_of(damage), fmt::join(lines, "; "),
                               is_false ? "FALSE HOME"
                               : home   ? "home"
                                        : last.reason,
                               result.distance_from_start_m)
                << std::flush;
      fs::remove_all(resumed.folder);
    }
    fs::remove_all(mission.folder);
  }
  std::cout << "\n";
  for (const auto& [outcome, count] : counts) std::cout << outcome << ": " << count << "\n";
  return wrong;
}

int run(const Options& options) {
  const test::ScratchFolder scratch;
  int wrong = 0;
  if (options.cases > 0) wrong += run_cases(options, scratch / "cases");
  if (options.missions > 0) wrong += run_missions(options, scratch / "missions");
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  adit::Options options;
  CLI::App app{"Damages journals of interrupted missions and resumes them"};
  app.add_option("--cases", options.cases, "Damages of a journal that its stage opens");
  app.add_option("--missions", options.missions, "Missions resumed with a damaged journal");
  app.add_option("--first", options.first, "Number of the first of them")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seed", options.seed, "Seed of mines and damages");
  app.add_option("--length-m", options.length_m, "Length of the mines");
  app.add_flag("--show", options.show, "Print each case on standard error");
  CLI11_PARSE(app, argc, argv);
  return adit::run(options);
} catch (const std::exception& error) {
  std::cerr << "damaged_journals_table: " << error.what() << "\n";
  return 2;
}
