// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/config.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config/number_text.hpp"
#include "tests/unit/common/config/example_params.hpp"

namespace adit {
namespace {

TEST(Config, KeepsTheDefaultOfAMissingKey) {
  EXPECT_EQ(load_outer(""), OuterParams{});
  EXPECT_EQ(load_outer("# nothing\n"), OuterParams{});
  EXPECT_EQ(load_outer("outer:\n"), OuterParams{});
  EXPECT_EQ(load_outer("other: {anything: 1}"), OuterParams{});
  EXPECT_EQ(load_section<OuterParams>(ConfigFile(), "outer"), OuterParams{});
}

TEST(Config, LoadsEveryType) {
  const OuterParams params = load_outer(R"(
outer:
  search_radius_m: 1e-1
  share: 1
  channel: "LASER REAR"
  thresholds_m: [1, 2.5, 3]
  T_body_laser: {x_m: -1.5, theta_rad: 3.1}
  inner:
    iterations: 3
    robust: false
)");
  EXPECT_EQ(params.search_radius_m, 0.1);
  EXPECT_EQ(params.share, 1.0);
  EXPECT_EQ(params.channel, "LASER REAR");
  EXPECT_EQ(params.thresholds_m, (std::vector<double>{1.0, 2.5, 3.0}));
  EXPECT_EQ(params.T_body_laser, (Pose2{-1.5, 0.0, 3.1}));
  EXPECT_EQ(params.inner, (InnerParams{3, false}));
}

TEST(Config, WritesWhatItLoads) {
  OuterParams params;
  params.search_radius_m = 0.1 + 0.2;
  params.share = 1.0 / 3.0;
  params.channel = "quote \" backslash \\ line\n tab\t: # é";
  params.thresholds_m = {};
  params.T_body_laser = {1e-300, -0.0, 3.0};
  params.inner.robust = false;
  EXPECT_EQ(load_outer(to_yaml(params, "outer")), params);
}

TEST(Config, WritesTheBoundsNextToTheValue) {
  EXPECT_EQ(to_yaml(OuterParams{}, "outer"), R"(outer:
  search_radius_m: 0.3  # > 0
  share: 0.1  # 0 to 1
  channel: "LASER_FRONT"
  thresholds_m: [0.5, 0.25]  # >= 0
  T_body_laser:
    x_m: 0.2
    y_m: 0
    theta_rad: 0
  inner:
    iterations: 10  # 1 to 100
    robust: true
)");
}

struct FleetParams {
  std::vector<InnerParams> robots;
  std::string steering = "ackermann";

  template <class V>
  void visit(V& v) {
    v("robots", robots);
    v("steering", steering, OneOf({"ackermann", "four_wheel"}));
  }
  friend bool operator==(const FleetParams&, const FleetParams&) = default;
};

FleetParams load_fleet(const std::string& yaml) {
  return load_section<FleetParams>(ConfigFile::parse(yaml, "robot.yaml"), "fleet");
}

std::string fleet_error(const std::string& yaml) {
  try {
    load_fleet(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Config, StartsEachElementOfAListFromTheDefaults) {
  const FleetParams fleet = load_fleet("fleet:\n  robots: [{iterations: 3}, {robust: false}]\n");
  EXPECT_EQ(fleet.robots, (std::vector<InnerParams>{{3, true}, {10, false}}));
  EXPECT_EQ(load_fleet("fleet: {robots: []}"), FleetParams{});
}

TEST(Config, WritesAListOfMapsAsItLoadsIt) {
  FleetParams fleet;
  EXPECT_EQ(load_fleet(to_yaml(fleet, "fleet")), fleet);
  fleet.robots = {{3, true}, {4, false}};
  EXPECT_EQ(load_fleet(to_yaml(fleet, "fleet")), fleet);
  EXPECT_EQ(to_yaml(fleet, "fleet"), R"(fleet:
  robots:
    - iterations: 3  # 1 to 100
      robust: true
    - iterations: 4  # 1 to 100
      robust: false
  steering: "ackermann"  # ackermann or four_wheel
)");
}

TEST(Config, NamesTheListElementOfAnError) {
  EXPECT_EQ(fleet_error("fleet:\n  robots:\n    - iterations: 3\n    - iterations: 0\n"),
            "robot.yaml:4: fleet.robots[1].iterations is 0; allowed: 1 to 100");
  EXPECT_EQ(fleet_error("fleet: {robots: {iterations: 3}}"),
            "robot.yaml:1: fleet.robots is a map, not a list");
  EXPECT_EQ(fleet_error("fleet: {robots: [3]}"),
            "robot.yaml:1: fleet.robots[0] is '3', not a map of keys");
}

TEST(Config, AcceptsAllowedNamesOnly) {
  EXPECT_EQ(load_fleet("fleet: {steering: four_wheel}").steering, "four_wheel");
  EXPECT_EQ(fleet_error("fleet: {steering: skid}"),
            "robot.yaml:1: fleet.steering is 'skid'; allowed: ackermann or four_wheel");
}

struct SharingParams {
  int own = 1;
  InnerParams inner;

  template <class V>
  void visit(V& v) {
    v.shared("common", inner);
    v("own", own);
  }
};

TEST(Config, LoadsSharedParametersFromASectionOfTheirOwn) {
  const auto file = ConfigFile::parse("one: {own: 3}\ncommon: {iterations: 7}\n", "test.yaml");
  for (const char* stage : {"one", "other"}) {
    EXPECT_EQ(load_section<SharingParams>(file, stage).inner.iterations, 7) << stage;
  }
  EXPECT_EQ(load_section<SharingParams>(file, "one").own, 3);
  const std::string yaml = to_yaml(load_section<SharingParams>(file, "one"), "one");
  EXPECT_EQ(yaml, "one:\n  own: 3\ncommon:\n  iterations: 7  # 1 to 100\n  robust: true\n");
}

TEST(Config, ChecksSharedKeys) {
  const auto failure = [](const std::string& text) -> std::string {
    try {
      load_section<SharingParams>(ConfigFile::parse(text, "test.yaml"), "one");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(failure("common:\n  iteration: 7\n"), testing::HasSubstr("test.yaml:2: unknown key"));
  EXPECT_THAT(failure("common:\n  iterations: 0\n"), testing::HasSubstr("common.iterations is 0"));
  EXPECT_THAT(failure("one:\n  inner: {iterations: 7}\n"),
              testing::HasSubstr("unknown key 'inner'"));
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(parse_number<double>(number_text(number)), number) << number;
  }
}

// fmt's "{}" gives 100000, 0.0001 and 1500000: files compared to the byte would change.
TEST(NumberText, IsTheShortestNotation) {
  EXPECT_EQ(number_text(1e5), "1e+05");
  EXPECT_EQ(number_text(1e-4), "1e-04");
  EXPECT_EQ(number_text(1.5e6), "1500000");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(number_text(-0.0), "-0");
}

TEST(Config, DescribesBounds) {
  EXPECT_EQ(above_up_to(0.0, 1.0).text(), "> 0, <= 1");
  EXPECT_EQ((Bounds{.max = 2.0}.text()), "<= 2");
  EXPECT_FALSE(above(0.0).allow(0.0));
  EXPECT_TRUE(at_least(0.0).allow(0.0));
  EXPECT_FALSE(within(0.0, 1.0).allow(1.1));
  EXPECT_FALSE(Bounds{}.allow(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(Bounds{}.allow(std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace adit
