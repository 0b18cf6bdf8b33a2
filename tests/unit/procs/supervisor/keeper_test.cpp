// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The keeper with real processes: small shells.
#include "procs/supervisor/keeper.hpp"

#include <algorithm>
#include <csignal>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include "common/process_list/parser.hpp"
#include "procs/supervisor/os/wall_time.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class KeeperTest : public testing::Test {
 protected:
  void keep(const std::string& list, const RestartPace& pace = {0.001, 0.002, 60.0}) {
    keeper_ = std::make_unique<Keeper>(parse_process_list(list, "list"),
                                       KeeperOptions{"", ADIT_WATCH, pace});
  }

  KeptProcess& process(const std::string& id) { return *keeper_->find(id); }

  void advance() {
    keeper_->advance(steady_us(), [this](const std::string&) { return works_elsewhere_; });
  }

  bool becomes(const std::string& id, LifeState state) {
    return test::soon([&] {
      advance();
      return process(id).life().state() == state;
    });
  }

  std::vector<std::string> lines(const std::string& id) {
    return process(id).output().since(0, 1'000'000).lines;
  }

  bool prints(const std::string& id, const std::string& line) {
    return test::soon([&] {
      advance();
      const std::vector<std::string> all = lines(id);
      return !all.empty() && all.back() == line;
    });
  }

  std::unique_ptr<Keeper> keeper_;
  bool works_elsewhere_ = false;
};

TEST_F(KeeperTest, KillsWhatIgnoresItsStopSignal) {
  const std::string sleep = test::unique_sleep();
  keep(R"(cmd "deaf" { exec = "sh -c 'trap \"\" TERM; echo ready; exec sleep )" + sleep +
       R"('"; stop_signal = 15; stop_time_allowed = 0.1; })");
  process("deaf").start();
  ASSERT_TRUE(prints("deaf", "ready"));
  process("deaf").stop(steady_us());
  EXPECT_TRUE(becomes("deaf", LifeState::kStopped));
  EXPECT_EQ(WTERMSIG(process("deaf").wait_status()), SIGKILL);
  EXPECT_EQ(test::processes_with(sleep), 0);
}

TEST_F(KeeperTest, SendsTheStopSignalThatTheListSays) {
  keep(
      R"(cmd "polite" { exec = "sh -c 'trap \"echo bye; exit 7\" USR1; echo ready; while :; do sleep 0.01; done'";
                         stop_signal = 10; })");
  process("polite").start();
  ASSERT_TRUE(prints("polite", "ready"));
  process("polite").stop(steady_us());
  EXPECT_TRUE(becomes("polite", LifeState::kStopped));
  EXPECT_EQ(lines("polite").back(), "bye");
  EXPECT_EQ(WEXITSTATUS(process("polite").wait_status()), 7);
}

TEST_F(KeeperTest, StartsAgainUpToTheLimitAndGivesUp) {
  keep(
      R"(cmd "crash" { exec = "sh -c 'echo run; exit 3'"; auto_respawn = "true"; restart_limit = 3; })");
  process("crash").start();
  EXPECT_TRUE(becomes("crash", LifeState::kFailed));
  EXPECT_THAT(lines("crash"), ElementsAre("run", "run", "run", "run"));
  EXPECT_EQ(process("crash").life().trouble(), "ended with exit code 3");
}

TEST_F(KeeperTest, SaysWhatCannotBeStarted) {
  keep(R"(cmd "none" { exec = "/nonexistent/program"; })");
  process("none").start();
  EXPECT_TRUE(becomes("none", LifeState::kFailed));
  EXPECT_THAT(process("none").life().trouble(), HasSubstr("No such file"));
  EXPECT_THAT(lines("none"), ElementsAre(HasSubstr("No such file")));
}

