// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A spinning lidar's driver, good and with mistakes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/messages/codec.hpp"
#include "common/messages/lidar.hpp"
#include "tests/unit/tools/check_driver/bad_results.hpp"
#include "tools/check_driver/driver_check.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Verdict = CheckResult::Verdict;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr std::int64_t kPeriodUs = 100'000;
constexpr int kColumns = 900;
constexpr int kRings = 16;

/// Revolutions of 0.1 s in a hall of 8 by 5 by 4 m, 0.8 m above its ground.
std::vector<LidarRevolution> good_revolutions(int rings = kRings) {
  std::mt19937 random(2);
  std::normal_distribution<float> noise_m(0.0F, 0.01F);
  std::vector<LidarRevolution> revolutions;
  for (int i = 0; i < 50; ++i) {
    LidarRevolution revolution;
    revolution.utime = kStartUs + i * kPeriodUs;
    for (int ring = 0; ring < rings; ++ring)
      revolution.rings.push_back(
          {static_cast<float>((2 * ring + 1 - rings) * 16.0 / rings * std::numbers::pi / 180.0)});
    for (int k = 0; k < kColumns; ++k) {
      const double azimuth = -2.0 * std::numbers::pi * k / kColumns;  // a VLP-16 turns clockwise
      revolution.columns.push_back(
          {static_cast<std::int32_t>(kPeriodUs * k / kColumns), static_cast<float>(azimuth)});
      for (const LidarRing& ring : revolution.rings) {
        const double wall_m = std::min(4.0 / std::max(1e-9, std::abs(std::cos(azimuth))),
                                       2.5 / std::max(1e-9, std::abs(std::sin(azimuth))));
        const double up = std::tan(ring.elevation_rad);
        const double level_m = std::min(wall_m, up < 0.0 ? 0.8 / -up : 3.2 / std::max(1e-9, up));
        revolution.ranges_m.push_back(static_cast<float>(level_m / std::cos(ring.elevation_rad)) +
                                      noise_m(random));
      }
    }
    revolutions.push_back(std::move(revolution));
  }
  return revolutions;
}

CheckResults results_of(const std::vector<LidarRevolution>& revolutions) {
  DriverCheck check("LIDAR", 100.0);
  for (const LidarRevolution& revolution : revolutions) {
    for (const LidarFragment& fragment : split(revolution))
      check.add("LIDAR", encode(to_message(fragment)), revolution.utime + kPeriodUs + 2000);
  }
  return check.results();
}

TEST(LidarCheck, FindsAGoodLidarGood) {
  const CheckResults results = results_of(good_revolutions());
  EXPECT_THAT(bad(results), testing::IsEmpty());
  const std::string text = text_of("LIDAR", results);
  EXPECT_THAT(text, HasSubstr("50, all valid"));
  EXPECT_THAT(text, HasSubstr("360° clockwise, in steps of 0.40°"));
  EXPECT_THAT(text, HasSubstr("16, -15.0° to 15.0°"));
  EXPECT_THAT(text, HasSubstr("LIDAR is what the stages need\n"));
}

struct Mistake {
  std::string name;
  std::function<void(LidarRevolution&)> make;  ///< of each revolution
  std::string line;                            ///< that is found bad, its beginning
  std::string remedy;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakesOfLidars : public testing::TestWithParam<Mistake> {};

TEST_P(MistakesOfLidars, AreFoundWithTheirRemedy) {
  auto revolutions = good_revolutions();
  for (LidarRevolution& revolution : revolutions) GetParam().make(revolution);
  const auto lines = bad(results_of(revolutions));
  EXPECT_THAT(lines, testing::Contains(testing::AllOf(testing::StartsWith(GetParam().line),
                                                      HasSubstr(GetParam().remedy))));
  EXPECT_LE(lines.size(), 2U) << testing::PrintToString(lines);
}

const Mistake kMistakes[] = {{"HalfATurn",
                              [](auto& r) {
                                r.columns.resize(kColumns / 2);
                                r.ranges_m.resize(r.columns.size() * kRings);
                              },
                              "revolution:", "one whole turn"},
                             {"WrongOrder",
                              [](auto& r) {
                                std::swap(r.columns[100].azimuth_rad, r.columns[140].azimuth_rad);
                                for (std::size_t i = 300; i + 1 < 340; i += 2)
                                  std::swap(r.columns[i].azimuth_rad, r.columns[i + 1].azimuth_rad);
                              },
                              "revolution:", "in order of time"},
                             {"NoLevelRing",
                              [](auto& r) {
                                for (auto& ring : r.rings) ring.elevation_rad -= 0.4F;
                              },
                              "rings:", "none of them is level"},
                             {"Millimetres",
                              [](auto& r) {
                                for (float& range_m : r.ranges_m) range_m *= 0.001F;
                              },
                              "ranges:", "publish metres"},
                             {"Blocked",
                              [](auto& r) {
                                for (std::size_t i = 0; i < r.ranges_m.size(); ++i)
                                  if (i % 10 != 0)
                                    r.ranges_m[i] = std::numeric_limits<float>::infinity();
                              },
                              "returns:", "blocked"},
                             {"LostDatagrams",
                              [](auto& r) {
                                for (std::size_t i = 0; i < r.ranges_m.size() / 5; ++i)
                                  r.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
                              },
                              "returns:", "datagrams are lost"}};

INSTANTIATE_TEST_SUITE_P(OfADriver, MistakesOfLidars, testing::ValuesIn(kMistakes),
                         [](const auto& test) { return test.param.name; });

TEST(LidarCheck, FindsRepeatedRevolutions) {
  auto revolutions = good_revolutions();
  for (std::size_t i = 20; i < 30; ++i) revolutions[i].ranges_m = revolutions[19].ranges_m;
  EXPECT_THAT(bad(results_of(revolutions)), testing::ElementsAre(HasSubstr("repetition: 10 of")));
}

TEST(LidarCheck, FindsLostFragments) {
  DriverCheck check("LIDAR", 100.0);
  int number = 0;
  for (const LidarRevolution& revolution : good_revolutions(128)) {
    for (const LidarFragment& fragment : split(revolution)) {
      ASSERT_GT(fragment.n_fragments, 1);
      if (fragment.fragment == 0 && ++number % 5 == 0) continue;
      check.add("LIDAR", encode(to_message(fragment)), revolution.utime + kPeriodUs + 2000);
    }
  }
  EXPECT_THAT(bad(check.results()),
              testing::Contains(testing::AllOf(HasSubstr("fragments: "), HasSubstr("rmem_max"))));
}

/// The level beams of an inverted lidar see the same, but its lowest ring the roof.
TEST(LidarCheck, DoesNotCallAnInvertedLidarUpright) {
  auto revolutions = good_revolutions();
  for (LidarRevolution& revolution : revolutions) {
    for (int k = 0; k < kColumns; ++k)
      std::reverse(revolution.ranges_m.begin() + k * kRings,
                   revolution.ranges_m.begin() + (k + 1) * kRings);
  }
  const CheckResults results = results_of(revolutions);
  const auto upright = std::ranges::find(results, "upright", &CheckResult::property);
  ASSERT_NE(upright, results.end());
  EXPECT_EQ(upright->verdict, Verdict::kUnknown) << upright->text;
}

}  // namespace
}  // namespace adit
