// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/run_node.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "common/bus/lcm_bus.hpp"
#include "common/bus/lcm_transport.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/node/version.hpp"
#include "common/command_line/command_line.hpp"
#include "common/files/file_utils.hpp"
#include "common/service/service_manager.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kExitUnusable = 2;
constexpr std::int64_t kWatchdogPeriodUs = 1'000'000;
constexpr const char* kConfigVariable = "ADIT_CONFIG";

struct Options {
  std::string device;
  std::string config;
  std::string lcm_url;
  bool sim_time = false;
  bool print_config = false;
};

void declare(CLI::App& app, const std::string& program, const std::vector<std::string>& devices,
             Options& options) {
  if (!devices.empty()) {
    app.add_option("DEVICE", options.device, "Which device; the section of its name configures it")
        ->check(CLI::IsMember(devices))
        ->required();
  }
  app.add_option("--config", options.config, "YAML file with one section per stage")
      ->type_name("FILE")
      ->envname(kConfigVariable);
  app.add_option("--lcm-url", options.lcm_url,
                 "URL of LCM, e.g. udpm://239.255.76.67:7667?ttl=0 (the default)")
      ->type_name("URL");
  app.add_flag("--sim-time", options.sim_time,
               "Use the time of a simulator (SIM_TIME) and acknowledge each with SIM_TIME_DONE");
  app.add_flag("--print-config", options.print_config,
               "Print every parameter with the value in effect and exit");
  app.set_version_flag("--version", program + " " + version());
}

/// One file configures all stages, so sections of other stages are valid.
ConfigFile load(const std::string& path, const std::string& stage) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(find_installed_file(path, "config"));
  std::vector<std::string> known = config_sections();
  known.push_back(stage);
  file.require_known_sections(known);
  return file;
}

/// Exports the options to child processes through the environment, as their defaults. Simulated
/// time is not exported: left over in a shell, it would make a robot wait indefinitely.
void export_to_children(const Options& options) {
  if (!options.config.empty()) {
    const auto config = std::filesystem::absolute(find_installed_file(options.config, "config"));
    setenv(kConfigVariable, config.c_str(), 1);
  }
  if (!options.lcm_url.empty()) setenv("LCM_DEFAULT_URL", options.lcm_url.c_str(), 1);
}

LcmBusOptions bus_options(const Options& options, const std::string& stage,
                          const SealParams& seal) {
  LcmBusOptions bus;
  bus.url = options.lcm_url;
  if (options.sim_time) bus.time = BusTime::kSimulated;
  bus.stage = stage;
  bus.seal = seal.read();
  return bus;
}

void run_on_lcm(const std::string& program, const ConfiguredNode& node, const Options& options,
                const SealParams& seal) {
  const StopSignal stop;  // before LCM starts its thread
  if (const auto advice = receive_buffer_advice(options.lcm_url)) {
    print_error(program, *advice);
  }
  LcmBus bus(bus_options(options, node.stage, seal));
  const HostedNode hosted(bus, node, StageBus::Measure::kHandlerTimes, &std::cerr);
  const ServiceManager service;
  if (ServiceManager::expects_watchdog()) {
    bus.create_wall_timer(kWatchdogPeriodUs,
                          [&service](std::int64_t) { service.notify("WATCHDOG=1"); });
  }
  bus.run(stop.descriptor());
}

}  // namespace

int run_stage(const std::string& name, const std::vector<std::string>& devices,
              const Configure& configure, int argc, char** argv) try {
  const std::string program = "adit-" + name;
  const std::vector<std::string> drivers = driver_names();
  const bool is_driver = std::find(drivers.begin(), drivers.end(), name) != drivers.end();
  const std::string what = is_driver ? "driver " : "stage ";
  const auto app =
      make_command_line("Runs the " + what + name + " on LCM until SIGINT or SIGTERM.", program);
  Options options;
  declare(*app, program, devices, options);
  if (const auto exit_code = parse_command_line(*app, argc, argv)) {
    finish_standard_output();
    return *exit_code;
  }

  const std::string stage = devices.empty() ? name : name + "_" + options.device;
  const ConfigFile file = load(options.config, stage);
  const ConfiguredNode node = configure(file, stage);
  const auto seal = load_section<SealParams>(file, SealParams::kSection);
  if (options.print_config) {
    std::cout << node.yaml;
    finish_standard_output();
    return 0;
  }
  export_to_children(options);  // before any thread starts
  run_on_lcm(program, node, options, seal);
  return 0;
} catch (const std::exception& error) {
  print_error("adit-" + name, error.what());
  return kExitUnusable;
}

}  // namespace adit
