// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// cloud_matching_table LOGS..: matches the recorded 3D scans of missions with each other, as
// mapping does, and compares the displacements with the ground truth of the simulator, as a table
// in Markdown.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "procs/mapping/loop_closure/cloud_matching.hpp"
#include "tests/eval/markdown.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

constexpr double kMoved = 0.5;         // [m] between two 3D scans that count
constexpr double kConstrainedM = 0.1;  // standard deviation along the displacement
constexpr double kWrongM = 0.1;        // error along the displacement

/// Of pairs of 3D scans within a range of distances.
struct Errors {
  double distance_max_m = 0.0;
  int pairs = 0;
  int constrained = 0;  ///< along the displacement
  int wrong = 0;        ///< of these, by more than kWrongM
  double prior_m2 = 0.0;
  double along_m2 = 0.0;
  double across_m2 = 0.0;
  double turn_rad2 = 0.0;
  double normalised = 0.0;  ///< squares of the errors along, by their variances
  double largest_m = 0.0;
  int within = 0;  ///< within 1.96 standard deviations
  int rises = 0;   ///< matches, constrained along the displacement or not
  double prior_rise_m2 = 0.0;
  double rise_m2 = 0.0;
  double rise_normalised = 0.0;

  void add(const Errors& other) {
    pairs += other.pairs;
    constrained += other.constrained;
    wrong += other.wrong;
    prior_m2 += other.prior_m2;
    along_m2 += other.along_m2;
    across_m2 += other.across_m2;
    turn_rad2 += other.turn_rad2;
    normalised += other.normalised;
    largest_m = std::max(largest_m, other.largest_m);
    within += other.within;
    rises += other.rises;
    prior_rise_m2 += other.prior_rise_m2;
    rise_m2 += other.rise_m2;
    rise_normalised += other.rise_normalised;
  }

  [[nodiscard]] std::string text() const {
    const double n = std::max(1, constrained);
    const double z = std::max(1, rises);
    return format(
        "%d | %d | %.3f | %.3f | %.3f | %.2f | %.3f; %d | %.0f %%; %.1f | %.4f | %.4f; %.1f", pairs,
        constrained, std::sqrt(prior_m2 / n), std::sqrt(along_m2 / n), std::sqrt(across_m2 / n),
        1e3 * std::sqrt(turn_rad2 / n), largest_m, wrong, 100.0 * within / n, normalised / n,
        std::sqrt(prior_rise_m2 / z), std::sqrt(rise_m2 / z), rise_normalised / z);
  }
};

using Table = std::array<Errors, 4>;

Table empty_table() {
  Table table;
  table[0].distance_max_m = 3.0;
  table[1].distance_max_m = 6.0;
  table[2].distance_max_m = 9.0;
  table[3].distance_max_m = 12.0;
  return table;
}

/// The 3D scans of a log, each matched when it ends.
class Matched {
 public:
  explicit Matched(const std::filesystem::path& log) : log_(log), matching_(CloudMatchingParams{}) {
    subscribe<pose_t>(bus_, channels::kTruth, Delivery::queued(500), [this](const StampedPose& p) {
      truth_.push_back({p.utime, p.T_odom_body, p.z_m});
    });
    subscribe<cloud_t>(bus_, channels::kCloud, Delivery::queued(CloudFragment::kFragmentsMax),
                       [this](const CloudFragment& fragment) {
                         if (auto cloud = reassembler_.add(fragment)) add(*cloud);
                       });
  }

