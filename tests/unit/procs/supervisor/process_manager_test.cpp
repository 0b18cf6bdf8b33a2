// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// ProcessManager with real processes: small shell scripts.
#include "procs/supervisor/process_manager.hpp"

#include <algorithm>
#include <csignal>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include "common/process_list/parser.hpp"
#include "common/service/wall_time.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ProcessManagerTest : public testing::Test {
 protected:
  void manage(const std::string& list, const RestartBackoff& backoff = {0.001, 0.002, 60.0}) {
    process_manager_ = std::make_unique<ProcessManager>(
        parse_process_list(list, "list"), ProcessManagerOptions{"", ADIT_WATCH, backoff});
  }

  ManagedProcess& process(const std::string& id) { return *process_manager_->find(id); }

  void advance() {
    process_manager_->advance(steady_us(), [this](const std::string&) { return remote_ready_; });
  }

  bool becomes(const std::string& id, LifecycleState state) {
    return test::becomes_true([&] {
      advance();
      return process(id).lifecycle().state() == state;
    });
  }

  std::vector<std::string> lines(const std::string& id) {
    return process(id).output().since(0, 1'000'000).lines;
  }

  bool prints(const std::string& id, const std::string& line) {
    return test::becomes_true([&] {
      advance();
      const std::vector<std::string> all = lines(id);
      return !all.empty() && all.back() == line;
    });
  }

  std::unique_ptr<ProcessManager> process_manager_;
  bool remote_ready_ = false;
};

TEST_F(ProcessManagerTest, KillsAProcessThatIgnoresItsStopSignal) {
  const std::string sleep = test::unique_sleep();
  manage(R"(cmd "ignoring" { exec = "sh -c 'trap \"\" TERM; echo ready; exec sleep )" + sleep +
         R"('"; stop_signal = 15; stop_time_allowed = 0.1; })");
  process("ignoring").start();
  ASSERT_TRUE(prints("ignoring", "ready"));
  process("ignoring").stop(steady_us());
  EXPECT_TRUE(becomes("ignoring", LifecycleState::kStopped));
  EXPECT_EQ(WTERMSIG(process("ignoring").wait_status()), SIGKILL);
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST_F(ProcessManagerTest, SendsTheStopSignalOfTheList) {
  manage(
      R"(cmd "handling" { exec = "sh -c 'trap \"echo bye; exit 7\" USR1; echo ready; while :; do sleep 0.01; done'";
                         stop_signal = 10; })");
  process("handling").start();
  ASSERT_TRUE(prints("handling", "ready"));
  process("handling").stop(steady_us());
  EXPECT_TRUE(becomes("handling", LifecycleState::kStopped));
  EXPECT_EQ(lines("handling").back(), "bye");
  EXPECT_EQ(WEXITSTATUS(process("handling").wait_status()), 7);
}

TEST_F(ProcessManagerTest, RestartsUpToTheLimit) {
  manage(
      R"(cmd "crash" { exec = "sh -c 'echo run; exit 3'"; auto_respawn = "true"; restart_limit = 3; })");
  process("crash").start();
  EXPECT_TRUE(becomes("crash", LifecycleState::kFailed));
  EXPECT_THAT(lines("crash"), ElementsAre("run", "run", "run", "run"));
  EXPECT_EQ(process("crash").lifecycle().error(), "ended with exit code 3");
}

TEST_F(ProcessManagerTest, ReportsAProgramThatCannotBeStarted) {
  manage(R"(cmd "none" { exec = "/nonexistent/program"; })");
  process("none").start();
  EXPECT_TRUE(becomes("none", LifecycleState::kFailed));
  EXPECT_THAT(process("none").lifecycle().error(), HasSubstr("No such file"));
  EXPECT_THAT(lines("none"), ElementsAre(HasSubstr("No such file")));
}

TEST_F(ProcessManagerTest, StartsInTheOrderOfDependencies) {
  manage(R"(cmd "last" { exec = "sleep 100"; depends_on = "middle"; }
          cmd "middle" { exec = "sleep 100"; depends_on = "first"; }
          cmd "first" { exec = "sleep 100"; alive_channel = "POSE"; })");
  for (const char* id : {"last", "middle", "first"}) process(id).start();
  ASSERT_TRUE(becomes("first", LifecycleState::kStarting));
  advance();
  EXPECT_EQ(process("middle").lifecycle().state(), LifecycleState::kWaiting);
  process_manager_->on_message("OTHER", steady_us());
  advance();
  EXPECT_EQ(process("first").lifecycle().state(), LifecycleState::kStarting);
  process_manager_->on_message("POSE", steady_us());
  EXPECT_TRUE(becomes("last", LifecycleState::kRunning));
}