TEST_F(KeeperTest, StartsInTheOrderOfDependencies) {
  keep(R"(cmd "last" { exec = "sleep 100"; depends_on = "middle"; }
          cmd "middle" { exec = "sleep 100"; depends_on = "first"; }
          cmd "first" { exec = "sleep 100"; alive_channel = "POSE"; })");
  for (const char* id : {"last", "middle", "first"}) process(id).start();
  ASSERT_TRUE(becomes("first", LifeState::kStarting));
  advance();
  EXPECT_EQ(process("middle").life().state(), LifeState::kWaiting);
  keeper_->heard("OTHER", steady_us());
  advance();
  EXPECT_EQ(process("first").life().state(), LifeState::kStarting);
  keeper_->heard("POSE", steady_us());
  EXPECT_TRUE(becomes("last", LifeState::kWorking));
}

TEST_F(KeeperTest, WaitsForWhatWorksOnOtherComputers) {
  keep(R"(cmd "here" { exec = "sleep 100"; depends_on = "there"; }
          cmd "there" { exec = "sleep 100"; deputy = "far"; })");
  EXPECT_EQ(keeper_->find("there"), nullptr);
  process("here").start();
  advance();
  EXPECT_EQ(process("here").life().state(), LifeState::kWaiting);
  works_elsewhere_ = true;
  EXPECT_TRUE(becomes("here", LifeState::kWorking));
}

TEST_F(KeeperTest, TakesOrdersAsProcmanDoes) {
  keep(R"(cmd "a" { exec = "sleep 100"; })");
  process("a").order(5, false, steady_us());
  ASSERT_TRUE(becomes("a", LifeState::kWorking));
  const pid_t first = process("a").pid();
  EXPECT_EQ(process("a").run_id(), 5);
  process("a").order(5, false, steady_us());  // is repeated each second
  advance();
  EXPECT_EQ(process("a").pid(), first);
  process("a").order(6, false, steady_us());
  EXPECT_TRUE(test::soon([&] {
    advance();
    return process("a").works() && process("a").pid() != first;
  }));
  process("a").order(6, true, steady_us());
  EXPECT_TRUE(becomes("a", LifeState::kStopped));
  process("a").order(6, false, steady_us());  // that run is over
  advance();
  EXPECT_EQ(process("a").life().state(), LifeState::kStopped);
}

TEST_F(KeeperTest, KeepsTheEndOfAFlood) {
  keep(R"(cmd "flood" { exec = "sh -c 'seq 1 300000'"; })");
  process("flood").start();
  EXPECT_TRUE(becomes("flood", LifeState::kStopped));
  const OutputPiece piece = process("flood").output().since(0, 1000);
  EXPECT_EQ(piece.lines.back(), "300000");
  EXPECT_EQ(piece.missed + static_cast<std::int64_t>(piece.lines.size()), 300'000);
}

TEST_F(KeeperTest, TellsWhatAProcessUses) {
  keep(R"(cmd "busy" { exec = "sh -c 'echo on; while :; do :; done'"; }
          cmd "idle" { exec = "sleep 100"; })");
  process("busy").start();
  process("idle").start();
  ASSERT_TRUE(prints("busy", "on"));
  keeper_->measure(steady_us());
  EXPECT_TRUE(test::soon([&] {  // a tick of the kernel's clock at least
    keeper_->measure(steady_us());
    return process("busy").use().cpu_cores > 0.0;
  }));
  EXPECT_LT(process("busy").use().cpu_cores, 20.0);  // one tick in one look at the table
  EXPECT_EQ(process("idle").use().cpu_cores, 0.0);
  EXPECT_GT(process("idle").use().memory_bytes, 100'000);  // a shell takes about 2 MB
  EXPECT_LT(process("idle").use().memory_bytes, 100'000'000);
  EXPECT_GT(process("idle").use().address_bytes, process("idle").use().memory_bytes);
}

TEST_F(KeeperTest, StopsAllWhenItGoes) {
  const std::string sleep = test::unique_sleep();
  keep(R"(cmd "a" { exec = "sleep )" + sleep + R"("; } cmd "b" { exec = "setsid -f sleep )" +
       sleep + R"("; } cmd "c" { exec = "sh -c 'trap \"\" INT; sleep )" + sleep +
       R"(; true'"; stop_time_allowed = 0.1; })");
  for (const char* id : {"a", "b", "c"}) process(id).start();
  advance();
  ASSERT_TRUE(test::soon([&] { return test::processes_with(sleep) >= 3; }));
  keeper_.reset();
  EXPECT_EQ(test::processes_with(sleep), 0);
}

