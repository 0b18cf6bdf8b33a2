// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/search_run.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <poll.h>

#include "common/files/file_utils.hpp"
#include "common/service/wall_time.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/local_runner.hpp"
#include "tools/search/cross_entropy.hpp"
#include "tools/search/search_report.hpp"
#include "tools/search/search_units.hpp"
#include "tools/search/shrinking.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr double kSamplingShare = 2.0 / 3.0;  // of the time limit; the rest is for shrinking
constexpr int kBatchesWithoutUnitMax = 20;    // then a discrete space is taken for exhausted

class SearchSequence {
 public:
  SearchSequence(const SearchOptions& options, const SearchFile& file, const CampaignFolder& folder,
                 const std::function<void(const SearchProgress&)>& progress)
      : options_(options), file_(file), tell_(progress), units_(file, folder, options.programs) {
    runner_.jobs = options.jobs > 0 ? options.jobs : LocalRunner::jobs_for(file.campaign.cores);
    runner_.watcher = options.programs / "adit-watch";
    runner_.stop_descriptor = options.stop_descriptor;
    progress_.units_max = options.units_max.value_or(file.search.units_max);
    if (options.time_max_s) {
      deadline_us_ = begin_us_ + microseconds(*options.time_max_s);
      sampling_deadline_us_ = begin_us_ + microseconds(kSamplingShare * *options.time_max_s);
    }
  }

  SearchResult run() {
    sample();
    progress_.is_shrinking = true;
    std::map<std::string, ShrunkPoint> shrunk;
    while (const auto kind = next_kind(shrunk)) shrunk[*kind] = shrink_kind(*kind);
    return result(shrunk);
  }

 private:
  static std::int64_t microseconds(double seconds) {
    return static_cast<std::int64_t>(1e6 * seconds);
  }

  /// The first that is not shrunk yet. Shrinking may find further ones.
  std::optional<std::string> next_kind(const std::map<std::string, ShrunkPoint>& shrunk) {
    for (const FoundKind& kind : kinds_found()) {
      if (!shrunk.contains(kind.kind)) return kind.kind;
    }
    return std::nullopt;
  }

  void sample() {
    CrossEntropyParams params;
    params.batch = file_.search.batch;
    params.uniform_share = file_.search.uniform_share;
    CrossEntropy cross_entropy(file_.space, params, static_cast<std::uint64_t>(file_.search.seed));
    int without_unit = 0;
    while (without_unit < kBatchesWithoutUnitMax && !has_enough(sampling_deadline_us_)) {
      std::vector<SearchPoint> points = cross_entropy.sample();
      const std::size_t before = units_.plan().units.size();
      const auto left = static_cast<std::size_t>(progress_.units_max) - before;
      const bool is_last = points.size() > left;
      if (is_last) points.resize(left);
      const auto evaluations = evaluate(points, sampling_deadline_us_);
      restarts_ = cross_entropy.restarts();
      if (!evaluations || is_last) return;
      cross_entropy.update(*evaluations);
      without_unit = units_.plan().units.size() > before ? 0 : without_unit + 1;
    }
  }

  bool has_enough(std::int64_t deadline_us) const {
    return is_stopped() || steady_us() >= deadline_us || has_enough_kinds() ||
           static_cast<int>(units_.plan().units.size()) >= progress_.units_max;
  }

  bool is_stopped() const {
    pollfd descriptor{options_.stop_descriptor, POLLIN, 0};
    return options_.stop_descriptor >= 0 && poll(&descriptor, 1, 0) > 0;
  }

  std::optional<std::vector<Evaluation>> evaluate(const std::vector<SearchPoint>& points,
                                                  std::int64_t deadline_us) {
    const std::vector<std::size_t> indices = units_.add(points);
    count_all();
    const auto on_unit = [&](const SearchUnit& unit) {
      count(unit);
      return steady_us() < deadline_us && !has_enough_kinds();
    };
    if (has_enough_kinds() || !units_.run(runner_, on_unit)) return std::nullopt;
    const std::vector<SearchUnit> all = units_.with_result();  // now the whole plan
    std::vector<Evaluation> evaluations;
    for (const std::size_t i : indices) evaluations.push_back(all.at(i).evaluation);
    return evaluations;
  }

  bool has_enough_kinds() const {
    const int kinds_max = file_.search.kinds_max;
    return !progress_.is_shrinking && kinds_max > 0 && static_cast<int>(kinds_.size()) >= kinds_max;
  }

  /// Of earlier runs, too.
  void count_all() {
    progress_.units = progress_.failures = 0;
    for (const SearchUnit& unit : units_.with_result()) {
      ++progress_.units;
      if (unit.evaluation.kind.empty()) continue;
      ++progress_.failures;
      kinds_.insert(unit.evaluation.kind);
    }
  }

