// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace adit {

/// The reason, on its way into a Result.
struct Rejected {
  std::string_view reason;
};

/// A value, or the reason why there is none: one short clause for people, of static storage, the
/// same for every case of one kind so that refusals can be counted by it.
template <class T>
class Result {
 public:
  // Implicit on purpose: `return scan;` and `return Refused{"no beams"};` both read well.
  Result(T value) : value_(std::move(value)) {}
  Result(Rejected rejected) : rejection_(rejected.reason) {}

  [[nodiscard]] explicit operator bool() const { return value_.has_value(); }
  [[nodiscard]] const T& operator*() const { return *value_; }
  [[nodiscard]] const T* operator->() const { return &*value_; }

  /// Empty where there is a value.
  [[nodiscard]] std::string_view rejection() const { return rejection_; }

 private:
  std::optional<T> value_;
  std::string_view rejection_;
};

}  // namespace adit
