// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/blind_side_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr double kCellM = 0.1;
constexpr double kReachM = 8.0;  // of the cells around the vehicle, to each side
constexpr double kMoveCellsM = 1.0;
constexpr double kDrivenM = 60.0;  // path length, after which driven ground is forgotten
constexpr double kCorrectionMaxM = 0.3;
constexpr double kDoubtMaxM = 1.5;         // a larger correction is not used at all
constexpr double kSameViewM = 0.5;         // between the poses of two scans that are compared
constexpr double kViewToleranceM = 0.15;   // of a range
constexpr std::size_t kViewBearings = 40;  // that two scans have in common
constexpr double kAgrees = 0.7;            // share of these
constexpr double kContradicts = 0.4;
constexpr double kRangeM = 5.0;     // of a beam that counts
constexpr double kShortOfM = 0.05;  // before the obstacle that a beam hit
constexpr double kJumpM = 0.5;      // maximum step between poses
constexpr double kMovedM = 0.05;    // between two scans, or two places, that are added
constexpr double kTurnedRad = 0.05;
constexpr double kStoredM = 0.5;  // between two scans that are stored
constexpr double kStoredRad = 0.25;
constexpr std::size_t kBearings = 360;  // 0.09 m apart at kRangeM
constexpr double kSampleM = 0.05;       // along the motion and along the edge of the footprint
constexpr double kInsideM = 0.02;  // the edge of the footprint that must be known lies inside it

Eigen::Vector2i cell_of(const Eigen::Vector2d& p_odom) {
  const auto index = [](double value) {
    return static_cast<int>(std::floor(std::clamp(value / kCellM, -1e9, 1e9)));
  };
  return {index(p_odom.x()), index(p_odom.y())};
}

CellBox cells_around(const Eigen::Vector2d& p_odom) {
  const Eigen::Vector2i reach = Eigen::Vector2i::Constant(static_cast<int>(kReachM / kCellM));
  const Eigen::Vector2i centre = cell_of(p_odom);
  return {centre - reach, centre + reach + Eigen::Vector2i::Ones()};
}

bool is_apart(const Pose2& a, const Pose2& b, double by_m, double by_rad) {
  const Pose2 step = between(a, b);
  return step.translation().norm() > by_m || std::abs(step.theta) > by_rad;
}

bool has_moved(const std::optional<Pose2>& from, const Pose2& to, double by_m = kMovedM,
               double by_rad = kTurnedRad) {
  return !from || is_apart(*from, to, by_m, by_rad);
}

/// The bearing of a line in the body frame, of kBearings.
std::size_t bearing_of(const Eigen::Vector2d& line) {
  const double turn = std::atan2(line.y(), line.x()) / (2.0 * std::numbers::pi) + 0.5;
  return static_cast<std::size_t>(turn * static_cast<double>(kBearings)) % kBearings;
}

Eigen::Vector2d direction_of_bearing(std::size_t bearing) {
  const double angle =
      2.0 * std::numbers::pi * ((static_cast<double>(bearing) + 0.5) / kBearings - 0.5);
  return {std::cos(angle), std::sin(angle)};
}

/// Points of the footprint, closer than the cells, and along its outline.
std::vector<Eigen::Vector2d> points_all_over(const ConvexPolygon& outline) {
  std::vector<Eigen::Vector2d> points = outline.boundary(kSampleM);
  const Eigen::Vector2d size = outline.high() - outline.low();
  const auto steps = [](double length_m) {
    return static_cast<int>(std::ceil(length_m / kSampleM));
  };
  for (int i = 0; i <= steps(size.x()); ++i) {
    for (int j = 0; j <= steps(size.y()); ++j) {
      const Eigen::Vector2d p = outline.low() + size.cwiseProduct(Eigen::Vector2d(
                                                    static_cast<double>(i) / steps(size.x()),
                                                    static_cast<double>(j) / steps(size.y())));
      if (outline.contains(p)) points.push_back(p);
    }
  }
  return points;
}

}  // namespace

BlindSideMemory::BlindSideMemory(const Vehicle& vehicle, const LaserMount& laser)
    : outline_(body_outline(vehicle)),
      edge_(outline_.grown(-kInsideM).boundary(kSampleM)),
      footprint_(points_all_over(outline_)),
      laser_(laser) {}

void BlindSideMemory::move_to(const Pose2& T_odom_body) {
  if (T_odom_body_ && between(*T_odom_body_, T_odom_body).translation().norm() > kJumpM) {
    known_ = {};
    places_.clear();
    doubted_.clear();
    T_odom_observed_.reset();
    T_odom_stored_.reset();
  }
  T_odom_body_ = T_odom_body;
  const Eigen::Vector2i centre = known_.box().from + known_.box().size() / 2;
  const Eigen::Vector2d p_odom_centre = kCellM * centre.cast<double>();
  if (known_.size() == 0 || (T_odom_body.translation() - p_odom_centre).norm() > kMoveCellsM)
    move_cells();
  if (places_.empty() || has_moved(places_.back().T_odom_body, T_odom_body)) add_place();
}

