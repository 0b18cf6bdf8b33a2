// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/slurm/slurm_queue.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

/// Lines as squeue of Slurm 22.05 prints them.
TEST(SlurmTask, IsALineOfSqueue) {
  const auto task = parse_slurm_task("17|adit-6b05468b-1|20|PENDING|Resources");
  ASSERT_TRUE(task.has_value());
  EXPECT_EQ(task->job, "17");
  EXPECT_EQ(task->name, "adit-6b05468b-1");
  EXPECT_EQ(task->index, 20);
  EXPECT_FALSE(task->has_ended());
  EXPECT_FALSE(task->is_held());
  EXPECT_FALSE(parse_slurm_task("3|sleep|N/A|RUNNING|None"));  // of no array
  EXPECT_FALSE(parse_slurm_task("slurm_load_jobs error: Unable to contact slurm controller"));
}

TEST(SlurmTask, KnowsWhichStatesAreFinal) {
  const auto has_ended = [](const std::string& state) {
    return parse_slurm_task("1|a|1|" + state + "|None")->has_ended();
  };
  for (const char* state :
       {"COMPLETED", "FAILED", "TIMEOUT", "OUT_OF_MEMORY", "NODE_FAIL", "CANCELLED"})
    EXPECT_TRUE(has_ended(state)) << state;
  for (const char* state :
       {"PENDING", "RUNNING", "COMPLETING", "CONFIGURING", "REQUEUED", "SUSPENDED"})
    EXPECT_FALSE(has_ended(state)) << state;
  EXPECT_TRUE(parse_slurm_task("1|a|1|PENDING|launch failed requeued held")->is_held());
}

}  // namespace
}  // namespace adit
