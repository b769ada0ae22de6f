#include "rig/virtual/virtual_rig.h"
#include "tests/contract/instruments.h"

namespace zrobench {
namespace {

class VirtualInstruments final : public InstrumentsUnderTest {
 public:
  VirtualInstruments()
      : clock_(station_.virtual_rig.epoch), rig_(*VirtualRig::Make(station_, 1, clock_)) {}
  Clock& clock() override { return clock_; }
  ThermalPlate& plate() override { return rig_->plate(); }
  Speaker& speaker() override { return rig_->speaker(); }

 private:
  Station station_;
  VirtualClock clock_;
  std::unique_ptr<VirtualRig> rig_;
};

}  // namespace

std::unique_ptr<InstrumentsUnderTest> MakeVirtualInstruments() {
  return std::make_unique<VirtualInstruments>();
}

}  // namespace zrobench
