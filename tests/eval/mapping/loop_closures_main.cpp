// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// loop_closures_table [--sd-m S] [--sd-deg S] [--seeds N]: accuracy of the matching of local maps
// on all recordings with relations and on drives through sample mines, as tables in Markdown.
// Predictions are the true relative poses with added noise. False pairs are maps of different
// places with a prediction that they overlap.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>

#include "common/config/config.hpp"
#include "common/geometry/order_statistics.hpp"
#include "procs/mapping/loop_closure/map_matching.hpp"
#include "tests/eval/mapping/loop_closure_runs.hpp"
#include "tests/eval/mapping/quadrilaterals.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

struct Options {
  double sd_m = 1.0;
  double sd_deg = 5.0;
  int seeds = 1;
  int neighbours = 1;
  std::string only;
  std::string config;
  MapMatchingParams matching;
  bool verbose = false;
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

bool is_within(const LoopClosureAlternative& alternative, const Pose2& truth, double metres,
               double degrees) {
  const Pose2 error = between(truth, alternative.T_older_newer);
  return error.translation().norm() < metres && std::abs(error.theta) < deg_to_rad(degrees);
}

bool is_right(const LoopClosureAlternative& alternative, const Pose2& truth) {
  return is_within(alternative, truth, 0.25, 3.0);
}

/// Looser than is_right, since relations of some recordings have larger errors.
bool is_right_place(const LoopClosureAlternative& alternative, const Pose2& truth) {
  return is_within(alternative, truth, 1.0, 10.0);
}

/// Statistics of the matches of one run.
class MatchStatistics {
 public:
  MatchStatistics(const MappedRun& run, const Options& options)
      : run_(run), options_(options), scatter_(scatter_of_relations(run)) {}

  void match_true_pairs() {
    for (const auto& [pair, truth] : true_pairs(run_)) {
      for (int seed = 0; seed < options_.seeds; ++seed) match(pair.first, pair.second, truth, true);
    }
  }

  void match_false_pairs() {
    constexpr double kNearM = 12.0;
    constexpr double kFarM = 30.0;
    const int maps = static_cast<int>(run_.maps.size());
    for (int older = 0; older < maps; ++older) {
      for (int newer = older + 3; newer < maps; newer += 5) {
        const Pose2 apart = between(run_.maps[older].T_odom_local, run_.maps[newer].T_odom_local);
        if (apart.translation().norm() < kNearM || apart.translation().norm() > kFarM) continue;
        if (false_pairs_ >= 300) return;
        match(older, newer, {0.0, 0.0, uniform_(random_)}, false);
      }
    }
  }

  void print(const std::string& name) const {
    std::cout << format("| %s | %zu | %d | %.3f | %.3f | %.3f | %.3f | %d / %d |", name.c_str(),
                        run_.maps.size(), true_pairs_, share(best_place_), share(best_right_),
                        share(any_right_), right_of_matched(), false_accepted_, false_pairs_)
              << format(" %.4f (%.4f) | %.3f | %.2f (%.2f) | %.2f | %zu | %.1f | %.1f |",
                        mean(errors_m_), quantile(errors_m_, 0.5), mean(errors_deg_), mean(nees_),
                        quantile(nees_, 0.5), mean(alternatives_), degenerate_, mean(ms_),
                        quantile(ms_, 0.99))
              << format(" %.1f, %.1f; %.1f, %.1f |\n", quantile(true_likelihoods_, 0.1),
                        quantile(true_likelihoods_, 0.5), quantile(false_likelihoods_, 0.5),
                        quantile(false_likelihoods_, 1.0))
              << std::flush;
  }

 private:
  [[nodiscard]] double share(int count) const { return count / std::max(1.0, 1.0 * true_pairs_); }

  /// Share of the true pairs with any alternative whose best alternative is right.
  [[nodiscard]] double right_of_matched() const {
    return best_right_ / std::max(1.0, 1.0 * matched_);
  }

  static bool fully_observed(const LoopClosureAlternative& a) {
    return a.information.determinant() > 1e3;
  }

