// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/drift_splits.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/world/plan_segment.hpp"

namespace adit {
namespace {

/// One straight piece of a line.
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double s_m = 0.0;  ///< at `from`

  [[nodiscard]] double length_m() const { return (to - from).norm(); }
};

std::vector<Segment> segments_of(const DriftLine& line) {
  std::vector<Segment> segments;
  double s = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    segments.push_back({line.points[i - 1], line.points[i], s});
    s += segments.back().length_m();
  }
  return segments;
}

/// Shares of both segments at which they cross; nothing for parallel ones.
std::optional<std::pair<double, double>> crossing(const Segment& a, const Segment& b) {
  const Eigen::Vector2d u = a.to - a.from;
  const Eigen::Vector2d v = b.to - b.from;
  const double area = cross(u, v);
  if (std::abs(area) < 1e-9 * u.norm() * v.norm()) return std::nullopt;
  const double share_a = cross(b.from - a.from, v) / area;
  const double share_b = cross(b.from - a.from, u) / area;
  const bool within = share_a >= 0.0 && share_a <= 1.0 && share_b >= 0.0 && share_b <= 1.0;
  if (!within) return std::nullopt;
  return std::pair(share_a, share_b);
}

/// All drifts of a plan, and where each of them is to be split.
class Splitter {
 public:
  explicit Splitter(const std::vector<DriftLine>& drifts)
      : drifts_(drifts), splits_(drifts.size()) {
    for (const DriftLine& drift : drifts) segments_.push_back(segments_of(drift));
  }

  std::vector<std::vector<DriftSplit>> splits() {
    for (std::size_t a = 0; a < drifts_.size(); ++a) {
      for (std::size_t b = a; b < drifts_.size(); ++b) add_crossings(a, b);
    }
    for (std::size_t a = 0; a < drifts_.size(); ++a) {
      add_end(a, 0.0, drifts_[a].points.front());
      add_end(a, drifts_[a].length_m(), drifts_[a].points.back());
    }
    return splits_;
  }

 private:
  void add_crossings(std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < segments_[a].size(); ++i) {
      // Neighbours within one line always meet.
      for (std::size_t j = a == b ? i + 2 : 0; j < segments_[b].size(); ++j) {
        const Segment& first = segments_[a][i];
        const Segment& second = segments_[b][j];
        const auto shares = crossing(first, second);
        if (!shares) continue;
        const Eigen::Vector2d p = first.from + shares->first * (first.to - first.from);
        splits_[a].push_back({first.s_m + shares->first * first.length_m(), p});
        splits_[b].push_back({second.s_m + shares->second * second.length_m(), p});
      }
    }
  }

  /// An end belongs to the nearest drift within half its width, or is a node of its own.
  void add_end(std::size_t a, double s_m, const Eigen::Vector2d& end) {
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> drift;
    DriftSplit foot{s_m, end};
    for (std::size_t b = 0; b < drifts_.size(); ++b) {
      if (b == a || !drifts_[b].reaches(end)) continue;
      const DriftLine::Place place = drifts_[b].place_of(end);
      if (std::abs(place.across_m) >= nearest) continue;
      nearest = std::abs(place.across_m);
      drift = b;
      foot = {place.s_m, drifts_[b].at(place.s_m).p_world};
    }
    splits_[a].push_back({s_m, foot.p_node});
    if (drift) splits_[*drift].push_back(foot);
  }

  const std::vector<DriftLine>& drifts_;
  std::vector<std::vector<Segment>> segments_;
  std::vector<std::vector<DriftSplit>> splits_;
};

}  // namespace

std::vector<std::vector<DriftSplit>> drift_splits(const std::vector<DriftLine>& drifts) {
  return Splitter(drifts).splits();
}

}  // namespace adit
