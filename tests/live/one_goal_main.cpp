// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit-one_goal DISTANCE: requests one 3D scan and, when its terrain is complete, a path straight
// ahead over this distance [m]. Runs until SIGTERM. The simulator can wait for it by the stage name
// `one_goal`.
#include <exception>
#include <iostream>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStartDelayUs = 1'500'000;  // after the first simulated time
constexpr std::size_t kTilesQueued = 200;

class OneGoal {
 public:
  OneGoal(Bus& bus, double distance_m) : bus_(bus), distance_m_(distance_m) {
    bus.create_timer(50'000, [this](std::int64_t utime) { request_scan(utime); });
    subscribe<terrain_t>(bus, channels::kTerrain, Delivery::queued(kTilesQueued),
                         [this](const TerrainFragment& tile) {
                           if (terrain_.add(tile)) publish_goal();
                         });
  }

 private:
  void request_scan(std::int64_t utime) {
    if (first_utime_ == 0) first_utime_ = utime;
    if (scan_requested_ || utime < first_utime_ + kStartDelayUs) return;
    scan_requested_ = true;
    publish(bus_, channels::kScanRequest, to_message(ScanRequest{utime, 1, LaserId::kFront}));
  }

  void publish_goal() {
    const PlanGoal goal{bus_.now_utime(), 1, PlanGoal::Kind::kAlong, {}, distance_m_};
    publish(bus_, channels::kGoal, to_message(goal));
  }

  Bus& bus_;
  double distance_m_;
  TerrainReassembler terrain_;
  std::int64_t first_utime_ = 0;
  bool scan_requested_ = false;
};

void run(double distance_m) {
  const StopSignal stop;
  LcmBusOptions options;
  options.time = BusTime::kSimulated;
  options.stage = "one_goal";
  LcmBus bus(options);
  const OneGoal one_goal(bus, distance_m);
  bus.run(stop.descriptor());
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "adit-one_goal DISTANCE\n";
    return 2;
  }
  adit::run(std::stod(argv[1]));
  return 0;
} catch (const std::exception& error) {
  std::cerr << "adit-one_goal: " << error.what() << "\n";
  return 2;
}
