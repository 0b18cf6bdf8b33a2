// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/shrinking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace adit {
namespace {

using Kind = SpaceParameter::Kind;

constexpr double kRangeShareDone = 0.02;  // of a range, to which a bisection is exact
constexpr int kDigits = 2;                // of a value that a bisection tries
constexpr double kSeedsTried = 3.0;

/// Thrown when no point can be evaluated any more.
struct Ended {};

class Shrinking {
 public:
  Shrinking(const SearchSpace& space, SearchPoint failing, int evaluated_max,
            const Reproduces& reproduces)
      : space_(space),
        evaluated_max_(evaluated_max),
        reproduces_(reproduces),
        result_{std::move(failing), 0, false} {}

  ShrunkPoint run() {
    try {
      if (accept_first({space_.simplest()})) return minimal();
      while (simplify_all() || refine_all()) {
      }
      return minimal();
    } catch (const Ended&) {
      return result_;
    }
  }

 private:
  ShrunkPoint minimal() {
    result_.is_minimal = true;
    return result_;
  }

  std::vector<bool> evaluate(const std::vector<SearchPoint>& points) {
    std::vector<SearchPoint> unknown;
    for (const SearchPoint& point : points) {
      if (!known_.contains(point) && std::ranges::count(unknown, point) == 0)
        unknown.push_back(point);
    }
    if (result_.evaluated + static_cast<int>(unknown.size()) > evaluated_max_) throw Ended{};
    result_.evaluated += static_cast<int>(unknown.size());
    if (!unknown.empty()) {
      const auto fails = reproduces_(unknown);
      if (!fails) throw Ended{};
      for (std::size_t i = 0; i < unknown.size(); ++i) known_[unknown[i]] = (*fails)[i];
    }
    std::vector<bool> results;
    for (const SearchPoint& point : points) results.push_back(known_.at(point));
    return results;
  }

  /// Takes the first of the points that fails. Returns its number from 1; 0 if none does.
  std::size_t accept_first(const std::vector<SearchPoint>& points) {
    const std::vector<bool> fails = evaluate(points);
    const auto first = std::ranges::find(fails, true);
    if (first == fails.end()) return 0;
    const auto i = static_cast<std::size_t>(first - fails.begin());
    result_.point = points[i];
    return i + 1;
  }

  [[nodiscard]] SearchPoint with(std::size_t parameter, double value) const {
    SearchPoint point = result_.point;
    point[parameter] = value;
    return point;
  }

  /// Each parameter that is not simple alone, then those together whose value does not matter.
  bool simplify_all() {
    std::vector<std::size_t> changed;
    std::vector<SearchPoint> points;
    for (std::size_t i = 0; i < space_.parameters.size(); ++i) {
      const double simple = space_.parameters[i].simple;
      if (result_.point[i] == simple) continue;
      changed.push_back(i);
      points.push_back(with(i, simple));
    }
    const std::vector<bool> fails = evaluate(points);
    SearchPoint together = result_.point;
    std::vector<std::size_t> alone;
    for (std::size_t n = 0; n < changed.size(); ++n) {
      if (!fails[n]) continue;
      alone.push_back(changed[n]);
      together[changed[n]] = space_.parameters[changed[n]].simple;
    }
    if (alone.empty()) return false;
    if (accept_first({together})) return true;
    for (const std::size_t i : alone) accept_first({with(i, space_.parameters[i].simple)});
    return true;
  }

  bool refine_all() {
    bool changes = false;
    for (std::size_t i = 0; i < space_.parameters.size(); ++i) {
      if (result_.point[i] == space_.parameters[i].simple) continue;
      changes |= space_.parameters[i].is_range() ? bisect(i) : try_simpler(i);
    }
    return changes;
  }

  /// Choices before this one, or the smallest seeds.
  bool try_simpler(std::size_t i) {
    const SpaceParameter& parameter = space_.parameters[i];
    double end = result_.point[i];
    if (parameter.kind == Kind::kSeed) end = std::min(end, parameter.simple + kSeedsTried);
    std::vector<SearchPoint> points;
    for (double value = parameter.simple + 1.0; value < end; value += 1.0)
      points.push_back(with(i, value));
    return accept_first(points) > 0;
  }

  /// Between the simple value, which does not fail, and this one, at three points at a time.
  bool bisect(std::size_t i) {
    const SpaceParameter& parameter = space_.parameters[i];
    double sound = parameter.simple;
    bool changes = false;
    const double done = std::max(kRangeShareDone * (parameter.to - parameter.from),
                                 parameter.kind == Kind::kInteger ? 1.0 : 0.0);
    while (std::abs(result_.point[i] - sound) > done) {
      const double failing = result_.point[i];
      std::vector<double> values;
      std::vector<SearchPoint> points;
      for (const double share : {0.25, 0.5, 0.75}) {
        const double value = parameter.rounded(sound + share * (failing - sound), kDigits);
        const bool is_between = (value - sound) * (value - failing) < 0.0;
        if (!is_between || std::ranges::count(values, value) > 0) continue;
        values.push_back(value);
        points.push_back(with(i, value));
      }
      if (values.empty()) return changes;
      const std::size_t accepted = accept_first(points);
      changes |= accepted > 0;
      if (accepted == 0) {
        sound = values.back();
      } else if (accepted > 1) {
        sound = values[accepted - 2];
      }
    }
    return changes;
  }

  const SearchSpace& space_;
  int evaluated_max_;
  const Reproduces& reproduces_;
  ShrunkPoint result_;
  std::map<SearchPoint, bool> known_;
};

}  // namespace

ShrunkPoint shrink(const SearchSpace& space, const SearchPoint& failing, int evaluated_max,
                   const Reproduces& reproduces) {
  return Shrinking(space, failing, evaluated_max, reproduces).run();
}

}  // namespace adit
