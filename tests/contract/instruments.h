#pragma once
// One set of instruments under contract: who implements a role adds a maker to kMakers.
#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "core/clock.h"
#include "drivers/plate/thermal_plate.h"
#include "drivers/speaker/speaker.h"

namespace zrobench {

/// Owns what it needs; references stay valid as long as it lives.
class InstrumentsUnderTest {
 public:
  virtual ~InstrumentsUnderTest() = default;
  virtual Clock& clock() = 0;
  virtual ThermalPlate& plate() = 0;
  virtual Speaker& speaker() = 0;
  Instant Soon() { return clock().now() + std::chrono::seconds(2); }
  void Pass(double seconds) { clock().Wait(clock().now() + FromSeconds(seconds), {}); }
};

struct Maker {
  std::string name;
  std::function<std::unique_ptr<InstrumentsUnderTest>()> make;
};
inline void PrintTo(const Maker& maker, std::ostream* out) { *out << maker.name; }

/// The virtual rig's instruments, plate at 23 degC.
std::unique_ptr<InstrumentsUnderTest> MakeVirtualInstruments();

}  // namespace zrobench
