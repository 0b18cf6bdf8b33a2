// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit-truth_as_pose: replaces scan matching by ground truth until SIGTERM: publishes TRUTH as
// POSE. The simulator can wait for it by the stage name `truth_as_pose`.
#include <exception>
#include <iostream>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"

int main() try {
  const adit::StopSignal stop;
  adit::LcmBusOptions options;
  options.time = adit::BusTime::kSimulated;
  options.stage = "truth_as_pose";
  adit::LcmBus bus(options);
  bus.subscribe(adit::channels::kTruth, adit::Delivery::latest(),
                [&bus](const adit::ReceivedMessage& truth) {
                  bus.publish(adit::channels::kPose, truth.bytes);
                  return std::string_view();
                });
  bus.run(stop.descriptor());
  return 0;
} catch (const std::exception& error) {
  std::cerr << "adit-truth_as_pose: " << error.what() << "\n";
  return 2;
}
