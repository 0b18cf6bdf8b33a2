// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace adit {

/// A file or a device cannot be read or written: one line with its path and the reason. It ends a
/// stage (exit code 2), unlike a failure on a message.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace adit
