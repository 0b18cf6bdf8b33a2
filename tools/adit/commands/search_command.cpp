// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/node/stop_signal.hpp"
#include "common/command_line/command_line.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/report/text_format.hpp"
#include "tools/search/search_run.hpp"

namespace adit {
namespace {

constexpr int kExitFailuresFound = 1;

constexpr const char* kSearchDetails =
    R"(Searches the parameters of a command for those with which it fails, as FILE describes:

  campaign:                               as for adit campaign: what is run, and what it is scored by
    command: adit mission random --seed {seed} --damage {damage} --config {out}/robot.yaml --in-process --out {out}/m
    files:                                written before the command starts
      - {name: robot.yaml, text: "sim: {{motion: {{slip_share: {slip}}}}}"}
    exit_codes: [0, 1]
    scores:
      - {name: outcome, file: m/summary.json, pointer: /mission/outcome}
      - {name: rmse_m, file: m/summary.json, pointer: /against_truth/rmse_m}
  search:                                 SQL expressions over parameters and scores
    failure: outcome <> "home"            so do crashes, and units beyond their limits of time and memory
    severity: rmse_m                      the larger, the closer to a failure: guides the search
    kind: outcome                         failures with the same text but for numbers are of one kind
    units_max: 400
    seed: 1                               of the search: the same seed, the same units
  space:
    damage: {from: 0, to: 1, simple: 0}   a range; integer: true for whole numbers
    slip: {from: 0, to: 0.5, simple: 0.03}
    seed: {seed: true}                    any integer

A parameter can also be a list, the first value of which is the simplest. Batches of units are drawn by the
cross-entropy method. A failure of each kind is then shrunk: towards the simple values, as long as it remains a
failure of this kind. The same command continues a search that was killed; nothing runs twice.

Outputs in DIR:
  search.md     a row for each kind of failure, with the simplest parameters and the command that repeats it
  campaign.db   SQLite: the view campaign has a row for each unit, also while it runs
  units/ID/     outputs of a unit (out), what it printed (output.log), how it ended (result.json)

docs/howto/search.md explains all keys.)";

constexpr const char* kSearchExitCodes = "  1  failures were found, or the search was interrupted";

constexpr const char* kSearchExamples =
    R"(  adit search tests/campaigns/search_missions.yaml --out search
  adit search missions.yaml --out search --time-max-s 3600 --jobs 2
  sqlite3 search/campaign.db 'select id, reason, damage from campaign where state <> "ended"')";

/// Prints a line for each new kind of failure, and how far the search is every ten seconds.
class SearchProgressPrinter {
 public:
  void update(const SearchProgress& progress) {
    if (!progress.new_kind.empty()) {
      std::cout << fmt::format("new kind of failure, unit {}: {}\n", progress.new_kind_id,
                               message_line(progress.new_kind));
    }
    const std::int64_t now_us = steady_us();
    if (progress.new_kind.empty() && now_us < next_us_) return;
    next_us_ = now_us + kPeriodUs;
    std::string line = fmt::format("{} of {} units, {} failures of {} kinds", progress.units,
                                   progress.units_max, progress.failures, progress.kinds);
    if (progress.is_shrinking) {
      line += ", shrinking";
    } else if (progress.time_to_go_s) {
      line += fmt::format(", {} to go", duration_text(*progress.time_to_go_s));
    }
    std::cout << line << "\n" << std::flush;
  }

 private:
  static constexpr std::int64_t kPeriodUs = 10'000'000;

  std::int64_t next_us_ = 0;
};

void run(SearchOptions options) {
  if (options.file.empty()) throw std::invalid_argument("FILE is required");
  if (options.folder.empty()) throw std::invalid_argument("--out is required");
  const StopSignal stop;
  options.stop_descriptor = stop.descriptor();
  SearchProgressPrinter printer;
  const SearchResult result =
      run_search(options, [&](const SearchProgress& progress) { printer.update(progress); });
  std::cout << fmt::format("{} units, {} failures of {} kinds\n", result.units, result.failures,
                           result.kinds.size());
  for (const FoundKind& kind : result.kinds) {
    std::cout << message_line(fmt::format("  {} times: {}; {}", kind.failures, kind.kind,
                                          kind.parameters.empty() ? "all simple" : kind.parameters))
              << "\n";
  }
  std::cout << (options.folder / "search.md").string() << "\n";
  if (result.interrupted) print_error("adit search", "interrupted; the same command continues it");
  if (result.interrupted || !result.kinds.empty()) throw CLI::RuntimeError(kExitFailuresFound);
}

}  // namespace

void add_search_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "search", "Search the parameters of a command for those that make it fail");
  set_help(*command, {kSearchDetails, kSearchExitCodes, kSearchExamples});
  const auto options = std::make_shared<SearchOptions>();
  command->add_option("FILE", options->file, "YAML file of the search")->type_name("FILE");
  command->add_option("--out", options->folder, "Output folder; created or continued")
      ->type_name("DIR");
  command
      ->add_option("--units-max", options->units_max,
                   "Units before the failures are shrunk, instead of that of FILE")
      ->type_name("N")
      ->check(number_in(within(1, 1'000'000)));
  command
      ->add_option("--time-max-s", options->time_max_s,
                   "Wall time, of which a third is for shrinking; default: no limit")
      ->type_name("SECONDS")
      ->check(number_in(above(0.0)));
  command
      ->add_option("--jobs", options->jobs,
                   "Units at the same time; default: cores of this computer")
      ->type_name("N")
      ->check(number_in(within(1, 100'000)));
  command->callback([options] { run(*options); });
}

}  // namespace adit
