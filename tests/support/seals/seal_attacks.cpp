// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/seals/seal_attacks.hpp"

#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "common/seal/seal_receiver.hpp"
#include "common/seal/seal_sender.hpp"

namespace adit {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::string_view, 3> kOrders{"DRIVE_COMMAND", "GOAL", "MISSION_ORDER"};
constexpr std::string_view kAnswer = "SEAL_ANSWER";
constexpr std::size_t kRecordedMax = 5000;
constexpr std::int64_t kLateUs = 4'500'000;  // more than the ages of message and answer together

/// The clock of a computer, of the time in the world.
struct Clock {
  std::int64_t offset_us = 0;
  double rate = 1.0;

  [[nodiscard]] std::int64_t at(std::int64_t us) const {
    return offset_us + static_cast<std::int64_t>(rate * static_cast<double>(us));
  }
};

struct Recorded {
  std::string channel;
  Bytes bytes;
};

class Scene {
 public:
  explicit Scene(std::uint64_t seed);

  SealAttackCounts run(std::int64_t attacks);

 private:
  struct Sender {
    SealSender seal;
    Clock clock;
  };

  std::int64_t integer(std::int64_t first, std::int64_t last) {
    return std::uniform_int_distribution<std::int64_t>(first, last)(random_);
  }
  Clock random_clock() {
    return {integer(1, 864'000'000'000), 1.0 + 1e-6 * static_cast<double>(integer(-500, 500))};
  }
  std::string_view random_channel() {
    return kOrders.at(static_cast<std::size_t>(integer(0, kOrders.size() - 1)));
  }

  Bytes random_message();
  Bytes sealed(Sender& sender, std::string_view channel);
  void record(std::string_view channel, const Bytes& bytes);
  std::string_view deliver(std::string_view channel, const Bytes& bytes);
  void introduce();
  void restart();
  void send_genuine();
  void replay_an_answer();
  void attack();
  Bytes damaged(Bytes bytes, SealAttack kind);

  std::mt19937_64 random_;
  SealKey key_ = SealKey::random();
  SealSender stranger_{SealKey::random()};
  SealReceiver receiver_{key_};
  Clock clock_;
  std::vector<Sender> senders_;
  std::int64_t us_ = 1'000'000;
  std::vector<Recorded> recorded_;
  std::vector<std::pair<SealNonce, Bytes>> answers_;
  SealAttackCounts counts_;
};

Scene::Scene(std::uint64_t seed) : random_(seed), clock_(random_clock()) {
  for (int i = 0; i < 2; ++i) senders_.push_back({SealSender(key_), random_clock()});
  introduce();
}

Bytes Scene::random_message() {
  Bytes bytes(static_cast<std::size_t>(integer(8, 80)));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(integer(0, 255));
  return bytes;
}

Bytes Scene::sealed(Sender& sender, std::string_view channel) {
  Bytes bytes = sender.seal.seal(channel, random_message(), sender.clock.at(us_));
  record(channel, bytes);
  return bytes;
}

void Scene::record(std::string_view channel, const Bytes& bytes) {
  Recorded message{std::string(channel), bytes};
  if (recorded_.size() < kRecordedMax) {
    recorded_.push_back(std::move(message));
  } else {
    recorded_.at(static_cast<std::size_t>(integer(0, kRecordedMax - 1))) = std::move(message);
  }
}

std::string_view Scene::deliver(std::string_view channel, const Bytes& bytes) {
  return receiver_.check(channel, bytes, clock_.at(us_));
}

/// Challenges all senders, if one is due, and delivers their answers.
void Scene::introduce() {
  const auto nonce = receiver_.take_challenge(clock_.at(us_));
  if (!nonce) return;
  for (Sender& sender : senders_) {
    us_ += integer(100, 20'000);
    const Bytes answer =
        sender.seal.seal(kAnswer, Bytes(nonce->begin(), nonce->end()), sender.clock.at(us_));
    us_ += integer(100, 20'000);
    receiver_.add_answer(kAnswer, answer, *nonce, clock_.at(us_));
    answers_.emplace_back(*nonce, answer);
    record(kAnswer, answer);
  }
}

/// A sender or the receiver starts again. Until the first challenge is answered no sender is known.
void Scene::restart() {
  if (integer(0, 1) == 0) {
    Sender& sender = senders_.at(static_cast<std::size_t>(integer(0, 1)));
    sender.seal = SealSender(key_);
    deliver(kOrders[0], sealed(sender, kOrders[0]));
    ++counts_.sender_starts;
  } else {
    receiver_ = SealReceiver(key_);
    if (integer(0, 1) == 0) clock_ = random_clock();
    ++counts_.receiver_starts;
  }
  us_ += SealReceiver::kAskAgainUs * 2;
  introduce();
}

void Scene::send_genuine() {
  const std::string_view channel = random_channel();
  const Bytes bytes = sealed(senders_.at(static_cast<std::size_t>(integer(0, 1))), channel);
  us_ += integer(50, 50'000);
  ++counts_.genuine;
  counts_.genuine_accepted += deliver(channel, bytes).empty();
}

void Scene::replay_an_answer() {
  const auto& [nonce, answer] = answers_.at(
      static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(answers_.size()) - 1)));
  receiver_.add_answer(kAnswer, answer, nonce, clock_.at(us_));
}

Bytes Scene::damaged(Bytes bytes, SealAttack kind) {
  const auto last = static_cast<std::int64_t>(bytes.size()) - 1;
  if (kind == SealAttack::kFlip) {
    bytes.at(static_cast<std::size_t>(integer(0, last))) ^=
        static_cast<std::uint8_t>(1 << integer(0, 7));
    return bytes;
  }
  const std::int64_t from = integer(0, last);
  const std::int64_t to = integer(0, 2) == 0 ? last : integer(from, last);
  bytes.erase(bytes.begin() + from, bytes.begin() + to + 1);
  return bytes;
}

void Scene::attack() {
  const auto kind = static_cast<SealAttack>(integer(0, kSealAttackNames.size() - 1));
  Sender& sender = senders_.at(static_cast<std::size_t>(integer(0, 1)));
  std::string channel(random_channel());
  Bytes bytes;
  switch (kind) {
    case SealAttack::kUnsealed:
      bytes = random_message();
      break;
    case SealAttack::kOtherKey:
      bytes = stranger_.seal(channel, random_message(), sender.clock.at(us_));
      break;
    case SealAttack::kReplay: {
      const Recorded& old = recorded_.at(
          static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(recorded_.size()) - 1)));
      if (old.channel != kAnswer) channel = old.channel;  // an answer is tried as an order
      bytes = old.bytes;
      break;
    }
    case SealAttack::kReorder:
      bytes = sealed(sender, channel);
      us_ += integer(1, 1000);
      deliver(channel, sealed(sender, channel));
      break;
    case SealAttack::kDelay:
      bytes = sealed(sender, channel);
      us_ += kLateUs;
      introduce();
      break;
    case SealAttack::kTruncate:
    case SealAttack::kFlip:
      bytes = damaged(sender.seal.seal(channel, random_message(), sender.clock.at(us_)), kind);
      break;
    case SealAttack::kWrongChannel:
      bytes = sender.seal.seal(channel, random_message(), sender.clock.at(us_));
      channel = channel == kOrders[0] ? kOrders[1] : kOrders[0];
      break;
  }
  ++counts_.attempts.at(static_cast<std::size_t>(kind));
  counts_.accepted.at(static_cast<std::size_t>(kind)) += deliver(channel, bytes).empty();
}

SealAttackCounts Scene::run(std::int64_t attacks) {
  for (std::int64_t i = 0; i < attacks; ++i) {
    us_ += integer(10, 100'000);
    introduce();
    if (integer(0, 999) == 0) restart();
    if (integer(0, 9) == 0) replay_an_answer();
    if (integer(0, 3) == 0) send_genuine();
    attack();
  }
  return counts_;
}

}  // namespace

SealAttackCounts attack_seals(std::int64_t attacks, std::uint64_t seed) {
  return Scene(seed).run(attacks);
}

}  // namespace adit