  /// Tells the progress after a unit that has run.
  void count(const SearchUnit& unit) {
    ++run_;
    const std::string& kind = unit.evaluation.kind;
    const bool is_new = !kind.empty() && kinds_.insert(kind).second;
    if (!tell_) return;
    ++progress_.units;
    progress_.failures += !kind.empty();
    progress_.kinds = static_cast<int>(kinds_.size());
    progress_.new_kind = is_new ? kind : "";
    progress_.new_kind_id = is_new ? unit.unit->id : "";
    const double elapsed_s = 1e-6 * static_cast<double>(steady_us() - begin_us_);
    progress_.time_to_go_s = elapsed_s / run_ * std::max(progress_.units_max - progress_.units, 0);
    tell_(progress_);
  }

  ShrunkPoint shrink_kind(const std::string& kind) {
    std::vector<SearchUnit> failing = units_.with_result();
    std::erase_if(failing, [&](const SearchUnit& unit) { return unit.evaluation.kind != kind; });
    const auto complexity = [&](const SearchUnit& unit) {
      return file_.space.complexity(unit.point);
    };
    const SearchPoint start = std::ranges::min_element(failing, {}, complexity)->point;
    const Reproduces reproduces =
        [&](const std::vector<SearchPoint>& points) -> std::optional<std::vector<bool>> {
      if (is_stopped() || steady_us() >= deadline_us_) return std::nullopt;
      const auto evaluations = evaluate(points, deadline_us_);
      if (!evaluations) return std::nullopt;
      std::vector<bool> fails;
      for (const Evaluation& evaluation : *evaluations) fails.push_back(evaluation.kind == kind);
      return fails;
    };
    return shrink(file_.space, start, file_.search.shrink_max, reproduces);
  }

  /// Each with the first unit in place of the simplest.
  std::vector<FoundKind> kinds_found() {
    std::vector<FoundKind> kinds;
    double cpu_s = 0.0;
    for (const SearchUnit& unit : units_.with_result()) {
      cpu_s += unit.cpu_s;
      const std::string& kind = unit.evaluation.kind;
      if (kind.empty()) continue;
      auto found = std::ranges::find(kinds, kind, &FoundKind::kind);
      if (found == kinds.end()) {
        FoundKind first;
        first.kind = kind;
        first.first_unit = unit.unit->number;
        first.first_cpu_s = cpu_s;
        set_simplest(first, unit);
        found = kinds.insert(kinds.end(), std::move(first));
      }
      ++found->failures;
    }
    return kinds;
  }

  void set_simplest(FoundKind& kind, const SearchUnit& unit) const {
    kind.simplest = *unit.unit;
    kind.command = shell_line(units_.plan(), *unit.unit, "repeat_" + unit.unit->id);
    kind.parameters.clear();
    for (std::size_t i = 0; i < unit.point.size(); ++i) {
      const SpaceParameter& parameter = file_.space.parameters[i];
      if (unit.point[i] == parameter.simple) continue;
      kind.parameters += fmt::format("{}{} {}", kind.parameters.empty() ? "" : ", ", parameter.name,
                                     parameter.written(unit.point[i]).text);
    }
  }

  SearchResult result(const std::map<std::string, ShrunkPoint>& shrunk) {
    SearchResult result;
    result.name = file_.campaign.name;
    result.restarts = restarts_;
    result.interrupted = is_stopped();
    result.kinds = kinds_found();
    for (const SearchUnit& unit : units_.with_result()) {
      ++result.units;
      result.cpu_s += unit.cpu_s;
      result.failures += !unit.evaluation.kind.empty();
      const auto found = shrunk.find(unit.evaluation.kind);
      if (found == shrunk.end() || found->second.point != unit.point) continue;
      FoundKind& kind = *std::ranges::find(result.kinds, unit.evaluation.kind, &FoundKind::kind);
      set_simplest(kind, unit);
      kind.shrink_units = found->second.evaluated;
      kind.is_minimal = found->second.is_minimal;
    }
    return result;
  }

  const SearchOptions& options_;
  const SearchFile& file_;
  const std::function<void(const SearchProgress&)>& tell_;
  SearchUnits units_;
  LocalRunner runner_;
  SearchProgress progress_;
  std::set<std::string> kinds_;
  std::int64_t begin_us_ = steady_us();
  std::int64_t deadline_us_ = INT64_MAX;
  std::int64_t sampling_deadline_us_ = INT64_MAX;
  int run_ = 0;  ///< units in this run
  int restarts_ = 0;
};

}  // namespace

SearchResult run_search(const SearchOptions& options,
                        const std::function<void(const SearchProgress&)>& progress) {
  const SearchFile file = load_search_file(options.file);
  const CampaignFolder folder{fs::absolute(options.folder)};
  NewCampaignFolder new_folder(folder);
  SearchSequence sequence(options, file, folder, progress);  // checks the file
  new_folder.keep();
  SearchResult result = sequence.run();
  write_text_file(search_report(result), folder.path / "search.md");
  return result;
}

}  // namespace adit
