// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// closures_table [--sd-m S] [--sd-deg S] [--seeds N]: how well local maps are matched onto each
// other, over every recording that has relations and drives through sample mines: tables in
// Markdown. Predictions are the truth, disturbed; false pairs are maps of different places that are
// offered as one.
#include <algorithm>
#include <cmath>
#include <cstdio>
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
#include "procs/mapping/map_matching.hpp"
#include "tests/eval/closure_runs.hpp"
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

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto i = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + i, values.end());
  return values[i];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

bool right(const ClosureAlternative& alternative, const Pose2& truth) {
  const Pose2 off = between(truth, alternative.T_older_newer);
  // Where the maps slide on each other nothing is claimed: only what is claimed can be wrong.
  return off.translation().norm() < 0.25 && std::abs(off.theta) < deg_to_rad(3.0);
}

class Table {
 public:
  Table(const MappedRun& run, const Options& options)
      : run_(run), options_(options), scatter_(scatter_of_relations(run)) {}

  void match_true_pairs() {
    for (const auto& [pair, truth] : true_pairs(run_)) {
      for (int seed = 0; seed < options_.seeds; ++seed) match(pair.first, pair.second, truth, true);
    }
  }

  /// Around a quadrilateral of two maps and the next ones, the matches and the displacements
  /// between must add up to nothing. Known without any truth.
  void go_around() {
    const auto pairs = true_pairs(run_);
    for (const auto& [pair, truth] : pairs) {
      const auto [j, k] = pair;
      if (k + 1 >= static_cast<int>(run_.maps.size())) continue;
      const Pose2 T_k_next = run_.maps[k + 1].T_previous_local;
      for (const int side : {j + 1, j - 1}) {
        if (side < 0 || k + 1 - side < 3) continue;
        const Pose2 T_j_side = between(run_.maps[j].T_odom_local, run_.maps[side].T_odom_local);
        const Pose2 expected = T_j_side.inverse() * truth * T_k_next;
        if (expected.translation().norm() > 3.0) continue;
        add_quadrilateral(j, k, side, truth, expected);
        break;
      }
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
        if (falses_ >= 300) return;
        match(older, newer, {0.0, 0.0, uniform_(random_)}, false);
      }
    }
  }

  void print(const std::string& name) const {
    std::cout << format("| %s | %zu | %d | %.3f | %.3f | %.3f | %d / %d |", name.c_str(),
                        run_.maps.size(), trues_, share(best_right_), share(any_right_),
                        right_of_first(), false_accepted_, falses_)
              << format(" %.4f (%.4f) | %.3f | %.2f (%.2f) | %.2f | %zu | %.1f | %.1f |",
                        mean(errors_m_), quantile(errors_m_, 0.5), mean(errors_deg_), mean(nees_),
                        quantile(nees_, 0.5), mean(alternatives_), degenerate_, mean(ms_),
                        quantile(ms_, 0.99))
              << format(" %.3f, %.2f |", scatter_.sd_m, rad_to_deg(scatter_.sd_rad))
              << format(" %zu | %.4f | %.2f | %.2f (%.2f) |", around_m_.size(), mean(around_m_),
                        mean(around_deg_), mean(around_nees_), quantile(around_nees_, 0.5))
              << format(" %.1f, %.1f; %.1f, %.1f |\n", quantile(true_likelihoods_, 0.1),
                        quantile(true_likelihoods_, 0.5), quantile(false_likelihoods_, 0.5),
                        quantile(false_likelihoods_, 1.0))
              << std::flush;
  }

 private:
  [[nodiscard]] double share(int count) const { return count / std::max(1.0, 1.0 * trues_); }

  /// Of the matches of true pairs that gave anything, how many had the right one first.
  [[nodiscard]] double right_of_first() const { return best_right_ / std::max(1.0, 1.0 * given_); }

  [[nodiscard]] std::vector<ClosureAlternative> match_alone(int older, int newer,
                                                            const Pose2& expected) const {
    RelativePose predicted{expected, Eigen::Vector3d(0.09, 0.09, 0.01).asDiagonal()};
    return match_maps(run_.walls[newer], {{&run_.walls[older], {}}}, older, predicted,
                      options_.matching);
  }

  void add_quadrilateral(int j, int k, int side, const Pose2& T_j_k, const Pose2& T_side_next) {
    const auto first = match_alone(j, k, T_j_k);
    const auto second = match_alone(side, k + 1, T_side_next);
    if (first.empty() || second.empty()) return;
    if (!whole(first.front()) || !whole(second.front())) return;
    const LocalMap& later = run_.maps[std::max(j, side)];
    const Pose2 T_j_side = side > j ? later.T_previous_local : later.T_previous_local.inverse();
    const Pose2 T_k_next = run_.maps[k + 1].T_previous_local;
    // Both ways from j to k + 1; all covariances are taken to the frame of k + 1.
    const Pose2 one = first.front().T_older_newer * T_k_next;
    const Pose2 other = T_j_side * second.front().T_older_newer;
    const auto moved = [](const Eigen::Matrix3d& information, const Pose2& T_to_from) {
      const Eigen::Matrix3d Ad = adjoint(T_to_from);
      return Eigen::Matrix3d(Ad * information.inverse() * Ad.transpose());
    };
    const Pose2 T_next_later = side > j ? second.front().T_older_newer.inverse()
                                        : (T_j_side * second.front().T_older_newer).inverse();
    const Eigen::Matrix3d covariance = moved(first.front().information, T_k_next.inverse()) +
                                       run_.maps[k + 1].information.inverse() +
                                       second.front().information.inverse() +
                                       moved(later.information, T_next_later);
    const Eigen::Vector3d off = between(one, other).vector();
    around_nees_.push_back(off.dot(covariance.inverse() * off));
    around_m_.push_back(off.head<2>().norm());
    around_deg_.push_back(rad_to_deg(std::abs(off.z())));
  }

  static bool whole(const ClosureAlternative& a) {
    return a.information.ldlt().rcond() > 0.0 && a.information.determinant() > 1e3;
  }

  void match(int older, int newer, const Pose2& truth, bool is_true) {
    const double sd_rad = deg_to_rad(options_.sd_deg);
    const Eigen::Vector3d sd(options_.sd_m, options_.sd_m, sd_rad);
    const Eigen::Vector3d off(normal_(random_), normal_(random_), normal_(random_));
    RelativePose predicted;
    predicted.T_older_newer = truth * Pose2::from_vector(off.cwiseProduct(sd));
    predicted.covariance = sd.cwiseAbs2().asDiagonal();
    const std::clock_t start = std::clock();
    const auto found =
        match_maps(run_.walls[newer], place(older), older, predicted, options_.matching);
    ms_.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (is_true) {
      count_true(older, newer, truth, found);
    } else if (!coincide(older, newer, found)) {
      ++falses_;
      false_accepted_ += found.empty() ? 0 : 1;
      if (!found.empty()) false_likelihoods_.push_back(found.front().log_likelihood);
    }
  }

  /// Is the alternative where the maps truly lie? A wide gate around the wrong place may hold it.
  [[nodiscard]] bool coincide(int older, int newer,
                              const std::vector<ClosureAlternative>& found) const {
    const Pose2 apart = between(run_.maps[older].T_odom_local, run_.maps[newer].T_odom_local);
    return std::any_of(found.begin(), found.end(), [&](const ClosureAlternative& a) {
      const Pose2 off = between(apart, a.T_older_newer);
      return off.translation().norm() < 2.0 && std::abs(off.theta) < 0.3;
    });
  }

  void count_true(int older, int newer, const Pose2& truth,
                  const std::vector<ClosureAlternative>& found) {
    ++trues_;
    given_ += found.empty() ? 0 : 1;
    alternatives_.push_back(static_cast<double>(found.size()));
    const auto hit =
        std::find_if(found.begin(), found.end(), [&](const auto& a) { return right(a, truth); });
    any_right_ += hit != found.end() ? 1 : 0;
    best_right_ += !found.empty() && hit == found.begin() ? 1 : 0;
    if (options_.verbose) report(older, newer, truth, found);
    if (hit == found.end()) return;
    const Eigen::Vector3d off = between(truth, hit->T_older_newer).vector();
    errors_m_.push_back(off.head<2>().norm());
    errors_deg_.push_back(rad_to_deg(std::abs(off.z())));
    true_likelihoods_.push_back(hit->log_likelihood);
    if (!whole(*hit)) {
      ++degenerate_;
    } else {
      const Eigen::Matrix3d covariance = hit->information.inverse() + scatter_.covariance();
      nees_.push_back(off.dot(covariance.inverse() * off));
    }
  }

  static void report(int older, int newer, const Pose2& truth,
                     const std::vector<ClosureAlternative>& found) {
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
    std::vector<PlacedWalls> placed{{&run_.walls[older], {}}};
    for (int k = 1; k <= options_.neighbours; ++k) {
      for (const int other : {older - k, older + k}) {
        if (other < 0 || other >= static_cast<int>(run_.maps.size())) continue;
        placed.push_back({&run_.walls[other],
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
  int trues_ = 0;
  int given_ = 0;
  int best_right_ = 0;
  int any_right_ = 0;
  int falses_ = 0;
  int false_accepted_ = 0;
  std::size_t degenerate_ = 0;
  std::vector<double> errors_m_;
  std::vector<double> errors_deg_;
  std::vector<double> nees_;
  std::vector<double> around_nees_;
  std::vector<double> around_m_;
  std::vector<double> around_deg_;
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
  for (const std::uint64_t seed : {1, 2, 3}) {
    runs.push_back({format("sample mine %d | no", static_cast<int>(seed)),
                    [=] { return map_sample(seed, seed == 2, false); }});
  }
  return runs;
}

void print_drift(const std::string& name, const MappedRun& run) {
  for (const DriftScore& s : score_drift(run, {})) {
    if (s.count < 5) continue;
    std::cout << format("| %s | %.0f to %.0f | %d | %.2f | %.2f | %.3f | %.3f | %.2f | %.2f |\n",
                        name.c_str(), s.from_m, s.to_m, s.count, s.nees, s.nees_median,
                        s.translation_m, s.sd_m, s.rotation_deg, s.sd_deg);
  }
}

}  // namespace

void print_tables(const Options& options) {
  std::vector<std::pair<std::string, MappedRun>> runs;
  for (const NamedRun& run : all_runs()) {
    if (run.name.find(options.only) != std::string::npos) runs.emplace_back(run.name, run.make());
  }
  std::cout
      << "| log | odometry | maps | true pairs | best is right | any is right "
         "| best is right, of those with any | false pairs accepted "
         "| error, mean (median) (m) | error (°) | normalised error squared (median) "
         "| alternatives | degenerate | ms | p99 "
         "| scatter of the relations (m, °) | quadrilaterals | gap (m) | gap (°) "
         "| normalised gap squared (median) "
         "| log likelihood: right, 10 % and 50 %; of accepted false, 50 % and most |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [name, run] : runs) {
    Table table(run, options);
    table.match_true_pairs();
    table.match_false_pairs();
    table.go_around();
    table.print(name);
  }
  std::cout << "\n| log | odometry | way (m) | displacements | normalised error squared, mean "
               "| median | error (m) | model, sd (m) | error (°) | model, sd (°) |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [name, run] : runs) print_drift(name, run);
}

}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Matching of local maps over all recordings, as tables in Markdown");
  adit::Options options;
  app.add_option("--sd-m", options.sd_m, "of the prediction, each axis")->capture_default_str();
  app.add_option("--sd-deg", options.sd_deg, "of its heading")->capture_default_str();
  app.add_option("--seeds", options.seeds, "predictions for each true pair")->capture_default_str();
  app.add_option("--neighbours", options.neighbours,
                 "local maps on each side of the older one that are matched with it")
      ->capture_default_str();
  app.add_option("--only", options.only, "runs whose name contains this");
  app.add_flag("--verbose", options.verbose, "every true pair, with all alternatives");
  app.add_option("--config", options.config, "YAML file with a section map_matching");
  CLI11_PARSE(app, argc, argv);
  if (!options.config.empty()) {
    options.matching = adit::load_section<adit::MapMatchingParams>(
        adit::ConfigFile::load(options.config), "map_matching");
  }
  adit::print_tables(options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "closures_table: " << error.what() << "\n";
  return 2;
}
