// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Whole searches with real processes on this computer.
#include "tools/search/search_run.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"
#include "tools/database/database.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The score is the value x of the configuration of the unit. Appends its parameters to the file
/// `runs`, unless a case of the script does something else.
std::string search(const std::string& failure, const std::string& keys = "",
                   const std::string& cases = "") {
  return R"(
campaign:
  command: >-
    sh -c 'echo {x} {k} {s} >>runs; case {k}{x} in )" +
         cases + R"( esac; cp {out}/in.json {out}/score.json'
  files: [{name: in.json, text: "{{\"value\": {x}, \"kind\": \"{k}\"}}"}]
  time_max_s: 60
  scores:
    - {name: value, file: score.json, pointer: /value}
    - {name: kind, file: score.json, pointer: /kind}
search:
  failure: )" +
         failure + R"(
  severity: value
  batch: 10
  units_max: 24
)" + keys +
         R"(
space:
  x: {from: 0, to: 100, integer: true}
  k: [a, b, c]
  s: {seed: true}
)";
}

class Search : public testing::Test {
 protected:
  SearchOptions options(const std::string& text, const std::string& out = "out") const {
    std::ofstream(folder_ / "s.yaml") << text;
    SearchOptions options;
    options.file = folder_ / "s.yaml";
    options.folder = folder_ / out;
    options.jobs = 2;
    options.programs = fs::path(ADIT_WATCH).parent_path();
    return options;
  }

  SearchResult run(const std::string& text, const std::string& out = "out") const {
    return run_search(options(text, out), {});
  }

  /// The parameters that have run, each with how often.
  std::map<std::string, int> runs() const {
    std::map<std::string, int> counts;
    std::ifstream file(folder_ / "runs");
    for (std::string line; std::getline(file, line);) ++counts[line];
    return counts;
  }

  std::string report(const std::string& out = "out") const {
    return test::contents(folder_ / (out + "/search.md"));
  }

  test::ScratchFolder folder_;
};

TEST_F(Search, FindsAndShrinksAFailureOfEachKind) {
  SearchOptions search_options = options(
      search("x > 60", "  uniform_share: 0.5\n  kind: \"'too much of ' || k\"\n", "c9*) exit 3;;"));
  search_options.units_max = 100;
  const SearchResult result = run_search(search_options, {});
  std::map<std::string, std::string> parameters;
  for (const FoundKind& kind : result.kinds) {
    parameters[kind.kind] = kind.parameters;
    EXPECT_TRUE(kind.is_minimal) << kind.kind;
  }
  EXPECT_EQ(parameters["too much of a"], "x 61");
  EXPECT_EQ(parameters["too much of b"], "x 61, k b");
  EXPECT_EQ(parameters["too much of c"], "x 61, k c");
  EXPECT_EQ(parameters["crashed: ended with exit code #"], "x 90, k c");
  EXPECT_THAT(report(), HasSubstr("| too much of b |"));
  EXPECT_THAT(report(), HasSubstr("x 61, k b"));
}

TEST_F(Search, FindsNothingWhereNothingFails) {
  const SearchResult result = run(search("x > 100"));
  EXPECT_EQ(result.units, 24);
  EXPECT_THAT(result.kinds, IsEmpty());
  EXPECT_THAT(report(), HasSubstr("24 units, 0 failures"));
}

TEST_F(Search, CountsWhatHasNoValueAsFailure) {
  const SearchResult result = run(search("nullif(value, 0) > 100"));
  ASSERT_EQ(result.kinds.size(), 1U);
  EXPECT_EQ(result.kinds[0].kind, "the condition of a failure has no value");
  EXPECT_EQ(result.kinds[0].parameters, "");  // x is 0
}

TEST_F(Search, RepeatsAFailureByTheCommandOfTheReport) {
  const SearchResult result = run(search("x > 60"));
  ASSERT_EQ(result.kinds.size(), 1U);
  EXPECT_THAT(report(), HasSubstr(result.kinds[0].command));
  const int status =
      std::system(("cd '" + folder_.path().string() + "' && " + result.kinds[0].command).c_str());
  EXPECT_EQ(status, 0);
  EXPECT_EQ(test::contents(folder_ / ("repeat_" + result.kinds[0].simplest.id) / "score.json"),
            R"({"value": 61, "kind": "a"})");
}

