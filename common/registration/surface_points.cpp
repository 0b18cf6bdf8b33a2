// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace adit {
namespace {

struct Return {
  int beam;
  double range;
  Eigen::Vector2d p_laser;
};

std::vector<Return> valid_returns(const LaserScan& scan, const LaserMount& mount) {
  std::vector<Return> returns;
  returns.reserve(scan.ranges_m.size());
  for (int i = 0; i < static_cast<int>(scan.ranges_m.size()); ++i) {
    const double range = scan.ranges_m[i];
    if (!(range >= mount.range_min_m && range < mount.range_max_m)) continue;  // NaN fails too
    const double angle = scan.angle_min_rad + i * scan.angle_step_rad;
    returns.push_back({i, range, {range * std::cos(angle), range * std::sin(angle)}});
  }
  return returns;
}

/// Whether the middle one of three consecutive returns lies on the line through the outer two.
bool in_line(const Return& a, const Return& b, const Return& c, double bend) {
  const Eigen::Vector2d chord = c.p_laser - a.p_laser;
  const Eigen::Vector2d d = b.p_laser - a.p_laser;
  const double length = chord.norm();
  return std::abs(chord.x() * d.y() - chord.y() * d.x()) < bend * length;
}

/// connected[i]: returns i and i + 1 lie on one surface.
std::vector<char> connect_neighbours(const std::vector<Return>& returns,
                                     const SurfaceParams& params) {
  const int n = static_cast<int>(returns.size());
  std::vector<char> connected(std::max(n, 1), 0);
  for (int i = 0; i + 1 < n; ++i) {
    const double gap = (returns[i + 1].p_laser - returns[i].p_laser).norm();
    const bool adjacent = returns[i + 1].beam - returns[i].beam <= 2;
    if (!adjacent || gap > params.gap_on_line_m) continue;
    const bool line_before =
        i > 0 && in_line(returns[i - 1], returns[i], returns[i + 1], params.bend_m);
    const bool line_after =
        i + 2 < n && in_line(returns[i], returns[i + 1], returns[i + 2], params.bend_m);
    connected[i] = gap < params.gap_m || line_before || line_after;
  }
  return connected;
}

/// A mixed pixel: both neighbours are far away, one nearer and one farther, as a laser reports when
/// its spot covers an edge.
bool mixed_pixel(const std::vector<Return>& returns, const std::vector<char>& connected, int i) {
  const int n = static_cast<int>(returns.size());
  if (i == 0 || i + 1 >= n) return false;
  if (connected[i - 1] || connected[i]) return false;
  return (returns[i - 1].range - returns[i].range) * (returns[i + 1].range - returns[i].range) < 0;
}

/// Total least squares line through the returns [first, last]; sets the normal if the fit is good.
void fit_normal(const std::vector<Return>& returns, int first, int last,
                const SurfaceParams& params, const Return& at, SurfacePoint& point) {
  const int n = last - first + 1;
  if (n < 3) return;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = first; i <= last; ++i) mean += returns[i].p_laser;
  mean /= n;
  double xx = 0, xy = 0, yy = 0;
  for (int i = first; i <= last; ++i) {
    const Eigen::Vector2d d = returns[i].p_laser - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  const double direction = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double half = 0.5 * std::hypot(xx - yy, 2.0 * xy);
  const double along = 0.5 * (xx + yy) + half;  // sum of squares
  const double across = std::max(0.0, 0.5 * (xx + yy) - half);
  const double variance = across / (n - 2);
  if (variance > params.residual_max_m * params.residual_max_m || along <= 4.0 * across) return;
  Eigen::Vector2d normal(-std::sin(direction), std::cos(direction));
  if (normal.dot(at.p_laser) > 0.0) normal = -normal;
  point.normal = normal;
  point.normal_variance = std::max(variance, params.range_sd_m * params.range_sd_m) / along;
}

/// A range error moves the point along the beam, a bearing error across it: on a distant wall at a
/// grazing angle the second is much larger.
double variance_along_normal(const Return& at, const SurfacePoint& point,
                             const SurfaceParams& params) {
  const double range_variance = params.range_sd_m * params.range_sd_m;
  const double across = at.range * params.bearing_sd_rad;
  const double cosine = point.has_normal() ? point.normal.dot(at.p_laser) / at.range : 0.0;
  return range_variance + across * across * (1.0 - cosine * cosine);
}

/// Projects points of a planar scan, and their normals, along the vertical.
class LevelProjection {
 public:
  LevelProjection(const LaserMount& mount, const Attitude& attitude)
      : height_m_(mount.height_m), R_level_body_(attitude.rotation()) {}

  void apply(SurfacePoint& point) const {
    const Eigen::Vector3d p = R_level_body_ * Eigen::Vector3d(point.p.x(), point.p.y(), height_m_);
    point.p = p.head<2>();
    point.z_m = p.z();
    if (!point.has_normal()) return;
    // The line of the surface in the plane of the scan is projected; the normal is across it.
    const Eigen::Vector2d line =
        R_level_body_.topLeftCorner<2, 2>() * Eigen::Vector2d(-point.normal.y(), point.normal.x());
    point.normal = Eigen::Vector2d(line.y(), -line.x()).normalized();
  }

 private:
  double height_m_;
  Eigen::Matrix3d R_level_body_;
};

/// SurfaceParams::half_window_beams for the beams of a scan.
int half_window_of(const LaserScan& scan, const SurfaceParams& params) {
  constexpr double kCoarseRad = 0.5 * std::numbers::pi / 180.0;
  constexpr int kBeamsMax = 50;
  const double finer = std::max(1.0, kCoarseRad / std::max(scan.angle_step_rad, 1e-6));
  const double beams = std::round(params.half_window_beams * finer * finer);
  return static_cast<int>(std::min<double>(beams, std::max(kBeamsMax, params.half_window_beams)));
}

}  // namespace

std::vector<SurfacePoint> surface_points(const LaserScan& scan, const LaserMount& mount,
                                         const SurfaceParams& params, const Attitude& attitude) {
  const auto returns = valid_returns(scan, mount);
  const auto connected = connect_neighbours(returns, params);
  const int half_window = half_window_of(scan, params);
  const int n = static_cast<int>(returns.size());
  const double c = std::cos(mount.T_body_laser.theta);
  const double s = std::sin(mount.T_body_laser.theta);
  Eigen::Matrix2d R_body_laser;
  R_body_laser << c, -s, s, c;
  const LevelProjection projection(mount, attitude);

  std::vector<SurfacePoint> points;
  points.reserve(n);
  for (int i = 0; i < n; ++i) {
    if (mixed_pixel(returns, connected, i)) continue;
    const auto near = [&](int j) {
      return (returns[j].p_laser - returns[i].p_laser).norm() <
             std::max(params.window_radius_m, params.gap_on_line_m * (std::abs(j - i) == 1));
    };
    int first = i;
    while (first > 0 && i - first < half_window && connected[first - 1] && near(first - 1)) --first;
    int last = i;
    while (last + 1 < n && last - i < half_window && connected[last] && near(last + 1)) ++last;
    SurfacePoint point;
    fit_normal(returns, first, last, params, returns[i], point);
    point.variance = variance_along_normal(returns[i], point, params);
    point.p = mount.T_body_laser * returns[i].p_laser;
    point.z_m = mount.height_m;
    point.normal = R_body_laser * point.normal;
    point.beam = returns[i].beam;
    if (!attitude.is_level()) projection.apply(point);
    point.weight = std::min(1.0, returns[i].range * scan.angle_step_rad / params.spacing_full_m);
    points.push_back(point);
  }
  return points;
}

}  // namespace adit
