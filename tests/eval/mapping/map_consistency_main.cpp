// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// map_consistency_table LOGS..: maps the recorded scan matches of missions again, and compares the
// errors of displacements, loop closures, local maps and the body with their covariances by the
// ground truth of the simulator, as a table in Markdown.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "tests/eval/markdown.hpp"
#include "tools/eval/map_consistency.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/report/records/map_record.hpp"

namespace adit {
namespace {

constexpr double kChiSquare3 = 7.814728;  // 95 %, three degrees of freedom
constexpr double kChiSquare2 = 5.991465;  // two
constexpr double kChiSquare1 = 3.841459;  // one

/// How many errors are within their 95 % region, and the mean of the normalised error squared.
struct Consistency {
  std::size_t count = 0;
  std::size_t within = 0;
  double sum = 0.0;

  void add(double normalised_squared, double bound) {
    ++count;
    within += normalised_squared <= bound ? 1U : 0U;
    sum += normalised_squared;
  }
  void add(const Consistency& other) {
    count += other.count;
    within += other.within;
    sum += other.sum;
  }
  [[nodiscard]] std::string text() const {
    if (count == 0) return "–";
    const auto n = static_cast<double>(count);
    return format("%zu, %.0f %%, %.1f", count, 100.0 * static_cast<double>(within) / n, sum / n);
  }
};

struct ConstraintError {
  MapConstraint constraint;
  std::int64_t utime = 0;  ///< of its second local map
  Eigen::Vector3d error;   ///< [m, m, rad] in the frame of its second local map
  double squared = 0.0;    ///< normalised
};

struct Row {
  std::vector<ConstraintError> errors;
  Consistency displacements;
  Consistency loop_closures;
  Consistency local_maps;
  double squares_m2 = 0.0;  ///< of the errors of local maps in plan, summed
  Consistency heights;      ///< of local maps
  double heights_m2 = 0.0;  ///< their errors, squared and summed
  Consistency body;         ///< relative to home, by each MAP_CORRECTION
  double body_sd_m = 0.0;   ///< at the end, in the worst direction
  double body_error_m = 0.0;

  void add(const Row& other) {
    displacements.add(other.displacements);
    loop_closures.add(other.loop_closures);
    local_maps.add(other.local_maps);
    squares_m2 += other.squares_m2;
    heights.add(other.heights);
    heights_m2 += other.heights_m2;
    body.add(other.body);
  }
};

/// Maps a log again.
class Remapped {
 public:
  explicit Remapped(const std::filesystem::path& log)
      : log_(log), mapping_(bus_, params_of(log)), record_(bus_) {
    subscribe<scan_match_t>(bus_, channels::kScanMatch, Delivery::queued(500),
                            [this](const ScanMatch& match) {
                              if (match.status != ScanMatch::Status::kRejected)
                                odom_.push_back({match.utime, match.T_odom_body});
                            });
    subscribe<map_correction_t>(bus_, channels::kMapCorrection, Delivery::queued(100),
                                [this](const MapCorrection& correction) {
                                  if (!odom_.empty())
                                    poses_.push_back({correction, odom_.back().utime,
                                                      correction.T_map_odom * odom_.back().pose});
                                });
  }

  Row score() {
    play();
    Row row;
    const auto start = true_at(begin_of(0));
    if (!record_.graph() || !start) return row;
    const MapGraph& graph = *record_.graph();
    for (const MapConstraint& c : graph.constraints) add_constraint(c, row);
    std::map<int, std::int64_t> utimes;
    for (const auto& [id, map] : record_.local_maps()) utimes[id] = map.utime;
    if (const auto maps = score_consistency(graph, utimes, record_.truth())) {
      row.local_maps.count = maps->local_maps;
      row.local_maps.within = maps->in_ellipsoid;
      row.squares_m2 = squares_m2(graph, *start);
      row.local_maps.sum = maps->normalised_error_squared * static_cast<double>(maps->local_maps);
    }
    add_heights(graph, row);
    for (const BodyPose& pose : poses_) add_body(pose, *start, row);
    return row;
  }

 private:
  struct BodyPose {
    MapCorrection correction;
    std::int64_t utime = 0;
    Pose2 T_map_body;
  };

  static MappingNodeParams params_of(const std::filesystem::path& log) {
    MappingNodeParams params;
    params.lasers = read_log_info({log}).lasers;
    return params;
  }

  void play() {
    const MappedFile file(log_);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) {
      for (const auto channel : {channels::kLaserFront, channels::kLaserRear, channels::kScanMatch,
                                 channels::kWheelOdometry, channels::kCloud, channels::kTruth}) {
        if (event->channel == channel) bus_.inject(event->utime, event->channel, event->data);
      }
    }
  }

  [[nodiscard]] std::int64_t begin_of(int map) const {
    const auto found = record_.local_maps().find(map);
    return found == record_.local_maps().end() ? 0 : found->second.utime;
  }

  [[nodiscard]] std::optional<Pose2> true_at(std::int64_t utime) const {
    if (record_.truth().empty()) return std::nullopt;
    return interpolate(record_.truth(), std::max(utime, record_.truth().front().utime));
  }

  [[nodiscard]] double squares_m2(const MapGraph& graph, const Pose2& start) const {
    double sum = 0.0;
    for (const auto& [id, map] : record_.local_maps()) {
      const auto real = true_at(map.utime);
      if (!real || id >= static_cast<int>(graph.poses.size())) continue;
      const Pose2 estimated = between(graph.poses[0], graph.poses[static_cast<std::size_t>(id)]);
      sum += (estimated.translation() - between(start, *real).translation()).squaredNorm();
    }
    return sum;
  }

