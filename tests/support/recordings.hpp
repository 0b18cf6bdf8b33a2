// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace adit::test {

/// Where a recording of the development data lies (path relative to its folder), or nothing where
/// the folder is absent: a test then skips and says so. The folder is $ADIT_DATA or, without it,
/// `../shared/data` beside the sources.
std::optional<std::filesystem::path> find_recording(std::string_view name);

}  // namespace adit::test

// NOLINTBEGIN(bugprone-macro-parentheses): the name of a variable takes none
/// Defines `variable` as the path of a recording, or skips the test.
#define ADIT_RECORDING_OR_SKIP(variable, name)                                           \
  const auto variable##_found = adit::test::find_recording(name);                        \
  if (!variable##_found) GTEST_SKIP() << "no recording " << (name) << "; set ADIT_DATA"; \
  const auto& variable = *variable##_found
// NOLINTEND(bugprone-macro-parentheses)
