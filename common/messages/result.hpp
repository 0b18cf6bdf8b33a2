// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace adit {

/// The reason for rejection, for the construction of a Result.
struct Rejected {
  std::string_view reason;
};

/// A value, or the reason for its rejection: one short clause in static storage, constant for each
/// kind of error so that rejections can be counted by reason.
template <class T>
class Result {
 public:
  // Implicit: allows `return scan;` and `return Rejected{"no beams"};`.
  Result(T value) : value_(std::move(value)) {}
  Result(Rejected rejected) : rejection_(rejected.reason) {}

  [[nodiscard]] explicit operator bool() const { return value_.has_value(); }
  [[nodiscard]] const T& operator*() const { return *value_; }
  [[nodiscard]] const T* operator->() const { return &*value_; }

  /// Empty if there is a value.
  [[nodiscard]] std::string_view rejection() const { return rejection_; }

 private:
  std::optional<T> value_;
  std::string_view rejection_;
};

}  // namespace adit