TEST_F(KeeperTest, KillsWhoLostTheirWatcher) {
  const std::string sleep = test::unique_sleep();
  keep(R"(cmd "a" { exec = "sh -c 'setsid sleep )" + sleep + R"( & echo ready; wait'"; })");
  process("a").start();
  ASSERT_TRUE(prints("a", "ready"));
  kill(process("a").watcher(), SIGKILL);
  EXPECT_TRUE(becomes("a", LifeState::kFailed));
  EXPECT_TRUE(test::soon([&] {
    keeper_->measure(steady_us());
    return test::processes_with(sleep) == 0;
  }));
}

TEST_F(KeeperTest, StopsWhatDependsOnOthersBeforeThese) {
  const test::ScratchFolder folder;
  const auto noted = [&](const std::string& id, const std::string& more = "") {
    return "cmd \"" + id + "\" { exec = \"sh -c 'trap \\\"sleep 0.05; echo " + id + " >> " +
           (folder / "order").string() +
           "; exit\\\" TERM; echo ready; while :; do sleep 0.01; done'\"; stop_signal = 15; " +
           more + "}";
  };
  keep(noted("laser") + noted("matching", R"(depends_on = "laser"; )") +
       noted("mapping", R"(depends_on = "matching", "laser"; )"));
  for (const char* id : {"laser", "matching", "mapping"}) process(id).start();
  for (const char* id : {"laser", "matching", "mapping"}) ASSERT_TRUE(prints(id, "ready"));
  keeper_.reset();
  EXPECT_EQ(test::contents(folder / "order"), "mapping\nmatching\nlaser\n");
}

TEST_F(KeeperTest, WritesWhatIsPrintedToFilesAndHowItEnded) {
  const test::ScratchFolder folder;
  keeper_ = std::make_unique<Keeper>(
      parse_process_list(R"(cmd "flood" { exec = "sh -c 'seq 1 5000; exit 3'"; })", "list"),
      KeeperOptions{"", ADIT_WATCH, {}, folder.path(), {}});
  process("flood").start();
  ASSERT_TRUE(becomes("flood", LifeState::kFailed));
  const std::string text = test::contents(folder / "flood.log");
  EXPECT_EQ(std::ranges::count(text, '\n'), 5002);  // more than is kept in memory
  EXPECT_THAT(text, HasSubstr("Z --- started: sh -c 'seq 1 5000; exit 3'\n"));
  EXPECT_THAT(text, testing::EndsWith("Z --- ended with exit code 3\n"));
}

/// The program of this test that keeps a process, until it is killed.
pid_t spawn_keeper(std::string command_line) {
  std::string program = ADIT_KEEP_PROCESSES;
  std::string watcher = ADIT_WATCH;
  char* arguments[] = {program.data(), watcher.data(), command_line.data(), nullptr};
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, program.c_str(), nullptr, nullptr, arguments, environ), 0);
  return pid;
}

TEST(KeeperThatIsKilled, LeavesNoOrphanAtAnyDepth) {
  const std::string sleep = test::unique_sleep();
  // One that ignores all that can be ignored, one in a session of its own, one whose parent ended.
  const pid_t keeper =
      spawn_keeper("sh -c 'trap \"\" HUP INT TERM; setsid sleep " + sleep + " & (sleep " + sleep +
                   " &) ; while :; do sleep " + sleep + "; done'");
  const auto all_run = [&] { return test::processes_with(sleep) >= 6; };
  ASSERT_TRUE(test::soon(all_run));  // with the keeper, the watcher and the shell
  kill(keeper, SIGKILL);
  waitpid(keeper, nullptr, 0);
  EXPECT_TRUE(test::soon([&] { return test::processes_with(sleep) == 0; }));
}

}  // namespace
}  // namespace adit
