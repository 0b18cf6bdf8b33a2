// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_extent.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kSquareM = 1.0;
constexpr std::int64_t kRow = std::int64_t{1} << 32;

Eigen::Vector2i square_of(const Eigen::Vector2d& p) {
  return (p / kSquareM).array().floor().cast<int>();
}

std::int64_t key_of(const Eigen::Vector2i& square) { return square.y() * kRow + square.x(); }

Eigen::Vector2i square_at(std::int64_t key) {
  const std::int64_t y = (key + kRow / 2) / kRow - ((key + kRow / 2) % kRow < 0 ? 1 : 0);
  return {static_cast<int>(key - y * kRow), static_cast<int>(y)};
}

void sort_unique(std::vector<std::int64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace

MapExtent::MapExtent(const LocalWalls& walls) {
  for (const auto& point : walls.points) covered_.push_back(key_of(square_of(point.p)));
  sort_unique(covered_);
  for (const std::int64_t key : covered_) {
    const Eigen::Vector2d square = square_at(key).cast<double>();
    samples_.emplace_back((square + Eigen::Vector2d::Constant(0.5)) * kSquareM);
    centre_ += samples_.back();
  }
  if (samples_.empty()) return;
  centre_ /= static_cast<double>(samples_.size());
  for (const auto& sample : samples_) {
    radius_m_ = std::max(radius_m_, (sample - centre_).norm() + kSquareM);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        covered_.push_back(key_of(square_of(sample) + Eigen::Vector2i(dx, dy)));
      }
    }
  }
  sort_unique(covered_);
}

bool MapExtent::covers(const Eigen::Vector2d& p) const {
  return std::binary_search(covered_.begin(), covered_.end(), key_of(square_of(p)));
}

double MapExtent::seen_by(const std::vector<Placed>& others) const {
  if (samples_.empty()) return 0.0;
  std::vector<Pose2> T_other_this;
  for (const Placed& other : others) T_other_this.push_back(other.T_this_other.inverse());
  const auto seen = [&](const Eigen::Vector2d& p) {
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (others[k].extent->covers(T_other_this[k] * p)) return true;
    }
    return false;
  };
  const auto count = std::count_if(samples_.begin(), samples_.end(), seen);
  return static_cast<double>(count) / static_cast<double>(samples_.size());
}

double MapExtent::overlap(const MapExtent& other, const Pose2& T_this_other) const {
  if (other.samples_.empty()) return 0.0;
  const double c = std::cos(T_this_other.theta);
  const double s = std::sin(T_this_other.theta);
  const auto inside = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d q(c * p.x() - s * p.y() + T_this_other.x,
                            s * p.x() + c * p.y() + T_this_other.y);
    return covers(q);
  };
  const auto count = std::count_if(other.samples_.begin(), other.samples_.end(), inside);
  return static_cast<double>(count) / static_cast<double>(other.samples_.size());
}

}  // namespace adit
