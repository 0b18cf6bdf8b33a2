// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/process_faults.hpp"

#include <array>
#include <csignal>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Idle processes with executables of any name.
class ProcessFaultsTest : public testing::Test {
 protected:
  void TearDown() override {
    for (const pid_t pid : started_) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
    for (const pid_t pid : orphans_) kill(pid, SIGKILL);
  }

  std::string executable(const std::string& name) {
    std::string path = folder_ / name;
    if (!std::filesystem::exists(path)) std::filesystem::copy_file("/bin/sleep", path);
    return path;
  }

  pid_t start(const std::string& name) {
    const std::string path = executable(name);
    started_.push_back(start_child(path));
    return started_.back();
  }

  /// One whose parent has ended.
  pid_t start_orphan(const std::string& name) {
    const std::string path = executable(name);
    std::array<int, 2> pipe_ends{};
    EXPECT_EQ(pipe(pipe_ends.data()), 0);
    const pid_t parent = fork();
    if (parent == 0) {
      const pid_t child = start_child(path);
      _exit(write(pipe_ends[1], &child, sizeof child) == sizeof child ? 0 : 1);
    }
    waitpid(parent, nullptr, 0);
    pid_t orphan = 0;
    EXPECT_EQ(read(pipe_ends[0], &orphan, sizeof orphan), static_cast<ssize_t>(sizeof orphan));
    for (const int end : pipe_ends) close(end);
    orphans_.push_back(orphan);
    return orphan;
  }

  test::ScratchFolder folder_;
  std::vector<pid_t> started_;
  std::vector<pid_t> orphans_;

 private:
  /// Returns when the executable runs: its end of the pipe closes on exec.
  static pid_t start_child(const std::string& path) {
    std::array<int, 2> pipe_ends{};
    EXPECT_EQ(pipe2(pipe_ends.data(), O_CLOEXEC), 0);
    const pid_t pid = fork();
    if (pid == 0) {
      execl(path.c_str(), path.c_str(), "60", nullptr);
      _exit(127);
    }
    close(pipe_ends[1]);
    char none = 0;
    EXPECT_EQ(read(pipe_ends[0], &none, 1), 0);
    close(pipe_ends[0]);
    return pid;
  }
};

TEST_F(ProcessFaultsTest, FindProcessesByTheNameOfTheirExecutable) {
  const pid_t mapping = start("adit-mapping");
  start("adit-mapping2");
  start("sleep");
  EXPECT_THAT(descendants_named(getpid(), "adit-mapping"), ElementsAre(mapping));
}

TEST_F(ProcessFaultsTest, IgnoreProcessesThatAreNotDescendants) {
  const pid_t orphan = start_orphan("adit-mapping");
  EXPECT_EQ(kill(orphan, 0), 0);  // it still exists
  EXPECT_THAT(descendants_named(getpid(), "adit-mapping"), IsEmpty());
}

TEST_F(ProcessFaultsTest, FindTheStarterAboveAWatcher) {
  const std::string shell = folder_ / "adit-watch";
  std::filesystem::copy_file("/bin/sh", shell);
  started_.push_back(fork());
  if (started_.back() == 0) {
    execl(shell.c_str(), shell.c_str(), "-c", (executable("adit-sim") + " 60; true").c_str(),
          nullptr);
    _exit(127);
  }
  std::vector<pid_t> simulators;
  for (int i = 0; i < 1000 && simulators.empty(); ++i) {
    usleep(10'000);
    simulators = descendants_named(getpid(), "adit-sim");
  }
  ASSERT_FALSE(simulators.empty());
  EXPECT_EQ(launcher_of(simulators.front()), getpid());
  EXPECT_EQ(launcher_of(started_.back()), getpid());
  orphans_.push_back(simulators.front());
}

/// A process that signals its siblings, as the simulator does.
TEST_F(ProcessFaultsTest, SignalSiblingsOfTheNameOnly) {
  const pid_t victim = start("adit-mapping");
  const pid_t other = start("adit-scan_matching");
  const pid_t orphan = start_orphan("adit-mapping");
  const pid_t simulator = fork();
  if (simulator == 0) _exit(signal_siblings("adit-mapping", SIGKILL));
  int status = 0;
  waitpid(simulator, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 1);  // signals sent
  waitpid(victim, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(waitpid(other, nullptr, WNOHANG), 0);  // still runs
  EXPECT_EQ(kill(orphan, 0), 0);
}

}  // namespace
}  // namespace adit
