// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/child_work.hpp"

#include <csignal>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/mesh/mesh_bytes.hpp"
#include "tests/support/box_drift.hpp"

namespace adit {
namespace {

constexpr int kSeconds = 1;

TEST(ChildWork, GivesWhatTheWorkReturns) {
  EXPECT_EQ(work_in_child([] { return Bytes(300'000, 7); }, kSeconds), Bytes(300'000, 7));
  EXPECT_EQ(work_in_child([] { return Bytes(); }, kSeconds), Bytes());
}

TEST(ChildWork, ThrowsWhatTheWorkThrows) {
  const auto work = []() -> Bytes { throw std::invalid_argument("no such thing"); };
  EXPECT_THAT([&] { work_in_child(work, kSeconds); },
              testing::ThrowsMessage<std::runtime_error>("no such thing"));
}

TEST(ChildWork, SurvivesACrash) {
  const auto work = []() -> Bytes {
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would report it at length
    std::raise(SIGSEGV);
    return {};
  };
  EXPECT_THAT([&] { work_in_child(work, kSeconds); },
              testing::ThrowsMessage<ChildDied>("its reader crashed"));
}

TEST(ChildWork, EndsWhatTakesTooLong) {
  const auto work = []() -> Bytes {
    for (volatile bool forever = true; forever;) {
    }
    return {};
  };
  EXPECT_THAT([&] { work_in_child(work, kSeconds); },
              testing::ThrowsMessage<ChildDied>("it takes too long to read"));
}

TEST(ChildWork, AMeshComesAcrossAsItIs) {
  const TriangleMesh mesh = box_drift().mesh;
  const TriangleMesh same =
      mesh_from_bytes(work_in_child([&] { return to_bytes(mesh); }, kSeconds));
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
