// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/channels.hpp"
#include "common/messages/seal.hpp"
#include "common/seal/seal_receiver.hpp"
#include "common/seal/seal_sender.hpp"

namespace adit {

/// The section `seal` of the configuration, shared by all stages.
struct SealParams {
  static constexpr const char* kSection = "seal";
  std::string key;  ///< file of `adit key --new`; empty: orders are not sealed

  template <class V>
  void visit(V& v) {
    v("key", key);
  }

  /// Nothing without a key. Throws as SealKey::read.
  [[nodiscard]] std::optional<SealKey> read() const {
    return key.empty() ? std::nullopt : std::optional(SealKey::read(key));
  }
};

/// What a bus with a key does with orders: it seals those that it publishes and rejects received
/// ones without a valid seal. Reads the clock of the computer that is never set and runs on while
/// it sleeps (CLOCK_BOOTTIME), also with simulated time.
class OrderSeal {
 public:
  /// The channels that set the robot in motion, release a stop, or start and stop processes.
  static constexpr std::array kChannels{
      channels::kMissionOrder, channels::kPhase, channels::kGoal,    channels::kPath,
      channels::kDriveCommand, channels::kStop,  channels::kPmOrders};

  explicit OrderSeal(const SealKey& key) : key_(key), sender_(key), receiver_(key) {}

  static bool covers(std::string_view channel);

  /// The message with its seal, for any channel.
  std::vector<std::uint8_t> seal(std::string_view channel, std::span<const std::uint8_t> message);

  /// The reason to reject a message of a sealed channel that arrived a while ago [µs]; empty if it
  /// is accepted. A stop is accepted from anybody, its release from the sealed only.
  std::string_view check(std::string_view channel, std::span<const std::uint8_t> bytes,
                         std::int64_t waited_us);

  /// The challenge to publish now, if one is due.
  std::optional<SealNonce> take_challenge();

  /// Whether a challenge comes from a holder of the key and is to be answered.
  [[nodiscard]] bool is_genuine_challenge(std::span<const std::uint8_t> bytes) const;

  /// Returns the reason for rejection, or an empty text.
  std::string_view add_answer(const ReceivedMessage& answer);

  /// Number of orders that were rejected, except of senders that were not known yet.
  [[nodiscard]] std::int64_t rejected() const { return rejected_; }

 private:
  SealKey key_;
  SealSender sender_;
  SealReceiver receiver_;
  std::int64_t rejected_ = 0;
};

}  // namespace adit
