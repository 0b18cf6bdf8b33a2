// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>
#include <thread>

#include <CLI/App.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "common/command_line/command_line.hpp"
#include "common/files/disk_space.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/check_driver/driver_check.hpp"
#include "tools/doctor/computer_checks.hpp"
#include "tools/doctor/stage_load.hpp"

namespace adit {
namespace {

constexpr int kExitComputer = 1;

struct DoctorOptions {
  std::filesystem::path config;        ///< empty: defaults, and no devices
  std::filesystem::path folder = ".";  ///< where logs and journals will be
  double seconds = 10.0;
};

constexpr const char* kDoctorDetails =
    R"(Checks the computer that is to run a robot, one line each; a line that begins with BAD ends with a remedy, one with -
could not be checked or does not matter here:

  route, buffers   of multicast, by which all messages travel
  clock            date and synchronisation
  governor         whether the processor is kept slow
  device           whether the devices of the drivers in --config may be opened
  load             all stages at the rates of the robot's sensors, in a simulated mine on this processor
  disk             its speed and space against the rate of the log

Run it as the user that runs the robot, on the computer as it will be: with the drivers running, and on batteries.)";

constexpr const char* kDoctorExamples =
    R"(  adit doctor --config /etc/adit/robot.yaml --disk /var/lib/adit
  sudo -u adit adit doctor --config /etc/adit/robot.yaml --disk /var/lib/adit)";

/// A folder for the journals of the measured stages, removed at the end.
class WorkFolder {
 public:
  explicit WorkFolder(const std::filesystem::path& parent)
      : path_(parent / fmt::format(".adit-doctor-{}", getpid())) {
    std::filesystem::create_directory(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void run(const DoctorOptions& options) {
  CheckResults results = check_computer(options.config);
  const WorkFolder work(options.folder);
  const StageLoad load = measure_stage_load(options.config, work.path(), options.seconds);
  results.push_back(check_load(load, std::max(1U, std::thread::hardware_concurrency())));
  const double free_mb = 1e-6 * static_cast<double>(free_bytes(options.folder).value_or(0));
  results.push_back(
      check_disk(options.folder, disk_speed_mb_s(options.folder), free_mb, load.log_mb_s));
  std::cout << text_of("this computer", results);
  if (!all_are_good(results)) throw CLI::RuntimeError(kExitComputer);
}

}  // namespace

void add_doctor_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "doctor", "Check the computer that is to run a robot, with remedies");
  set_help(*command,
           {kDoctorDetails, "  1  something is not as the robot needs it", kDoctorExamples});
  const auto options = std::make_shared<DoctorOptions>();
  command->add_option("--config", options->config, "YAML file of the robot")
      ->type_name("FILE")
      ->envname("ADIT_CONFIG");
  command->add_option("--disk", options->folder, "Folder of logs and journals")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "How long to measure the load")
      ->type_name("SECONDS")
      ->check(number_in(above_up_to(0.0, 600.0)))
      ->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace adit
