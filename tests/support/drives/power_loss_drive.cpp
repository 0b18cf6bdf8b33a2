// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/power_loss_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/geometry/pose2.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tests/support/robots/simulated_robot.hpp"

namespace adit::test {
namespace {

constexpr const char* kMapJournal = "map.journal";
constexpr const char* kVolumeJournal = "volume.journal";
constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr double kOffS = 2.0;   // enough for the vehicle to come to rest
constexpr double kWaitS = 5.0;  // for a map correction
constexpr double kStepS = 1e-6 * static_cast<double>(Simulation::kStepUs);
constexpr std::array kSensors{channels::kLaserFront, channels::kLaserRear,
                              channels::kTiltFront,  channels::kTiltRear,
                              channels::kImu,        channels::kWheelOdometry};

WaypointDriverParams driver_without_timeout() {
  WaypointDriverParams params;
  params.progress_timeout_s = 1e6;
  return params;
}

ScanMatchingParams scan_matching_params() {
  auto params = with_groundhog_lasers<ScanMatchingParams>();
  params.lasers_tilt = true;
  return params;
}

int scans_in(const VolumeMap& map) {
  int scans = 0;
  for (const PlacedVolume& placed : map.volumes()) scans += placed.volume.scans();
  return scans;
}

}  // namespace

/// The stages from start to power loss, with the latest pose and map correction.
class PowerLossDrive::Computer {
 public:
  Computer(MemoryBus& world, const std::filesystem::path& folder) {
    bus_.tap([&world](const ReceivedMessage& received) {
      if (received.channel == channels::kTiltCommandFront ||
          received.channel == channels::kTiltCommandRear) {
        world.publish(received.channel, received.bytes);
      }
    });
    subscribe<pose_t>(bus_, channels::kPose, Delivery::latest(),
                      [this](const StampedPose& pose) { pose_ = pose; });
    subscribe<map_correction_t>(bus_, channels::kMapCorrection, Delivery::latest(),
                                [this](const MapCorrection& c) { correction_ = c; });
    auto mapping = with_groundhog_lasers<MappingNodeParams>();
    mapping.journal = (folder / kMapJournal).string();
    mapping_ = std::make_unique<MappingNode>(bus_, mapping);
    VolumeMapNodeParams volume;
    volume.journal = (folder / kVolumeJournal).string();
    auto assembly = with_groundhog_lasers<ScanAssemblyNodeParams>();
    assembly.journal = (folder / "scans.journal").string();
    scan_assembly_ = std::make_unique<ScanAssemblyNode>(bus_, assembly);
    volume_map_ = std::make_unique<VolumeMapNode>(bus_, volume);
  }

  void receive(const ReceivedMessage& received) {
    bus_.inject(received.utime, received.channel, received.bytes);
  }
  MemoryBus& bus() { return bus_; }
  [[nodiscard]] int maps() const { return static_cast<int>(mapping_->map().local_maps().size()); }
  [[nodiscard]] const VolumeMap& volume() const { return volume_map_->map(); }
  [[nodiscard]] int scans() const { return scans_in(volume()); }
  [[nodiscard]] const std::optional<StampedPose>& pose() const { return pose_; }
  [[nodiscard]] const std::optional<MapCorrection>& correction() const { return correction_; }
  [[nodiscard]] Pose2 T_map_body() const { return correction_->T_map_odom * pose_->T_odom_body; }

