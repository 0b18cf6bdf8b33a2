// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/seal/seal_receiver.hpp"
#include "common/seal/seal_sender.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/seals/seal_attacks.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kSecond = 1'000'000;
const Bytes kOrder{1, 2, 3, 4, 5, 6, 7, 8, 9};

std::string reason_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(SealKey, IsTheSameFromItsFile) {
  const test::ScratchFolder scratch;
  const SealKey key = SealKey::random();
  key.write_new(scratch.path() / "key");
  const SealTrailer seal{random_nonce(), 7, {}};
  EXPECT_EQ(SealKey::read(scratch.path() / "key").tag("GOAL", seal, kOrder),
            key.tag("GOAL", seal, kOrder));
  EXPECT_NE(SealKey::random().tag("GOAL", seal, kOrder), key.tag("GOAL", seal, kOrder));
}

TEST(SealKey, IsNeverOverwritten) {
  const test::ScratchFolder scratch;
  SealKey::random().write_new(scratch.path() / "key");
  EXPECT_THAT(reason_of([&] { SealKey::random().write_new(scratch.path() / "key"); }),
              HasSubstr("key: File exists"));
}

TEST(SealKey, IsRejectedIfOthersMayReadIt) {
  const test::ScratchFolder scratch;
  const fs::path path = scratch.path() / "key";
  SealKey::random().write_new(path);
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(path, fs::perms::group_read, fs::perm_options::add);
  EXPECT_NO_THROW(SealKey::read(path));
  fs::permissions(path, fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(reason_of([&] { SealKey::read(path); }), HasSubstr("others may read"));
}

TEST(SealKey, IsRejectedUnlessItIsALineOf64Digits) {
  const test::ScratchFolder scratch;
  const fs::path path = scratch.path() / "key";
  for (const std::string& text : {std::string(), std::string(63, 'a'), std::string(66, 'a'),
                                  std::string(63, 'a') + "g", std::string(64, 'a') + " "}) {
    std::ofstream(path) << text;
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_THAT(reason_of([&] { SealKey::read(path); }), HasSubstr("64 hexadecimal digits"))
        << text;
  }
  EXPECT_THAT(reason_of([&] { SealKey::read(scratch.path() / "none"); }),
              HasSubstr("No such file"));
  EXPECT_THAT(reason_of([&] { SealKey::read(scratch.path()); }), HasSubstr("not a file"));
}

// RFC 7693 as Python computes it: hashlib.blake2b(b"adit seal 1" + bytes([4]) + b"GOAL" + bytes(16)
// + (7).to_bytes(8, "big") + bytes(range(1, 10)), key=bytes.fromhex("ab" * 32), digest_size=16)
TEST(SealKey, TagIsTheDocumentedHash) {
  const test::ScratchFolder scratch;
  std::string text;
  for (int i = 0; i < 32; ++i) text += "ab";
  std::ofstream(scratch.path() / "key") << text << "\n";
  fs::permissions(scratch.path() / "key", fs::perms::owner_read);
  const SealNonce tag = SealKey::read(scratch.path() / "key").tag("GOAL", {{}, 7, {}}, kOrder);
  const SealNonce expected{0x34, 0xe3, 0xb9, 0x9c, 0x75, 0x03, 0x44, 0x76,
                           0xec, 0xfc, 0xef, 0x5a, 0xa6, 0x02, 0x2f, 0xc1};
  EXPECT_EQ(tag, expected);
}

TEST(SealTrailer, LeavesTheMessageInFront) {
  SealSender sender(SealKey::random());
  const Bytes bytes = sender.seal("GOAL", kOrder, kSecond);
  EXPECT_EQ(bytes.size(), kOrder.size() + SealTrailer::kBytes);
  EXPECT_THAT(without_seal(bytes), testing::ElementsAreArray(kOrder));
  EXPECT_THAT(without_seal(kOrder), testing::ElementsAreArray(kOrder));
}

class SealedOrders : public testing::Test {
 protected:
  /// The receiver challenges at a time of its own clock; the sender answers at one of its own.
  void introduce(SealSender& sender, std::int64_t us, std::int64_t sender_us) {
    const auto nonce = receiver_.take_challenge(us);
    ASSERT_TRUE(nonce);
    answer(sender, *nonce, us, sender_us);
  }
  void answer(SealSender& sender, const SealNonce& nonce, std::int64_t us, std::int64_t sender_us) {
    const Bytes bytes = sender.seal("SEAL_ANSWER", Bytes(nonce.begin(), nonce.end()), sender_us);
    EXPECT_EQ(receiver_.add_answer("SEAL_ANSWER", bytes, nonce, us), "");
  }

  SealKey key_ = SealKey::random();
  SealSender sender_{key_};
  SealReceiver receiver_{key_};
};

TEST_F(SealedOrders, AreAcceptedOnceTheSenderHasAnsweredWhateverItsClock) {
  const std::int64_t days_us = 86'400 * kSecond * 9;
  const Bytes early = sender_.seal("GOAL", kOrder, days_us);
  EXPECT_EQ(receiver_.check("GOAL", early, kSecond), SealReceiver::kUnknown);
  introduce(sender_, kSecond, days_us + 10);
  const Bytes order = sender_.seal("GOAL", kOrder, days_us + 20);
  EXPECT_EQ(receiver_.check("GOAL", order, kSecond + 20), "");
  EXPECT_EQ(receiver_.check("GOAL", order, kSecond + 30), SealReceiver::kReplayed);
  EXPECT_EQ(receiver_.check("GOAL", early, kSecond + 40), SealReceiver::kReplayed);
}

TEST_F(SealedOrders, OfTheLastRunAreRejectedByAReceiverThatHasJustStarted) {
  introduce(sender_, kSecond, kSecond);
  const Bytes order = sender_.seal("GOAL", kOrder, 2 * kSecond);
  receiver_ = SealReceiver(key_);
  EXPECT_EQ(receiver_.check("GOAL", order, 2 * kSecond), SealReceiver::kUnknown);
  introduce(sender_, 3 * kSecond, 3 * kSecond);  // the sender still runs
  EXPECT_EQ(receiver_.check("GOAL", order, 3 * kSecond), SealReceiver::kReplayed);
  receiver_ = SealReceiver(key_);  // it has ended: nobody answers for it
  EXPECT_EQ(receiver_.check("GOAL", order, 4 * kSecond), SealReceiver::kUnknown);
  EXPECT_EQ(receiver_.check("GOAL", order, 7 * kSecond), SealReceiver::kUnanswered);
}

TEST_F(SealedOrders, AreRejectedIfTheyArriveLate) {
  introduce(sender_, kSecond, kSecond);
  const Bytes order = sender_.seal("GOAL", kOrder, kSecond);
  const Bytes next = sender_.seal("GOAL", kOrder, kSecond);
  EXPECT_EQ(receiver_.check("GOAL", order, kSecond + SealReceiver::kAgeMaxUs), "");
  EXPECT_EQ(receiver_.check("GOAL", next, kSecond + SealReceiver::kAgeMaxUs + 100),
            SealReceiver::kReplayed);
}

TEST_F(SealedOrders, AreInOrderOnEachChannelAlone) {
  introduce(sender_, kSecond, kSecond);
  const Bytes goal = sender_.seal("GOAL", kOrder, kSecond);
  const Bytes drive = sender_.seal("DRIVE_COMMAND", kOrder, kSecond);
  EXPECT_EQ(receiver_.check("DRIVE_COMMAND", drive, kSecond), "");
  EXPECT_EQ(receiver_.check("GOAL", goal, kSecond), "");
}

TEST_F(SealedOrders, NeedAnAnswerToAChallengeOfThisReceiver) {
  const SealNonce foreign = random_nonce();
  answer(sender_, foreign, kSecond, kSecond);
  answer(sender_, {}, kSecond, kSecond);  // announces itself
  const Bytes order = sender_.seal("GOAL", kOrder, kSecond);
  EXPECT_EQ(receiver_.check("GOAL", order, kSecond), SealReceiver::kUnknown);
  const auto nonce = receiver_.take_challenge(kSecond);
  ASSERT_TRUE(nonce);
  const std::int64_t late = kSecond + SealReceiver::kAnswerMaxUs + 1;
  answer(sender_, *nonce, late, late);
  EXPECT_NE(receiver_.check("GOAL", sender_.seal("GOAL", kOrder, late), late), "");
}

TEST_F(SealedOrders, AreChallengedAtTheStartThenRarely) {
  EXPECT_TRUE(receiver_.take_challenge(kSecond));
  EXPECT_FALSE(receiver_.take_challenge(2 * kSecond));
  receiver_.check("GOAL", sender_.seal("GOAL", kOrder, kSecond), 2 * kSecond);
  EXPECT_TRUE(receiver_.take_challenge(2 * kSecond));
  receiver_.check("GOAL", sender_.seal("GOAL", kOrder, kSecond), 2 * kSecond);
  EXPECT_FALSE(receiver_.take_challenge(2 * kSecond + SealReceiver::kAskAgainUs / 2));
  EXPECT_TRUE(receiver_.take_challenge(2 * kSecond + SealReceiver::kAskAgainUs));
  EXPECT_TRUE(receiver_.take_challenge(3 * kSecond + SealReceiver::kRepeatUs));
}

TEST_F(SealedOrders, StayKnownWhileChallengesAreAnswered) {
  introduce(sender_, kSecond, kSecond);
  const std::int64_t soon = kSecond + SealReceiver::kForgetUs;
  EXPECT_EQ(receiver_.check("GOAL", sender_.seal("GOAL", kOrder, soon), soon), "");
  EXPECT_EQ(receiver_.check("GOAL", sender_.seal("GOAL", kOrder, soon + 1), soon + 1),
            SealReceiver::kUnknown);
}

TEST(SealAttacks, AreAllRejectedAndGenuineOrdersAccepted) {
  const SealAttackCounts counts = attack_seals(10'000, 1);
  for (std::size_t i = 0; i < kSealAttackNames.size(); ++i) {
    EXPECT_GT(counts.attempts.at(i), 1000) << kSealAttackNames.at(i);
    EXPECT_EQ(counts.accepted.at(i), 0) << kSealAttackNames.at(i);
  }
  EXPECT_GT(counts.genuine, 2000);
  EXPECT_EQ(counts.genuine_accepted, counts.genuine);
  EXPECT_GT(counts.sender_starts, 0);
  EXPECT_GT(counts.receiver_starts, 0);
}

}  // namespace
}  // namespace adit
