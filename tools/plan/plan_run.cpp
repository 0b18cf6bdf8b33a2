// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_run.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/text/message_text.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/map/log_input.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/plan/logged_plan.hpp"
#include "tools/plan/plan_output.hpp"

namespace adit {
namespace {

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(path);
  file.require_known_sections(config_sections());
  return file;
}

ScanInput scan_of_points(const PlanRunOptions& options) {
  if (options.choice.all || options.choice.number || options.choice.id) {
    throw std::invalid_argument("--scan, --id and --all require a log; a point cloud is one scan");
  }
  const PointCloud points = read_cloud_file(options.input);
  ScanInput source;
  if (points.skipped > 0) {
    source.warnings.push_back(
        fmt::format("skipped {} points that are not finite or farther than 100 km from the origin",
                    points.skipped));
  }
  try {
    source.clouds.push_back(place_cloud(points, options.placement));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", options.input.string(), error.what()));
  }
  return source;
}

void print_warnings(const PlanRunOptions& options, const std::vector<std::string>& warnings,
                    std::ostream& err) {
  for (const std::string& warning : warnings) {
    err << message_line(fmt::format("adit: {}: {}", options.input.string(), warning)) << "\n";
  }
}

std::string title_of(const PlanRunOptions& options, const NumberedScan& scan,
                     const PlannedPath& path) {
  const std::string number =
      options.choice.all || scan.number > 1 ? fmt::format(" {}", scan.number) : "";
  return fmt::format("{}{}: {}", options.input.filename().string(), number, path.reason);
}

void print(const std::vector<std::string>& lines, std::ostream& out) {
  for (const std::string& line : lines) out << fmt::format("  {}\n", line);
}

/// The clearance of a rejoin is added after planning and not compared.
bool is_same(const PlannedPath& a, const PlannedPath& b) {
  constexpr double kToleranceM = 0.001;
  const auto at_one_place = [](const PathPoint& p, const PathPoint& q) {
    return (p.T_odom_body.translation() - q.T_odom_body.translation()).norm() <= kToleranceM;
  };
  return a.outcome == b.outcome && a.reason == b.reason &&
         std::ranges::equal(a.points, b.points, at_one_place);
}

/// Of the plan that the mission made for the same goal.
std::string comparison_with(const std::optional<PlannedPath>& logged, const PlannedPath& path) {
  if (!logged) return "the log has no answer to this goal";
  if (is_same(*logged, path)) return "as in the mission";
  return fmt::format("in the mission: {}: {}", name_of(logged->outcome), logged->reason);
}

/// Plans again for a goal of a mission.
bool run_logged_plan(const PlanRunOptions& options, const ConfigFile& config, std::ostream& out,
                     std::ostream& err) {
  if (!options.choice.id || !is_lcm_log(options.input))
    throw std::invalid_argument("--logged requires a log, and --id: the goal of the mission");
  LoggedPlan logged = logged_plan(options.input, *options.choice.id);
  if (!logged.params && options.config.empty())
    logged.warnings.emplace_back("the log has no parameters of planning; using the defaults");
  print_warnings(options, logged.warnings, err);
  const PlanningParams params = logged.params && options.config.empty()
                                    ? *logged.params
                                    : load_scan_plan_params(config, options.estimator).planning;
  Planning planning(params);
  const ScanPlan plan = plan_on_terrain(logged.terrain, logged.goal, logged.T_odom_body, planning);
  const ResultFolder results(options.folder);
  write_plan_files(fmt::format("{} goal {}: {}", options.input.filename().string(), logged.goal.id,
                               plan.path.reason),
                   logged.cloud, plan, planning, params.vehicle, results.unfinished());
  results.publish();
  out << options.folder.string() << "\n";
  print(plan_summary(logged.cloud, plan), out);
  print({comparison_with(logged.path, plan.path), plan_times(plan.times)}, out);
  return plan.path.outcome == PlanOutcome::kFound;
}

}  // namespace

bool run_plan(const PlanRunOptions& options, std::ostream& out, std::ostream& err) {
  const ConfigFile config = load_config(options.config);
  if (options.logged) return run_logged_plan(options, config, out, err);
  const ScanPlanParams params = load_scan_plan_params(config, options.estimator);
  Planning planning(params.planning);
  const ScanInput source =
      is_lcm_log(options.input) ? scans_of_log(options.input, config) : scan_of_points(options);
  print_warnings(options, source.warnings, err);
  bool all_found = true;
  const ResultFolder results(options.folder);
  for (const NumberedScan& scan : select_scans(source, options.choice)) {
    const ScanPlan plan = plan_on_scan(scan.cloud, options.goal, params, planning);
    std::filesystem::path folder = results.unfinished();
    if (options.choice.all) folder /= fmt::format("scan_{}", scan.number);
    std::filesystem::create_directories(folder);
    write_plan_files(title_of(options, scan, plan.path), scan.cloud, plan, planning,
                     params.planning.vehicle, folder);
    out << fmt::format("{}{}\n", options.folder.string(),
                       options.choice.all ? fmt::format("/scan_{}", scan.number) : "");
    print(plan_summary(scan.cloud, plan), out);
    print({plan_times(plan.times)}, out);
    all_found = all_found && plan.path.outcome == PlanOutcome::kFound;
  }
  results.publish();
  return all_found;
}

void list_scans(const PlanRunOptions& options, std::ostream& out, std::ostream& err) {
  if (!is_lcm_log(options.input)) {
    throw std::invalid_argument("--list requires a log; a point cloud is one scan");
  }
  const ScanInput source = scans_of_log(options.input, load_config(options.config));
  print_warnings(options, source.warnings, err);
  out << "scan      id             utime   lines    points\n";
  int number = 0;
  for (const Cloud& cloud : source.clouds) {
    out << fmt::format("{:4}{:8}{:18}{:8}{:10}{}\n", ++number, cloud.id, cloud.utime,
                       cloud.lines.size(), cloud.points(), cloud.complete ? "" : "  incomplete");
  }
}

}  // namespace adit
