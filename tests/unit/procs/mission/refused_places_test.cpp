// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/refused_places.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(RefusedPlaces, AreNotLeftBehindByWhoComesBack) {
  RefusedPlaces refused;
  EXPECT_TRUE(refused.all_beyond(1.0, {0.0, 0.0}));
  refused.add({0.0, 0.0});
  EXPECT_FALSE(refused.all_beyond(1.0, {0.9, 0.0}));
  EXPECT_TRUE(refused.all_beyond(1.0, {1.1, 0.0}));
  refused.add({10.0, 0.0});
  EXPECT_FALSE(refused.all_beyond(1.0, {0.5, 0.0}));
}

TEST(RefusedPlaces, AreTheNewestSoMany) {
  RefusedPlaces refused;
  refused.add({-5.0, 0.0});
  for (std::size_t i = 0; i < RefusedPlaces::kPlaces; ++i) {
    refused.add({static_cast<double>(i), 0.0});
  }
  EXPECT_TRUE(refused.all_beyond(1.0, {-5.0, 0.0}));
  EXPECT_FALSE(refused.all_beyond(1.0, {0.0, 0.0}));
}

}  // namespace
}  // namespace adit
