// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/daemon.hpp"

#include <csignal>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(ReloadSignal, CanBePolled) {
  ReloadSignal::block();
  const ReloadSignal signal;
  EXPECT_FALSE(signal.received());
  raise(SIGHUP);
  EXPECT_TRUE(signal.received());
  EXPECT_FALSE(signal.received());
}

}  // namespace
}  // namespace adit