 private:
  MemoryBus bus_;
  std::optional<StampedPose> pose_;
  std::optional<MapCorrection> correction_;
  ScanMatchingNode scan_matching_{bus_, scan_matching_params()};
  std::unique_ptr<ScanAssemblyNode> scan_assembly_;
  std::unique_ptr<MappingNode> mapping_;
  std::unique_ptr<VolumeMapNode> volume_map_;
};

PowerLossDrive::PowerLossDrive(World world, std::vector<Waypoint> waypoints,
                               std::filesystem::path folder)
    : folder_(std::move(folder)),
      site_(std::move(world)),
      sim_(bus_, site_, SimulationParams{}, 1, kStartUtime),
      driver_(std::move(waypoints), Vehicle{}, driver_without_timeout()) {
  bus_.tap([this](const ReceivedMessage& received) {
    const bool sensed = std::ranges::find(kSensors, received.channel) != kSensors.end();
    if (computer_ && sensed) computer_->receive(received);
  });
  start_computer();
  T_world_start_ = T_world_body();
  run(1.0);
}

PowerLossDrive::~PowerLossDrive() = default;

void PowerLossDrive::start_computer() { computer_ = std::make_unique<Computer>(bus_, folder_); }

void PowerLossDrive::step() {
  bus_.advance_to(sim_.next_utime());
  sim_.step();
  if (!driving_ || sim_.simulation().utime() % (5 * Simulation::kStepUs) != 0) return;
  publish(bus_, channels::kDriveCommand,
          to_message(driver_.command(sim_.simulation().vehicle().motion())));
}

void PowerLossDrive::run(double seconds) {
  for (double t = 0.0; t < seconds; t += kStepS) step();
}

bool PowerLossDrive::drive(double distance_travelled_m) {
  const double end_m = driver_.progress_m() + distance_travelled_m;
  driving_ = true;
  const auto stuck = [&] {
    return driver_.done() || driver_.abort_reason() || !sim_.simulation().state().failure.empty();
  };
  while (driver_.progress_m() < end_m && !stuck()) step();
  return !stuck();
}

void PowerLossDrive::sweep(double seconds) {
  driving_ = false;
  run(kOffS);
  volume_bytes_ = std::filesystem::file_size(folder_ / kVolumeJournal);
  publish(computer_->bus(), channels::kScanRequest,
          to_message(ScanRequest{computer_->bus().now_utime(), ++sweeps_, LaserId::kFront}));
  run(seconds);
}

void PowerLossDrive::wait(double seconds) {
  driving_ = false;
  run(seconds);
}

const VolumeMap& PowerLossDrive::volume() const { return computer_->volume(); }

PowerLoss PowerLossDrive::lose_power(DiskAfterPowerLoss disk, std::mt19937& random) {
  PowerLoss loss;
  loss.distance_travelled_m = driver_.progress_m();
  loss.in_motion = driving_;
  loss.truncated = disk == DiskAfterPowerLoss::kTruncated;
  loss.maps = computer_->maps();
  loss.scans = computer_->scans();
  T_world_before_loss_ = T_world_body();
  const bool placed = computer_->correction() && computer_->pose();
  T_map_before_loss_ =
      placed ? computer_->T_map_body() : between(T_world_start_, T_world_before_loss_);
  driving_ = false;
  computer_.reset();
  if (disk == DiskAfterPowerLoss::kTruncated) {
    truncate_journal(folder_ / kMapJournal, random);
    truncate_journal(folder_ / kVolumeJournal, random);
  }
  if (disk == DiskAfterPowerLoss::kBeforeLastScan) {
    const std::filesystem::path journal = folder_ / kVolumeJournal;
    std::filesystem::resize_file(journal, volume_bytes_);
    std::filesystem::resize_file(journal_copy(journal), volume_bytes_);
  }
  run(kOffS);
  start_computer();
  loss.maps_lost = std::max(0, loss.maps - computer_->maps());
  loss.scans_lost = loss.scans - computer_->scans();
  for (double t = 0.0; t < kWaitS && !computer_->correction(); t += kStepS) {
    step();
    loss.localized_after_s = t;
  }
  if (!computer_->correction()) loss.localized_after_s.reset();
  evaluate_later(loss);
  loss.error_m = loss.error_after_driving_m;
  loss.sd_m = loss.sd_after_driving_m;
  if (!loss.localized_after_s) return loss;
  const Pose2 truth = between(T_world_before_loss_, T_world_body());
  loss.error_rad =
      std::abs(angle_diff(between(T_map_before_loss_, computer_->T_map_body()).theta, truth.theta));
  if (computer_->correction()->covariance) {
    loss.sd_rad = std::sqrt((*computer_->correction()->covariance)(2, 2));
  }
  return loss;
}

void PowerLossDrive::evaluate_later(PowerLoss& loss) const {
  if (!computer_->correction() || !computer_->pose()) return;
  const Pose2 truth = between(T_world_before_loss_, T_world_body());
  const Pose2 found = between(T_map_before_loss_, computer_->T_map_body());
  loss.error_after_driving_m = between(truth, found).translation().norm();
  if (const auto& covariance = computer_->correction()->covariance) {
    const Eigen::Matrix2d plane = covariance->topLeftCorner<2, 2>();
    loss.sd_after_driving_m = std::sqrt(symmetric_eigen(plane).values.maxCoeff());
  }
}

/// Truncates the last record at a random position, like a disk that had not written all of it.
void PowerLossDrive::truncate_journal(const std::filesystem::path& journal,
                                      std::mt19937& random) const {
  std::size_t last = 0;
  read_journal(journal, [&](const JournalRecord& record) {
    last = journal_format::kHeaderBytes + record.kind.size() + record.bytes.size();
  });
  if (last == 0) return;
  const std::size_t truncated = std::uniform_int_distribution<std::size_t>(1, last)(random);
  const std::uintmax_t size = std::filesystem::file_size(journal) - truncated;
  std::filesystem::resize_file(journal, size);
  std::filesystem::resize_file(journal_copy(journal), size);
}

Pose2 PowerLossDrive::T_world_body() const {
  return in_plan(sim_.simulation().vehicle().motion().T_world_body);
}

}  // namespace adit::test
