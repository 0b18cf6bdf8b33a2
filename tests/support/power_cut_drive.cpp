// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/power_cut_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/geometry/in_plan.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/cloud_pieces.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/local_map_pieces.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/scan_request.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tests/support/groundhog_params.hpp"

namespace adit::test {
namespace {

constexpr const char* kMapJournal = "map.journal";
constexpr const char* kVolumeJournal = "volume.journal";
constexpr std::int64_t kStartUtime = 1'600'000'000'000'000;
constexpr double kOffS = 2.0;   // the vehicle comes to rest in that time
constexpr double kWaitS = 5.0;  // for a correction
constexpr double kStepS = 1e-6 * static_cast<double>(Simulation::kStepUs);
constexpr std::array kSensors{channels::kLaserFront, channels::kLaserRear,
                              channels::kTiltFront,  channels::kTiltRear,
                              channels::kImu,        channels::kWheelOdometry};

WaypointDriverParams patient() {
  WaypointDriverParams params;
  params.patience_s = 1e6;
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

/// All stages from start to end, and what was heard of them.
class PowerCutDrive::Life {
 public:
  Life(MemoryBus& world, const std::filesystem::path& folder) {
    bus_.tap([&world](const Received& received) {
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

  void hear(const Received& received) {
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

PowerCutDrive::PowerCutDrive(World world, std::vector<Waypoint> waypoints,
                             std::filesystem::path folder)
    : folder_(std::move(folder)),
      site_(std::move(world)),
      sim_(bus_, site_, SimulationParams{}, 1, kStartUtime),
      driver_(std::move(waypoints), Vehicle{}, patient()) {
  bus_.tap([this](const Received& received) {
    const bool sensed = std::ranges::find(kSensors, received.channel) != kSensors.end();
    if (life_ && sensed) life_->hear(received);
  });
  begin_life();
  T_world_start_ = T_world_body();
  run(1.0);
}

PowerCutDrive::~PowerCutDrive() = default;

void PowerCutDrive::begin_life() { life_ = std::make_unique<Life>(bus_, folder_); }

void PowerCutDrive::step() {
  bus_.advance_to(sim_.next_utime());
  sim_.step();
  if (!driving_ || sim_.simulation().utime() % (5 * Simulation::kStepUs) != 0) return;
  publish(bus_, channels::kDriveCommand,
          to_message(driver_.command(sim_.simulation().vehicle().motion())));
}

void PowerCutDrive::run(double seconds) {
  for (double t = 0.0; t < seconds; t += kStepS) step();
}

bool PowerCutDrive::drive(double way_m) {
  const double end_m = driver_.progress_m() + way_m;
  driving_ = true;
  const auto stuck = [&] {
    return driver_.done() || driver_.given_up() || !sim_.simulation().state().failure.empty();
  };
  while (driver_.progress_m() < end_m && !stuck()) step();
  return !stuck();
}

void PowerCutDrive::sweep(double seconds) {
  driving_ = false;
  run(kOffS);
  volume_bytes_ = std::filesystem::file_size(folder_ / kVolumeJournal);
  publish(life_->bus(), channels::kScanRequest,
          to_message(ScanRequest{life_->bus().now_utime(), ++sweeps_, LaserId::kFront}));
  run(seconds);
}

void PowerCutDrive::wait(double seconds) {
  driving_ = false;
  run(seconds);
}

const VolumeMap& PowerCutDrive::volume() const { return life_->volume(); }

PowerCut PowerCutDrive::cut(DiskAfterCut disk, std::mt19937& random) {
  PowerCut cut;
  cut.way_m = driver_.progress_m();
  cut.in_motion = driving_;
  cut.torn = disk == DiskAfterCut::kTorn;
  cut.maps = life_->maps();
  cut.scans = life_->scans();
  T_world_before_ = T_world_body();
  const bool placed = life_->correction() && life_->pose();
  T_map_before_ = placed ? life_->T_map_body() : between(T_world_start_, T_world_before_);
  driving_ = false;
  life_.reset();
  if (disk == DiskAfterCut::kTorn) {
    tear(folder_ / kMapJournal, random);
    tear(folder_ / kVolumeJournal, random);
  }
  if (disk == DiskAfterCut::kBeforeTheScan) {
    std::filesystem::resize_file(folder_ / kVolumeJournal, volume_bytes_);
  }
  run(kOffS);
  begin_life();
  cut.maps_lost = std::max(0, cut.maps - life_->maps());
  cut.scans_lost = cut.scans - life_->scans();
  for (double t = 0.0; t < kWaitS && !life_->correction(); t += kStepS) {
    step();
    cut.found_s = t;
  }
  if (!life_->correction()) cut.found_s.reset();
  look_back(cut);
  cut.error_m = cut.later_error_m;
  cut.sd_m = cut.later_sd_m;
  if (!cut.found_s) return cut;
  const Pose2 truth = between(T_world_before_, T_world_body());
  cut.error_rad =
      std::abs(angle_diff(between(T_map_before_, life_->T_map_body()).theta, truth.theta));
  if (life_->correction()->covariance) {
    cut.sd_rad = std::sqrt((*life_->correction()->covariance)(2, 2));
  }
  return cut;
}

void PowerCutDrive::look_back(PowerCut& cut) const {
  if (!life_->correction() || !life_->pose()) return;
  const Pose2 truth = between(T_world_before_, T_world_body());
  const Pose2 found = between(T_map_before_, life_->T_map_body());
  cut.later_error_m = between(truth, found).translation().norm();
  if (const auto& covariance = life_->correction()->covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
        Eigen::Matrix2d(covariance->topLeftCorner<2, 2>()), Eigen::EigenvaluesOnly);
    cut.later_sd_m = std::sqrt(axes.eigenvalues().maxCoeff());
  }
}

/// As a disk does that had not written all of it.
void PowerCutDrive::tear(const std::filesystem::path& journal, std::mt19937& random) const {
  std::size_t last = 0;
  read_journal(journal, [&](const JournalRecord& record) {
    last = journal_format::kHeadBytes + record.kind.size() + record.bytes.size();
  });
  if (last == 0) return;
  const std::size_t torn = std::uniform_int_distribution<std::size_t>(1, last)(random);
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - torn);
}

Pose2 PowerCutDrive::T_world_body() const {
  return in_plan(sim_.simulation().vehicle().motion().T_world_body);
}

}  // namespace adit::test
