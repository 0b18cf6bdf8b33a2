// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace adit::test {

/// The path of a recording; `name` is relative to the data folder. Nothing if it does not exist:
/// the test must then be skipped. The data folder is $ADIT_DATA or, if unset, `../shared/data`
/// relative to the source folder.
std::optional<std::filesystem::path> find_recording(std::string_view name);

}  // namespace adit::test

// NOLINTBEGIN(bugprone-macro-parentheses): a variable name cannot be parenthesized
/// Defines `variable` as the path of a recording, or skips the test.
#define ADIT_RECORDING_OR_SKIP(variable, name)                                           \
  const auto variable##_found = adit::test::find_recording(name);                        \
  if (!variable##_found) GTEST_SKIP() << "no recording " << (name) << "; set ADIT_DATA"; \
  const auto& variable = *variable##_found
// NOLINTEND(bugprone-macro-parentheses)
