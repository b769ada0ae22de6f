#include "corrector/node/test_modes.h"

namespace zro::node {

bool TestModes::Unlock(std::uint32_t key) {
  if (key == 0) Clear();
  if (key == kKey) {
    unlocked_ = true;
    since_ = 0;
  }
  return key == 0 || key == kKey;
}

void TestModes::SetInjection(const std::int16_t lsb[kAxes]) {
  for (int i = 0; i < kAxes; ++i) injection_[i] = lsb[i];
}

bool TestModes::SetLoad(std::uint8_t pct) {
  if (pct > 100) return false;
  load_pct_ = pct;
  return true;
}

void TestModes::OnSample(std::uint32_t elapsed) {
  since_ = since_ + elapsed < since_ ? 0xFFFFFFFFu : since_ + elapsed;
  if (since_ > allowed_) Clear();
}

void TestModes::Clear() {
  unlocked_ = false;
  load_pct_ = 0;
  for (std::int16_t& lsb : injection_) lsb = 0;
}

}  // namespace zro::node
