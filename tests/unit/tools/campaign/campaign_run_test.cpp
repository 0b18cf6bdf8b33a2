// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Whole campaigns of real processes on this computer.
#include "tools/campaign/campaign_run.hpp"

#include <cerrno>
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

#include "common/config/config_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"
#include "tests/unit/tools/report/markup_check.hpp"
#include "tools/campaign/campaign_status.hpp"
#include "tools/database/database.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Writes {"value": N} and appends a line to the file `runs` beside the campaign, unless a case of
/// the script does something else with the unit.
std::string campaign(const std::string& cases, const std::string& keys = "",
                     const std::string& seeds = "{from: 1, to: 8}",
                     const std::string& limits = "  time_max_s: 60\n  memory_max_mb: 4000\n") {
  return "campaign:\n  command: >-\n    sh -c 'echo {n} >>runs; case {n} in " + cases +
         " esac; echo \"{{ \\\"value\\\": {n} }}\" >{out}/score.json'\n" + limits +
         "  scores: [{name: value, file: score.json, pointer: /value}]\n" + keys +
         "matrix: {n: " + seeds + "}\n";
}

class Campaign : public testing::Test {
 protected:
  CampaignOptions options(const std::string& text, const std::string& out = "out") const {
    std::ofstream(folder_ / "c.yaml") << text;
    CampaignOptions options;
    options.file = folder_ / "c.yaml";
    options.folder = folder_ / out;
    options.jobs = 2;
    options.programs = fs::path(ADIT_WATCH).parent_path();
    return options;
  }

  CampaignResult run(const std::string& text, const std::string& out = "out") const {
    return run_campaign(options(text, out), {}, {});
  }

  /// The first column of a query as text, in the order of units.
  std::vector<std::string> select(const std::string& what, const std::string& out = "out") const {
    Database database(folder_ / (out + "/campaign.db"), Database::Mode::kRead);
    SqlStatement rows = database.prepare("SELECT " + what + " FROM campaign ORDER BY unit");
    std::vector<std::string> texts;
    while (rows.step()) texts.push_back(rows.text(0));
    return texts;
  }

  /// How often each unit has run.
  std::map<std::string, int> runs() const {
    std::map<std::string, int> counts;
    std::ifstream file(folder_ / "runs");
    for (std::string line; std::getline(file, line);) ++counts[line];
    return counts;
  }

  test::ScratchFolder folder_;
};

TEST_F(Campaign, HasARowForEveryUnitWithTheReasonOfItsEnd) {
  const CampaignResult result =
      run(campaign("2) exit 3;; 3) kill -SEGV $$;; 4) exit 0;; 5) sleep 100;; 6) tail /dev/zero;;",
                   "  rates: [{name: large, condition: value >= 7, min: 0.2}]\n",
                   "{from: 1, to: 8}", "  time_max_s: 2\n  memory_max_mb: 150\n"));
  EXPECT_TRUE(result.is_complete());
  EXPECT_THAT(
      select("state || ': ' || reason"),
      ElementsAre("ended: ", "crashed: ended with exit code 3", "crashed: killed by SIGSEGV",
                  "no score: cannot read score.json", "time limit: more than 2 s",
                  "memory limit: more than 150 MB", "ended: ", "ended: "));
  EXPECT_THAT(select("value"), ElementsAre("1", "", "", "", "", "", "7", "8"));
  ASSERT_EQ(result.rates.size(), 1U);
  EXPECT_EQ(result.rates[0].counts.yes, 2);
  EXPECT_EQ(result.rates[0].counts.no, 1);
  EXPECT_EQ(result.rates[0].counts.unknown, 5);
  EXPECT_TRUE(result.succeeded());
}

TEST_F(Campaign, RunsOnlyWhatIsMissing) {
  run(campaign("", "", "{from: 1, to: 3}"));
  const CampaignResult result = run(campaign("", "", "{from: 1, to: 5}"));
  EXPECT_EQ(result.with_result, 5);
  for (const auto& [unit, count] : runs()) EXPECT_EQ(count, 1) << unit;
}

TEST_F(Campaign, RunsUnitsAgainWhoseLimitIsRaised) {
  const std::string cases = "2) sleep 3;;";
  std::string text = campaign(cases, "", "[1, 2]");
  const auto limit = [&](const std::string& value) {
    std::string changed = text;
    return changed.replace(changed.find("time_max_s: 60"), 14, "time_max_s: " + value);
  };
  run(limit("1"));
  EXPECT_THAT(select("state"), ElementsAre("ended", "time limit"));
  run(limit("0.5"));  // a lower limit forgets nothing
  EXPECT_EQ(runs()["2"], 1);
  run(limit("60"));
  EXPECT_THAT(select("state"), ElementsAre("ended", "ended"));
  EXPECT_EQ(runs()["1"], 1);
}

