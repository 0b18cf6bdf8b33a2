// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/node/stop_signal.hpp"
#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/campaign/campaign_run.hpp"
#include "tools/campaign/campaign_status.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

constexpr int kExitNotMet = 1;

struct CampaignCommand {
  CampaignOptions campaign;
  std::string on = "local";
  std::string compare;
  std::filesystem::path folder;  // of the sub-commands
  std::string id;
};

constexpr const char* kCampaignDetails =
    R"(Runs a command for every combination of parameters, as FILE describes:

  campaign:
    command: adit mission random --seed {seed} --in-process --out {out}
    exit_codes: [0, 1]                    of units with a result; 1: the robot did not return
    time_max_s: 900                       limits of a unit
    memory_max_mb: 4000
    remove: "*.lcmlog *.journal"          outputs that are not kept
    report: mission.html                  output to which the page links
    scores:                               columns of the table, from files of the unit
      - {name: outcome, file: summary.json, pointer: /mission/outcome}
      - {name: rmse_m, file: summary.json, pointer: /against_truth/rmse_m}
    rates:                                what is asked for, as SQL expressions
      - {name: home, condition: outcome == "home", min: 0.99}
    distributions:
      - {name: RMSE (m), value: rmse_m}
    worst: rmse_m                         the largest is the worst
  matrix:
    seed: {from: 1, to: 100}              or a list, or {files: logs/*.log}

Paths are relative to the folder of FILE. A unit is known by its command and the content of its inputs and program:
the same command continues a campaign that was killed, and runs what has changed. A unit that crashes or exceeds a
limit is a row with its reason.

Outputs in DIR:
  campaign.html   rates with 95 % intervals, distributions, the worst units with the command that repeats each
  campaign.db     SQLite: the view campaign has a row for each unit, also while it runs
  units/ID/       outputs of a unit (out), what it printed (output.log), how it ended (result.json)

docs/howto/campaigns.md explains all keys.)";

constexpr const char* kCampaignExitCodes =
    "  1  a rate is outside its bounds, or units have no result since the campaign was interrupted";

constexpr const char* kCampaignExamples =
    R"(  adit campaign tests/campaigns/random.yaml --out random
  adit campaign random.yaml --out random --on slurm      on a cluster; DIR is on a disk that all nodes share
  adit campaign random.yaml --out new --compare random   which units changed
  adit campaign status random                            while it runs
  sqlite3 random/campaign.db 'select seed, reason from campaign where state <> "ended"')";

constexpr const char* kStatusDetails =
    R"(Prints the units with a result, how they ended, the rates, and while the campaign runs the time to go at the
pace since it was started. Reads DIR/campaign.db; changes nothing.)";

constexpr const char* kRunUnitDetails =
    R"(Runs the unit ID of DIR/plan.jsonl within the limits of the campaign, and writes DIR/units/ID with its result. Does
nothing if it has a result. This is what each task of Slurm runs; adit campaign takes the result into its table.)";

std::string rate_line(const Rate& rate) {
  const ShareInterval interval = rate.interval();
  std::string line = fmt::format("  {}: {} of {}, 95 % interval {:.1f} to {:.1f} %",
                                 rate.definition.name, rate.count(), rate.counts.total(),
                                 100.0 * interval.lower, 100.0 * interval.upper);
  if (rate.counts.unknown > 0) line += fmt::format(", {} unknown", rate.counts.unknown);
  switch (rate.verdict()) {
    case RateVerdict::kNotAsked:
    case RateVerdict::kNotCounted:
      return line;
    case RateVerdict::kShown:
      return line + ": within its bounds";
    case RateVerdict::kMet:
      return line + ": within its bounds, its interval is not";
    case RateVerdict::kNotMet:
      return line + ": OUTSIDE ITS BOUNDS";
  }
  return line;
}

void run(const CampaignCommand& command) {
  CampaignOptions options = command.campaign;
  if (options.file.empty()) throw std::invalid_argument("FILE is required");
  if (options.folder.empty()) throw std::invalid_argument("--out is required");
  options.on_slurm = command.on == "slurm";
  if (!command.compare.empty()) options.compare = command.compare;
  CampaignResult result;
  {
    const StopSignal stop;
    options.stop_descriptor = stop.descriptor();
    std::optional<ProgressBar> bar;
    result = run_campaign(
        options,
        [&](const CampaignProgress& progress) {
          if (!bar) bar.emplace(fmt::format("{} units", progress.to_run));
          bar->update(static_cast<double>(progress.run) / progress.to_run);
        },
        [&](const std::string& message) {
          bar.reset();
          print_error("adit campaign", message);
        });
  }
  std::cout << fmt::format("{} of {} units have a result{}\n", result.with_result, result.units,
                           result.stopped_after ? ", which suffices for the rates" : "");
  for (const Rate& rate : result.rates) std::cout << message_line(rate_line(rate)) << "\n";
  std::cout << (options.folder / "campaign.html").string() << "\n";
  if (result.interrupted)
    print_error("adit campaign", "interrupted; the same command continues it");
  if (!result.succeeded()) throw CLI::RuntimeError(kExitNotMet);
}

void print_status(const CampaignCommand& command) {
  const CampaignStatus status = read_campaign_status(command.folder);
  std::cout << message_line(fmt::format("{}: {} of {} units have a result, {}", status.name,
                                        status.with_result, status.units,
                                        status.is_running ? "running" : "not running"));
  if (status.time_to_go_s) std::cout << ", " << duration_text(*status.time_to_go_s) << " to go";
  std::cout << "\n";
  for (const auto& [state, count] : status.states)
    std::cout << fmt::format("  {}: {}\n", state, count);
  for (const Rate& rate : status.rates) std::cout << message_line(rate_line(rate)) << "\n";
}

void run_unit(const CampaignCommand& command) {
  const StopSignal stop;
  if (!run_campaign_unit(command.folder, command.id, stop.descriptor()))
    throw std::runtime_error("interrupted; the unit has no result");
}

}  // namespace

void add_campaign_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "campaign", "Run a command over many parameters, and count how it ends");
  set_help(*command, {kCampaignDetails, kCampaignExitCodes, kCampaignExamples});
  const auto options = std::make_shared<CampaignCommand>();
  command->add_option("FILE", options->campaign.file, "YAML file of the campaign")
      ->type_name("FILE");
  command->add_option("--out", options->campaign.folder, "Output folder; created or continued")
      ->type_name("DIR");
  command->add_option("--on", options->on, "local: on this computer; slurm: on a cluster")
      ->type_name("NAME")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command
      ->add_option("--jobs", options->campaign.jobs,
                   "Units at the same time; default: cores of this computer")
      ->type_name("N")
      ->check(number_in(within(1, 100'000)));
  command->add_option("--compare", options->compare, "Folder of an earlier campaign")
      ->type_name("DIR");
  command->require_subcommand(0, 1);
  CLI::App* status = add_command(*command, "status", "Print how far a campaign is");
  set_help(*status, {kStatusDetails, "", "  adit campaign status random"});
  status->add_option("DIR", options->folder, "Folder of the campaign")
      ->type_name("DIR")
      ->required();
  status->callback([options] { print_status(*options); });
  CLI::App* unit = add_command(*command, "run-unit", "Run one unit, as tasks of Slurm do");
  set_help(*unit, {kRunUnitDetails, "", "  adit campaign run-unit random 2b3c51d11f2648ef"});
  unit->add_option("DIR", options->folder, "Folder of the campaign")->type_name("DIR")->required();
  unit->add_option("ID", options->id, "Name of the unit: its folder in DIR/units")
      ->type_name("NAME")
      ->required();
  unit->callback([options] { run_unit(*options); });
  command->callback([options, command] {
    if (command->get_subcommands().empty()) run(*options);
  });
}

}  // namespace adit
