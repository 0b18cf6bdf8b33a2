// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/bus_recorder.hpp"

#include <utility>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

constexpr std::size_t kMessagesWaiting = 4096;  // of one channel

}  // namespace

BusRecorder::BusRecorder(Bus& bus, const std::filesystem::path& path, Clock clock)
    : log_(path), clock_(std::move(clock)) {
  for (const std::string_view channel : channels::kAll) {
    bus.subscribe(channel, Delivery::queued(kMessagesWaiting),
                  [this](const Received& received) -> std::string_view {
                    log_.write({clock_(), received.channel, received.bytes});
                    return {};
                  });
  }
}

}  // namespace adit