TEST_F(Campaign, ReadsOtherScoresWithoutRunningAgain) {
  run(campaign("", "", "[1, 2]"));
  std::string text = campaign("", "", "[1, 2]");
  text.replace(text.find("{name: value"), 12, "{name: other");
  run(text);
  EXPECT_THAT(select("other"), ElementsAre("1", "2"));
  EXPECT_EQ(runs()["1"], 1);
}

/// Also of units that were not in the plan when the scores changed.
TEST_F(Campaign, ReadsOtherScoresOfUnitsOfAnEarlierPlan) {
  run(campaign("", "", "[1, 2]"));
  std::string text = campaign("", "", "[1]");
  const auto rename = [](std::string& score) {
    score.replace(score.find("{name: value"), 12, "{name: other");
  };
  rename(text);
  run(text);
  std::string both = campaign("", "", "[1, 2]");
  rename(both);
  run(both);
  EXPECT_THAT(select("other"), ElementsAre("1", "2"));
  EXPECT_EQ(runs()["2"], 1);
}

TEST_F(Campaign, WritesTheFilesOfAUnitBeforeItStarts) {
  const auto text = [](const std::string& text_of_file) {
    return "campaign:\n  command: sh -c 'cp {out}/in/{n}.json {out}/score.json'\n"
           "  files:\n    - name: in/{n}.json\n      text: |\n        " +
           text_of_file +
           "\n  scores:\n    - {name: value, file: score.json, pointer: /value}\n"
           "    - {name: out, file: score.json, pointer: /out}\nmatrix: {n: [1, 2]}\n";
  };
  run(text(R"({{"value": {n}0, "out": "{out}"}})"));
  EXPECT_THAT(select("value"), ElementsAre("10", "20"));
  EXPECT_THAT(select("out"), testing::Each(testing::EndsWith("/out")));
  run(text(R"({{"value": {n}00, "out": ""}})"));  // a unit depends on the content of its files
  EXPECT_THAT(select("value"), ElementsAre("100", "200"));
}

TEST_F(Campaign, CountsOtherExitCodesWithoutRunningAgain) {
  const std::string text = campaign("2) echo {{}} >{out}/score.json; exit 1;;", "", "[1, 2]");
  run(text);
  EXPECT_THAT(select("state"), ElementsAre("ended", "crashed"));
  std::string accepting = text;
  accepting.insert(accepting.find("  command"), "  exit_codes: [0, 1]\n");
  run(accepting);
  EXPECT_THAT(select("state"), ElementsAre("ended", "ended"));
  EXPECT_EQ(runs()["2"], 1);
}

