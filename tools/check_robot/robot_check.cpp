// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/robot_check.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "common/types/body_outline.hpp"
#include "procs/guard/guard.hpp"
#include "sim/vehicle/kinematics.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

void construct(CheckResults& results, const char* stage, const std::function<void()>& make) {
  try {
    make();
    results.push_back({Verdict::kGood, "stages", fmt::format("{} accepts its parameters", stage)});
  } catch (const std::exception& error) {
    results.push_back(
        {Verdict::kBad, "stages", fmt::format("{} rejects: {}", stage, error.what())});
  }
}

/// Why no stage accepts the footprint; empty if they do.
std::string fault_of_footprint(const Vehicle& vehicle) {
  try {
    body_outline(vehicle);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

void add_relation(CheckResults& results, bool holds, std::string_view property,
                  const std::string& arithmetic, std::string_view remedy) {
  const std::string text = holds ? arithmetic : fmt::format("{}: {}", arithmetic, remedy);
  results.push_back({holds ? Verdict::kGood : Verdict::kBad, std::string(property), text});
}

RobotConfig with_usable_footprint(RobotConfig robot) {
  if (!fault_of_footprint(robot.vehicle).empty()) robot.vehicle.footprint.clear();
  return robot;
}

CheckResults check_robot(const RobotConfig& given) {
  CheckResults results;
  const std::string fault = fault_of_footprint(given.vehicle);
  if (!fault.empty()) results.push_back({Verdict::kBad, "vehicle", fault});
  const RobotConfig robot = with_usable_footprint(given);
  check_body(robot, results);
  check_lasers(robot, results);
  check_motion(robot, results);
  construct(results, "guard", [&] { const Guard guard(robot.guard); });
  construct(results, "driving", [&] { const Driving driving(robot.driving); });
  construct(results, "planning", [&] {
    const Planning planning(robot.planning);
    const CSpaceKernels kernels(robot.vehicle, robot.planning.c_space, robot.terrain.cell_m);
  });
  return results;
}

std::string text_of_robot(std::string_view name, const CheckResults& results) {
  std::string text;
  for (const CheckResult& result : results) {
    const char* const mark = result.verdict == Verdict::kBad ? "BAD" : "ok";
    text += fmt::format("{:<4} {:<9} {}\n", mark, result.property, result.text);
  }
  const auto bad = std::ranges::count(results, Verdict::kBad, &CheckResult::verdict);
  return text + (bad == 0 ? fmt::format("{}: all {} relations hold\n", name, results.size())
                          : fmt::format("{}: {} of {} relations do not hold\n", name, bad,
                                        results.size()));
}

}  // namespace adit
