// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/procman/name_claim.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/service/node_end.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kStepUs = 20'000;
constexpr std::int64_t kSecondUs = 1'000'000;

/// Supervisors of one name on a network that loses messages. A supervisor that holds its name
/// publishes PM_INFO each second and in answer to a probe.
class Network {
 public:
  explicit Network(double loss_share, unsigned seed) : loss_(loss_share), random_(seed) {}

  void start(std::int64_t nonce) {
    supervisors_.push_back({NameClaim("robot", nonce, NameClaim::kListenS, now_us_), now_us_});
  }

  void run_for(std::int64_t duration_us) {
    for (const std::int64_t end = now_us_ + duration_us; now_us_ < end; now_us_ += kStepUs) step();
  }

  [[nodiscard]] std::ptrdiff_t holders() {
    return std::ranges::count_if(supervisors_, [&](Supervisor& s) { return s.holds; });
  }
  [[nodiscard]] std::ptrdiff_t ended() {
    return std::ranges::count_if(supervisors_, [](const Supervisor& s) { return s.ended; });
  }
  void kill_holders() {
    for (Supervisor& s : supervisors_) s.ended = s.ended || s.holds, s.holds = false;
  }

 private:
  struct Supervisor {
    NameClaim claim;
    std::int64_t next_info_us;
    bool holds = false;
    bool ended = false;
  };

  void step() {
    for (Supervisor& s : supervisors_) {
      if (s.ended) continue;
      try {
        s.holds = s.claim.is_held(now_us_);
      } catch (const NodeEnd&) {
        s.ended = true;
        s.holds = false;
        continue;
      }
      if (const auto probe = s.claim.take_probe(now_us_, now_us_)) deliver(*probe);
      if (s.holds && now_us_ >= s.next_info_us) inform(s);
    }
  }

  void inform(Supervisor& sender) {
    sender.next_info_us = now_us_ + kSecondUs;
    const ProcmanInfo info{now_us_ + (&sender - supervisors_.data()), "robot", {}, {}};
    sender.claim.published(info);
    for (Supervisor& s : supervisors_) {
      if (!s.ended && arrives()) s.claim.on_message(info, now_us_);
    }
  }

  void deliver(const ProcmanDiscovery& probe) {
    for (Supervisor& s : supervisors_) {
      if (s.ended || !arrives()) continue;
      s.claim.on_message(probe);
      if (s.holds) inform(s);
    }
  }

  bool arrives() { return std::bernoulli_distribution(1.0 - loss_)(random_); }

  double loss_;
  std::mt19937 random_;
  std::int64_t now_us_ = kSecondUs;
  std::vector<Supervisor> supervisors_;
};

TEST(NameClaim, IsHeldAfterListening) {
  Network network(0.0, 1);
  network.start(5);
  network.run_for(kSecondUs);
  EXPECT_EQ(network.holders(), 0);
  network.run_for(kSecondUs);
  EXPECT_EQ(network.holders(), 1);
}

TEST(NameClaim, IsLostToAHolder) {
  Network network(0.0, 1);
  network.start(5);
  network.run_for(5 * kSecondUs);
  network.start(1);  // a smaller nonce does not matter
  network.run_for(5 * kSecondUs);
  EXPECT_EQ(network.holders(), 1);
  EXPECT_EQ(network.ended(), 1);
}

TEST(NameClaim, PassesToANewSupervisorAfterTheEndOfTheHolder) {
  Network network(0.0, 1);
  network.start(5);
  network.run_for(5 * kSecondUs);
  network.kill_holders();
  network.start(7);
  network.run_for(5 * kSecondUs);
  EXPECT_EQ(network.holders(), 1);
}

TEST(NameClaim, HasOneHolderOfSupervisorsThatStartTogether) {
  std::mt19937 random(3);
  for (unsigned seed = 0; seed < 200; ++seed) {
    Network network(0.0, seed);
    for (int i = 0; i < 4; ++i) {
      network.start(std::uniform_int_distribution<std::int64_t>(1, 1'000'000'000)(random));
      if (seed > 0) network.run_for(std::uniform_int_distribution<int>(0, 40)(random) * kStepUs);
    }
    network.run_for(5 * kSecondUs);
    EXPECT_EQ(network.holders(), 1) << seed;
    EXPECT_EQ(network.ended(), 3) << seed;
  }
}

/// Two probes of six, and one PM_INFO, suffice: with 30 % loss none arrives in 0.1 % of the starts.
TEST(NameClaim, ToleratesLoss) {
  int conflicts = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Network network(0.3, seed);
    network.start(1);
    network.run_for(3 * kSecondUs);
    network.start(2);
    network.run_for(5 * kSecondUs);
    conflicts += network.holders() > 1 ? 1 : 0;
  }
  EXPECT_LE(conflicts, 2);
}

TEST(NameClaim, NamesTheConflict) {
  NameClaim claim("rob\x1bot", 1, NameClaim::kListenS, 0);
  claim.on_message(ProcmanInfo{5, "other", {}, {}}, 0);
  EXPECT_FALSE(claim.is_held(0));
  claim.on_message(ProcmanInfo{5, "rob\x1bot", {}, {}}, 0);
  try {
    claim.is_held(0);
    FAIL() << "held";
  } catch (const NodeEnd& error) {
    EXPECT_THAT(error.what(), HasSubstr("another supervisor named 'rob\\x1bot' runs"));
  }
}

TEST(NameClaim, ReportsASupervisorOfTheSameNameThatAppearsLater) {
  NameClaim claim("robot", 1, 0.0, 0);
  EXPECT_TRUE(claim.is_held(0));
  const ProcmanInfo own{5, "robot", {}, {}};
  claim.published(own);
  claim.on_message(own, kSecondUs);
  EXPECT_EQ(claim.problem(kSecondUs), "");
  claim.on_message(ProcmanInfo{6, "robot", {}, {}}, 2 * kSecondUs);
  EXPECT_THAT(claim.problem(2 * kSecondUs), HasSubstr("another supervisor named 'robot'"));
  EXPECT_TRUE(claim.is_held(2 * kSecondUs));
  EXPECT_EQ(claim.problem(20 * kSecondUs), "");
}

}  // namespace
}  // namespace adit