  void match(int older, int newer, const Pose2& truth, bool is_true) {
    const double sd_rad = deg_to_rad(options_.sd_deg);
    const Eigen::Vector3d sd(options_.sd_m, options_.sd_m, sd_rad);
    const Eigen::Vector3d noise(normal_(random_), normal_(random_), normal_(random_));
    RelativePose predicted;
    predicted.T_older_newer = truth * Pose2::from_vector(noise.cwiseProduct(sd));
    predicted.covariance = sd.cwiseAbs2().asDiagonal();
    const std::clock_t start = std::clock();
    const auto found =
        match_maps(*run_.walls[newer], place(older), older, predicted, options_.matching);
    ms_.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (is_true) {
      count_true(older, newer, truth, found);
    } else if (!contains_truth(older, newer, found)) {
      ++false_pairs_;
      false_accepted_ += found.empty() ? 0 : 1;
      if (!found.empty()) false_likelihoods_.push_back(found.front().log_likelihood);
    }
  }

  /// Whether an alternative is at the true relative pose, which a wide gate around the wrong place
  /// may contain.
  [[nodiscard]] bool contains_truth(int older, int newer,
                                    const std::vector<LoopClosureAlternative>& found) const {
    const Pose2 apart = between(run_.maps[older].T_odom_local, run_.maps[newer].T_odom_local);
    return std::any_of(found.begin(), found.end(), [&](const LoopClosureAlternative& a) {
      const Pose2 error = between(apart, a.T_older_newer);
      return error.translation().norm() < 2.0 && std::abs(error.theta) < 0.3;
    });
  }

  void count_true(int older, int newer, const Pose2& truth,
                  const std::vector<LoopClosureAlternative>& found) {
    ++true_pairs_;
    matched_ += found.empty() ? 0 : 1;
    alternatives_.push_back(static_cast<double>(found.size()));
    const auto hit =
        std::find_if(found.begin(), found.end(), [&](const auto& a) { return is_right(a, truth); });
    any_right_ += hit != found.end() ? 1 : 0;
    best_place_ += !found.empty() && is_right_place(found.front(), truth) ? 1 : 0;
    best_right_ += !found.empty() && hit == found.begin() ? 1 : 0;
    if (options_.verbose) report(older, newer, truth, found);
    if (hit == found.end()) return;
    const Eigen::Vector3d error = between(truth, hit->T_older_newer).vector();
    errors_m_.push_back(error.head<2>().norm());
    errors_deg_.push_back(rad_to_deg(std::abs(error.z())));
    true_likelihoods_.push_back(hit->log_likelihood);
    if (!fully_observed(*hit)) {
      ++degenerate_;
    } else {
      const Eigen::Matrix3d covariance = hit->information.inverse() + scatter_.covariance();
      nees_.push_back(error.dot(covariance.inverse() * error));
    }
  }

  static void report(int older, int newer, const Pose2& truth,
                     const std::vector<LoopClosureAlternative>& found) {
    std::cout << format("%d-%d:", older, newer);
    for (const auto& a : found) {
      const Pose2 off = between(truth, a.T_older_newer);
      const Eigen::Vector3d e = off.vector();
      std::cout << format(" [%.3f %.3f %.2f° L %.1f nees %.1f]", off.x, off.y,
                          rad_to_deg(off.theta), a.log_likelihood, e.dot(a.information * e));
    }
    std::cout << "\n";
  }

  [[nodiscard]] std::vector<PlacedWalls> place(int older) const {
    std::vector<PlacedWalls> placed{{run_.walls[older], {}}};
    for (int k = 1; k <= options_.neighbours; ++k) {
      for (const int other : {older - k, older + k}) {
        if (other < 0 || other >= static_cast<int>(run_.maps.size())) continue;
        placed.push_back({run_.walls[other],
                          between(run_.maps[older].T_odom_local, run_.maps[other].T_odom_local)});
      }
    }
    return placed;
  }

