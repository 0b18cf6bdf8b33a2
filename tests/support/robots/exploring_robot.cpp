// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robots/exploring_robot.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace adit::test {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr double kSpeed = 0.3;
constexpr double kLaserRangeM = 30.0;
constexpr double kRangeSdM = 0.008;
constexpr double kScanSpacingM = 1.25;    // distance travelled between scans
constexpr double kStrideM = 0.2;          // step of the robot
constexpr double kMapM = 5.0;             // distance travelled per local map
constexpr double kViewM = 10.0;           // range of the planner
constexpr double kMinPathM = 2.5;         // shorter paths count as blocked (paper, section 3.3)
constexpr double kMinProgressM = 1.0;     // with more, the target is scanned again before a verdict
constexpr double kOnwardM = 6.0;          // route beyond a frontier, straight ahead
constexpr double kBeyondFrontierM = 1.5;  // distance beyond a frontier at which access is checked
constexpr double kAlignedM = 30.0;        // length scale of the map distortion

/// A planned path around an obstacle that rejoins the route as far ahead as possible.
struct Detour {
  std::vector<Eigen::Vector2d> cells;  // p_world; empty if there is no path of kMinPathM
  std::size_t skipped = 0;             // points of the route up to the rejoined one
};

/// Flood fill of reachable places within kViewM of a position.
class LocalFlood {
 public:
  LocalFlood(const PlanarMine& mine, const Eigen::Vector2d& from) : origin_(from) {
    queue_ = {{0, 0}};
    before_[{0, 0}] = {0, 0};
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const auto [x, y] = queue_[k];
      for (const auto& [dx, dy] : kSteps) {
        const Cell next{x + dx, y + dy};
        if (std::hypot(next.first, next.second) * kStrideM > kViewM) continue;
        if (before_.count(next) > 0 || !mine.reachable(place(next))) continue;
        before_[next] = queue_[k];
        queue_.push_back(next);
      }
    }
  }

  /// Empty if the place is not reached.
  [[nodiscard]] std::vector<Eigen::Vector2d> path_to(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d off = (p - origin_) / kStrideM;
    Cell cell{static_cast<int>(std::lround(off.x())), static_cast<int>(std::lround(off.y()))};
    std::vector<Eigen::Vector2d> path;
    if (before_.count(cell) == 0) return path;
    for (; cell != Cell{0, 0}; cell = before_.at(cell)) path.push_back(place(cell));
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  using Cell = std::pair<int, int>;
  static constexpr std::array<Cell, 8> kSteps{
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

  [[nodiscard]] Eigen::Vector2d place(const Cell& cell) const {
    return origin_ + kStrideM * Eigen::Vector2d(cell.first, cell.second);
  }

  Eigen::Vector2d origin_;
  std::vector<Cell> queue_;
  std::map<Cell, Cell> before_;
};

Detour find_detour(const PlanarMine& mine, const Eigen::Vector2d& from,
                   const std::vector<Eigen::Vector2d>& route) {
  const LocalFlood flood(mine, from);
  for (std::size_t i = route.size(); i-- > 0;) {
    const bool far = (route[i] - from).norm() >= kMinPathM || i + 1 == route.size();
    if (!far || (route[i] - from).norm() > kViewM) continue;
    Detour detour{flood.path_to(route[i]), i + 1};
    if (!detour.cells.empty()) return detour;
  }
  return {};
}

}  // namespace

ExploringRobot::ExploringRobot(const PlanarMine& mine, double distortion_m, std::uint64_t seed)
    : mine_(&mine),
      distortion_m_(distortion_m),
      random_(seed),
      noise_m_(0.0, kRangeSdM),
      T_world_body_(mine.T_world_start),
      covered_(mine.corridor.size()) {
  start_map();
  scan();
  maps_.push_back(map_);
}

void ExploringRobot::start_map() {
  map_ = {};
  map_.id = static_cast<int>(maps_.size());
  map_.utime = utime();
  map_.T_odom_local = between(mine_->T_world_start, T_world_body_);
  T_world_local_ = T_world_body_;
  T_world_locals_.push_back(T_world_body_);
}

std::int64_t ExploringRobot::utime() const {
  return kStart + static_cast<std::int64_t>(1e6 * distance_travelled_m_ / kSpeed);
}

/// A scan with noise, in steps of a centimetre, that ends at 30 m, so that tunnels are discovered
/// step by step.
LaserScan ExploringRobot::measure(const Pose2& T_world_laser) {
  LaserScan scan = exact_scan(mine_->walls, T_world_laser, utime(), kLaserRangeM);
  for (float& range_m : scan.ranges_m) {
    const double noise_m = noise_m_(random_);  // drawn for each beam
    if (range_m > kLaserRangeM) continue;
    range_m = static_cast<float>(0.01 * std::round(100.0 * std::max(0.0, range_m + noise_m)));
  }
  return scan;
}