  Table score(bool print_pairs) {
    const MappedFile file(log_);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) {
      if (event->channel == channels::kCloud || event->channel == channels::kTruth)
        bus_.inject(event->utime, event->channel, event->data);
    }
    Table table = empty_table();
    for (std::size_t newer = 0; newer < places_.size(); ++newer) {
      const auto matches = matching_.matches(static_cast<int>(newer), [this](int i) {
        const Place& place = places_[static_cast<std::size_t>(i)];
        return PlacedLocalMap{place.T_odom_level, place.z_m};
      });
      count_pairs(newer, table);
      for (const MatchedClouds& matched : matches) {
        add(matched.loop_closure, print_pairs, table);
        add_rise(matched.match);
      }
    }
    add_rises(table);
    return table;
  }

 private:
  struct Place {
    std::int64_t utime = 0;
    Pose2 T_odom_level;
    double z_m = 0.0;
  };

  void add(const Cloud& cloud) {
    matching_.add(cloud, 0, {cloud.utime, static_cast<int>(places_.size()), 0.0, 0.0}, Pose2{});
    places_.push_back({cloud.utime, cloud.T_odom_level, cloud.z_odom_m});
  }

  [[nodiscard]] std::optional<Pose2> true_displacement(std::size_t older, std::size_t newer) const {
    const auto from = interpolate(truth_, places_[older].utime);
    const auto to = interpolate(truth_, places_[newer].utime);
    if (!from || !to) return std::nullopt;
    return between(*from, *to);
  }

  static Errors* row_of(double distance_m, Table& table) {
    if (distance_m < kMoved) return nullptr;
    const auto row = std::ranges::find_if(
        table, [&](const Errors& errors) { return distance_m <= errors.distance_max_m; });
    return row == table.end() ? nullptr : &*row;
  }

  /// Of the nearest ones, which are those that are matched.
  void count_pairs(std::size_t newer, Table& table) const {
    std::vector<double> distances;
    for (std::size_t older = 0; older < newer; ++older) {
      const double distance_m =
          between(places_[older].T_odom_level, places_[newer].T_odom_level).translation().norm();
      if (distance_m <= CloudMatchingParams{}.distance_max_m) distances.push_back(distance_m);
    }
    std::ranges::sort(distances);
    distances.resize(std::min<std::size_t>(distances.size(), CloudMatchingParams{}.matched_max));
    for (const double distance_m : distances) {
      if (Errors* const row = row_of(distance_m, table)) ++row->pairs;
    }
  }

  void add_rise(const CloudMatch& match) {
    const Place& older = places_[static_cast<std::size_t>(match.older.map)];
    const Place& newer = places_[static_cast<std::size_t>(match.newer.map)];
    const auto from = interpolate_in_space(truth_, older.utime);
    const auto to = interpolate_in_space(truth_, newer.utime);
    if (!from || !to) return;
    const double rise_m = to->z_m - from->z_m;
    rises_.push_back(
        {match.lever_m, newer.z_m - older.z_m - rise_m, match.rise_m - rise_m, match.rise_sd_m});
  }

  /// Without the constant error of the attitude, which inclines the rises of a mission alike, in
  /// the prior and in the matches.
  void add_rises(Table& table) const {
    Eigen::Matrix2d squares = 1e-6 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d of_prior = Eigen::Vector2d::Zero();
    Eigen::Vector2d of_match = Eigen::Vector2d::Zero();
    for (const Rise& rise : rises_) {
      squares += rise.lever_m * rise.lever_m.transpose();
      of_prior += rise.lever_m * rise.prior_error_m;
      of_match += rise.lever_m * rise.error_m;
    }
    const Eigen::Matrix2d inverse = squares.inverse();
    for (const Rise& rise : rises_) {
      Errors* const row = row_of(rise.lever_m.norm(), table);
      if (row == nullptr) continue;
      const double prior_m = rise.prior_error_m - rise.lever_m.dot(inverse * of_prior);
      const double match_m = rise.error_m - rise.lever_m.dot(inverse * of_match);
      ++row->rises;
      row->prior_rise_m2 += prior_m * prior_m;
      row->rise_m2 += match_m * match_m;
      row->rise_normalised += match_m * match_m / (rise.sd_m * rise.sd_m);
    }
  }

  void add(const LoopClosure& match, bool print_pairs, Table& table) const {
    const LoopClosureAlternative& found = match.alternatives.front();
    const auto older = static_cast<std::size_t>(found.older_map);
    const auto newer = static_cast<std::size_t>(match.newer_map);
    const auto truth = true_displacement(older, newer);
    const Pose2 prior = between(places_[older].T_odom_level, places_[newer].T_odom_level);
    Errors* const row = row_of(prior.translation().norm(), table);
    if (!truth || row == nullptr) return;
    const Eigen::Vector2d along = truth->translation().normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(found.T_older_newer.theta).toRotationMatrix();
    const Eigen::Matrix3d covariance = found.information.inverse();
    const double variance = along.dot(R * covariance.topLeftCorner<2, 2>() * R.transpose() * along);
    if (variance > kConstrainedM * kConstrainedM) return;
    const Eigen::Vector2d error = found.T_older_newer.translation() - truth->translation();
    const double before_m = along.dot(prior.translation() - truth->translation());
    const double along_m = along.dot(error);
    const double across_m = across.dot(error);
    const double turn_rad = between(*truth, found.T_older_newer).theta;
    ++row->constrained;
    row->wrong += std::abs(along_m) > kWrongM ? 1 : 0;
    row->prior_m2 += before_m * before_m;
    row->along_m2 += along_m * along_m;
    row->across_m2 += across_m * across_m;
    row->turn_rad2 += turn_rad * turn_rad;
    row->normalised += along_m * along_m / variance;
    row->largest_m = std::max(row->largest_m, std::abs(along_m));
    row->within += along_m * along_m <= 1.96 * 1.96 * variance ? 1 : 0;
    if (!print_pairs) return;
    std::cerr << format(
        "%s: 3D scans %zu and %zu, %.1f m: %.3f m before, %.3f +- %.3f m, %.4f rad\n",
        log_.parent_path().filename().c_str(), older, newer, truth->translation().norm(), before_m,
        along_m, std::sqrt(variance), turn_rad);
  }

  std::filesystem::path log_;
  MemoryBus bus_;
  CloudMatching matching_;
  CloudReassembler reassembler_;
  std::vector<Place> places_;
  struct Rise {
    Eigen::Vector2d lever_m;
    double prior_error_m;
    double error_m;
    double sd_m;
  };
  std::vector<Rise> rises_;
  Trajectory truth_;
};

void print_table(const std::vector<std::filesystem::path>& logs, bool print_pairs) {
  Table sum = empty_table();
  const auto start = std::chrono::steady_clock::now();
  for (const std::filesystem::path& log : logs) {
    const Table table = Matched(log).score(print_pairs);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i].add(table[i]);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  print_heading(
      "| 3D scans apart (m) | pairs | constrained along | prior, RMSE along (m) | match, RMSE "
      "along (m) | across (m) | turn (mrad) | largest along (m); above 0.1 m | in 95 %; error "
      "squared (1) | rise without constant tilt, prior, RMSE (m) | match, RMSE (m); error squared "
      "(1) |");
  double from_m = kMoved;
  for (const Errors& errors : sum) {
    std::cout << "| " << format("%.1f to %.1f", from_m, errors.distance_max_m) << " | "
              << errors.text() << " |\n";
    from_m = errors.distance_max_m;
  }
  std::cerr << format("%zu missions, %.1f s\n", logs.size(), taken.count());
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares matches of 3D scans with the truth, as a table in Markdown");
  std::vector<std::filesystem::path> logs;
  app.add_option("LOGS", logs, "Logs of simulated missions")->required();
  bool print_pairs = false;
  app.add_flag("--pairs", print_pairs, "Print each match that constrains the displacement");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(logs, print_pairs);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "cloud_matching_table: " << error.what() << "\n";
  return 2;
}
