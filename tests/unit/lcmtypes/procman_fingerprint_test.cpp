// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Repeats the layouts of procman's types and LCM's computation of fingerprints (lcmgen.c:
// lcm_struct_hash and the generated code), to verify that a stock sheriff decodes our messages.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "adit/planar_lidar_t.hpp"
#include "procman_lcm/deputy_info_t.hpp"
#include "procman_lcm/discovery_t.hpp"
#include "procman_lcm/orders_t.hpp"
#include "procman_lcm/output_t.hpp"

namespace {

struct Layout;

struct Member {
  std::string type;  // of a primitive
  std::string name;
  std::string count;               // of an array of variable length
  const Layout* nested = nullptr;  // instead of a primitive
};

struct Layout {
  std::vector<Member> members;
};

std::uint64_t update(std::uint64_t hash, std::uint64_t byte) {
  const auto carried = static_cast<std::uint64_t>(static_cast<std::int64_t>(hash) >> 55);
  return ((hash << 8) ^ carried) + byte;
}

std::uint64_t update(std::uint64_t hash, const std::string& text) {
  hash = update(hash, text.size());
  for (const char c : text) hash = update(hash, static_cast<std::uint64_t>(c));
  return hash;
}

constexpr std::uint64_t kVariableLength = 1;

std::uint64_t fingerprint_of(const Layout& layout) {
  std::uint64_t hash = 0x12345678;
  for (const Member& member : layout.members) {
    hash = update(hash, member.name);
    if (!member.nested) hash = update(hash, member.type);
    hash = update(hash, member.count.empty() ? 0 : 1);
    if (!member.count.empty()) hash = update(update(hash, kVariableLength), member.count);
  }
  for (const Member& member : layout.members) {
    if (member.nested) hash += fingerprint_of(*member.nested);
  }
  return (hash << 1) + (hash >> 63);
}

std::int64_t expected(const Layout& layout) {
  return static_cast<std::int64_t>(fingerprint_of(layout));
}

const Layout kCommand{{{"string", "command_id", "", nullptr},
                       {"string", "exec_str", "", nullptr},
                       {"string", "group", "", nullptr},
                       {"boolean", "auto_respawn", "", nullptr},
                       {"int8_t", "stop_signal", "", nullptr},
                       {"float", "stop_time_allowed", "", nullptr}}};

const Layout kDesired{{{"", "cmd", "", &kCommand},
                       {"int32_t", "desired_runid", "", nullptr},
                       {"boolean", "force_quit", "", nullptr}}};

const Layout kStatus{{{"", "cmd", "", &kCommand},
                      {"int32_t", "pid", "", nullptr},
                      {"int32_t", "actual_runid", "", nullptr},
                      {"int32_t", "exit_code", "", nullptr},
                      {"float", "cpu_usage", "", nullptr},
                      {"int64_t", "mem_vsize_bytes", "", nullptr},
                      {"int64_t", "mem_rss_bytes", "", nullptr}}};

const Layout kInfo{{{"int64_t", "utime", "", nullptr},
                    {"string", "deputy_id", "", nullptr},
                    {"float", "cpu_load", "", nullptr},
                    {"int64_t", "phys_mem_total_bytes", "", nullptr},
                    {"int64_t", "phys_mem_free_bytes", "", nullptr},
                    {"int64_t", "swap_total_bytes", "", nullptr},
                    {"int64_t", "swap_free_bytes", "", nullptr},
                    {"int32_t", "ncmds", "", nullptr},
                    {"", "cmds", "ncmds", &kStatus}}};

const Layout kOrders{{{"int64_t", "utime", "", nullptr},
                      {"string", "deputy_id", "", nullptr},
                      {"string", "sheriff_id", "", nullptr},
                      {"int32_t", "ncmds", "", nullptr},
                      {"", "cmds", "ncmds", &kDesired}}};

const Layout kOutput{{{"int64_t", "utime", "", nullptr},
                      {"string", "deputy_id", "", nullptr},
                      {"int16_t", "num_commands", "", nullptr},
                      {"string", "command_ids", "num_commands", nullptr},
                      {"string", "text", "num_commands", nullptr}}};

const Layout kDiscovery{{{"int64_t", "utime", "", nullptr},
                         {"string", "transmitter_id", "", nullptr},
                         {"int64_t", "nonce", "", nullptr}}};

TEST(ProcmanFingerprint, IsComputedLikeLcm) {
  const Layout lidar{{{"int64_t", "utime", "", nullptr},
                      {"int32_t", "nranges", "", nullptr},
                      {"float", "ranges", "nranges", nullptr},
                      {"int32_t", "nintensities", "", nullptr},
                      {"float", "intensities", "nintensities", nullptr},
                      {"float", "rad0", "", nullptr},
                      {"float", "radstep", "", nullptr}}};
  EXPECT_EQ(adit::planar_lidar_t::getHash(), expected(lidar));
}

TEST(ProcmanFingerprint, MatchesProcmanForEveryType) {
  EXPECT_EQ(procman_lcm::cmd_t::getHash(), expected(kCommand));
  EXPECT_EQ(procman_lcm::cmd_desired_t::getHash(), expected(kDesired));
  EXPECT_EQ(procman_lcm::cmd_status_t::getHash(), expected(kStatus));
  EXPECT_EQ(procman_lcm::deputy_info_t::getHash(), expected(kInfo));
  EXPECT_EQ(procman_lcm::orders_t::getHash(), expected(kOrders));
  EXPECT_EQ(procman_lcm::output_t::getHash(), expected(kOutput));
  EXPECT_EQ(procman_lcm::discovery_t::getHash(), expected(kDiscovery));
}

}  // namespace
