// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/merge/merge_run.hpp"

namespace adit {
namespace {

constexpr const char* kMergeDetails =
    R"(Joins the maps of any number of runs of one mine into one map. The runs may be by different robots and begin
anywhere. A RUN is the folder of a mission (adit mission), the folder of a map (adit map, adit merge), or a log, which
is mapped first. Give the runs in order of time: what changed between them is told by this order.

Each run's local maps are searched in the map of the others. A run is joined only if matches agree at several
places along both, at one place only, and if the walls do not contradict each other; a run that is not is said so.

Outputs in DIR:
  map.png               picture of the map with the paths of all runs
  map.pgm, map.yaml     occupancy grid for ROS map_server and Nav2
  trajectory_N.tum      of run N (1, 2, ..): time x y z qx qy qz qw at the scans of its local maps
  graph.g2o             pose graph of all local maps
  changes.png, .tsv     what some runs saw as wall and others as free space
  map.journal           the joined local maps, for adit map --resume and adit merge; only if all
                        robots have the same lasers
  summary.json          every join with its links and evidence, every rejection with its reason

If the runs are of several mines, the files show the map of most runs. Section `merge` of the
configuration has the limits of a join, `changes` those of a change. See docs/howto/merge.md.)";

constexpr const char* kMergeExitCodes = "  1  not all runs are in the map";

constexpr const char* kMergeExamples =
    R"(  adit merge monday tuesday --out mine
  adit merge mine wednesday.lcmlog --out mine          add a run to the map
  adit merge runs/* --out mine --draw-graph)";

constexpr int kExitNotAll = 1;

void merge(const MergeOptions& options) {
  std::optional<RunProgress> progress(std::in_place, options.folder);
  const MergeResult result = run_merge(
      options, [&](const std::string& step, double done) { progress->update(step, done); });
  progress.reset();
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  for (const std::string& sentence : result.not_joined) print_error("adit", sentence);
  std::cout << message_line(fmt::format(
                   "{}: {} of {} runs in the map, {} local maps, {} links between runs, {} "
                   "change{}; the optimum is {}",
                   options.folder.string(), result.joined, result.runs, result.local_maps,
                   result.links, result.changes, result.changes == 1 ? "" : "s",
                   result.is_global ? "proven" : "not proven to be the global one"))
            << "\n"
            << std::flush;
  if (!result.not_joined.empty()) throw CLI::RuntimeError(kExitNotAll);
}

}  // namespace

void add_merge_command(CLI::App& adit) {
  CLI::App* command = add_command(adit, "merge", "Join the maps of several runs of a mine");
  set_help(*command, {kMergeDetails, kMergeExitCodes, kMergeExamples});
  const auto options = std::make_shared<MergeOptions>();
  command
      ->add_option("RUN", options->runs, "Folders of missions or maps, or logs, in order of time")
      ->type_name("PATH")
      ->required();
  command->add_option("--out", options->folder, "Output folder; created if it does not exist")
      ->type_name("DIR")
      ->required();
  command->add_option("--config", options->config, "YAML file with a section per stage")
      ->type_name("FILE");
  command->add_flag("--draw-graph", options->draw_graph,
                    "Draw local maps and loop closures in map.png");
  command->callback([options] { merge(*options); });
}

}  // namespace adit
