// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// What the vehicle is told, so that it can follow: speed grows and curvature changes no faster
/// than given; it slows down at once, as the vehicle brakes harder than is planned. From a stand it
/// drives off when it has stood for a while and is steered.
class CommandRamp {
 public:
  CommandRamp(double acceleration_m_s2, double steering_rate_1_m_s)
      : acceleration_m_s2_(acceleration_m_s2), steering_rate_1_m_s_(steering_rate_1_m_s) {}

  /// For the next `seconds`; a speed to the other side than the present one means to stand first.
  void drive(double speed_m_s, double curvature_1_m, double seconds);
  /// The steering stays.
  void stand(double seconds);

  /// Long enough for the vehicle to stand, too.
  [[nodiscard]] bool has_stood() const;
  /// Negative in reverse.
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }
  [[nodiscard]] double curvature_1_m() const { return curvature_1_m_; }

 private:
  double acceleration_m_s2_;
  double steering_rate_1_m_s_;
  double speed_m_s_ = 0.0;
  double curvature_1_m_ = 0.0;
  double standing_s_ = 0.0;
};

}  // namespace adit
