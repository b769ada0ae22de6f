#pragma once
// Object 0x2100: the corrector's limits as values of the bus. Freestanding.
#include "corrector/config.h"
#include "corrector/node/byte_writer.h"
#include "corrector/node/sdo.h"

namespace zro::node {

inline constexpr std::uint8_t kLimitSubs = 9;

/// Appends limit `sub` (1..9): mode u8, max_bias f32, max_step f32, max_slope f32, still_sigma f32,
/// min_samples u16, vibration ratio f32, min and max temperature i16 (1/256 degC).
void PutLimit(const Limits& limits, std::uint8_t sub, ByteWriter* out);

/// Sets it; kRange, and nothing changed, for values that no corrector can work with.
SdoAbort SetLimit(std::uint8_t sub, const std::uint8_t* bytes, Limits* limits);

/// CRC-32 of the nine values as PutLimit() gives them, in order: DUT_IDENT ConfigCrc32.
std::uint32_t LimitsCrc(const Limits& limits);

}  // namespace zro::node
