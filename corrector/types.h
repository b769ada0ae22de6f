#pragma once
// What goes into the corrector and what comes out. Freestanding: no heap, no double, no libc beyond
// mem*, fabsf and sqrtf. Units are in the names; rates are degrees per second, three axes x, y, z.
#include <cstdint>

namespace zro {

inline constexpr int kAxes = 3;
inline constexpr std::uint8_t kNoAxis = 3;
inline constexpr std::uint8_t kNoBin = 63;

/// One instant of the board's sensors.
struct Sample {
  float rate_dps[kAxes];  ///< uncorrected gyro
  float accel_g[kAxes];   ///< accelerometer, gravity included
  float temp_degc;        ///< last temperature the sensor gave; may be held over several samples
  std::uint32_t elapsed;  ///< nominal sample periods since the previous sample; 1 = consecutive
  bool gyro_clipped;      ///< a gyro axis at full scale
  bool accel_clipped;     ///< an accelerometer axis at full scale
  bool overrun;           ///< the sensor lost data before this sample
};

/// Why something was or was not learned. The numbers are the wire's (EMCY, log 0x2201).
enum class Code : std::uint8_t {
  kNone = 0,
  // 1..16: a reading was refused
  kMotion = 1,
  kGyroVariance = 2,
  kBiasLimit = 3,
  kDiffersFromEntry = 4,
  kTemperatureSlope = 5,
  kTemperatureRange = 6,
  kTemperatureSensor = 7,
  kTooShort = 8,
  kClipped = 9,
  kAcousticOrVibration = 10,
  kSampleGap = 11,
  kSupply = 12,
  kStoreInvalid = 13,
  kStoreWrite = 14,
  kDiffersFromEstimate = 15,
  kTestMode = 16,
  // 32..41: what was done
  kNew = 32,
  kMerged = 33,
  kOverwroteOld = 34,
  kRecentNothingToDo = 35,
  kQuarantined = 36,
  kShiftConfirmed = 37,
  kQuarantineExpired = 38,
  kRetry = 39,
  kTableComplete = 40,
  kReArmed = 41,
};
inline constexpr bool IsRejection(Code c) {
  return static_cast<std::uint8_t>(c) >= 1 && static_cast<std::uint8_t>(c) <= 16;
}

/// A reading entered the table by it.
inline constexpr bool IsWrite(Code c) {
  return c == Code::kNew || c == Code::kMerged || c == Code::kOverwroteOld ||
         c == Code::kShiftConfirmed;
}

/// One decision with the numbers behind it.
struct Event {
  std::uint32_t seq;     ///< counts the events since boot, from 0
  std::uint32_t sample;  ///< index of the sample it was taken at, since boot
  Code code;
  std::uint8_t axis;          ///< worst axis 0..2, kNoAxis where none
  std::uint8_t bin;           ///< table bin of temp_degc, kNoBin where none
  float temp_degc;            ///< smoothed temperature of the reading
  float measured_dps[kAxes];  ///< smoothed gyro of the reading (0 where there was none yet)
  float limit;                ///< the limit that decided, in the unit of the code's quantity
  float value;                ///< the quantity compared with it (same unit)
};

/// Where the offset now subtracted comes from (wire: DUT_CORR CorrState).
enum class Source : std::uint8_t {
  kOff = 0,
  kDefaultZero = 1,  ///< table empty: nothing is subtracted
  kInterpolated = 2,
  kExtrapolatedHold = 3,  ///< outside the table: bounded extrapolation
  kLearning = 4,          ///< interpolated, while the device is still and a reading is under way
  kFrozen = 5,
  kInvalidLut = 6,
};

struct Output {
  float rate_dps[kAxes];  ///< corrected: sample minus zro_dps
  float zro_dps[kAxes];   ///< offset subtracted
  float sigma_dps;        ///< 1-sigma uncertainty of zro_dps, worst axis
  Source source;
  std::uint8_t bin;        ///< nearest table bin, kNoBin when the table is empty
  std::uint16_t age_days;  ///< age of the nearest entry; 0xFFFF when unknown
  bool still;              ///< declared motionless
  bool learning;           ///< a reading is being averaged
  bool vibration;          ///< gyro noise well above its floor
  bool updated;            ///< this sample wrote the table (codes 32, 33, 34, 37)
};

}  // namespace zro