TEST_F(Search, RunsNothingTwice) {
  const std::string text = search("x > 60");
  const SearchResult first = run(text);
  const std::string first_report = report();
  const std::map<std::string, int> first_runs = runs();
  for (const auto& [unit, count] : first_runs) EXPECT_EQ(count, 1) << unit;
  EXPECT_EQ(run(text).units, first.units);
  EXPECT_EQ(runs(), first_runs);
  EXPECT_EQ(report(), first_report);
}

TEST_F(Search, GivesTheSameUnitsWithAnyNumberOfJobs) {
  SearchOptions serial = options(search("x > 60"), "serial");
  serial.jobs = 1;
  run_search(serial, {});
  const std::map<std::string, int> serial_runs = runs();
  fs::remove(folder_ / "runs");
  run(search("x > 60"));
  EXPECT_EQ(runs(), serial_runs);
}

/// By the signal that no process can handle, while units run.
TEST_F(Search, ContinuesAfterAKill) {
  const std::string text =
      search("x > 60", "", "?[5-9]*) while [ ! -e go ]; do sleep 0.02; done;;");
  const SearchOptions search_options = options(text);
  const pid_t child = fork();
  if (child == 0) {
    run_search(search_options, {});
    _exit(0);
  }
  ASSERT_TRUE(test::becomes_true([&] { return runs().size() >= 2; }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/search.md"));
  std::ofstream(folder_ / "go");
  const SearchResult result = run_search(search_options, {});
  EXPECT_EQ(result.kinds.size(), 1U);
  for (const auto& [unit, count] : runs()) EXPECT_LE(count, 2) << unit;
  fs::remove(folder_ / "runs");
  const SearchResult undisturbed = run(text, "undisturbed");
  EXPECT_EQ(undisturbed.units, result.units);
  EXPECT_EQ(undisturbed.kinds[0].parameters, result.kinds[0].parameters);
}

TEST_F(Search, EndsWithAReportWhenItIsStopped) {
  SearchOptions search_options = options(search("x > 60"));
  int stop[2];
  ASSERT_EQ(pipe(stop), 0);
  search_options.stop_descriptor = stop[0];
  const SearchResult result = run_search(search_options, [&](const SearchProgress& progress) {
    if (progress.units == 5) {
      EXPECT_EQ(write(stop[1], "x", 1), 1);
    }
  });
  EXPECT_TRUE(result.interrupted);
  EXPECT_LT(result.units, 10);
  EXPECT_THAT(report(), HasSubstr("interrupted"));
  close(stop[0]);
  close(stop[1]);
}

TEST_F(Search, EndsAtItsLimits) {
  SearchOptions search_options = options(search("x > 100"));
  search_options.units_max = 13;
  EXPECT_EQ(run_search(search_options, {}).units, 13);
  search_options.units_max.reset();
  search_options.time_max_s = 1e-3;
  EXPECT_LE(run_search(search_options, {}).units, 14);
  const SearchResult first_kind = run(search("x > 60", "  kinds_max: 1\n  shrink_max: 0\n"), "one");
  EXPECT_EQ(first_kind.kinds.size(), 1U);
  EXPECT_LT(first_kind.units, 24);
  EXPECT_FALSE(first_kind.kinds[0].is_minimal);
}

TEST_F(Search, EndsWhenASmallSpaceIsExhausted) {
  std::string text = search("x > 100");
  text.replace(text.find("{from: 0, to: 100, integer: true}"), 33, "[1, 2]");
  text.replace(text.find("{seed: true}"), 12, "[1]");
  EXPECT_EQ(run(text).units, 6);
}

TEST_F(Search, ReportsItsProgress) {
  std::vector<std::string> new_kinds;
  int shrinking = 0;
  run_search(options(search("x > 60")), [&](const SearchProgress& progress) {
    if (!progress.new_kind.empty()) new_kinds.push_back(progress.new_kind);
    shrinking += progress.is_shrinking;
    EXPECT_LE(progress.kinds, 1);
  });
  EXPECT_THAT(new_kinds, ElementsAre("failure"));
  EXPECT_GT(shrinking, 0);
}

}  // namespace
}  // namespace adit
