// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

/// What the numbers, texts and matrices of messages are, and the values that they can have. A bound
/// is one that no vehicle, sensor or mine exceeds, far beyond those of a particular robot: it keeps
/// absurd values out of the algorithms, it does not replace the limits of the configuration.
namespace adit {

/// A kind of number with its plausible values, from `min` to `max`.
struct Quantity {
  double min;
  double max;
  const char* reason;          ///< of rejection, one clause
  bool may_be_nan = false;     ///< NaN stands for "unknown"
  bool has_exception = false;  ///< `exception` is valid too
  double exception = 0.0;

  [[nodiscard]] constexpr bool contains(double number) const {
    if (number >= min && number <= max) return true;
    if (has_exception && number == exception) return true;
    return may_be_nan && number != number;
  }
  /// The same with a reason that names the field.
  [[nodiscard]] constexpr Quantity because(const char* text) const {
    Quantity named = *this;
    named.reason = text;
    return named;
  }
  [[nodiscard]] constexpr Quantity or_nan() const {
    Quantity optional = *this;
    optional.may_be_nan = true;
    return optional;
  }
  /// With one value outside the range that stands for "unknown" or "unlimited".
  [[nodiscard]] constexpr Quantity or_exactly(double number) const {
    Quantity extended = *this;
    extended.has_exception = true;
    extended.exception = number;
    return extended;
  }
};

/// A text with its greatest length [bytes].
struct TextLimit {
  std::size_t bytes_max;
  const char* reason;
  bool may_be_empty = true;
};

/// A symmetric 3×3 matrix of (x, y, θ): a covariance [m², m rad, rad²] or its inverse.
struct MatrixLimit {
  double diagonal_max;
  const char* reason;
  bool is_definite = true;  ///< whether it must be positive semidefinite, not only its diagonal
  /// Tolerance of that, relative to the diagonal.
  double rounding = 1e-6;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kInt32Max = std::numeric_limits<std::int32_t>::max();

constexpr const char* kImplausibleTime = "time outside 1970 to 2286";
constexpr const char* kShareOutOfRange = "share outside 0 to 1";
constexpr const char* kImplausiblePosition = "implausible position";
constexpr const char* kImplausibleHeading = "implausible heading";
constexpr const char* kImplausibleHeight = "implausible height";
constexpr const char* kImplausibleAttitude = "roll or pitch beyond 60 degrees";
constexpr const char* kInvalidDistance = "invalid distance";
constexpr const char* kInvalidInformation = "invalid information matrix";
constexpr const char* kInvalidCovariance = "invalid covariance matrix";

/// Any value, for numbers that are checked where they are used, such as the ranges of a laser.
inline constexpr Quantity kAny{-kInfinity, kInfinity, "", true};

// Times, counts and codes.
inline constexpr Quantity kTime{0.0, 1e16 - 2.0, kImplausibleTime};  // [µs since the epoch]
inline constexpr bool is_plausible_utime(std::int64_t utime) {
  return kTime.contains(static_cast<double>(utime));
}
inline constexpr Quantity kDuration{0.0, 1e7, "invalid interval"};  // [s]
inline constexpr Quantity kMilliseconds{0.0, 1e10, "invalid time of a handler"};
inline constexpr Quantity kId{0.0, kInt32Max, "negative id"};
inline constexpr Quantity kOptionalId{-1.0, kInt32Max, "negative id"};  // −1: none
inline constexpr Quantity kCount{0.0, 1e15, "negative count"};
inline constexpr Quantity kRevision{0.0, 1e15, "negative revision"};
inline constexpr Quantity kFlag{0.0, 1.0, "flag is neither 0 nor 1"};

// Places.
inline constexpr double kPositionMaxM = 1e5;  // along each axis of a frame
inline constexpr Quantity kPosition{-kPositionMaxM, kPositionMaxM, kImplausiblePosition};
inline constexpr Quantity kHeight{-1e4, 1e4, kImplausibleHeight};
inline constexpr Quantity kHeading{-1e3, 1e3, kImplausibleHeading};           // [rad]
inline constexpr Quantity kUnwrappedHeading{-1e5, 1e5, kImplausibleHeading};  // of wheels [rad]
inline constexpr double kAttitudeMaxRad = std::numbers::pi / 3.0;
inline constexpr Quantity kAttitude{-kAttitudeMaxRad, kAttitudeMaxRad, kImplausibleAttitude};
/// A component of a unit vector or unit quaternion.
inline constexpr Quantity kComponent{-1.001, 1.001, "not a unit vector"};

// Lengths.
inline constexpr Quantity kDistance{0.0, 1e7, kInvalidDistance};
inline constexpr Quantity kSignedDistance{-1e7, 1e7, kInvalidDistance};
inline constexpr Quantity kCell{0.001, 10.0, "implausible cell size"};
inline constexpr Quantity kLeverArm{1e-3, 1e5, "implausible lever arm"};
inline constexpr Quantity kResidual{0.0, 1e4, "implausible residual"};

// Motion.
inline constexpr Quantity kSpeed{-30.0, 30.0, "implausible speed"};
inline constexpr Quantity kCurvature{-100.0, 100.0, "implausible curvature"};
inline constexpr Quantity kAngularVelocity{-100.0, 100.0, "implausible angular velocity"};
inline constexpr Quantity kAcceleration{-1000.0, 1000.0, "implausible acceleration"};
inline constexpr Quantity kAngle{-6.3, 6.3, "implausible angle"};
inline constexpr Quantity kRate{-20.0, 20.0, "implausible rate"};
inline constexpr Quantity kRateMax{1e-6, 20.0, "rate is not positive"};
inline constexpr Quantity kDepth{0.0, 100.0, "implausible depth"};

// Shares, likelihoods and costs.
inline constexpr Quantity kShare{0.0, 1.0, kShareOutOfRange};
inline constexpr Quantity kLikelihood{-1e15, 1e15, "implausible likelihood"};
inline constexpr Quantity kScore{-1e6, 1e6, "implausible score"};
inline constexpr Quantity kCost{-1e15, 1e15, "implausible cost"};
inline constexpr Quantity kVariance{0.0, 1e8, "implausible variance"};  // [m²]

// Matrices. A covariance is that of a motion between two scans or of a pose in the map.
inline constexpr MatrixLimit kCovariance{1e8, kInvalidCovariance, true, 1e-12};
inline constexpr MatrixLimit kPoseCovariance{1e12, kInvalidCovariance, true, 1e-6};
inline constexpr MatrixLimit kVariances{1e12, kInvalidCovariance, false};
inline constexpr MatrixLimit kInformation{1e12, kInvalidInformation, true, 1e-6};

// Texts.
inline constexpr TextLimit kName{1000, "name too long"};
inline constexpr TextLimit kSentence{10'000, "sentence too long"};
inline constexpr TextLimit kLongText{4U << 20U, "text too long"};
constexpr TextLimit required(const TextLimit& limit, const char* reason) {
  return {limit.bytes_max, reason, false};
}

/// A code from 0 to `last`, one of the constants of a message.
constexpr Quantity code(int last, const char* reason) {
  return {0.0, static_cast<double>(last), reason};
}

}  // namespace adit