/// A killed campaign, by the signal that no process can handle: its units end with it.
TEST_F(Campaign, ContinuesAfterAKill) {
  const CampaignOptions campaign_options =
      options(campaign("3) echo $$ >pid; while [ ! -e go ]; do sleep 0.05; done;;"));
  const pid_t child = fork();
  if (child == 0) {
    run_campaign(campaign_options, {}, {});
    _exit(0);
  }
  // Unit 3 runs and waits.
  ASSERT_TRUE(
      test::becomes_true([&] { return runs()["4"] > 0 && fs::file_size(folder_ / "pid") > 0; }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  pid_t unit = 0;
  std::ifstream(folder_ / "pid") >> unit;
  ASSERT_GT(unit, 0);
  EXPECT_TRUE(test::becomes_true([&] { return kill(unit, 0) != 0 && errno == ESRCH; }));
  EXPECT_FALSE(fs::exists(folder_ / "out/campaign.html"));
  std::ofstream(folder_ / "go");
  EXPECT_TRUE(run_campaign(campaign_options, {}, {}).is_complete());
  EXPECT_THAT(select("state || value"), ElementsAre("ended1", "ended2", "ended3", "ended4",
                                                    "ended5", "ended6", "ended7", "ended8"));
  EXPECT_EQ(runs()["1"], 1);
  EXPECT_EQ(runs()["3"], 2);
  for (const auto& entry : fs::directory_iterator(folder_ / "out/units"))
    EXPECT_EQ(entry.path().filename().string().size(), 16U) << entry.path();  // no attempt is left
}

/// Slurm starts a task again whose node seemed dead, and both run to their ends.
TEST_F(Campaign, TakesTheFirstOfTwoResultsOfAUnit) {
  CampaignOptions campaign_options = options(
      campaign("*) touch started.$$; while [ $(ls started.* | wc -l) -lt 2 ]; do sleep 0.02; done; "
               "echo $$ >{out}/pid;;",
               "", "[1]"));
  int stop[2];
  ASSERT_EQ(pipe(stop), 0);
  ASSERT_EQ(write(stop[1], "x", 1), 1);
  campaign_options.stop_descriptor = stop[0];
  EXPECT_TRUE(run_campaign(campaign_options, {}, {}).interrupted);  // has a plan
  const std::string id = select("id")[0];
  std::vector<pid_t> tasks;
  for (int i = 0; i < 2; ++i) {
    tasks.push_back(fork());
    if (tasks.back() != 0) continue;
    _exit(run_campaign_unit(folder_ / "out", id, -1, campaign_options.programs) ? 0 : 1);
  }
  for (const pid_t task : tasks) {
    int status = -1;
    waitpid(task, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(runs()["1"], 2);
  int entries = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/units")) {
    EXPECT_EQ(entry.path().filename(), id);
    ++entries;
  }
  EXPECT_EQ(entries, 1);
  EXPECT_FALSE(test::contents(folder_ / "out/units" / id / "out/pid").empty());
  EXPECT_TRUE(run_campaign_unit(folder_ / "out", id, -1, campaign_options.programs));
  EXPECT_EQ(runs()["1"], 2);  // it has a result
  close(stop[0]);
  close(stop[1]);
}

TEST_F(Campaign, StopsWhenARateIsKnownWellEnough) {
  const std::string keys = "  rates: [{name: even, condition: value % 2 = 0, stop_width: 0.4}]\n";
  const CampaignResult result = run(campaign("", keys, "{from: 1, to: 200}"));
  ASSERT_TRUE(result.stopped_after.has_value());
  EXPECT_LT(*result.stopped_after, 40);
  EXPECT_EQ(result.units, *result.stopped_after);
  EXPECT_EQ(result.rates[0].counts.total(), result.units);
  EXPECT_LT(result.rates[0].interval().width(), 0.4);
  CampaignOptions serial = options(campaign("", keys, "{from: 1, to: 200}"), "serial");
  serial.jobs = 1;
  EXPECT_EQ(run_campaign(serial, {}, {}).stopped_after, result.stopped_after);
  EXPECT_EQ(select("parameters", "serial"), select("parameters"));
}

TEST_F(Campaign, WritesAPageWithTheWorstUnitsAndWhatChanged) {
  const std::string keys =
      "  report: score.json\n  worst: value\n"
      "  rates: [{name: 'small <b>', condition: value < 5, min: 0.9}]\n"
      "  distributions: [{value: value}]\n";
  run(campaign("", keys), "before");
  CampaignOptions now =
      options(campaign("7) exit 9;; 2) echo {{}} >{out}/score.json; exit 0;;", keys));
  now.compare = folder_ / "before";
  run_campaign(now, {}, {});
  const std::string page = test::contents(folder_ / "out/campaign.html");
  EXPECT_THAT(test::markup_errors(page), IsEmpty());
  for (const std::string& link : test::markup_links(page))
    EXPECT_TRUE(fs::exists(folder_ / "out" / link)) << link;
  EXPECT_THAT(page, HasSubstr("small &lt;b&gt;"));
  EXPECT_THAT(page, HasSubstr("crashed: ended with exit code 9"));
  EXPECT_THAT(page, HasSubstr("/out/score.json\">report</a>"));
  EXPECT_THAT(page, HasSubstr("units that changed"));
  EXPECT_THAT(page, HasSubstr("unit 2 <code>{&quot;n&quot;:2}</code>: no longer"));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
}

TEST_F(Campaign, DoesNotBeginIfThereIsNothingToCompareWith) {
  CampaignOptions campaign_options = options(campaign(""));
  campaign_options.compare = folder_ / "none";
  EXPECT_THROW(run_campaign(campaign_options, {}, {}), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Campaign, TellsItsStatus) {
  run(campaign("2) exit 1;;", "  rates: [{name: all, condition: value > 0}]\n", "[1, 2]"));
  const CampaignStatus status = read_campaign_status(folder_ / "out");
  EXPECT_EQ(status.units, 2);
  EXPECT_EQ(status.with_result, 2);
  EXPECT_FALSE(status.is_running);
  ASSERT_EQ(status.rates.size(), 1U);
  EXPECT_EQ(status.rates[0].counts.yes, 1);
  EXPECT_THROW(read_campaign_status(folder_ / "nothing"), std::runtime_error);
}

TEST_F(Campaign, RemovesOutputsThatAreNotKept) {
  run(campaign("*) mkdir {out}/a; touch {out}/a/x.log {out}/a/y;;", "  remove: '*.log'\n", "[1]"));
  const fs::path out = folder_ / "out/units" / select("id")[0] / "out/a";
  EXPECT_TRUE(fs::exists(out / "y"));
  EXPECT_FALSE(fs::exists(out / "x.log"));
}

TEST_F(Campaign, ReportsAnExpressionThatIsNotSql) {
  EXPECT_THAT([&] { run(campaign("", "  rates: [{name: a, condition: valeu > 1}]\n")); },
              testing::ThrowsMessage<ConfigError>(
                  HasSubstr("c.yaml: campaign.rates[0].condition: no such column: valeu")));
  EXPECT_TRUE(runs().empty());
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace adit
