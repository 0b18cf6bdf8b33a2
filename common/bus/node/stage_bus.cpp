// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/stage_bus.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/files/file_error.hpp"
#include "common/service/node_end.hpp"

namespace adit {

std::vector<StageBus::HandlerTimes> StageBus::take_handler_times() {
  return std::exchange(times_, std::vector<HandlerTimes>(subscriptions_.size()));
}

SubscriptionId StageBus::subscribe(std::string_view channel, Delivery delivery, Handler handler) {
  handler = contained(channel, std::move(handler));
  if (measure_ == Measure::kHandlerTimes) handler = with_timing(std::move(handler));
  times_.emplace_back();
  subscriptions_.push_back(ForwardingBus::subscribe(channel, delivery, std::move(handler)));
  return subscriptions_.back();
}

Handler StageBus::with_timing(Handler handler) {
  const std::size_t index = subscriptions_.size();
  return [this, index, handler = std::move(handler)](const ReceivedMessage& received) {
    const auto start = std::chrono::steady_clock::now();
    const std::string_view rejection = handler(received);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    HandlerTimes& times = times_[index];
    ++times.calls;
    times.total_ms += elapsed.count();
    times.max_ms = std::max(times.max_ms, elapsed.count());
    return rejection;
  };
}

bool StageBus::contain(std::string_view what, const std::function<void()>& function) {
  try {
    function();
    return true;
  } catch (const NodeEnd&) {
    throw;
  } catch (const FileError&) {
    throw;
  } catch (const std::system_error&) {
    throw;
  } catch (const std::exception& error) {
    ++failures_.count;
    failures_.last = fmt::format("{}: {}", what, error.what());
    return false;
  }
}

Handler StageBus::contained(std::string_view channel, Handler handler) {
  return [this, channel = std::string(channel),
          handler = std::move(handler)](const ReceivedMessage& received) {
    std::string_view rejection;
    const bool done = contain(channel, [&] { rejection = handler(received); });
    return done ? rejection : kHandlerFailed;
  };
}

TimerHandler StageBus::contained(TimerHandler handler) {
  return [this, handler = std::move(handler)](std::int64_t utime) {
    contain("a timer", [&] { handler(utime); });
  };
}

void StageBus::create_wall_timer(std::int64_t period_us, TimerHandler handler) {
  ForwardingBus::create_wall_timer(period_us, contained(std::move(handler)));
}

void StageBus::create_timer(std::int64_t period_us, TimerHandler handler) {
  ForwardingBus::create_timer(period_us, contained(std::move(handler)));
}

void StageBus::watch(int descriptor, std::function<void()> handler) {
  ForwardingBus::watch(descriptor,
                       [this, handler = std::move(handler)] { contain("a device", handler); });
}

}  // namespace adit