  /// Above the first local map.
  void add_heights(const MapGraph& graph, Row& row) const {
    if (record_.truth().empty()) return;
    const std::int64_t first = record_.truth().front().utime;
    const auto start = interpolate_in_space(record_.truth(), std::max(begin_of(0), first));
    for (const auto& [id, map] : record_.local_maps()) {
      const auto i = static_cast<std::size_t>(id);
      const auto real = interpolate_in_space(record_.truth(), map.utime);
      if (id == 0 || !start || !real || i >= graph.z_m.size()) continue;
      const double error_m = graph.z_m[i] - graph.z_m[0] - (real->z_m - start->z_m);
      row.heights_m2 += error_m * error_m;
      row.heights.add(error_m * error_m / graph.z_variance[i], kChiSquare1);
    }
  }

  void add_constraint(const MapConstraint& c, Row& row) const {
    const auto from = true_at(begin_of(c.measured.from));
    const auto to = true_at(begin_of(c.measured.to));
    if (!from || !to) return;
    const Eigen::Vector3d error = between(c.measured.T_from_to, between(*from, *to)).vector();
    const double squared = error.dot(c.measured.information * error);
    const bool sequential = c.kind == MapConstraint::Kind::kSequential;
    (sequential ? row.displacements : row.loop_closures).add(squared, kChiSquare3);
    row.errors.push_back({c, begin_of(c.measured.to) - begin_of(0), error, squared});
  }

  void add_body(const BodyPose& pose, const Pose2& start, Row& row) const {
    const auto real = true_at(pose.utime);
    if (!real || !pose.correction.body_covariance.allFinite()) return;
    const Pose2 T_estimated_real = between(pose.T_map_body, between(start, *real));
    const Eigen::Vector2d error = T_estimated_real.translation();
    const Eigen::Matrix2d covariance = pose.correction.body_covariance.topLeftCorner<2, 2>();
    row.body.add(error.dot(covariance.ldlt().solve(error)), kChiSquare2);
    row.body_sd_m = position_sd_m(pose.correction.body_covariance);
    row.body_error_m = error.norm();
  }

  std::filesystem::path log_;
  MemoryBus bus_;
  MappingNode mapping_;
  MapRecord record_;
  Trajectory odom_;
  std::vector<BodyPose> poses_;
};

void print_row(const std::string& name, const Row& row, const std::string& end) {
  std::cout << "| " << name << " | " << row.displacements.text() << " | "
            << row.loop_closures.text() << " | " << row.local_maps.text()
            << format(" | %.3f | ",
                      std::sqrt(row.squares_m2 / std::max<std::size_t>(1, row.local_maps.count)))
            << row.heights.text()
            << format(" | %.3f | ",
                      std::sqrt(row.heights_m2 / std::max<std::size_t>(1, row.heights.count)))
            << row.body.text() << " | " << end << " |\n"
            << std::flush;
}

void print_errors(const std::vector<ConstraintError>& errors) {
  std::puts(
      "\n| constraint | from | to | at (s) | displacement (m, m, mrad) | error (mm, mm, mrad) | "
      "stated deviation (mm, mm, mrad) | normalised error squared (3) |\n"
      "|---|---|---|---|---|---|---|---|");
  for (const ConstraintError& e : errors) {
    const auto& measured = e.constraint.measured;
    const Eigen::Vector3d sd =
        1e3 * Eigen::Matrix3d(measured.information.inverse()).diagonal().cwiseSqrt();
    const Pose2& T = measured.T_from_to;
    const bool sequential = e.constraint.kind == MapConstraint::Kind::kSequential;
    std::printf(
        "| %s | %d | %d | %.1f | %.2f, %.2f, %.0f | %.1f, %.1f, %.1f | %.1f, %.1f, %.1f | %.1f |\n",
        sequential ? "displacement" : "loop closure", measured.from, measured.to,
        1e-6 * static_cast<double>(e.utime), T.x, T.y, 1e3 * T.theta, 1e3 * e.error.x(),
        1e3 * e.error.y(), 1e3 * e.error.z(), sd.x(), sd.y(), sd.z(), e.squared);
  }
}

void print_table(const std::vector<std::filesystem::path>& logs, bool each) {
  print_heading(
      "| mission | displacements: number, in 95 % ellipsoid, mean normalised error squared (3) | "
      "loop closures (3) | local maps (3) | their RMSE in plan (m) | heights (1) | their RMSE (m) "
      "| body relative to home (2) | at the "
      "end: 95 %, error "
      "(m) |");
  Row sum;
  std::vector<ConstraintError> errors;
  for (const std::filesystem::path& log : logs) {
    const Row row = Remapped(log).score();
    print_row(log.parent_path().filename().string(), row,
              format("%.2f, %.2f", std::sqrt(kChiSquare2) * row.body_sd_m, row.body_error_m));
    sum.add(row);
    if (each) errors.insert(errors.end(), row.errors.begin(), row.errors.end());
  }
  print_row("all", sum, "");
  if (each) print_errors(errors);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares the errors of maps with their covariances, as a table in Markdown");
  std::vector<std::filesystem::path> logs;
  app.add_option("LOGS", logs, "Logs of simulated missions")->required();
  bool each = false;
  app.add_flag("--each", each, "Print each displacement and loop closure too");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(logs, each);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "map_consistency_table: " << error.what() << "\n";
  return 2;
}
