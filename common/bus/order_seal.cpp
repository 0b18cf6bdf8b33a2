// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/order_seal.hpp"

#include <algorithm>
#include <ctime>

#include "common/messages/codec.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

std::int64_t boot_us() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return now.tv_sec * 1'000'000LL + now.tv_nsec / 1000;
}

bool is_stop(std::span<const std::uint8_t> bytes) {
  const auto message = decode<stop_t>(bytes);
  if (!message) return false;
  const auto order = from_message(*message);
  return order && order->stopped;
}

}  // namespace

bool OrderSeal::covers(std::string_view channel) {
  return std::find(kChannels.begin(), kChannels.end(), channel) != kChannels.end();
}

std::vector<std::uint8_t> OrderSeal::seal(std::string_view channel,
                                          std::span<const std::uint8_t> message) {
  return sender_.seal(channel, message, boot_us());
}

std::string_view OrderSeal::check(std::string_view channel, std::span<const std::uint8_t> bytes,
                                  std::int64_t waited_us) {
  const std::string_view reason = receiver_.check(channel, bytes, boot_us() - waited_us);
  if (reason.empty() || (channel == channels::kStop && is_stop(bytes))) return {};
  if (reason != SealReceiver::kUnknown) ++rejected_;
  return reason;
}

std::optional<SealNonce> OrderSeal::take_challenge() { return receiver_.take_challenge(boot_us()); }

bool OrderSeal::is_genuine_challenge(std::span<const std::uint8_t> bytes) const {
  const auto sealed = split_seal(bytes);
  return sealed && key_.matches(channels::kSealChallenge, *sealed);
}

std::string_view OrderSeal::add_answer(const ReceivedMessage& answer) {
  const auto message = decode<seal_nonce_t>(answer.bytes);
  if (!message) return message.rejection();
  const auto value = from_message(*message);
  if (!value) return value.rejection();
  return receiver_.add_answer(channels::kSealAnswer, answer.bytes, value->nonce, boot_us());
}

}  // namespace adit