/// Three processes get the same input: one ignores it, one answers late, one gets none.
TEST_F(ProcessManagerTest, RestartsAProcessThatIgnoresItsInput) {
  const std::string rule = R"( auto_respawn = "true"; stop_signal = 15; start_timeout_s = 0;
                                answer_timeout_s = 0.4; answer_channel = )";
  manage(R"(cmd "ignoring" { exec = "sleep 100"; answers_to = "SCAN";)" + rule + R"("POSE"; }
          cmd "slow" { exec = "sleep 100"; answers_to = "SCAN", "TILT";)" +
         rule + R"("MAP"; }
          cmd "idle" { exec = "sleep 100"; answers_to = "GOAL";)" +
         rule + R"("PATH"; })");
  for (const char* id : {"ignoring", "slow", "idle"}) process(id).start();
  advance();
  std::int64_t answered_us = steady_us();
  EXPECT_TRUE(test::becomes_true([&] {
    process_manager_->on_message("SCAN", steady_us());
    if (steady_us() - answered_us >= 200'000) {
      process_manager_->on_message("MAP", answered_us = steady_us());
    }
    advance();
    return process("ignoring").lifecycle().total_restarts() == 2;
  }));
  EXPECT_EQ(process("ignoring").lifecycle().error(),
            "ignored its input: no POSE for 0.4 s while SCAN came");
  EXPECT_EQ(process("slow").lifecycle().total_restarts(), 0);
  EXPECT_EQ(process("idle").lifecycle().total_restarts(), 0);
  EXPECT_TRUE(process("idle").is_ready());
}

TEST_F(ProcessManagerTest, WaitsForRemoteDependencies) {
  manage(R"(cmd "here" { exec = "sleep 100"; depends_on = "there"; }
          cmd "there" { exec = "sleep 100"; deputy = "far"; })");
  EXPECT_EQ(process_manager_->find("there"), nullptr);
  process("here").start();
  advance();
  EXPECT_EQ(process("here").lifecycle().state(), LifecycleState::kWaiting);
  remote_ready_ = true;
  EXPECT_TRUE(becomes("here", LifecycleState::kRunning));
}

TEST_F(ProcessManagerTest, ExecutesOrdersLikeProcman) {
  manage(R"(cmd "a" { exec = "sleep 100"; })");
  process("a").order(5, false, steady_us());
  ASSERT_TRUE(becomes("a", LifecycleState::kRunning));
  const pid_t first = process("a").pid();
  EXPECT_EQ(process("a").run_id(), 5);
  process("a").order(5, false, steady_us());  // orders are repeated every second
  advance();
  EXPECT_EQ(process("a").pid(), first);
  process("a").order(6, false, steady_us());
  EXPECT_TRUE(test::becomes_true([&] {
    advance();
    return process("a").is_ready() && process("a").pid() != first;
  }));
  process("a").order(6, true, steady_us());
  EXPECT_TRUE(becomes("a", LifecycleState::kStopped));
  process("a").order(6, false, steady_us());  // this run was stopped
  advance();
  EXPECT_EQ(process("a").lifecycle().state(), LifecycleState::kStopped);
}