void ExploringRobot::scan() {
  since_scan_m_ = 0.0;
  traversed_path_.push_back(T_world_body_.translation());
  map_.end_utime = utime();
  const Pose2 T_local_body = between(T_world_local_, T_world_body_);
  const Lasers lasers;
  for (const auto& [channel, mount] :
       {std::pair("LASER_FRONT", lasers.front), std::pair("LASER_REAR", lasers.rear)}) {
    map_.scans.push_back({channel, measure(T_world_body_ * mount.T_body_laser), T_local_body});
  }
  update_coverage();
}

void ExploringRobot::update_coverage() {
  for (std::size_t i = 0; i < covered_.size(); ++i) {
    const Eigen::Vector2d ray = mine_->corridor[i] - T_world_body_.translation();
    if (covered_[i] || ray.norm() > kCoverageRangeM) continue;
    if (mine_->walls.cast(T_world_body_.translation(), std::atan2(ray.y(), ray.x()), ray.norm())) {
      continue;
    }
    covered_[i] = true;
    ++n_covered_;
  }
}

double ExploringRobot::drive(const std::vector<Eigen::Vector2d>& route_map, double distance_m) {
  blocked_ = false;
  start_map();
  scan();
  const Pose2 T_world_map = T_world_body_ * T_map_body().inverse();
  std::vector<Eigen::Vector2d> route;
  for (const Eigen::Vector2d& p_map : route_map) route.push_back(T_world_map * p_map);
  double driven_m = 0.0;
  for (std::size_t i = 0; i < route.size() && driven_m < distance_m && !blocked_;) {
    if (drive_to(route[i], distance_m, driven_m)) {
      ++i;
      continue;
    }
    const std::vector<Eigen::Vector2d> rest(route.begin() + static_cast<std::ptrdiff_t>(i),
                                            route.end());
    const Detour detour = find_detour(*mine_, T_world_body_.translation(), rest);
    blocked_ = detour.cells.empty();
    for (const Eigen::Vector2d& p : detour.cells) {
      if (!drive_to(p, distance_m, driven_m)) break;
    }
    i += detour.skipped;
  }
  scan();
  maps_.push_back(map_);
  return driven_m;
}

/// False if an obstacle stops the robot; true if it reaches the target or the distance limit.
bool ExploringRobot::drive_to(const Eigen::Vector2d& target, double distance_m, double& driven_m) {
  while (driven_m < distance_m) {
    const Eigen::Vector2d off = target - T_world_body_.translation();
    const double stride = std::min({kStrideM, off.norm(), distance_m - driven_m});
    if (off.norm() < 1e-6) return true;
    const Eigen::Vector2d next = T_world_body_.translation() + stride * off.normalized();
    if (!mine_->reachable(next)) return false;
    T_world_body_ = {next.x(), next.y(), std::atan2(off.y(), off.x())};
    driven_m += stride;
    distance_travelled_m_ += stride;
    since_scan_m_ += stride;
    if (since_scan_m_ >= kScanSpacingM) scan();
  }
  return true;
}

/// All local maps of one graph share the same distortion.
Pose2 ExploringRobot::distorted(const Pose2& T_world) const {
  const Pose2 T_map = between(mine_->T_world_start, T_world);
  const double phase = static_cast<double>(maps_.size());
  const auto wave = [&](double along) {
    return distortion_m_ * (std::sin(along / kAlignedM + phase) - std::sin(phase));
  };
  return {T_map.x + wave(T_map.y), T_map.y + wave(T_map.x), T_map.theta};
}

MapGraph ExploringRobot::graph() const {
  MapGraph graph;
  graph.utime = maps_.back().end_utime;
  graph.revision = static_cast<std::int64_t>(maps_.size());
  for (const Pose2& T_world_local : T_world_locals_)
    graph.poses.push_back(distorted(T_world_local));
  return graph;
}

Pose2 ExploringRobot::T_map_body() const {
  return distorted(T_world_local_) * between(T_world_local_, T_world_body_);
}

Eigen::Vector2d ExploringRobot::to_map(const Eigen::Vector2d& p_world) const {
  return distorted({p_world.x(), p_world.y(), 0.0}).translation();
}

double ExploringRobot::missed_m() const {
  double missed = 0.0;
  for (std::size_t i = 0; i < covered_.size(); ++i) {
    bool near = false;
    for (std::size_t k = 0; k < covered_.size() && !near; ++k) {
      near = covered_[k] && (mine_->corridor[k] - mine_->corridor[i]).norm() <= kMissedM;
    }
    if (!near) missed += PlanarMine::kSpacingM;
  }
  return missed;
}

double ExploringRobot::covered_share() const {
  return covered_.empty() ? 0.0
                          : static_cast<double>(n_covered_) / static_cast<double>(covered_.size());
}