/// A new session is a new odom frame: the correction says nothing about its poses before.
void BlindSideMemory::correct(const MapCorrection& correction) {
  if (!T_odom_body_) return;
  const std::optional<MapCorrection> before = std::exchange(correction_, correction);
  corrected_at_m_ = odometer_m_;
  if (!before || before->T_map_odom == correction.T_map_odom) return;
  const Pose2 T_after_before = between(correction.T_map_odom, before->T_map_odom);
  const double moved_m = correction.session == before->session
                             ? moved_at_m(T_after_before, T_odom_body_->translation())
                             : std::numeric_limits<double>::infinity();
  const auto recent =
      std::ranges::lower_bound(places_, odometer_m_ - kKeepsPlaceInOdomM, {}, &Place::driven_at_m);
  for (auto place = places_.begin(); place != recent; ++place)
    place->T_odom_body = T_after_before * place->T_odom_body;
  for (Place& place : doubted_) place.T_odom_body = T_after_before * place.T_odom_body;
  if (moved_m > kCorrectionMaxM) doubt_places_before(recent);
  if (moved_m > kDoubtMaxM) doubted_.clear();
  mark_all_near();
  T_odom_observed_.reset();  // the next scan counts, though the vehicle stands
}

void BlindSideMemory::doubt_places_before(const Places::iterator& recent) {
  doubted_.insert(doubted_.end(), places_.begin(), recent);
  places_.erase(places_.begin(), recent);
}

/// Compares the scan with the one that was stored nearest.
void BlindSideMemory::settle_doubts(const std::vector<float>& free_m) {
  const auto distance_m = [&](const Place& place) {
    return place.free_m.empty() ? std::numeric_limits<double>::infinity()
                                : between(place.T_odom_body, *T_odom_body_).translation().norm();
  };
  const auto nearest = std::ranges::min_element(doubted_, {}, distance_m);
  if (nearest == doubted_.end() || distance_m(*nearest) > kSameViewM) return;
  const auto share = agreement(*nearest, free_m);
  if (!share) return;
  if (*share >= kAgrees) {
    places_.insert(places_.begin(), doubted_.begin(), doubted_.end());
    doubted_.clear();
    mark_all_near();
  } else if (*share <= kContradicts) {
    doubted_.clear();
  }
}

/// Share of the ranges of a stored scan that the present one confirms, seen from where the vehicle
/// is; nothing if it sees too few of them.
std::optional<double> BlindSideMemory::agreement(const Place& place,
                                                 const std::vector<float>& free_m) const {
  const Pose2 T_now_then = between(*T_odom_body_, place.T_odom_body);
  const Eigen::Vector2d p_body_laser = laser_.T_body_laser.translation();
  std::size_t compared = 0;
  std::size_t confirmed = 0;
  for (std::size_t i = 0; i < place.free_m.size(); ++i) {
    if (place.free_m[i] <= 0.0F || place.free_m[i] >= kRangeM - kShortOfM) continue;
    const Eigen::Vector2d p_then = p_body_laser + place.free_m[i] * direction_of_bearing(i);
    const Eigen::Vector2d line = T_now_then * p_then - p_body_laser;
    const double seen_m = free_m[bearing_of(line)];
    if (seen_m <= 0.0) continue;
    ++compared;
    confirmed += std::abs(line.norm() - seen_m) <= kViewToleranceM ? 1 : 0;
  }
  if (compared < kViewBearings) return std::nullopt;
  return static_cast<double>(confirmed) / static_cast<double>(compared);
}

void BlindSideMemory::observe(const LaserPoints& points) {
  if (!T_odom_body_ || !has_moved(T_odom_observed_, *T_odom_body_)) return;
  T_odom_observed_ = T_odom_body_;
  const Eigen::Vector2d p_odom_laser = *T_odom_body_ * laser_.T_body_laser.translation();
  for (const Eigen::Vector2d& p_body : points.p_body_free) {
    if (p_body.allFinite()) mark_line(p_odom_laser, *T_odom_body_ * p_body);
  }
  if (!doubted_.empty()) settle_doubts(free_by_bearing(points));
  if (!has_moved(T_odom_stored_, *T_odom_body_, kStoredM, kStoredRad)) return;
  T_odom_stored_ = T_odom_body_;
  add_place();
  for (Place& place : places_) {
    if (!is_apart(place.T_odom_body, *T_odom_body_, 0.5 * kStoredM, 0.5 * kStoredRad))
      place.free_m = {};  // the new scan takes its place
  }
  places_.back().free_m = free_by_bearing(points);
}

std::vector<float> BlindSideMemory::free_by_bearing(const LaserPoints& points) const {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  std::vector<float> free_m(kBearings, kNone);
  for (const Eigen::Vector2d& p_body : points.p_body_free) {
    if (!p_body.allFinite()) continue;
    const Eigen::Vector2d line = p_body - laser_.T_body_laser.translation();
    float& least_m = free_m[bearing_of(line)];
    least_m = std::min(least_m, static_cast<float>(line.norm()));
  }
  std::ranges::replace(free_m, kNone, 0.0F);  // nothing known
  return free_m;
}

