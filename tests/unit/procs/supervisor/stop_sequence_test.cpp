// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/stop_sequence.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ListedCommand command(const std::string& id, const std::vector<std::string>& depends_on = {}) {
  ListedCommand command;
  command.id = id;
  command.depends_on = depends_on;
  return command;
}

class StopSequenceTest : public testing::Test {
 protected:
  std::vector<std::string> due(std::int64_t now_us = 0) {
    std::vector<std::string> ids;
    const auto is_ending = [&](const std::string& id) { return ending_.contains(id); };
    for (const auto& stop : stop_sequence_.take_due(now_us, is_ending)) ids.push_back(stop.id);
    ending_.insert(ids.begin(), ids.end());
    return ids;
  }

  StopSequence stop_sequence_;
  std::set<std::string> ending_;
};

TEST_F(StopSequenceTest, StopsDependentsBeforeTheirDependencies) {
  stop_sequence_.add(command("laser"), false, 0);
  stop_sequence_.add(command("mapping", {"matching"}), false, 0);
  stop_sequence_.add(command("matching", {"laser"}), false, 0);
  stop_sequence_.add(command("logger"), false, 0);
  EXPECT_THAT(due(), ElementsAre("mapping", "logger"));
  EXPECT_TRUE(stop_sequence_.is_pending("laser"));
  EXPECT_FALSE(stop_sequence_.is_pending("mapping"));
  EXPECT_THAT(due(), IsEmpty());
  ending_.erase("mapping");
  EXPECT_THAT(due(), ElementsAre("matching"));
  ending_.erase("logger");
  EXPECT_THAT(due(), IsEmpty());
  ending_.erase("matching");
  EXPECT_THAT(due(), ElementsAre("laser"));
}

TEST_F(StopSequenceTest, DoesNotWaitForDependentsThatContinueToRun) {
  stop_sequence_.add(command("laser"), false, 0);
  stop_sequence_.add(command("mapping", {"matching"}), false,
                     0);  // matching, between them, continues to run
  EXPECT_THAT(due(), ElementsAre("laser", "mapping"));
}

TEST_F(StopSequenceTest, CancelsAStop) {
  stop_sequence_.add(command("laser"), false, 0);
  stop_sequence_.add(command("matching", {"laser"}), true, 0);
  EXPECT_THAT(due(), ElementsAre("matching"));
  stop_sequence_.remove("laser");
  ending_.clear();
  EXPECT_THAT(due(), IsEmpty());
  EXPECT_FALSE(stop_sequence_.is_pending("laser"));
}

TEST_F(StopSequenceTest, TimesOutIfADependentDoesNotStop) {
  stop_sequence_.add(command("laser"), false, 0);
  stop_sequence_.add(command("far", {"laser"}), false, 0);
  EXPECT_THAT(due(), ElementsAre("far"));
  EXPECT_THAT(due(StopSequence::kTimeoutUs - 1), IsEmpty());
  EXPECT_THAT(due(StopSequence::kTimeoutUs), ElementsAre("laser"));
}

}  // namespace
}  // namespace adit
