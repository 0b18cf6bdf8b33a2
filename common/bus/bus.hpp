// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace adit {

/// Whether it can be the name of a channel: 1 to 63 (LCM_MAX_CHANNEL_NAME_LENGTH) of A-Z 0-9 _.
inline bool is_channel_name(std::string_view name) {
  constexpr std::size_t kLengthMax = 63;
  return !name.empty() && name.size() <= kLengthMax &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// A message as it came, with the bus time at which it did [µs since the epoch].
struct ReceivedMessage {
  std::string_view channel;
  std::int64_t utime = 0;
  std::span<const std::uint8_t> bytes;
};

/// Takes a message. Returns why it refused it, a text of static storage, or nothing if it did not.
using Handler = std::function<std::string_view(const ReceivedMessage&)>;

/// Called with bus time [µs since the epoch].
using TimerHandler = std::function<void(std::int64_t utime)>;

/// What waits for a handler that is slower than its channel: only the newest message (for state),
/// or the newest `capacity` (for measurements), so that a stall loses the oldest.
struct Delivery {
  std::size_t capacity = 1;
  bool counts_drops = false;  ///< whether a message that made room for a newer one is a loss

  static Delivery latest() { return {1, false}; }
  static Delivery queued(std::size_t capacity) { return {capacity, true}; }
};

/// Which subscription of a bus; given by subscribe.
using SubscriptionId = std::size_t;

/// What became of the messages of one subscription since it was made.
struct SubscriptionStats {
  std::string channel;
  std::int64_t handled = 0;
  std::int64_t rejected = 0;
  std::int64_t dropped = 0;
  std::map<std::string, std::int64_t, std::less<>> rejections;  ///< refused, by reason
};

/// What carries messages between stages. One thread: handlers run one at a time, on whoever drives
/// the bus, never inside of `publish`. A handler's exception goes to whoever drives the bus.
///
/// Bus time is the wall clock on the robot (LcmBus), a simulator's where it says so, and the time
/// of the messages in a replay or a test (ReplayBus, MemoryBus): the same inputs then give the same
/// outputs.
///
/// A channel is 1 to 63 of A–Z, 0–9 and _; anything else throws std::invalid_argument.
class Bus {
 public:
  virtual ~Bus() = default;

  virtual void publish(std::string_view channel, std::span<const std::uint8_t> bytes) = 0;

  /// The handler must live as long as the bus is driven.
  virtual SubscriptionId subscribe(std::string_view channel, Delivery delivery,
                                   Handler handler) = 0;

  /// Calls the handler as soon as bus time is known and then each period [µs]. A replay makes up
  /// for the ticks of a gap of at most ten seconds.
  virtual void create_timer(std::int64_t period_us, TimerHandler handler) = 0;

  /// The same by the time of the world, where bus time is a simulator's: for what looks after
  /// processes and devices. What is computed from messages has no use for it. In a replay or a
  /// test, which have no such time, as `every`.
  virtual void create_wall_timer(std::int64_t period_us, TimerHandler handler) {
    create_timer(period_us, std::move(handler));
  }

  /// Bus time [µs since the epoch].
  [[nodiscard]] virtual std::int64_t now_utime() const = 0;

  [[nodiscard]] virtual const SubscriptionStats& stats(SubscriptionId id) const = 0;

  /// Messages that the transport did not take.
  [[nodiscard]] virtual std::int64_t unsent() const { return 0; }
};

/// Throws std::invalid_argument unless the name can be that of a channel.
void require_valid_channel(std::string_view channel);

}  // namespace adit