  const MappedRun& run_;
  const Options& options_;
  Scatter scatter_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{-3.14, 3.14};
  int true_pairs_ = 0;
  int matched_ = 0;
  int best_right_ = 0;
  int best_place_ = 0;
  int any_right_ = 0;
  int false_pairs_ = 0;
  int false_accepted_ = 0;
  std::size_t degenerate_ = 0;
  std::vector<double> errors_m_;
  std::vector<double> errors_deg_;
  std::vector<double> nees_;
  std::vector<double> alternatives_;
  std::vector<double> ms_;
  std::vector<double> true_likelihoods_;
  std::vector<double> false_likelihoods_;
};

struct NamedRun {
  std::string name;
  std::function<MappedRun()> make;
};

std::vector<NamedRun> all_runs() {
  std::vector<NamedRun> runs;
  const auto add = [&](const std::string& name, const char* log, const char* relations) {
    const auto log_path = test::find_recording(std::string("laser2d/") + log);
    const auto relations_path = test::find_recording(std::string("laser2d/") + relations);
    if (!log_path || !relations_path) return;
    for (const bool odometry : {true, false}) {
      runs.push_back({name + (odometry ? " | yes" : " | no"),
                      [=] { return map_recording(*log_path, *relations_path, odometry); }});
    }
  };
  add("CSAIL", "csail_raw.log.gz", "csail.relations");
  add("Intel", "intel_raw.log.gz", "intel.relations");
  add("FR079", "fr079_chain.log.gz", "fr079.relations");
  for (const char* name : {"acapulco", "seattle"}) {
    const auto log = test::find_recording(std::string("laser2d/") + name + "_scans.log.gz");
    if (log) runs.push_back({std::string(name) + " | no", [=] { return map_corrected(*log); }});
  }
  for (const int seed : {1, 2, 3}) {
    runs.push_back(
        {format("sample mine %d | no", seed), [=] { return map_sample(seed, seed == 2, false); }});
  }
  return runs;
}

void print_gaps(const std::string& name, const MappedRun& run, const Options& options) {
  const QuadrilateralGaps gaps = close_quadrilaterals(run, options.matching);
  const Scatter scatter = scatter_of_relations(run);
  std::cout << format("| %s | %zu | %.4f | %.2f | %.2f | %.2f | %.3f | %.2f |\n", name.c_str(),
                      gaps.metres.size(), mean(gaps.metres), mean(gaps.degrees),
                      mean(gaps.normalised), quantile(gaps.normalised, 0.5), scatter.sd_m,
                      rad_to_deg(scatter.sd_rad));
}

void print_displacements(const std::string& name, const MappedRun& run) {
  for (const DisplacementScore& s : score_displacements(run, {})) {
    if (s.count < 5) continue;
    std::cout << format("| %s | %.0f to %.0f | %d | %.2f | %.2f | %.3f | %.3f | %.2f | %.2f |\n",
                        name.c_str(), s.from_m, s.to_m, s.count, s.nees, s.nees_median,
                        s.translation_m, s.sd_m, s.rotation_deg, s.sd_deg);
  }
}

void print_tables(const Options& options) {
  std::vector<std::pair<std::string, MappedRun>> runs;
  for (const NamedRun& run : all_runs()) {
    if (run.name.find(options.only) != std::string::npos) runs.emplace_back(run.name, run.make());
  }
  print_heading(
      "| log | odometry | maps | true pairs | best at the place | best right | any right "
      "| best right, of matched pairs | false pairs accepted "
      "| error, mean (median) (m) | error (°) | normalized error squared (median) "
      "| alternatives | degenerate | ms | p99 "
      "| log likelihood: right, 10 % and 50 %; accepted false, 50 % and 100 % |");
  for (const auto& [name, run] : runs) {
    MatchStatistics statistics(run, options);
    statistics.match_true_pairs();
    statistics.match_false_pairs();
    statistics.print(name);
  }
  std::cout << "\n";
  print_heading(
      "| log | odometry | quadrilaterals | gap (m) | gap (°) | normalized gap squared, mean "
      "| median | scatter of the relations (m) | (°) |");
  for (const auto& [name, run] : runs) print_gaps(name, run, options);
  std::cout << "\n";
  print_heading(
      "| log | odometry | path length (m) | displacements | normalized error squared, mean | "
      "median "
      "| error (m) | model, sd (m) | error (°) | model, sd (°) |");
  for (const auto& [name, run] : runs) print_displacements(name, run);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Matching of local maps on all recordings, as tables in Markdown");
  adit::Options options;
  app.add_option("--sd-m", options.sd_m, "Standard deviation of the predicted position, per axis")
      ->capture_default_str();
  app.add_option("--sd-deg", options.sd_deg, "Standard deviation of the predicted heading")
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "Predictions for each true pair")->capture_default_str();
  app.add_option("--neighbours", options.neighbours,
                 "Local maps on each side of the older one that are matched with it")
      ->capture_default_str();
  app.add_option("--only", options.only, "Only runs whose name contains this text");
  app.add_flag("--verbose", options.verbose, "Print all alternatives of every true pair");
  app.add_option("--config", options.config, "YAML file with section map_matching");
  CLI11_PARSE(app, argc, argv);
  if (!options.config.empty()) {
    options.matching = adit::load_section<adit::MapMatchingParams>(
        adit::ConfigFile::load(options.config), "map_matching");
  }
  adit::print_tables(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "loop_closures_table: " << error.what() << "\n";
  return 2;
}
