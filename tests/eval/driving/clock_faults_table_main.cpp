// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// clock_faults_table: missions in small random mines in which the clock of a sensor jumps, drifts
// or stops, as a table in Markdown. Succeeds if none claims home falsely, collides, or has no POSE
// for over five seconds after the cause is gone.
#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/eval/markdown.hpp"
#include "tests/support/clocks/clock_fault_mission.hpp"
#include "tests/support/scores/outcome_name.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

struct Options {
  unsigned seed = 1;
  int cases = 200;
  std::string half = "both";
  std::optional<int> only;
};

std::string seconds_text(const std::optional<double>& time_s) {
  return time_s ? format("%.2f", *time_s) : "–";
}

struct Sums {
  int missions = 0, without_effect = 0, reported = 0, failures = 0, false_home = 0, collisions = 0;
  double blind_after_s = 0.0;
  std::map<std::string, int> outcomes;

  void add(const test::ClockFaultCase& fault_case, const test::ClockFaultResult& result) {
    ++missions;
    ++outcomes[test::outcome_name(result.outcome)];
    const bool has_fault = fault_case.fault.kind != test::ClockFault::Kind::kNone;
    without_effect += has_fault && result.changed == 0 ? 1 : 0;
    reported += result.reported.empty() ? 0 : 1;
    false_home += result.claims_home_falsely() ? 1 : 0;
    collisions += result.failure.empty() ? 0 : 1;
    failures += result.is_failure() ? 1 : 0;
    blind_after_s = std::max(blind_after_s, result.blind_after_s.value_or(0.0));
  }
};

bool is_chosen(const test::ClockFaultCase& fault_case, const Options& options) {
  if (options.only) return fault_case.number == *options.only;
  const bool even = fault_case.number % 2 == 0;
  return fault_case.number < options.cases &&
         (options.half == "both" || even == (options.half == "even"));
}

void print(const test::ClockFaultCase& fault_case, const test::ClockFaultResult& result) {
  const std::string reported = result.reported.empty() ? "–" : result.reported;
  std::string outcome = test::outcome_name(result.outcome);
  if (result.outcome != MissionOutcome::kHome) outcome += ": " + result.reason;
  if (!result.failure.empty()) outcome = "failed: " + result.failure;
  std::cout << fmt::format(
      "| {} | {} | {} | {:.1f} | {} | {:.2f} | {:.0f} | {} | {} | {} | {} |{}\n", fault_case.number,
      fault_case.mine, fault_case.fault.text(), fault_case.fault.at_s, outcome,
      result.distance_from_start_m, result.simulated_s, seconds_text(result.blind_s),
      seconds_text(result.blind_after_s), result.rejected, reported,
      result.is_failure() ? " FAILED" : "");
  std::cout.flush();
}

void print(const Sums& sums) {
  std::cout << format("\n| %d missions | |\n|---|---|\n", sums.missions);
  for (const auto& [outcome, count] : sums.outcomes) {
    std::cout << format("| %s | %d |\n", outcome.c_str(), count);
  }
  std::cout << format("| falsely home; collisions | %d; %d |\n", sums.false_home, sums.collisions)
            << format("| longest time without POSE after the cause | %.2f s |\n",
                      sums.blind_after_s)
            << format("| fault named in a heartbeat | %d |\n", sums.reported)
            << format("| ended before the fault | %d |\n", sums.without_effect)
            << format("| failures | %d |\n", sums.failures);
}

int run(const Options& options) {
  print_heading(
      "| case | mine | fault | at (s) | outcome | from the start (m) | simulated (s) | longest "
      "without POSE (s) | after the cause (s) | rejected | reported |");
  Sums sums;
  for (const test::ClockFaultCase& fault_case : test::clock_fault_cases(options.seed)) {
    if (!is_chosen(fault_case, options)) continue;
    const test::ScratchFolder scratch;
    const test::ClockFaultResult result = run_clock_fault(fault_case, scratch / "");
    print(fault_case, result);
    sums.add(fault_case, result);
  }
  print(sums);
  const bool complete = sums.missions > 0 && sums.without_effect == 0;
  return complete && sums.failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  adit::Options options;
  CLI::App app("Missions in which the clock of a sensor fails, as a table in Markdown");
  app.add_option("--seed", options.seed, "Order and times of the faults");
  app.add_option("--cases", options.cases, "The first of all cases");
  app.add_option("--half", options.half, "Those with an even or odd number, or both")
      ->check(CLI::IsMember({"even", "odd", "both"}));
  app.add_option("--only", options.only, "The case with this number");
  CLI11_PARSE(app, argc, argv);
  return adit::run(options);
} catch (const std::exception& error) {
  std::cerr << "clock_faults_table: " << error.what() << "\n";
  return 2;
}
