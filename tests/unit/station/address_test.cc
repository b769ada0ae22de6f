#include "rig/station/address.h"

#include <gmock/gmock.h>

namespace zrobench {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Address, EveryFormOfTheFormatIsGood) {
  for (const char* plate : {"virtual:", "modbus-tcp://10.0.0.5:502", "modbus-rtu:/dev/ttyUSB0",
                            "modbus-rtu:/dev/ttyUSB0?baud=9600", "modbus-rtu:pty:plate"}) {
    EXPECT_THAT(AddressFault(Role::kPlate, plate), IsEmpty()) << plate;
  }
  for (const char* speaker :
       {"scpi:/dev/usbtmc0", "scpi-tcp://generator:5025", "jds6600:/dev/ttyUSB1", "virtual:"}) {
    EXPECT_THAT(AddressFault(Role::kSpeaker, speaker), IsEmpty()) << speaker;
  }
  for (const char* board : {"can:can0", "slcan:pty:board", "slcan-tcp://localhost:3333",
                            "unix-can:bench.sock", "virtual:"}) {
    EXPECT_THAT(AddressFault(Role::kBoard, board), IsEmpty()) << board;
  }
}

TEST(Address, WrongPartsAreNamed) {
  EXPECT_THAT(AddressFault(Role::kPlate, "modbus-tcp://10.0.0.5"), HasSubstr("HOST:PORT"));
  EXPECT_THAT(AddressFault(Role::kPlate, "modbus-tcp://10.0.0.5:70000"), HasSubstr("65535"));
  EXPECT_THAT(AddressFault(Role::kPlate, "modbus-rtu:/dev/x?baud=fast"), HasSubstr("baud"));
  EXPECT_THAT(AddressFault(Role::kPlate, "modbus-rtu:"), HasSubstr("path"));
  EXPECT_THAT(AddressFault(Role::kBoard, "can:"), HasSubstr("can:can0"));
  EXPECT_THAT(AddressFault(Role::kBoard, "virtual:x"), HasSubstr("nothing after"));
}

TEST(Address, ARoleRefusesAnotherRolesInstrument) {
  EXPECT_THAT(AddressFault(Role::kSpeaker, "can:can0"), HasSubstr("no address of a speaker"));
  EXPECT_THAT(AddressFault(Role::kBoard, "modbus-tcp://h:1"), HasSubstr("slcan"));
  EXPECT_THAT(AddressFault(Role::kPlate, ""), HasSubstr("begins with one of virtual:"));
}

}  // namespace
}  // namespace zrobench