TEST_F(ProcessManagerTest, StoresTheEndOfALargeOutput) {
  manage(R"(cmd "flood" { exec = "sh -c 'seq 1 300000'"; })");
  process("flood").start();
  EXPECT_TRUE(becomes("flood", LifecycleState::kStopped));
  const OutputLines unread = process("flood").output().since(0, 1000);
  EXPECT_EQ(unread.lines.back(), "300000");
  EXPECT_EQ(unread.omitted + static_cast<std::int64_t>(unread.lines.size()), 300'000);
}

TEST_F(ProcessManagerTest, MeasuresResourceUsage) {
  manage(R"(cmd "busy" { exec = "sh -c 'echo on; while :; do :; done'"; }
          cmd "idle" { exec = "sleep 100"; })");
  process("busy").start();
  process("idle").start();
  ASSERT_TRUE(prints("busy", "on"));
  process_manager_->measure(steady_us());
  EXPECT_TRUE(test::becomes_true([&] {  // at least one clock tick
    process_manager_->measure(steady_us());
    return process("busy").usage().cpu_cores > 0.0;
  }));
  EXPECT_LT(process("busy").usage().cpu_cores, 20.0);  // one tick within one measurement
  EXPECT_EQ(process("idle").usage().cpu_cores, 0.0);
  EXPECT_GT(process("idle").usage().memory_bytes, 100'000);  // a shell takes about 2 MB
  EXPECT_LT(process("idle").usage().memory_bytes, 100'000'000);
  EXPECT_GT(process("idle").usage().address_bytes, process("idle").usage().memory_bytes);
}

TEST_F(ProcessManagerTest, StopsAllProcessesOnDestruction) {
  const std::string sleep = test::unique_sleep();
  manage(R"(cmd "a" { exec = "sleep )" + sleep + R"("; } cmd "b" { exec = "setsid -f sleep )" +
         sleep + R"("; } cmd "c" { exec = "sh -c 'trap \"\" INT; sleep )" + sleep +
         R"(; true'"; stop_time_allowed = 0.1; })");
  for (const char* id : {"a", "b", "c"}) process(id).start();
  advance();
  ASSERT_TRUE(test::becomes_true([&] { return test::count_processes_with(sleep) >= 3; }));
  process_manager_.reset();
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST_F(ProcessManagerTest, KillsOrphansOfAKilledWatcher) {
  const std::string sleep = test::unique_sleep();
  manage(R"(cmd "a" { exec = "sh -c 'setsid sleep )" + sleep + R"( & echo ready; wait'"; })");
  process("a").start();
  ASSERT_TRUE(prints("a", "ready"));
  kill(process("a").watcher(), SIGKILL);
  EXPECT_TRUE(becomes("a", LifecycleState::kFailed));
  EXPECT_TRUE(test::becomes_true([&] {
    process_manager_->measure(steady_us());
    return test::count_processes_with(sleep) == 0;
  }));
}

TEST_F(ProcessManagerTest, StopsDependentsBeforeTheirDependencies) {
  const test::ScratchFolder folder;
  const auto noted = [&](const std::string& id, const std::string& more = "") {
    return "cmd \"" + id + "\" { exec = \"sh -c 'trap \\\"sleep 0.05; echo " + id + " >> " +
           (folder / "order").string() +
           "; exit\\\" TERM; echo ready; while :; do sleep 0.01; done'\"; stop_signal = 15; " +
           more + "}";
  };
  manage(noted("laser") + noted("matching", R"(depends_on = "laser"; )") +
         noted("mapping", R"(depends_on = "matching", "laser"; )"));
  for (const char* id : {"laser", "matching", "mapping"}) process(id).start();
  for (const char* id : {"laser", "matching", "mapping"}) ASSERT_TRUE(prints(id, "ready"));
  process_manager_.reset();
  EXPECT_EQ(test::contents(folder / "order"), "mapping\nmatching\nlaser\n");
}

TEST_F(ProcessManagerTest, WritesOutputAndEndsToFiles) {
  const test::ScratchFolder folder;
  process_manager_ = std::make_unique<ProcessManager>(
      parse_process_list(R"(cmd "flood" { exec = "sh -c 'seq 1 5000; exit 3'"; })", "list"),
      ProcessManagerOptions{"", ADIT_WATCH, {}, folder.path(), {}});
  process("flood").start();
  ASSERT_TRUE(becomes("flood", LifecycleState::kFailed));
  const std::string text = test::contents(folder / "flood.log");
  EXPECT_EQ(std::ranges::count(text, '\n'), 5002);  // more lines than OutputLog stores
  EXPECT_THAT(text, HasSubstr("Z --- started: sh -c 'seq 1 5000; exit 3'\n"));
  EXPECT_THAT(text, testing::EndsWith("Z --- ended with exit code 3\n"));
}

/// Runs manage_processes, which is killed by the test.
pid_t spawn_process_manager(std::string command_line) {
  std::string program = ADIT_MANAGE_PROCESSES;
  std::string watcher = ADIT_WATCH;
  char* arguments[] = {program.data(), watcher.data(), command_line.data(), nullptr};
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, program.c_str(), nullptr, nullptr, arguments, environ), 0);
  return pid;
}

TEST(KilledProcessManager, LeavesNoOrphanAtAnyDepth) {
  const std::string sleep = test::unique_sleep();
  // One ignores all signals, one has its own session, one is orphaned.
  const pid_t process_manager =
      spawn_process_manager("sh -c 'trap \"\" HUP INT TERM; setsid sleep " + sleep + " & (sleep " +
                            sleep + " &) ; while :; do sleep " + sleep + "; done'");
  const auto all_run = [&] { return test::count_processes_with(sleep) >= 6; };
  ASSERT_TRUE(test::becomes_true(all_run));  // with the manager, the watcher and the shell
  kill(process_manager, SIGKILL);
  waitpid(process_manager, nullptr, 0);
  EXPECT_TRUE(test::becomes_true([&] { return test::count_processes_with(sleep) == 0; }));
}

}  // namespace
}  // namespace adit
