// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/spool.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>
#include <malloc.h>

#include "common/files/file_error.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kMany = 300'000;  // 2.4 MB

std::uint64_t square(std::uint64_t i) { return i * i; }

class SpoolTest : public testing::Test {
 protected:
  void fill() {
    for (std::uint64_t i = 0; i < kMany; ++i) spool_.push_back(square(i));
  }

  test::ScratchFolder folder_;
  Spool<std::uint64_t> spool_{folder_.path()};
};

TEST_F(SpoolTest, ReturnsWhatWasAddedInAnyOrder) {
  EXPECT_TRUE(spool_.empty());
  fill();
  ASSERT_EQ(spool_.size(), kMany);
  std::uint64_t i = 0;
  for (const std::uint64_t value : spool_) ASSERT_EQ(value, square(i++));
  EXPECT_EQ(i, kMany);
  for (std::uint64_t k = 0; k < kMany; k += 997) {
    ASSERT_EQ(spool_[kMany - 1 - k], square(kMany - 1 - k));
    ASSERT_EQ(spool_[k], square(k));
  }
  EXPECT_EQ(spool_.front(), 0U);
  EXPECT_EQ(spool_.back(), square(kMany - 1));
}

TEST_F(SpoolTest, IsSearchedLikeAVector) {
  fill();
  const auto found = std::ranges::lower_bound(spool_, square(123'456) - 1);
  EXPECT_EQ(found - spool_.begin(), 123'456);
  EXPECT_EQ(std::ranges::lower_bound(spool_, square(kMany)), spool_.end());
}

TEST_F(SpoolTest, ReplacesTheLastElements) {
  fill();
  for (std::uint64_t i = 0; i < 100'000; ++i) spool_.pop_back();
  EXPECT_EQ(spool_.size(), kMany - 100'000);
  spool_.push_back(7);
  EXPECT_EQ(spool_.back(), 7U);
  EXPECT_EQ(spool_[kMany - 100'001], square(kMany - 100'001));
}

TEST_F(SpoolTest, IsMovedWithItsElements) {
  fill();
  const Spool<std::uint64_t> moved = std::move(spool_);
  EXPECT_EQ(moved.size(), kMany);
  EXPECT_EQ(moved[kMany / 2], square(kMany / 2));
}

TEST_F(SpoolTest, KeepsLittleInMemory) {
  const auto before = mallinfo2();
  fill();
  std::uint64_t sum = 0;
  for (const std::uint64_t value : spool_) sum += value;
  EXPECT_GT(sum, 0U);
  const auto after = mallinfo2();
  EXPECT_LT(after.uordblks + after.hblkhd, before.uordblks + before.hblkhd + 1'000'000);
}

TEST_F(SpoolTest, ReportsAFullDisk) {
  const test::FileSizeLimit limit(1'000'000);
  EXPECT_THROW(fill(), FileError);
}

}  // namespace
}  // namespace adit