double BlindSideMemory::known_m(const ArcMotion& motion, double within_m) const {
  if (!T_odom_body_) return 0.0;
  const double sign = direction_of(motion);
  double known = 0.0;
  for (double distance_m = kSampleM; known < within_m; distance_m += kSampleM) {
    // Never less than a sample, which is more than kInsideM: the vehicle cannot creep onto new
    // ground.
    const double signed_m = sign * distance_m;
    const Pose2 T_body_ahead = along_arc(signed_m, signed_m * motion.curvature_1_m);
    if (!is_known(*T_odom_body_ * T_body_ahead)) return known;
    known = std::min(distance_m, within_m);
  }
  return known;
}

/// Whether all of the outline is known: what is inside has been passed by the outline before.
bool BlindSideMemory::is_known(const Pose2& T_odom_body) const {
  return std::ranges::all_of(edge_, [&](const Eigen::Vector2d& p_body) {
    const Eigen::Vector2d p_odom = T_odom_body * p_body;
    return is_under_body(p_odom) || known_.get(cell_of(p_odom)) != 0;
  });
}

/// The body is up to kMovedM ahead of the last place that was added.
bool BlindSideMemory::is_under_body(const Eigen::Vector2d& p_odom) const {
  return outline_.contains(T_odom_body_->inverse() * p_odom);
}

/// A new place replaces those that are the same but for a fraction of a cell: their number is
/// bounded by the ground, not by how often it is driven.
void BlindSideMemory::add_place() {
  if (!places_.empty())
    odometer_m_ += between(places_.back().T_odom_body, *T_odom_body_).translation().norm();
  std::erase_if(places_, [&](const Place& place) {
    return place.free_m.empty() &&
           !is_apart(place.T_odom_body, *T_odom_body_, 0.5 * kMovedM, 0.5 * kTurnedRad);
  });
  places_.push_back({*T_odom_body_, odometer_m_, {}});
  mark(places_.back());
  forget_old_places();
}

/// Those that were driven or placed by a map correction too long ago.
void BlindSideMemory::forget_old_places() {
  if (correction_ && corrected_at_m_ >= odometer_m_ - kDrivenM) return;
  bool forgot_near = false;
  while (places_.front().driven_at_m < odometer_m_ - kDrivenM) {
    forgot_near = forgot_near || is_near(places_.front());
    places_.pop_front();
  }
  if (forgot_near) mark_all_near();
}

/// The footprint, and what was seen from there.
void BlindSideMemory::mark(const Place& place) {
  for (const Eigen::Vector2d& p_body : footprint_) {
    const Eigen::Vector2i cell = cell_of(place.T_odom_body * p_body);
    if (known_.contains(cell)) known_.at(cell) = 1;
  }
  const Eigen::Vector2d p_body_laser = laser_.T_body_laser.translation();
  for (std::size_t i = 0; i < place.free_m.size(); ++i) {
    const Eigen::Vector2d end = p_body_laser + place.free_m[i] * direction_of_bearing(i);
    mark_line(place.T_odom_body * p_body_laser, place.T_odom_body * end);
  }
}

void BlindSideMemory::mark_all_near() {
  known_ = Grid2<std::uint8_t>(known_.box());
  for (const Place& place : places_) {
    if (is_near(place)) mark(place);
  }
}

/// Whether it may reach into the cells.
bool BlindSideMemory::is_near(const Place& place) const {
  const double reach_m = 2.0 * outline_.radius_m() + (place.free_m.empty() ? 0.0 : kRangeM);
  return between(place.T_odom_body, *T_odom_body_).translation().norm() <
         std::numbers::sqrt2 * kReachM + kMoveCellsM + reach_m;
}

/// Moves the cells with the vehicle.
void BlindSideMemory::move_cells() {
  const Grid2<std::uint8_t> before = std::move(known_);
  known_ = Grid2<std::uint8_t>(cells_around(T_odom_body_->translation()));
  mark_all_near();
  for (std::size_t i = 0; i < known_.size(); ++i)
    known_[i] = std::max(known_[i], before.get(known_.cell(i)));
}

void BlindSideMemory::mark_line(const Eigen::Vector2d& p_odom_from,
                                const Eigen::Vector2d& p_odom_to) {
  const Eigen::Vector2d line = p_odom_to - p_odom_from;
  const double range_m = line.norm();
  const double end_m = std::min(range_m - kShortOfM, kRangeM);
  for (double distance_m = 0.0; distance_m < end_m; distance_m += kSampleM) {
    const Eigen::Vector2i cell = cell_of(p_odom_from + distance_m / range_m * line);
    if (known_.contains(cell)) known_.at(cell) = 1;
  }
}

}  // namespace adit
