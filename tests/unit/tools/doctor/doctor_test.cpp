// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tools/doctor/computer_checks.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Verdict = CheckResult::Verdict;

TEST(Doctor, FindsAMissingRoute) {
  const std::string heading = "Iface\tDestination\tGateway\n";
  EXPECT_EQ(check_route(heading + "lo\t000000E0\t00000000\n").verdict, Verdict::kGood);
  const CheckResult missing = check_route(heading + "eth0\t0009000A\t00000000\n");
  EXPECT_EQ(missing.verdict, Verdict::kBad);
  EXPECT_THAT(missing.text, HasSubstr("adit-loopback"));
}

TEST(Doctor, FindsSmallBuffers) {
  EXPECT_EQ(check_buffers(4'194'304).verdict, Verdict::kGood);
  const CheckResult small = check_buffers(212'992);
  EXPECT_EQ(small.verdict, Verdict::kBad);
  EXPECT_THAT(small.text, HasSubstr("sudo sysctl -w net.core.rmem_max=4194304"));
}

TEST(Doctor, FindsAClockThatWasNeverSet) {
  EXPECT_EQ(check_clock({true, 0.001, 1'800'000'000'000'000}).verdict, Verdict::kGood);
  EXPECT_EQ(check_clock({false, 16.0, 1'800'000'000'000'000}).verdict, Verdict::kUnknown);
  EXPECT_EQ(check_clock({false, 16.0, 0}).verdict, Verdict::kBad);
}

TEST(Doctor, FindsAProcessorThatIsKeptSlow) {
  EXPECT_EQ(check_governors({}).verdict, Verdict::kUnknown);
  EXPECT_EQ(check_governors({"performance", "schedutil"}).verdict, Verdict::kGood);
  const CheckResult slow = check_governors({"powersave", "powersave"});
  EXPECT_EQ(slow.verdict, Verdict::kBad);
  EXPECT_THAT(slow.text, HasSubstr("2 x powersave"));
}

TEST(Doctor, FindsADiskThatIsTooSlowOrTooFull) {
  EXPECT_EQ(check_disk("/d", 100.0, 100'000.0, 1.0).verdict, Verdict::kGood);  // 27.8 h
  EXPECT_THAT(check_disk("/d", 100.0, 100'000.0, 1.0).text, HasSubstr("27.8 h"));
  EXPECT_THAT(check_disk("/d", 3.0, 100'000.0, 1.0).text, HasSubstr("too slow"));
  const CheckResult full = check_disk("/d", 100.0, 10'000.0, 1.0);  // 2.8 h
  EXPECT_EQ(full.verdict, Verdict::kBad);
  EXPECT_THAT(full.text, HasSubstr("move earlier logs away"));
}

TEST(Doctor, FindsDevicesThatAreMissing) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch / "tty") << "";
  EXPECT_EQ(check_device("scip_front", (scratch / "tty").string()).verdict, Verdict::kGood);
  EXPECT_EQ(check_device("scip_front", "tcp://10.0.0.2:10940").verdict, Verdict::kUnknown);
  const CheckResult missing = check_device("scip_front", (scratch / "none").string());
  EXPECT_EQ(missing.verdict, Verdict::kBad);
  EXPECT_THAT(missing.text, HasSubstr("does not exist"));
}

TEST(Doctor, FindsAComputerThatIsTooSlow) {
  EXPECT_EQ(check_load({10.0, 0.4, 0.9, 1.0}, 2).verdict, Verdict::kGood);
  EXPECT_EQ(check_load({10.0, 1.4, 1.8, 1.0}, 2).verdict, Verdict::kBad);
  EXPECT_EQ(check_load({10.0, 0.4, 2.5, 1.0}, 2).verdict, Verdict::kBad);
}

TEST(Doctor, MeasuresTheDiskAndTheStages) {
  const test::ScratchFolder scratch;
  EXPECT_GT(disk_speed_mb_s(scratch.path()), 0.0);
  const StageLoad load = measure_stage_load({}, scratch.path(), 0.5);
  EXPECT_GT(load.simulated_s, 0.0);
  EXPECT_GT(load.share, 0.0);
  EXPECT_GT(load.log_mb_s, 0.01);  // two lasers of 361 beams at 37.5 Hz alone are 0.1
}

}  // namespace
}  // namespace adit
