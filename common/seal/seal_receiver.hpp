// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/seal/seal_key.hpp"
#include "common/seal/seal_trailer.hpp"

namespace adit {

/// Decides which sealed messages a process accepts: those of a holder of the key, each once, in
/// order, and not later than kAgeMaxUs. It keeps nothing over a restart and compares no clocks of
/// two computers. Instead it asks: a challenge is a random number that the sender returns under its
/// own seal. An answer proves that the session is alive, that everything up to the sequence of the
/// answer is past, and which time of the sender corresponds to which time here.
///
/// A recorded message is therefore rejected by every receiver, also by one that has just started:
/// its session answers no new challenge, or its sequence precedes the answer.
///
/// Times are of a clock of this computer that is never set [µs].
class SealReceiver {
 public:
  static constexpr std::int64_t kAgeMaxUs = 2'000'000;     ///< of a message, beside the next
  static constexpr std::int64_t kAnswerMaxUs = 2'000'000;  ///< from a challenge to its answer
  static constexpr std::int64_t kRepeatUs = 10'000'000;    ///< of challenges to all senders
  static constexpr std::int64_t kAskAgainUs = 100'000;     ///< minimum between challenges
  static constexpr std::int64_t kForgetUs = 60'000'000;    ///< a session without answers is over
  static constexpr std::size_t kSessionsMax = 64;

  /// Reasons for rejection. The sender of the first message after a start is not known yet, which
  /// is no sign of an attack.
  static constexpr std::string_view kUnknown = "its sender is not known yet";
  static constexpr std::string_view kUnsealed = "not sealed";
  static constexpr std::string_view kForged = "sealed with another key, or changed";
  static constexpr std::string_view kReplayed = "seal of the past";
  static constexpr std::string_view kUnanswered = "its sender does not answer";

  explicit SealReceiver(const SealKey& key) : key_(key) {}

  /// The reason to reject a message on a channel; empty if it is accepted.
  std::string_view check(std::string_view channel, std::span<const std::uint8_t> bytes,
                         std::int64_t now_us);

  /// A challenge to all senders if one is due: each kRepeatUs, and after a message of an unknown
  /// sender.
  std::optional<SealNonce> take_challenge(std::int64_t now_us);

  /// Takes the answer of a sender, `nonce` being the content of the message. Returns the reason for
  /// rejection, or an empty text. An answer to nobody, with the nonce zero, announces a sender.
  std::string_view add_answer(std::string_view channel, std::span<const std::uint8_t> bytes,
                              const SealNonce& nonce, std::int64_t now_us);

 private:
  struct Challenge {
    SealNonce nonce;
    std::int64_t sent_us;
  };
  struct Session {
    std::int64_t answer_sequence = 0;
    std::int64_t answered_us = 0;
    std::map<std::string, std::int64_t, std::less<>> last;  ///< sequence by channel
    std::int64_t first = 0;  ///< sequence of the first answer: earlier messages are of the past
  };

  Session* find(const SealNonce& session, std::int64_t now_us);
  std::string_view ask(const SealNonce& session, std::int64_t now_us);
  Session& add(const SealNonce& session);
  [[nodiscard]] bool is_outstanding(const SealNonce& nonce, std::int64_t now_us) const;

  SealKey key_;
  std::map<SealNonce, Session> sessions_;
  std::map<SealNonce, std::int64_t> unknown_;  ///< time of their first message
  std::deque<Challenge> challenges_;
  bool wants_challenge_ = true;
};

}  // namespace adit
