#pragma once
// The messages of zrobench.dbc as plain structs. Fields hold the integers of the bus; the constants
// below scale them. Decode() wants the message's id and exact length; bits that the DBC does not
// name are ignored when read and sent as zero. Freestanding.
#include <cstdint>

#include "corrector/node/frame.h"

namespace zro::node {

inline constexpr float kDpsPerRateLsb = 1.0f / 256;      ///< DUT_RATE, EMCY RejMeasured, log
inline constexpr float kDpsPerCorrLsb = 1.0f / 1024;     ///< DUT_CORR
inline constexpr float kDegcPerTempLsb = 1.0f / 256;     ///< DUT_TIME, log, object 0x2100:8, :9
inline constexpr float kAccelLsbPerG = 8000.0f;          ///< DUT_ACC, 0.000125 g
inline constexpr std::uint16_t kEmcyRejection = 0xFF10;  ///< + code 1..16

/// Network management states (CiA 301, 7.3.2.2) as in a heartbeat.
inline constexpr std::uint8_t kStateBootUp = 0, kStateStopped = 4, kStateOperational = 5,
                              kStatePreOperational = 127;
inline constexpr std::uint8_t kNmtStart = 1, kNmtStop = 2, kNmtEnterPreOp = 128,
                              kNmtResetNode = 129, kNmtResetComm = 130;

struct NmtMsg {
  static constexpr std::uint32_t kId = 0x000;
  static constexpr std::uint8_t kDlc = 2;
  std::uint8_t command, node_id;  ///< node_id 0 = all
};
struct TimeStampMsg {
  static constexpr std::uint32_t kId = 0x100;
  static constexpr std::uint8_t kDlc = 6;
  std::uint32_t ms;    ///< of the day, 28 bits
  std::uint16_t days;  ///< since 1984-01-01
};
struct EmcyMsg {
  static constexpr std::uint32_t kId = 0x090;
  static constexpr std::uint8_t kDlc = 8;
  std::uint16_t code;
  std::uint8_t error_register, reason, axis, bin;
  std::int16_t measured;  ///< LSB 1/256 dps
  std::uint8_t event_seq;
};
struct RateMsg {
  static constexpr std::uint32_t kId = 0x190;
  static constexpr std::uint8_t kDlc = 8;
  std::int16_t rate[3];  ///< LSB 1/256 dps
  std::uint8_t seq;
  bool valid, clipped, still, corr_applied, learning, vibration, temp_fresh, test_mode;
};
struct RawMsg {
  static constexpr std::uint32_t kId = 0x290;
  static constexpr std::uint8_t kDlc = 8;
  std::int16_t raw[3];  ///< LSB 125 * 2^range_code / 32768 dps
  std::uint8_t seq, range_code;
  bool overrun;
};
struct AccMsg {
  static constexpr std::uint32_t kId = 0x2D0;
  static constexpr std::uint8_t kDlc = 8;
  std::int16_t acc[3];  ///< LSB 0.000125 g
  std::uint8_t seq;
  bool clipped;
};
struct TimeMsg {
  static constexpr std::uint32_t kId = 0x390;
  static constexpr std::uint8_t kDlc = 8;
  std::uint32_t sample_time_us;
  std::uint16_t sample_seq;
  std::int16_t temperature;  ///< LSB 1/256 degC
};
struct CorrMsg {
  static constexpr std::uint32_t kId = 0x490;
  static constexpr std::uint8_t kDlc = 8;
  std::int16_t corr[3];  ///< LSB 1/1024 dps
  std::uint8_t bin, state, age_s;
};
/// Both directions of the SDO channel; segments are read from the frame's bytes themselves.
struct SdoMsg {
  static constexpr std::uint32_t kTxId = 0x590;  ///< board to rig
  static constexpr std::uint32_t kRxId = 0x610;  ///< rig to board
  static constexpr std::uint8_t kDlc = 8;
  std::uint32_t id;
  std::uint8_t cmd;
  std::uint16_t index;
  std::uint8_t sub;
  std::uint32_t data;
};
struct StatusMsg {
  static constexpr std::uint32_t kId = 0x690;
  static constexpr std::uint8_t kDlc = 8;
  std::uint8_t boot_reason;
  std::uint16_t boot_count;
  std::uint32_t uptime_s;  ///< 24 bits
  std::uint8_t corr_mode, nv_state;
  bool test_mode_active, rig_heartbeat_ok;
  std::uint8_t rejections;  ///< low byte of their number since boot
};
/// Multiplexed: only the fields of page `mux` (0..3) are on the bus, the others read as zero.
struct IdentMsg {
  static constexpr std::uint32_t kId = 0x6B0;
  static constexpr std::uint8_t kDlc = 8;
  static constexpr std::uint8_t kPages = 4;
  std::uint8_t mux;
  std::uint8_t fw_major, fw_minor, fw_patch;  // page 0
  std::uint32_t build_id;
  std::uint8_t hw_rev;  // page 1
  std::uint32_t serial;
  std::uint8_t lut_points;  // page 2
  std::uint16_t lut_generation;
  std::uint32_t lut_crc32;
  std::uint8_t proto_major, proto_minor;  // page 3
  std::uint32_t config_crc32;
};
/// The board's and the rig's heartbeat.
struct HeartbeatMsg {
  static constexpr std::uint32_t kNodeId = 0x710;
  static constexpr std::uint32_t kRigId = 0x77E;
  static constexpr std::uint8_t kDlc = 1;
  std::uint32_t id;
  std::uint8_t state;
};

Frame Encode(const NmtMsg& m);
Frame Encode(const TimeStampMsg& m);
Frame Encode(const EmcyMsg& m);
Frame Encode(const RateMsg& m);
Frame Encode(const RawMsg& m);
Frame Encode(const AccMsg& m);
Frame Encode(const TimeMsg& m);
Frame Encode(const CorrMsg& m);
Frame Encode(const SdoMsg& m);
Frame Encode(const StatusMsg& m);
Frame Encode(const IdentMsg& m);
Frame Encode(const HeartbeatMsg& m);

/// False, and `out` untouched, when the frame is not this message.
bool Decode(const Frame& f, NmtMsg* out);
bool Decode(const Frame& f, TimeStampMsg* out);
bool Decode(const Frame& f, EmcyMsg* out);
bool Decode(const Frame& f, RateMsg* out);
bool Decode(const Frame& f, RawMsg* out);
bool Decode(const Frame& f, AccMsg* out);
bool Decode(const Frame& f, TimeMsg* out);
bool Decode(const Frame& f, CorrMsg* out);
bool Decode(const Frame& f, SdoMsg* out);
bool Decode(const Frame& f, StatusMsg* out);
bool Decode(const Frame& f, IdentMsg* out);
bool Decode(const Frame& f, HeartbeatMsg* out);

/// Nearest integer (halves away from zero) of value / lsb, saturating; NaN gives 0.
inline std::int16_t ToWire16(float value, float lsb) {
  const float x = value / lsb;
  if (!(x == x)) return 0;
  if (x >= 32767.0f) return 32767;
  if (x <= -32768.0f) return -32768;
  const float half = x < 0 ? -0.5f : 0.5f;  // chosen, not branched on: the sign of noise
  return static_cast<std::int16_t>(x + half);
}
std::uint16_t ToWireU16(float value, float lsb);

}  // namespace zro::node
