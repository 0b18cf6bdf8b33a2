// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Real processes: the environment of a started program, and the tracking of its descendants.
#include "procs/supervisor/os/child_process.hpp"

#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "procs/supervisor/os/procfs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::size_t kPlenty = 10'000'000;

ChildStart start_of(const std::string& line) {
  return {*parse_command_line(line), SIGTERM, 5.0, ADIT_WATCH};
}

/// A shell with a script, which must not contain single quotes.
ChildStart shell(const std::string& script) { return start_of("sh -c '" + script + "'"); }

/// Polls the process until it ends.
ChildProcess::End end_of(ChildProcess& child, std::string* output = nullptr) {
  std::optional<ChildProcess::End> end;
  EXPECT_TRUE(test::becomes_true([&] {
    end = child.poll();
    const std::string more = child.read_output(kPlenty);
    if (output) *output += more;
    return end.has_value();
  }));
  return end.value_or(ChildProcess::End{});
}

std::string output_of(const ChildStart& start) {
  ChildProcess child(start);
  std::string output;
  end_of(child, &output);
  return output;
}

TEST(ChildProcess, ReturnsHowTheProgramEnded) {
  ChildProcess succeeded(shell("exit 0"));
  EXPECT_TRUE(end_of(succeeded).succeeded());
  ChildProcess badly(shell("exit 3"));
  const ChildProcess::End end = end_of(badly);
  EXPECT_EQ(WEXITSTATUS(end.wait_status), 3);
  EXPECT_EQ(end.text(), "ended with exit code 3");
  ChildProcess killed(shell("kill -SEGV $$"));
  EXPECT_EQ(end_of(killed).text(), "killed by SIGSEGV");
}

