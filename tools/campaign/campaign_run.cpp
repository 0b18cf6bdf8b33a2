// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/campaign_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/locked_file.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/page/campaign_html.hpp"
#include "tools/campaign/results/comparison.hpp"
#include "tools/campaign/results/result_table.hpp"
#include "tools/campaign/results/stopping_rule.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/local_runner.hpp"
#include "tools/campaign/slurm/slurm_queue.hpp"
#include "tools/campaign/slurm/slurm_runner.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

using Notify = std::function<void(const CampaignProgress&)>;
using Tell = std::function<void(const std::string&)>;

fs::path programs_of(const CampaignOptions& options) {
  return options.programs.empty() ? own_program_folder() : options.programs;
}

fs::path folder_of(const fs::path& file) { return fs::absolute(file).parent_path(); }

class CampaignRun {
 public:
  CampaignRun(const CampaignOptions& options, CampaignDefinition definition, CampaignPlan plan)
      : options_(options),
        definition_(std::move(definition)),
        plan_(std::move(plan)),
        folder_{fs::absolute(options.folder)},
        lock_(folder_.lock()),
        file_text_(read_text_file(options.file)),
        table_(folder_, definition_, plan_, options.file.string(), file_text_),
        rule_(definition_, table_.database()) {}

  CampaignResult run(const Notify& progress, const Tell& notify) {
    write_plan(plan_, folder_.plan());
    table_.synchronize(plan_);
    CampaignResult result;
    result.stopped_after = rule_.update();
    if (!result.stopped_after) {
      result.interrupted = !run_missing(progress, notify);
      result.stopped_after = rule_.update();
    }
    result.units = result.stopped_after.value_or(static_cast<int>(plan_.units.size()));
    table_.limit_rows(result.units);
    result.with_result = count_results();
    result.rates = measure_rates(definition_, table_.database());
    folder_.remove_old_attempts();
    write_page(result);
    return result;
  }

 private:
  bool run_missing(const Notify& progress, const Tell& notify) {
    const std::vector<const CampaignUnit*> missing = table_.units_without_result(plan_);
    table_.begin_run();
    CampaignProgress state;
    state.to_run = static_cast<int>(missing.size());
    const auto on_result = [&](const CampaignUnit& unit, const UnitResult& result) {
      table_.add(unit, result);
      ++state.run;
      state.failed += result.state != UnitState::kEnded;
      if (progress) progress(state);
      return !rule_.update();
    };
    folder_.remove_old_attempts();
    if (options_.on_slurm) {
      SlurmRunner runner;
      runner.programs = programs_of(options_);
      runner.cores = definition_.cores;
      runner.jobs = options_.jobs;
      runner.stop_descriptor = options_.stop_descriptor;
      runner.notify = notify;
      return runner.run(plan_, missing, folder_, on_result);
    }
    LocalRunner runner;
    runner.jobs = options_.jobs > 0 ? options_.jobs : LocalRunner::jobs_for(definition_.cores);
    runner.watcher = programs_of(options_) / "adit-watch";
    runner.stop_descriptor = options_.stop_descriptor;
    return runner.run(plan_, missing, folder_, on_result);
  }

  void write_page(const CampaignResult& result) {
    CampaignPage page = describe_campaign(definition_, table_.database());
    page.stopped_after = result.stopped_after;
    page.file_text = file_text_;
    if (options_.compare) {
      page.compared_with = options_.compare->string();
      page.comparisons = compare_campaigns(table_, definition_, *options_.compare);
    }
    write_text_file(campaign_html(page, folder_), folder_.page());
  }

  int count_results() {
    SqlStatement count =
        table_.database().prepare("SELECT count(*) FROM campaign WHERE state IS NOT NULL");
    count.step();
    return static_cast<int>(count.integer(0));
  }

  const CampaignOptions& options_;
  CampaignDefinition definition_;
  CampaignPlan plan_;
  CampaignFolder folder_;
  LockedFile lock_;
  std::string file_text_;
  ResultTable table_;
  StoppingRule rule_;
};

}  // namespace

bool CampaignResult::succeeded() const {
  return is_complete() && std::ranges::none_of(rates, [](const Rate& rate) {
           return rate.verdict() == RateVerdict::kNotMet;
         });
}

CampaignResult run_campaign(const CampaignOptions& options,
                            const std::function<void(const CampaignProgress&)>& progress,
                            const std::function<void(const std::string&)>& notify) {
  const ConfigFile file = ConfigFile::load(options.file);
  CampaignDefinition definition = load_campaign(file);
  const fs::path folder = folder_of(options.file);
  CampaignPlan plan = make_plan(definition, expand_matrix(file, folder), options.file.string(),
                                folder, programs_of(options));
  if (options.compare) require_campaign(*options.compare);
  if (options.on_slurm) SlurmQueue(programs_of(options) / "adit-watch").require_installed();
  NewCampaignFolder new_folder({fs::absolute(options.folder)});
  CampaignRun run(options, std::move(definition), std::move(plan));  // checks the file
  new_folder.keep();
  return run.run(progress, notify);
}

bool run_campaign_unit(const fs::path& folder_path, const std::string& id, int stop_descriptor,
                       const fs::path& programs) {
  const CampaignFolder folder{fs::absolute(folder_path)};
  if (fs::exists(folder.result(id))) return true;
  const CampaignPlan plan = read_plan(folder.plan(), id);
  LocalRunner runner;
  runner.watcher = programs / "adit-watch";
  runner.stop_descriptor = stop_descriptor;
  return runner.run(plan, {&plan.units.front()}, folder,
                    [](const auto&, const auto&) { return true; });
}

}  // namespace adit
