// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/messages/codec.hpp"
#include "common/messages/fields/fields.hpp"

namespace adit {

/// Where the bytes of a field are in an encoded message, by the table of fields
/// (common/messages/fields). An array has a place for each element.
struct FieldPlace {
  enum class Kind { kInteger, kFloat, kText };

  std::string name;
  Kind kind = Kind::kInteger;
  std::size_t offset = 0;
  std::size_t bytes = 0;  ///< of a text: its length, its characters and its NUL
  Quantity quantity = kAny;
  double value = 0.0;      ///< the number decoded
  bool in_matrix = false;  ///< plausible together with other numbers only
};

/// Visits the fields of a message and adds up where their encoding is.
class FieldLayout {
 public:
  template <class T>
  void number(const char* name, T& number, const Quantity& quantity) {
    const auto kind = std::is_floating_point_v<std::remove_const_t<T>> ? FieldPlace::Kind::kFloat
                                                                       : FieldPlace::Kind::kInteger;
    add({name, kind, 0, sizeof(T), quantity, static_cast<double>(number)});
  }
  void text(const char* name, const std::string& text, const TextLimit& /*limit*/) {
    add({name, FieldPlace::Kind::kText, 0, sizeof(std::int32_t) + text.size() + 1});
  }
  void matrix(const char* name, const double (&rows)[3][3], const MatrixLimit& limit) {
    const Quantity entry{-limit.diagonal_max, limit.diagonal_max, limit.reason};
    for (const auto& row : rows) {
      for (const double number : row)
        add({name, FieldPlace::Kind::kFloat, 0, sizeof(double), entry, number, true});
    }
  }

  [[nodiscard]] const std::vector<FieldPlace>& places() const& { return places_; }
  /// Length of the encoded message [bytes].
  [[nodiscard]] std::size_t end() const { return end_; }

 private:
  void add(FieldPlace place) {
    place.offset = end_;
    end_ += place.bytes;
    places_.push_back(std::move(place));
  }

  std::vector<FieldPlace> places_;
  std::size_t end_ = sizeof(std::int64_t);  // behind the fingerprint
};

/// The layout of an encoded message; without places if it does not decode.
template <class Msg>
FieldLayout field_layout(std::span<const std::uint8_t> bytes) {
  FieldLayout layout;
  if (const Result<Msg> message = decode<Msg>(bytes)) visit_fields(*message, layout);
  return layout;
}

/// The bits of a field, in the low bytes.
std::uint64_t read_bits(const std::vector<std::uint8_t>& message, const FieldPlace& place);
void write_bits(const FieldPlace& place, std::uint64_t bits, std::vector<std::uint8_t>& message);

/// The number that the bits of a field stand for. Not for texts.
double number_of(const FieldPlace& place, std::uint64_t bits);

/// The bits of extreme values of a field: the ends of its type and of its quantity, the next
/// numbers beyond these, zero, denormals, infinities and NaN. For a text, lengths.
std::vector<std::uint64_t> extreme_bits(const FieldPlace& place);

}  // namespace adit
