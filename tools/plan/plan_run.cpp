// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_run.hpp"

#include <cstdio>
#include <stdexcept>

#include "common/bus/stages.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/plan/plan_files.hpp"

namespace adit {
namespace {

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(path);
  file.require_known_sections(config_sections());
  return file;
}

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

ScanSource scan_of_points(const PlanRunOptions& options) {
  if (options.choice.all || options.choice.number || options.choice.id) {
    throw std::invalid_argument("--scan, --id and --all are for logs; a cloud is one scan");
  }
  const PointCloud points = read_cloud_file(options.input);
  ScanSource source;
  if (points.skipped > 0) {
    source.complaints.push_back("skipped " + std::to_string(points.skipped) +
                                " points that are not finite, or farther than 100 km from 0");
  }
  try {
    source.clouds.push_back(place_cloud(points, options.placement));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(options.input.string() + ": " + error.what());
  }
  return source;
}

void complain(const PlanRunOptions& options, const ScanSource& source, std::ostream& err) {
  for (const std::string& sentence : source.complaints) {
    err << "adit: " << options.input.string() << ": " << sentence << "\n";
  }
}

void say(const Cloud& cloud, const ScanPlan& plan, std::ostream& out) {
  const auto& [seen, never_seen, shadow, below_ray, no_return] = plan.ground;
  const Eigen::Vector3f laser =
      cloud.lines.empty() ? Eigen::Vector3f::Zero() : cloud.lines.front().origin;
  const auto& times = plan.times;
  const PlannedPath& path = plan.path;
  out << text("  scan   %zu points%s; laser at %.2f, %.2f, %.2f m from the robot on the ground\n",
              cloud.points(), cloud.complete ? "" : ", cut short", laser.x(), laser.y(), laser.z())
      << text(
             "  cells  %zu: %zu seen, %zu never looked at, %zu in shadow, %zu below a beam, %zu "
             "without return\n",
             plan.terrain.cells.size(), seen, never_seen, shadow, below_ray, no_return)
      << text(
             "  times  terrain %.1f ms, C-space %.1f ms, search %.1f ms: scan to path %.1f ms "
             "(kernels, once: %.1f ms)\n",
             times.terrain_ms, times.c_space_ms, times.search_ms, times.scan_to_path_ms(),
             times.kernels_ms)
      << "  path   " << name_of(path.outcome) << ": " << path.reason << "\n";
  if (path.points.empty()) return;
  out << text(
      "         %.1f m long, %.1f m towards the goal, at least %.2f m from what is lethal\n",
      path_length_m(path), path.reached_m, least_clearance_m(path));
}

std::string title_of(const PlanRunOptions& options, const NumberedScan& scan,
                     const PlannedPath& path) {
  std::string title = options.input.filename().string();
  if (options.choice.all || scan.number > 1) title.append(" ").append(std::to_string(scan.number));
  return title + ": " + path.reason;
}

}  // namespace

bool run_plan(const PlanRunOptions& options, std::ostream& out, std::ostream& err) {
  const ConfigFile config = load_config(options.config);
  const ScanPlanParams params = load_scan_plan_params(config, options.estimator);
  Planning planning(params.planning);
  const ScanSource source =
      is_scan_log(options.input) ? scans_of_log(options.input, config) : scan_of_points(options);
  complain(options, source, err);
  bool all_found = true;
  const ResultFolder results(options.folder);
  for (const NumberedScan& scan : choose(source, options.choice)) {
    const ScanPlan plan = plan_on_scan(scan.cloud, options.goal, params, planning);
    std::filesystem::path folder = results.unfinished();
    if (options.choice.all) folder /= "scan_" + std::to_string(scan.number);
    std::filesystem::create_directories(folder);
    write_plan_files(title_of(options, scan, plan.path), scan.cloud, plan, planning,
                     params.planning.vehicle, folder);
    out << options.folder.string();
    if (options.choice.all) out << "/scan_" << scan.number;
    out << "\n";
    say(scan.cloud, plan, out);
    all_found = all_found && plan.path.outcome == PlanOutcome::kFound;
  }
  results.publish();
  return all_found;
}

void list_scans(const PlanRunOptions& options, std::ostream& out, std::ostream& err) {
  if (!is_scan_log(options.input)) {
    throw std::invalid_argument("--list is for logs; a cloud is one scan");
  }
  const ScanSource source = scans_of_log(options.input, load_config(options.config));
  complain(options, source, err);
  out << "scan      id             utime   lines    points\n";
  int number = 0;
  for (const Cloud& cloud : source.clouds) {
    out << text("%4d %7d %17lld %7zu %9zu%s\n", ++number, cloud.id,
                static_cast<long long>(cloud.utime), cloud.lines.size(), cloud.points(),
                cloud.complete ? "" : "  cut short");
  }
}

}  // namespace adit
