// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/frame_tree.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr double kEqualM = 1e-3;
constexpr double kEqualRad = 1e-3;
constexpr std::size_t kDepthMax = 100;  // of the tree; a cycle has no root

double angle_of(const Eigen::Matrix3d& R) { return Eigen::AngleAxisd(R).angle(); }

bool differ(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d between = a.inverse() * b;
  return between.translation().norm() > kEqualM || angle_of(between.linear()) > kEqualRad;
}

}  // namespace

void FrameTree::add(const RosTransform& transform, bool is_static) {
  const auto [entry, is_new] = edges_.try_emplace(transform.child, Edge{transform.parent});
  Edge& edge = entry->second;
  if (edge.parent != transform.parent || transform.parent == transform.child) return;
  auto& samples = edge.samples;
  if (is_static && !is_new) return;
  if (!samples.empty() && transform.utime <= samples.back().utime) return;
  const Eigen::Isometry3d& T = transform.T_parent_child;
  if (!samples.empty()) edge.moves = edge.moves || differ(samples.front().T_parent_child, T);
  const auto equals = [&T](const Sample& sample) {
    return sample.T_parent_child.matrix() == T.matrix();
  };
  const bool repeated = samples.size() >= 2 && equals(samples.back()) && equals(samples.end()[-2]);
  if (repeated) samples.pop_back();
  samples.push_back({transform.utime, T});
}

bool FrameTree::has(const std::string& frame) const {
  return edges_.contains(frame) || std::ranges::any_of(edges_, [&frame](const auto& edge) {
           return edge.second.parent == frame;
         });
}

bool FrameTree::moves(const std::string& frame) const {
  const auto edge = edges_.find(frame);
  return edge != edges_.end() && edge->second.moves;
}

std::optional<std::string> FrameTree::parent(const std::string& frame) const {
  const auto edge = edges_.find(frame);
  if (edge == edges_.end()) return std::nullopt;
  return edge->second.parent;
}

Eigen::Isometry3d FrameTree::pose_at(const Edge& edge, std::int64_t utime) {
  const auto& samples = edge.samples;
  const auto after = std::ranges::upper_bound(samples, utime, {}, &Sample::utime);
  if (after == samples.begin()) return samples.front().T_parent_child;
  if (after == samples.end()) return samples.back().T_parent_child;
  const Sample& a = after[-1];
  const Sample& b = *after;
  const double share =
      static_cast<double>(utime - a.utime) / static_cast<double>(b.utime - a.utime);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() =
      (1.0 - share) * a.T_parent_child.translation() + share * b.T_parent_child.translation();
  T.linear() = Eigen::Quaterniond(a.T_parent_child.linear())
                   .slerp(share, Eigen::Quaterniond(b.T_parent_child.linear()))
                   .toRotationMatrix();
  return T;
}

/// The frame and those above it.
std::vector<std::string> FrameTree::chain(const std::string& frame) const {
  std::vector<std::string> frames{frame};
  while (frames.size() < kDepthMax) {
    const auto above = parent(frames.back());
    if (!above) break;
    frames.push_back(*above);
  }
  return frames;
}

std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>>
FrameTree::between_frames(const std::string& a, const std::string& b) const {
  std::vector<std::string> from_a = chain(a);
  std::vector<std::string> from_b = chain(b);
  for (std::size_t i = 0; i < from_a.size(); ++i) {
    const auto common = std::ranges::find(from_b, from_a[i]);
    if (common == from_b.end()) continue;
    from_b.erase(common, from_b.end());
    from_a.resize(i);
    return std::pair(std::move(from_a), std::move(from_b));
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> FrameTree::lookup(const std::string& a, const std::string& b,
                                                   std::int64_t utime) const {
  const auto frames = between_frames(a, b);
  if (!frames) return std::nullopt;
  const auto pose_in_ancestor = [this, utime](const std::vector<std::string>& up) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (const std::string& frame : up) T = pose_at(edges_.at(frame), utime) * T;
    return T;
  };
  return pose_in_ancestor(frames->first).inverse() * pose_in_ancestor(frames->second);
}

bool FrameTree::moves(const std::string& a, const std::string& b) const {
  return !times_of(a, b).empty();
}

std::vector<std::int64_t> FrameTree::times_of(const std::string& a, const std::string& b) const {
  std::vector<std::int64_t> times;
  const auto frames = between_frames(a, b);
  if (!frames) return times;
  for (const auto* side : {&frames->first, &frames->second}) {
    for (const std::string& frame : *side) {
      const Edge& edge = edges_.at(frame);
      if (!edge.moves) continue;
      for (const Sample& sample : edge.samples) times.push_back(sample.utime);
    }
  }
  return times;
}

std::string FrameTree::rigid_root(const std::string& frame) const {
  std::string root = frame;
  for (const std::string& above : chain(frame)) {
    root = above;
    if (moves(above)) break;
  }
  return root;
}

}  // namespace adit
