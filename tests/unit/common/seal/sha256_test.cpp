// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/seal/sha256.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "common/files/file_error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

/// FIPS 180-4, examples of NIST.
TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, OfAFileIsThatOfItsContent) {
  const test::ScratchFolder folder;
  const std::string text(3'000'000, 'x');  // more than one block
  std::ofstream(folder / "file") << text;
  EXPECT_EQ(sha256_of_file(folder / "file"), sha256_hex(text));
  EXPECT_THROW(sha256_of_file(folder / "none"), FileError);
  EXPECT_THROW(sha256_of_file(folder.path()), FileError);
}

}  // namespace
}  // namespace adit
