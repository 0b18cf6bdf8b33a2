// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/procfs.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/files/file_utils.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

constexpr const char* kStat =
    "4711 (a) (b) S 17 4711 4711 0 -1 4194304 100 0 0 0 150 50 0 0 20 0 3 0 999 8192000 100 "
    "18446744073709551615 1 1 0 0 0 0 0 0 0 0 0 0 17 2 0 0 0 0 0";

TEST(ProcessTable, ParsesAnyProcessName) {
  const auto entry = parse_process_entry(kStat);
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->pid, 4711);
  EXPECT_EQ(entry->parent, 17);
  EXPECT_EQ(entry->state, 'S');
  EXPECT_DOUBLE_EQ(entry->cpu_s, 200.0 / static_cast<double>(sysconf(_SC_CLK_TCK)));
  EXPECT_EQ(entry->address_bytes, 8'192'000);
  EXPECT_EQ(entry->memory_bytes, 100 * sysconf(_SC_PAGESIZE));
}

TEST(ProcessTable, RejectsInvalidLines) {
  for (const char* text : {"", "4711", "4711 (a", "4711 (a) S 17", ") S 1 2 3"}) {
    EXPECT_FALSE(parse_process_entry(text)) << text;
  }
}

ProcessEntry entry(pid_t pid, pid_t parent, double cpu_s = 0.0) {
  return {pid, parent, 'S', cpu_s, 1000, 10};
}

TEST(ProcessTable, FindsDescendantsAtAnyDepthInAnInconsistentTable) {
  const ProcessTable table({{2, entry(2, 1)},
                            {3, entry(3, 2)},
                            {4, entry(4, 3)},
                            {5, entry(5, 1)},
                            {7, entry(7, 8)},
                            {8, entry(8, 7)}});  // a cycle, possible in a non-atomic read
  EXPECT_THAT(table.descendants_of(2), ElementsAre(3, 4));
  EXPECT_THAT(table.children_of(1), ElementsAre(2, 5));
  EXPECT_THAT(table.descendants_of(7), ElementsAre(8));
}

TEST(ProcessTable, OfDescendantsHasThemAlone) {
  const pid_t child = fork();
  if (child == 0) {
    if (fork() == 0) pause();
    pause();
  }
  const auto has_two = [&] {
    return ProcessTable::read_descendants(getpid()).descendants_of(getpid()).size() == 2;
  };
  EXPECT_TRUE(test::becomes_true(has_two));
  const ProcessTable table = ProcessTable::read_descendants(child);
  const auto grandchildren = table.descendants_of(child);
  ASSERT_THAT(grandchildren, testing::SizeIs(1));
  EXPECT_EQ(table.entries().at(*grandchildren.begin()).parent, child);
  kill(*grandchildren.begin(), SIGKILL);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(ProcessTable, ContainsThisProcess) {
  const ProcessTable table = ProcessTable::read();
  ASSERT_TRUE(table.entries().contains(getpid()));
  EXPECT_EQ(table.entries().at(getpid()).parent, getppid());
  EXPECT_GT(table.entries().at(getpid()).memory_bytes, 1'000'000);
}

/// A file that can be opened but not read, like that of a process that ends in between.
TEST(ProcessTable, OmitsAProcessThatEndsDuringTheRead) {
  const test::ScratchFolder proc;
  std::filesystem::create_directories(proc / "17" / "stat");
  std::filesystem::create_directories(proc / "4711");
  write_text_file(kStat, proc / "4711" / "stat");
  const ProcessTable table = ProcessTable::read(proc.path());
  EXPECT_EQ(table.entries().size(), 1U);
  EXPECT_TRUE(table.entries().contains(4711));
}

TEST(UsageMeter, SumsTheUsageOfDescendants) {
  UsageMeter meter;
  const ProcessTable before({{2, entry(2, 1, 5.0)}, {3, entry(3, 2, 1.0)}, {4, entry(4, 3, 2.0)}});
  const ResourceUsage first = meter.measure(before, 2, 10'000'000);
  EXPECT_EQ(first.cpu_cores, 0.0);  // no previous measurement
  EXPECT_EQ(first.address_bytes, 2000);
  EXPECT_EQ(first.memory_bytes, 20);
  // 3 has used half a second, 4 has ended, 5 is new.
  const ProcessTable after({{2, entry(2, 1, 9.0)}, {3, entry(3, 2, 1.5)}, {5, entry(5, 3, 0.25)}});
  EXPECT_DOUBLE_EQ(meter.measure(after, 2, 12'000'000).cpu_cores, 0.375);
}

TEST(UsageMeter, DetectsDescendantsInDiskSleep) {
  UsageMeter meter;
  ProcessEntry waiting = entry(4, 3);
  waiting.state = 'D';
  const ProcessTable table({{2, entry(2, 1)}, {3, entry(3, 2)}, {4, waiting}, {5, entry(5, 1)}});
  EXPECT_TRUE(meter.measure(table, 2, 10'000'000).in_disk_sleep);
  EXPECT_FALSE(meter.measure(table, 5, 11'000'000).in_disk_sleep);
}

TEST(HostMeter, MeasuresMemoryAndLoadOfThisComputer) {
  HostMeter meter;
  const HostLoad load = meter.measure();  // since boot
  EXPECT_GT(load.cpu_share, 0.0);
  EXPECT_LT(load.cpu_share, 1.0);
  EXPECT_GT(load.memory_bytes, load.memory_free_bytes);
  EXPECT_GT(load.memory_free_bytes, 0);
}

}  // namespace
}  // namespace adit
