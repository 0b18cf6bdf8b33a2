// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Minimal stage to test the node infrastructure: publishes for each scan a pose whose x is the
// number of beams.
#include "common/bus/channels.hpp"
#include "common/bus/node/run_node.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

class RelayNode {
 public:
  struct Params {
    double y_m = 0.5;
    template <class V>
    void visit(V& v) {
      v("y_m", y_m);
    }
  };

  RelayNode(Bus& bus, const Params& params) {
    subscribe<planar_lidar_t>(
        bus, channels::kLaserFront, Delivery::queued(100), [&bus, params](const LaserScan& scan) {
          const Pose2 pose{static_cast<double>(scan.ranges_m.size()), params.y_m, 0.0};
          publish(bus, channels::kPose, to_message(StampedPose{scan.utime, pose, {}}));
        });
  }
};

}  // namespace
}  // namespace adit

int main(int argc, char** argv) { return adit::run_node<adit::RelayNode>("relay", argc, argv); }
