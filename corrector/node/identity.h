#pragma once
#include <cstdint>

namespace zro::node {

/// Who the board is: DUT_IDENT and objects 0x1009, 0x100A, 0x1018.
struct Identity {
  std::uint8_t fw_major, fw_minor, fw_patch, hw_rev;
  std::uint32_t build_id, serial;
};

}  // namespace zro::node
