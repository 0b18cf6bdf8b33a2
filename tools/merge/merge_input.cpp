// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/merge_input.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/log/event_source.hpp"
#include "common/config/config.hpp"
#include "common/journal/journal_recovery.hpp"
#include "procs/mapping/map_journal.hpp"
#include "tools/map/log_input.hpp"
#include "tools/map/map_run.hpp"

namespace adit {
namespace {

/// The journal of mapping in a folder; empty without.
std::filesystem::path journal_in(const std::filesystem::path& folder) {
  for (const char* name : {"map.journal", "mapping.journal"}) {
    std::filesystem::path journal = folder / name;
    if (std::filesystem::is_regular_file(journal) ||
        std::filesystem::is_regular_file(journal_copy(journal)))
      return journal;
  }
  return {};
}

/// Those of the first CONFIG in a log of the folder.
std::optional<Lasers> lasers_in(const std::filesystem::path& folder,
                                std::vector<std::string>& warnings) {
  std::vector<std::filesystem::path> logs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".lcmlog") || name.ends_with(".lcmlog.zst")) logs.push_back(entry.path());
  }
  std::ranges::sort(logs);
  for (const std::filesystem::path& log : logs) {
    LogReader reader(log);
    while (const auto event = reader.next()) {
      if (const auto lasers = recorded_lasers(*event, warnings)) return lasers;
    }
  }
  return std::nullopt;
}

}  // namespace

MergeInput open_run(const std::filesystem::path& run, const std::filesystem::path& config,
                    const std::filesystem::path& scratch,
                    const std::function<void(const std::string&, double)>& progress) {
  MergeInput input;
  input.name = run.string();
  std::filesystem::path folder = run;
  if (!std::filesystem::exists(run))
    throw std::runtime_error(fmt::format("{} does not exist", run.string()));
  if (!std::filesystem::is_directory(run)) {
    folder = scratch;
    MapRunOptions options;
    options.input = run;
    options.folder = scratch;
    options.config = config;
    input.warnings = run_map(options, progress).warnings;
  }
  const std::filesystem::path journal = journal_in(folder);
  if (journal.empty()) {
    throw std::runtime_error(
        fmt::format("no map in {}: neither map.journal nor mapping.journal", run.string()));
  }
  input.map = read_map_journal(journal);
  if (input.map.maps.empty() && !input.map.unfinished)
    throw std::runtime_error(fmt::format("no local map in {}", journal.string()));
  if (const std::string report = map_journal_report(journal, input.map); !report.empty())
    input.warnings.push_back(report);
  const ConfigFile file = config.empty() ? ConfigFile{} : ConfigFile::load(config);
  if (file.section(Lasers::kSection) != nullptr) {
    input.lasers = load_section<Lasers>(file, Lasers::kSection);
  } else if (const auto recorded = lasers_in(folder, input.warnings)) {
    input.lasers = *recorded;
  } else {
    input.warnings.push_back(
        fmt::format("no log in {} tells where the lasers are; the default is used", run.string()));
  }
  return input;
}

}  // namespace adit
