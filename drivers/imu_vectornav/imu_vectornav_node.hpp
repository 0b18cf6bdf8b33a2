// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/device/device_node.hpp"
#include "drivers/imu_vectornav/vectornav.hpp"

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// Out: IMU (imu_t), each reading as soon as it is complete.
class ImuVectorNavNode {
 public:
  using Params = VectorNavParams;

  /// Throws as VectorNav and DeviceNode do.
  ImuVectorNavNode(Bus& bus, const Params& params);

  [[nodiscard]] Health health() const { return node_.health(); }

 private:
  std::size_t receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);

  Bus& bus_;
  VectorNav imu_;
  DeviceNode node_;
};

}  // namespace adit
