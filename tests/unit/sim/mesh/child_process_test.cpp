// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/child_process.hpp"

#include <csignal>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

constexpr int kSeconds = 1;

TEST(ChildProcess, ReturnsTheResultOfTheWork) {
  EXPECT_EQ(run_in_child_process([] { return Bytes(300'000, 7); }, kSeconds), Bytes(300'000, 7));
  EXPECT_EQ(run_in_child_process([] { return Bytes(); }, kSeconds), Bytes());
}

TEST(ChildProcess, RethrowsAnErrorOfTheWork) {
  const auto work = []() -> Bytes { throw std::invalid_argument("no such thing"); };
  EXPECT_THAT([&] { run_in_child_process(work, kSeconds); },
              testing::ThrowsMessage<std::runtime_error>("no such thing"));
}

TEST(ChildProcess, ReportsACrash) {
  const auto work = []() -> Bytes {
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would report it at length
    std::raise(SIGSEGV);
    return {};
  };
  EXPECT_THAT([&] { run_in_child_process(work, kSeconds); },
              testing::ThrowsMessage<ChildProcessError>("its reader crashed"));
}

TEST(ChildProcess, KillsWorkBeyondTheTimeLimit) {
  const auto work = []() -> Bytes {
    for (volatile bool forever = true; forever;) {
    }
    return {};
  };
  EXPECT_THAT([&] { run_in_child_process(work, kSeconds); },
              testing::ThrowsMessage<ChildProcessError>("it takes too long to read"));
}

TEST(ChildProcess, TransfersAMeshUnchanged) {
  const TriangleMesh mesh = box_tunnel().mesh;
  const TriangleMesh same =
      mesh_from_bytes(run_in_child_process([&] { return to_bytes(mesh); }, kSeconds));
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(same.triangle_parts, mesh.triangle_parts);
  ASSERT_EQ(same.parts.size(), mesh.parts.size());
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    EXPECT_EQ(same.parts[i].name, mesh.parts[i].name);
    EXPECT_EQ(same.parts[i].kind, mesh.parts[i].kind);
    EXPECT_EQ(same.parts[i].material, mesh.parts[i].material);
  }
}

}  // namespace
}  // namespace adit
