// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/loop_order.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "common/geometry/order_statistics.hpp"
#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/odometry_chain.hpp"

namespace adit {
namespace {

constexpr int kIntervals = 300;
constexpr double kSpread = 2.0;  // of uncertainty among loops decided together
// Of the accepted loops, to be decided together, so that the number of batches grows with the
// logarithm of theirs.
constexpr double kBatchShare = 0.25;
constexpr double kFar = std::numeric_limits<double>::infinity();

Eigen::Vector3d variances(const PoseConstraint& constraint) {
  return measured_by(constraint).covariance.diagonal();
}

}  // namespace

LoopOrder::LoopOrder(const std::vector<PoseConstraint>& chain,
                     const std::vector<PoseConstraint>& bridges, std::vector<PoseConstraint> loops)
    : loops_(std::move(loops)), is_pending_(loops_.size(), true) {
  for (int axis = 0; axis < 3 && !chain.empty(); ++axis) {
    std::vector<double> values;
    for (const PoseConstraint& step : chain) values.push_back(variances(step)[axis]);
    unit_[axis] = std::max(median(std::move(values)), std::numeric_limits<double>::min());
  }
  double total = 0.0;
  for (const PoseConstraint& step : chain) total += variance_of(step);
  interval_variance_ = total / kIntervals;
  double begin = 0.0;  // variance from the first node to the begin of the interval
  double here = 0.0;
  interval_.push_back(0);
  chain_.emplace_back();
  for (const PoseConstraint& step : chain) {
    here += variance_of(step);
    if (here - begin > interval_variance_) {
      const auto next = static_cast<int>(chain_.size());
      chain_.emplace_back();
      link(chain_, next - 1, next, here - begin);
      begin = here;
    }
    interval_.push_back(static_cast<int>(chain_.size()) - 1);
  }
  for (const PoseConstraint& bridge : bridges) {
    link(chain_, interval_of(bridge.from), interval_of(bridge.to), variance_of(bridge));
  }
}

/// Sum of the variances, each in units of that of a typical step.
double LoopOrder::variance_of(const PoseConstraint& constraint) const {
  return variances(constraint).cwiseQuotient(unit_).sum();
}

void LoopOrder::link(Links& links, int a, int b, double variance) {
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    const auto [at, is_new] = links[as_index(from)].try_emplace(to, variance);
    at->second = std::min(at->second, variance);
  }
}

/// Dijkstra's algorithm.
std::vector<double> LoopOrder::distances_from(const Links& links, int interval) {
  using Entry = std::pair<double, int>;
  std::vector<double> distances(links.size(), kFar);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distances[as_index(interval)] = 0.0;
  queue.emplace(0.0, interval);
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    if (distance > distances[as_index(at)]) continue;
    for (const auto& [next, variance] : links[as_index(at)]) {
      double& known = distances[as_index(next)];
      if (distance + variance >= known) continue;
      known = distance + variance;
      queue.emplace(known, next);
    }
  }
  return distances;
}

LoopOrder::Candidates LoopOrder::most_certain(std::size_t most,
                                              const std::vector<int>& accepted) const {
  Links links = chain_;
  for (const int loop : accepted) {
    const PoseConstraint& c = loops_[as_index(loop)];
    link(links, interval_of(c.from), interval_of(c.to), variance_of(c));
  }
  std::map<int, std::vector<double>> from;  // distances from the intervals of pending loops
  std::vector<std::pair<double, int>> order;
  for (int loop = 0; loop < static_cast<int>(loops_.size()); ++loop) {
    if (!is_pending(loop)) continue;
    const PoseConstraint& c = loops_[as_index(loop)];
    const auto [at, is_new] = from.try_emplace(interval_of(c.from));
    if (is_new) at->second = distances_from(links, interval_of(c.from));
    order.emplace_back(at->second[static_cast<std::size_t>(interval_of(c.to))], loop);
  }
  std::sort(order.begin(), order.end());
  if (order.size() > most) order.resize(most);
  const double certain =
      kSpread * std::max(order.empty() ? 0.0 : order.front().first, interval_variance_);
  const auto least = static_cast<std::size_t>(kBatchShare * static_cast<double>(accepted.size()));
  Candidates candidates;
  for (const auto& [distance, loop] : order) {
    if (distance <= certain) {
      candidates.most_certain.push_back(loop);
    } else if (candidates.most_certain.size() + candidates.further.size() < least) {
      candidates.further.push_back(loop);
    }
  }
  return candidates;
}

void LoopOrder::take(const std::vector<int>& loops) {
  for (const int loop : loops) is_pending_[as_index(loop)] = false;
}

}  // namespace adit
