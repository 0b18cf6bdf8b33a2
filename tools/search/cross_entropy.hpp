// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tools/search/search_space.hpp"

namespace adit {

/// What a search is told of a point.
struct Evaluation {
  std::optional<double> severity;  ///< larger the closer to a failure
  std::string kind;                ///< of the failure; empty if it did not fail
};

struct CrossEntropyParams {
  int batch = 16;
  double uniform_share = 0.1;  ///< of a batch, drawn from the whole space
  double elite_share = 0.1;    ///< of the points of the last batches
  int memory = 4;              ///< batches from which the elite is taken
  double smoothing = 0.7;      ///< weight of the elite against the distribution before
  double sd_min = 0.03;        ///< of a range, relative to its width
  double restart_sd = 0.3;     ///< of a restart around a random centre
  int known_after = 3;         ///< failures of a kind after which others like it do not guide
  int stalls_max = 4;          ///< batches without progress before a restart
};

/// The cross-entropy method (Rubinstein and Kroese 2004, ch. 4) for failures of several kinds:
/// draws batches from a product of truncated normal and categorical distributions, and moves it to
/// the most severe points. Restarts when its kind of failure is known, or when it makes no
/// progress: at a random centre, with a limited spread, so that another basin attracts it. A share
/// of each batch is uniform. Seeds are always uniform. The same seed and evaluations give the same
/// points.
class CrossEntropy {
 public:
  CrossEntropy(const SearchSpace& space, const CrossEntropyParams& params, std::uint64_t seed);

  /// The points to evaluate next.
  std::vector<SearchPoint> sample();

  /// Takes the evaluations of the points that were drawn last.
  void update(const std::vector<Evaluation>& evaluations);

  /// Times it has begun at another centre.
  [[nodiscard]] int restarts() const { return restarts_; }

 private:
  /// Of one parameter; `mean` and `sd` relative to its range.
  struct Marginal {
    double mean = 0.5;
    double sd = 0.5;
    std::vector<double> shares;  ///< of choices
  };
  struct Ranked {
    SearchPoint point;
    double severity;
  };

  void restart();
  double draw(const SpaceParameter& parameter, const Marginal& marginal);
  double draw_uniform(const SpaceParameter& parameter);
  void fit(const std::vector<Ranked>& elite);
  [[nodiscard]] std::vector<Ranked> elite() const;
  [[nodiscard]] std::size_t guided() const;
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  const SearchSpace& space_;
  CrossEntropyParams params_;
  std::mt19937_64 random_;
  std::vector<Marginal> marginals_;
  std::vector<SearchPoint> points_;         ///< drawn last, guided ones first
  std::deque<std::vector<Ranked>> recent_;  ///< batches since the restart that may guide
  std::map<std::string, int> kinds_;        ///< failures so far
  double best_ = 0.0;                       ///< lowest severity of the elite since the restart
  int stalls_ = 0;
  int restarts_ = -1;
};

}  // namespace adit
