// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/cross_entropy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

using Kind = SpaceParameter::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kKnownShareMax = 0.4;  // of a batch that fails as is known, before a restart
constexpr double kShareMin = 0.05;      // of each choice, relative to a uniform one

}  // namespace

CrossEntropy::CrossEntropy(const SearchSpace& space, const CrossEntropyParams& params,
                           std::uint64_t seed)
    : space_(space), params_(params), random_(seed) {
  restart();
}

/// The first run begins with the whole space.
void CrossEntropy::restart() {
  ++restarts_;
  recent_.clear();
  best_ = -kInfinity;
  stalls_ = 0;
  marginals_.assign(space_.parameters.size(), {});
  for (std::size_t i = 0; i < marginals_.size(); ++i) {
    const std::size_t choices = space_.parameters[i].choices.size();
    marginals_[i].shares.assign(choices,
                                1.0 / static_cast<double>(std::max<std::size_t>(choices, 1)));
    if (restarts_ == 0) continue;
    marginals_[i].mean = uniform();
    marginals_[i].sd = params_.restart_sd;
  }
}

std::size_t CrossEntropy::guided() const {
  return static_cast<std::size_t>(
      std::lround((1.0 - params_.uniform_share) * static_cast<double>(params_.batch)));
}

double CrossEntropy::draw_uniform(const SpaceParameter& parameter) {
  const bool is_discrete = parameter.kind != Kind::kReal;
  const double width = parameter.to - parameter.from + (is_discrete ? 1.0 : 0.0);
  const double value = parameter.from + width * uniform();
  return is_discrete ? std::min(std::floor(value), parameter.to) : parameter.rounded(value);
}

double CrossEntropy::draw(const SpaceParameter& parameter, const Marginal& marginal) {
  if (parameter.kind == Kind::kSeed) return draw_uniform(parameter);
  if (parameter.kind == Kind::kChoice) {
    double rest = uniform();
    for (std::size_t i = 0; i + 1 < marginal.shares.size(); ++i) {
      rest -= marginal.shares[i];
      if (rest < 0.0) return static_cast<double>(i);
    }
    return static_cast<double>(marginal.shares.size() - 1);
  }
  std::normal_distribution<double> normal(marginal.mean, marginal.sd);
  double share = normal(random_);
  while (share < 0.0 || share > 1.0)
    share = normal(random_);  // mean is within: one of two at least
  return parameter.rounded(parameter.from + share * (parameter.to - parameter.from));
}

std::vector<SearchPoint> CrossEntropy::sample() {
  points_.clear();
  for (int n = 0; n < params_.batch; ++n) {
    const bool is_guided = points_.size() < guided();
    SearchPoint point;
    for (std::size_t i = 0; i < space_.parameters.size(); ++i) {
      point.push_back(is_guided ? draw(space_.parameters[i], marginals_[i])
                                : draw_uniform(space_.parameters[i]));
    }
    points_.push_back(std::move(point));
  }
  return points_;
}

void CrossEntropy::update(const std::vector<Evaluation>& evaluations) {
  std::vector<Ranked> batch;
  double known = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Evaluation& evaluation = evaluations[i];
    const bool fails = !evaluation.kind.empty();
    const bool is_known = fails && ++kinds_[evaluation.kind] > params_.known_after;
    if (i >= guided()) continue;  // only counts
    known += is_known ? 1.0 : 0.0;
    if (is_known) continue;
    const double severity = fails ? kInfinity : evaluation.severity.value_or(-kInfinity);
    batch.push_back({points_[i], std::isnan(severity) ? -kInfinity : severity});
  }
  recent_.push_back(std::move(batch));
  if (static_cast<int>(recent_.size()) > params_.memory) recent_.pop_front();

  const std::vector<Ranked> best = elite();
  const bool improves = !best.empty() && best.back().severity > best_;
  stalls_ = improves ? 0 : stalls_ + 1;
  if (improves) best_ = best.back().severity;
  if (known > kKnownShareMax * static_cast<double>(guided()) || stalls_ >= params_.stalls_max)
    return restart();
  if (!best.empty()) fit(best);
}

/// The most severe points, of equal ones the newest; none if all are equal.
std::vector<CrossEntropy::Ranked> CrossEntropy::elite() const {
  std::vector<Ranked> all;
  for (auto batch = recent_.rbegin(); batch != recent_.rend(); ++batch)
    all.insert(all.end(), batch->begin(), batch->end());
  std::ranges::stable_sort(all, std::ranges::greater{}, &Ranked::severity);
  if (all.empty() || all.front().severity == all.back().severity) return {};
  const double count = params_.elite_share * static_cast<double>(all.size());
  all.resize(std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(count))));
  return all;
}

/// The maximum-likelihood distribution of the elite, smoothed.
void CrossEntropy::fit(const std::vector<Ranked>& elite) {
  const auto count = static_cast<double>(elite.size());
  const auto smoothed = [&](double before, double now) {
    return params_.smoothing * now + (1.0 - params_.smoothing) * before;
  };
  for (std::size_t i = 0; i < marginals_.size(); ++i) {
    const SpaceParameter& parameter = space_.parameters[i];
    Marginal& marginal = marginals_[i];
    if (parameter.kind == Kind::kSeed) continue;
    if (parameter.kind == Kind::kChoice) {
      std::vector<double> shares(marginal.shares.size(), 0.0);
      for (const Ranked& ranked : elite)
        shares[static_cast<std::size_t>(std::lround(ranked.point[i]))] += 1.0 / count;
      const double least = kShareMin / static_cast<double>(shares.size());
      double sum = 0.0;
      for (std::size_t k = 0; k < shares.size(); ++k) {
        marginal.shares[k] = std::max(smoothed(marginal.shares[k], shares[k]), least);
        sum += marginal.shares[k];
      }
      for (double& share : marginal.shares) share /= sum;
      continue;
    }
    double mean = 0.0;
    double square = 0.0;
    for (const Ranked& ranked : elite) {
      const double share = (ranked.point[i] - parameter.from) / (parameter.to - parameter.from);
      mean += share / count;
      square += share * share / count;
    }
    const double sd = std::sqrt(std::max(square - mean * mean, 0.0));
    marginal.mean = smoothed(marginal.mean, mean);
    marginal.sd = std::max(smoothed(marginal.sd, sd), params_.sd_min);
  }
}

}  // namespace adit
