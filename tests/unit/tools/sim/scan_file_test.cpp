// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include <gtest/gtest.h>

#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/sim/sim_files.hpp"

namespace adit {
namespace {

TEST(ScanFile, ALogHoldsTheCompleteScan) {
  const test::ScratchFolder folder;
  Cloud cloud;
  cloud.utime = 5'000'000;
  cloud.id = 3;
  cloud.lines.resize(400);
  for (CloudLine& line : cloud.lines) {
    line.points.assign(100, {1.0F, 2.0F, 3.0F});
    line.misses.assign(5, {1.0F, 0.0F, 0.0F});
  }
  write_scan(cloud, folder / "scan.lcmlog");
  const LogFile log(folder / "scan.lcmlog");
  CloudReassembler assembler;
  std::optional<Cloud> read;
  for (const LogEventView& event : log.events()) {
    EXPECT_EQ(event.channel, "CLOUD");
    EXPECT_LT(event.data.size(), 60'000U);
    if (auto whole = assembler.add(*from_message(*decode<cloud_t>(event.data)))) read = whole;
  }
  ASSERT_TRUE(read);
  EXPECT_EQ(read->id, 3);
  EXPECT_EQ(read->points(), 40'000U);
  EXPECT_EQ(read->lines[7].misses.size(), 5U);
}

TEST(ScanFile, RejectsOtherExtensions) {
  EXPECT_THROW(write_scan({}, "scan.stl"), std::runtime_error);
  EXPECT_THROW(write_scan({}, "/nowhere/scan.ply"), std::runtime_error);
}

}  // namespace
}  // namespace adit
