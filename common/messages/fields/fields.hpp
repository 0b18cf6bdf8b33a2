// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

#include "common/messages/fields/quantities.hpp"

namespace adit {

/// The fields of a message type in the order of its declaration, each with its quantity:
///   template <>
///   struct Fields<gas_t> {
///     static void visit(auto& message, auto& field) {
///       field("utime", message.utime, kTime);
///       ...
/// This table is what the decoders check (`implausible_field`) and what the tests change, one
/// number at a time; a test compares its length with that of the encoded message.
template <class Msg>
struct Fields;

/// Divides fields into numbers, texts and matrices for a visitor, which has
///   void number(const char* name, T& number, const Quantity& quantity);
///   void text(const char* name, std::string& text, const TextLimit& limit);
///   void matrix(const char* name, double (&rows)[3][3], const MatrixLimit& limit);
/// each also for a const field if the message is const.
template <class Visitor>
class FieldDivider {
 public:
  explicit FieldDivider(Visitor& visitor) : visitor_(visitor) {}

  /// A number, an array of numbers or one of arrays.
  template <class T>
  void operator()(const char* name, T& field, const Quantity& quantity) {
    if constexpr (std::is_arithmetic_v<std::remove_const_t<T>>) {
      visitor_.number(name, field, quantity);
    } else {
      for (auto& part : field) (*this)(name, part, quantity);
    }
  }
  /// A text or an array of texts.
  template <class T>
  void operator()(const char* name, T& field, const TextLimit& limit) {
    if constexpr (std::same_as<std::remove_const_t<T>, std::string>) {
      visitor_.text(name, field, limit);
    } else {
      for (auto& part : field) (*this)(name, part, limit);
    }
  }
  template <class T>
  void operator()(const char* name, T& rows, const MatrixLimit& limit) {
    visitor_.matrix(name, rows, limit);
  }

  /// A pose (x, y, θ), or an array of poses.
  template <class T>
  void pose(const char* name, T& pose) {
    if constexpr (requires { pose[0][0]; }) {
      for (auto& part : pose) this->pose(name, part);
    } else {
      (*this)(name, pose[0], kPosition);
      (*this)(name, pose[1], kPosition);
      (*this)(name, pose[2], kHeading);
    }
  }
  /// A nested message, or an array of them.
  template <class T>
  void part(T& part) {
    Fields<std::remove_const_t<T>>::visit(part, *this);
  }
  template <class T>
  void parts(T& parts) {
    for (auto& part : parts) this->part(part);
  }

 private:
  Visitor& visitor_;
};

/// Visits all fields of a message, nested ones included.
template <class Msg, class Visitor>
void visit_fields(Msg& message, Visitor& visitor) {
  FieldDivider divider(visitor);
  Fields<std::remove_const_t<Msg>>::visit(message, divider);
}

/// Whether a matrix is within its limit: finite, symmetric within rounding, with a diagonal from
/// zero to the greatest and, unless it need not be, positive semidefinite within rounding. Zero is
/// valid: no information.
bool is_plausible(const double (&rows)[3][3], const MatrixLimit& limit);

/// A visitor that finds the first field without a plausible value.
class FieldCheck {
 public:
  template <class T>
  void number(const char* /*name*/, const T& number, const Quantity& quantity) {
    require(quantity.contains(static_cast<double>(number)), quantity.reason);
  }
  void text(const char* /*name*/, const std::string& text, const TextLimit& limit) {
    require(text.size() <= limit.bytes_max && (limit.may_be_empty || !text.empty()), limit.reason);
  }
  void matrix(const char* /*name*/, const double (&rows)[3][3], const MatrixLimit& limit) {
    require(is_plausible(rows, limit), limit.reason);
  }

  /// Empty if all fields are plausible.
  [[nodiscard]] std::string_view reason() const { return reason_; }

 private:
  void require(bool plausible, const char* reason) {
    if (!plausible && reason_.empty()) reason_ = reason;
  }

  std::string_view reason_;
};

/// The reason for which a field of the message has no plausible value, the first of them; empty if
/// there is none.
template <class Msg>
std::string_view implausible_field(const Msg& message) {
  FieldCheck check;
  visit_fields(message, check);
  return check.reason();
}

}  // namespace adit