TEST(ChildProcess, WritesToAFileInAFolderInPlaceOfATerminal) {
  const test::ScratchFolder folder;
  const int output = open((folder / "output").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  ChildStart start = shell("pwd; [ -t 0 ] || cat; echo error >&2; exit 4");
  start.output = output;
  start.folder = folder.path();
  ChildProcess child(start);
  const ChildProcess::End end = end_of(child);
  close(output);
  EXPECT_EQ(WEXITSTATUS(end.wait_status), 4);
  EXPECT_GT(end.memory_bytes, 100'000);
  EXPECT_EQ(test::contents(folder / "output"), folder.path().string() + "\nerror\n");
}

TEST(ChildProcess, MeasuresTheCpuTimeOfAllDescendants) {
  ChildProcess child(shell("(i=0; while [ $i -lt 100000 ]; do i=$((i + 1)); done) & wait"));
  const ChildProcess::End end = end_of(child);
  EXPECT_GT(end.cpu_s, 0.01);
  EXPECT_LT(end.cpu_s, 30.0);
}

TEST(ChildProcess, PassesAListeningSocketAsSystemdDoes) {
  const int listening = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(listen(listening, 1), 0);
  ChildStart start = shell(
      "[ \"$LISTEN_PID\" = $$ ] && echo $LISTEN_FDS socket; readlink /proc/$$/fd/3 | cut -c 1-7");
  EXPECT_THAT(output_of(start), testing::Not(HasSubstr("socket")));
  start.listening_socket = listening;
  EXPECT_THAT(output_of(start), testing::StartsWith("1 socket\nsocket:\n"));
  close(listening);
}

TEST(ChildProcess, ReportsWhyAProgramCannotBeStarted) {
  EXPECT_THROW(
      {
        try {
          const ChildProcess child(start_of("/nonexistent/program x"));
        } catch (const std::runtime_error& error) {
          EXPECT_THAT(error.what(), HasSubstr("No such file"));
          throw;
        }
      },
      std::runtime_error);
}

TEST(ChildProcess, PassesArgumentsUnchangedAndExtendsTheEnvironment) {
  EXPECT_EQ(output_of(start_of(R"(printf '%s|' "a b" '' '$HOME;' c\ d)")), "a b||$HOME;|c d|");
  EXPECT_EQ(output_of(start_of("ADIT_TEST='x y' sh -c 'echo $ADIT_TEST $0'")), "x y sh\n");
}

TEST(ChildProcess, HasATerminalWithoutOutputProcessing) {
  EXPECT_EQ(output_of(shell("test -t 0 && test -t 1 && test -t 2 && echo yes; echo err >&2")),
            "yes\nerr\n");
}

TEST(ChildProcess, LeadsASession) {
  EXPECT_EQ(output_of(shell("set -- $(cut -d\" \" -f 5,6 /proc/$$/stat); "
                            "test $1 = $$ && test $2 = $$ && echo own")),
            "own\n");
}

TEST(ChildProcess, ReceivesAllSignals) {
  // Signals 32 and 33 are internal to glibc, which ignores them between fork and exec.
  EXPECT_EQ(output_of(start_of("grep -Ec 'SigBlk:.0{16}|SigIgn:.*0{7}$' /proc/self/status")),
            "2\n");
}

TEST(ChildProcess, InheritsNoDescriptors) {
  const int leak = open("/dev/null", O_RDONLY);  // not close-on-exec, like LCM's sockets
  ASSERT_GE(leak, 3);
  // Descriptor 3 is the folder that ls reads.
  EXPECT_EQ(output_of(start_of("ls -1 /proc/self/fd")), "0\n1\n2\n3\n");
  close(leak);
}

TEST(ChildProcess, SendsSignalsToAllDescendants) {
  const std::string sleep = test::unique_sleep();
  ChildProcess child(
      shell("sleep " + sleep + " & setsid sh -c \"sleep " + sleep + "; true\" & wait"));
  // Two sleep processes and two shells with that text on their command lines.
  ASSERT_TRUE(test::becomes_true([&] { return test::count_processes_with(sleep) >= 4; }));
  child.send(SIGTERM);
  EXPECT_EQ(end_of(child).text(), "killed by SIGTERM");
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST(ChildProcess, KillsProcessesThatIgnoreTheStopSignal) {
  const std::string sleep = test::unique_sleep();
  ChildProcess child(
      shell("trap \"\" TERM INT HUP; sleep " + sleep + " & echo ready; wait; sleep " + sleep));
  ASSERT_TRUE(test::becomes_true([&] { return !child.read_output(kPlenty).empty(); }));
  child.send(SIGTERM);
  EXPECT_FALSE(child.poll());
  EXPECT_GE(test::count_processes_with(sleep), 1);
  child.send(SIGKILL);
  EXPECT_EQ(end_of(child).text(), "killed by SIGKILL");
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST(ChildProcess, StopsRemainingDescendants) {
  const std::string sleep = test::unique_sleep();
  ChildProcess child(shell("setsid sleep " + sleep + " & exit 4"));
  EXPECT_EQ(end_of(child).text(), "ended with exit code 4");
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST(ChildProcess, KillsRemainingDescendantsThatDoNotStop) {
  const std::string sleep = test::unique_sleep();
  ChildStart start = shell("(trap \"\" TERM; sleep " + sleep + ") & sleep 0.1; exit 4");
  start.stop_time_s = 0.1;
  ChildProcess child(start);
  EXPECT_EQ(end_of(child).text(), "ended with exit code 4");
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST(ChildProcess, KillsAllDescendantsOnDestruction) {
  const std::string sleep = test::unique_sleep();
  {
    const ChildProcess child(
        shell("trap \"\" HUP TERM; setsid sleep " + sleep + " & sleep " + sleep));
    ASSERT_TRUE(test::becomes_true([&] { return test::count_processes_with(sleep) >= 3; }));
  }
  EXPECT_EQ(test::count_processes_with(sleep), 0);
}

TEST(ChildProcess, ReportsTheEndOfItsWatcher) {
  ChildProcess child(shell("sleep " + test::unique_sleep()));
  kill(child.watcher(), SIGKILL);
  ASSERT_TRUE(test::becomes_true(
      [&] { return ProcessTable::read().entries().at(child.watcher()).state == 'Z'; }));
  child.send(SIGTERM);  // without effect
  EXPECT_EQ(end_of(child).text(), "killed by SIGKILL");
}

TEST(ChildProcess, LeavesNoZombies) {
  {
    ChildProcess child(
        shell("for i in 1 2 3 4 5; do (sleep 0.01 &) ; done; sleep 0.1; echo done; "
              "exec sleep 100"));
    std::string output;
    ASSERT_TRUE(
        test::becomes_true([&] { return !(output += child.read_output(kPlenty)).empty(); }));
    ASSERT_TRUE(test::becomes_true(
        [&] { return ProcessTable::read().descendants_of(child.watcher()).size() == 1; }));
  }
  EXPECT_TRUE(ProcessTable::read().children_of(getpid()).empty());
}

TEST(ChildProcess, BlocksItsOutputUntilItIsRead) {
  ChildProcess child(shell("yes 0123456789 | head -c 3000000"));
  std::string output;
  EXPECT_TRUE(end_of(child, &output).succeeded());
  EXPECT_EQ(output.size(), 3'000'000U);
}

}  // namespace
}  // namespace adit
