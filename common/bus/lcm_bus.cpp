// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/lcm_bus.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <lcm/lcm-cpp.hpp>
#include <poll.h>

#include "common/bus/channel_filter.hpp"
#include "common/bus/channels.hpp"
#include "common/bus/lcm_transport.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/seal.hpp"
#include "common/messages/sim.hpp"
#include "common/service/wall_time.hpp"

namespace adit {
namespace {

// Capacity of LCM's queue, which fills while a handler runs. `drain_lcm_queue` moves it to the
// queues of this bus, which keep the newest messages.
constexpr int kLcmQueue = 4096;

constexpr std::size_t kSimTimeQueue = 1000;  // at 20 messages for each simulated second
constexpr std::size_t kSealQueue = 100;
constexpr std::int64_t kChallengePeriodUs = 100'000;
constexpr std::int64_t kWaitMaxUs =
    10'000'000;  // of a message in LCM's queue, while a handler runs

constexpr int kNoDescriptor = -1;  // ignored by poll
constexpr int kIdleTimeoutMs = 1000;

}  // namespace

LcmBus::LcmBus(const LcmBusOptions& options)
    : lcm_(std::make_unique<lcm::LCM>(complete_lcm_url(options.url))),
      time_(options.time),
      stage_(options.stage),
      dispatcher_(options.max_message_bytes) {
  if (!lcm_->good()) throw std::runtime_error(lcm_failure_reason(options.url));
  if (time_ == BusTime::kSimulated) subscribe_sim_time();
  if (!options.seal) return;
  seal_.emplace(*options.seal);
  subscribe_seal();
}

LcmBus::~LcmBus() = default;

bool LcmBus::handle(int timeout_ms) {
  wait(timeout_ms, kNoDescriptor);
  run_due_timers();
  return dispatcher_.dispatch_one();
}

void LcmBus::run(int stop_descriptor) {
  while (wait(kIdleTimeoutMs, stop_descriptor)) {
    run_due_timers();
    dispatcher_.dispatch_one();
  }
}

/// Blocks until a message, a timer, a device or the stop descriptor is ready, and runs the handlers
/// of devices. Returns false if `stop_descriptor` is readable.
bool LcmBus::wait(int timeout_ms, int stop_descriptor) {
  const std::int64_t timeout_us = timeout_ms * 1000LL;
  const auto timer_ms = static_cast<int>(
      std::min<std::int64_t>((time_to_next_timer_us(timeout_us) + 999) / 1000, timeout_ms));
  std::vector<pollfd> descriptors{{lcm_->getFileno(), POLLIN, 0}, {stop_descriptor, POLLIN, 0}};
  for (const auto& [descriptor, handler] : watched_) descriptors.push_back({descriptor, POLLIN, 0});
  const int ready =
      poll(descriptors.data(), descriptors.size(), dispatcher_.is_idle() ? timer_ms : 0);
  if (ready < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
  if (ready < 0 || descriptors[0].revents != 0) drain_lcm_queue();
  for (std::size_t i = 2; ready > 0 && i < descriptors.size(); ++i) {
    if (descriptors[i].revents != 0) watched_[i - 2].second();
  }
  return ready <= 0 || descriptors[1].revents == 0;
}

/// Time to the next timer on wall time, or the timeout.
std::int64_t LcmBus::time_to_next_timer_us(std::int64_t timeout_us) const {
  const Timers& timers = time_ == BusTime::kSimulated ? wall_timers_ : timers_;
  return timers.wait_us(wall_utime()).value_or(timeout_us);
}

void LcmBus::drain_lcm_queue() {
  for (int i = 0; i < kLcmQueue; ++i) {
    const int handled = lcm_->handleTimeout(0);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (handled < 0) throw std::runtime_error("LCM failed to receive");
    if (handled == 0) return;
  }
}

void LcmBus::on_receive(const lcm::ReceiveBuffer* buffer, const std::string& channel,
                        LcmBus* bus) try {
  bus->receive({channel,
                buffer->recv_utime,
                {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size}});
} catch (...) {
  bus->failure_ = std::current_exception();
}

/// Queues a message, or rejects it. Its time is the wall time of its arrival.
void LcmBus::receive(const ReceivedMessage& received) {
  if (seal_ && OrderSeal::covers(received.channel)) {
    // The wall clock may have been set since.
    const std::int64_t waited_us =
        std::clamp<std::int64_t>(wall_utime() - received.utime, 0, kWaitMaxUs);
    const std::string_view reason = seal_->check(received.channel, received.bytes, waited_us);
    if (!reason.empty()) {
      dispatcher_.reject(received.channel, reason);
      challenge_senders();
      return;
    }
  }
  const std::int64_t utime = time_ == BusTime::kWall ? received.utime : now_utime();
  dispatcher_.enqueue({received.channel, utime, received.bytes});
}

void LcmBus::run_due_timers() {
  // Timers on simulated time run in advance_to.
  Timers& timers = time_ == BusTime::kSimulated ? wall_timers_ : timers_;
  while (const auto tick = timers.next(wall_utime())) tick->handler(now_utime());
}

void LcmBus::subscribe_sim_time() {
  adit::subscribe<sim_time_t>(*this, channels::kSimTime, Delivery::queued(kSimTimeQueue),
                              [this](const SimTime& time) { advance_to(time.utime); });
}

void LcmBus::subscribe_seal() {
  subscribe(channels::kSealChallenge, Delivery::queued(kSealQueue),
            [this](const ReceivedMessage& received) -> std::string_view {
              const auto message = decode<seal_nonce_t>(received.bytes);
              if (!message) return message.rejection();
              const auto challenge = from_message(*message);
              if (!challenge) return challenge.rejection();
              if (!seal_->is_genuine_challenge(received.bytes)) return SealReceiver::kForged;
              publish_seal(channels::kSealAnswer, challenge->nonce);
              return {};
            });
  subscribe(channels::kSealAnswer, Delivery::queued(kSealQueue),
            [this](const ReceivedMessage& received) { return seal_->add_answer(received); });
  create_wall_timer(kChallengePeriodUs, [this](std::int64_t) { challenge_senders(); });
  publish_seal(channels::kSealAnswer, {});
}

void LcmBus::publish_seal(std::string_view channel, const SealNonce& nonce) {
  const auto message = encode(to_message(SealChallenge{wall_utime(), nonce}));
  publish(channel, seal_->seal(channel, message));
}

void LcmBus::challenge_senders() {
  if (!receives_orders_) return;
  if (const auto nonce = seal_->take_challenge()) publish_seal(channels::kSealChallenge, *nonce);
}

void LcmBus::advance_to(std::int64_t utime) {
  simulated_utime_ = utime;
  while (const auto tick = timers_.next(utime)) tick->handler(utime);
  if (stage_.empty()) return;
  adit::publish(*this, channels::kSimTimeDone, to_message(SimTimeDone{utime, stage_}));
}

void LcmBus::publish(std::string_view channel, std::span<const std::uint8_t> bytes) {
  require_valid_channel(channel);
  std::vector<std::uint8_t> sealed;
  if (seal_ && OrderSeal::covers(channel)) bytes = sealed = seal_->seal(channel, bytes);
  const auto size = static_cast<unsigned int>(bytes.size());
  if (lcm_->publish(std::string(channel), bytes.data(), size) != 0) ++unsent_;
}

SubscriptionId LcmBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  const SubscriptionId id = dispatcher_.subscribe(channel, delivery, std::move(handler));
  receives_orders_ = receives_orders_ || OrderSeal::covers(channel);
  if (!channels_.emplace(channel).second) return id;
  const std::set<int> sockets = bound_datagram_sockets();
  // LCM's `subscribe` with a member function is miscompiled by GCC 12 under -fsanitize=undefined.
  lcm::Subscription* const subscription =
      lcm_->subscribeFunction(std::string(channel), &LcmBus::on_receive, this);
  if (!subscription) throw std::runtime_error("LCM cannot subscribe to " + std::string(channel));
  subscription->setQueueCapacity(kLcmQueue);
  if (channels_.size() == 1) sockets_ = bound_datagram_sockets_except(sockets);
  attach_channel_filter(channels_, sockets_);
  return id;
}

void LcmBus::create_timer(std::int64_t period_us, TimerHandler handler) {
  timers_.add(period_us, std::move(handler));
}

void LcmBus::watch(int descriptor, std::function<void()> handler) {
  watched_.emplace_back(descriptor, std::move(handler));
}

void LcmBus::create_wall_timer(std::int64_t period_us, TimerHandler handler) {
  Timers& timers = time_ == BusTime::kSimulated ? wall_timers_ : timers_;
  timers.add(period_us, std::move(handler));
}

std::int64_t LcmBus::now_utime() const {
  return time_ == BusTime::kSimulated ? simulated_utime_ : wall_utime();
}

std::int64_t LcmBus::without_valid_seal() const { return seal_ ? seal_->rejected() : 0; }

const SubscriptionStats& LcmBus::stats(SubscriptionId id) const { return dispatcher_.stats(id); }

}  // namespace adit