namespace {

/// Number of blocked frontiers beyond which the vehicle can stand.
int count_wrong_blocked(const PlanarMine& mine, const std::vector<Frontier>& frontiers) {
  return static_cast<int>(
      std::count_if(frontiers.begin(), frontiers.end(), [&](const Frontier& frontier) {
        const Eigen::Vector2d beyond = frontier.p_map + kBeyondFrontierM * frontier.direction_map;
        return frontier.state == FrontierState::kBlocked &&
               mine.reachable(mine.T_world_start * beyond);
      }));
}

class Run {
 public:
  Run(const PlanarMine& mine, Exploration& exploration, double budget_m, double distortion_m,
      std::uint64_t seed)
      : mine_(mine),
        exploration_(exploration),
        budget_m_(budget_m),
        robot_(mine, distortion_m, seed) {}

  ExplorationRun run() {
    take_map();
    while (robot_.distance_travelled_m() < budget_m_ && step()) note_share();
    while (run_.covered_share.size() < 4) run_.covered_share.push_back(robot_.covered_share());
    run_.missed_m = robot_.missed_m();
    for (const auto& p_world : robot_.traversed_path())
      run_.path_map.push_back(robot_.to_map(p_world));
    run_.distance_travelled_m = robot_.distance_travelled_m();
    run_.distance_from_start_m =
        (robot_.T_world_body().translation() - mine_.T_world_start.translation()).norm();
    run_.returned = run_.distance_from_start_m <= 0.5 && run_.distance_travelled_m <= budget_m_;
    run_.complete = exploration_.incomplete_reasons().empty();
    run_.frontiers = static_cast<int>(exploration_.frontiers().size());
    run_.falsely_blocked = count_wrong_blocked(mine_, exploration_.frontiers());
    return run_;
  }

 private:
  void take_map() {
    exploration_.add(robot_.last_map());
    exploration_.update(robot_.graph());
  }

  void note_share() {
    const double share = robot_.distance_travelled_m() / budget_m_;
    while (run_.covered_share.size() < 4 &&
           share >= 0.25 * static_cast<double>(run_.covered_share.size() + 1)) {
      run_.covered_share.push_back(robot_.covered_share());
    }
  }

  /// False at the end of the exploration.
  bool step() {
    const int target = exploration_.report().decision.frontier;
    const auto before = std::chrono::steady_clock::now();
    take_map();
    const ExplorationDecision decision = exploration_.decide(
        {robot_.utime(), robot_.T_map_body(), budget_m_ - robot_.distance_travelled_m(), 0.0});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
    run_.longest_decision_s = std::max(run_.longest_decision_s, took.count());
    ++run_.decisions;
    count_turn(target, decision.frontier);
    using Kind = ExplorationDecision::Kind;
    if (decision.kind == Kind::kDone || decision.kind == Kind::kStay) return false;
    const double driven_m = robot_.drive(route_of(decision), kMapM);
    if (robot_.stopped() && driven_m < kMinProgressM) {
      ++run_.blocked;
      take_map();
      exploration_.decide(
          {robot_.utime(), robot_.T_map_body(), budget_m_ - robot_.distance_travelled_m(), 0.0});
      const int frontier = exploration_.report().decision.frontier;
      exploration_.report_blocked(frontier, {robot_.utime(), 0.0, "the planner found no path"});
    }
    return ++idle_ < 20 || robot_.distance_travelled_m() > idle_from_m_ + 1.0 ? note_progress()
                                                                              : false;
  }

  bool note_progress() {
    if (robot_.distance_travelled_m() > idle_from_m_ + 1.0) {
      idle_from_m_ = robot_.distance_travelled_m();
      idle_ = 0;
    }
    return true;
  }

  [[nodiscard]] std::vector<Eigen::Vector2d> route_of(const ExplorationDecision& decision) const {
    std::vector<Eigen::Vector2d> route = exploration_.route();
    if (decision.kind == ExplorationDecision::Kind::kHome) {
      route.emplace_back(decision.T_map_goal.translation());
      return route;
    }
    if (decision.frontier == ExplorationDecision::kNoFrontier) return route;  // on patrol
    const Frontier frontier = exploration_.frontiers()[static_cast<std::size_t>(decision.frontier)];
    for (double on = kStrideM; on <= kOnwardM; on += kStrideM) {
      route.emplace_back(frontier.p_map + on * frontier.direction_map);
    }
    return route;
  }

  void count_turn(int before, int now) {
    if (before < 0 || now < 0 || before == now) return;
    const Frontier frontier = exploration_.frontiers()[static_cast<std::size_t>(before)];
    if (frontier.state == FrontierState::kOpen) ++run_.turns;
  }

  const PlanarMine& mine_;
  Exploration& exploration_;
  double budget_m_;
  ExploringRobot robot_;
  ExplorationRun run_;
  double idle_from_m_ = 0.0;
  int idle_ = 0;
};

}  // namespace

ExplorationRun run_exploration(const PlanarMine& mine, Exploration& exploration, double budget_m,
                               double distortion_m, std::uint64_t seed) {
  return Run(mine, exploration, budget_m, distortion_m, seed).run();
}

}  // namespace adit::test
