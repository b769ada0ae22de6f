#include "tests/bench/corrector/learner.h"

#include <cstring>
#include <optional>

#include "corrector/corrector.h"
#include "rig/record/ram_storage.h"
#include "tests/bench/corrector/simple_learners.h"

namespace zrobench::bench {
namespace {

/// Entries of `before` that `after` does not hold exactly.
int Lost(const zro::Table& before, const zro::Table& after) {
  int lost = 0;
  for (int i = 0; i < before.size(); ++i) {
    bool kept = false;
    for (int j = 0; j < after.size(); ++j) {
      kept = kept || std::memcmp(&before[i], &after[j], sizeof(zro::Entry)) == 0;
    }
    lost += kept ? 0 : 1;
  }
  return lost;
}

class Ours final : public Learner {
 public:
  explicit Ours(double sample_hz) {
    // The noise density of the scenarios: 50 mdps a sample at 100 Hz.
    config_ = zro::ConfigFor(static_cast<float>(sample_hz), 0.005f);
    corrector_.emplace(config_, &storage_);
    corrector_->Boot();
  }

  void LoadFactory(const std::vector<std::pair<double, Vector>>& entries) override {
    for (const auto& [degc, zro] : entries) {
      const float zro_dps[3] = {static_cast<float>(zro[0]), static_cast<float>(zro[1]),
                                static_cast<float>(zro[2])};
      corrector_->AddFactoryEntry(static_cast<float>(degc), zro_dps, 0.010f);
    }
    corrector_->Commit();
  }
  void SetDate(std::uint16_t days) override {
    date_ = days;
    corrector_->SetDate(days);
  }
  Vector Step(const zro::Sample& sample) override {
    const zro::Output out = corrector_->Step(sample);
    return {static_cast<double>(out.zro_dps[0]), static_cast<double>(out.zro_dps[1]),
            static_cast<double>(out.zro_dps[2])};
  }
  void TakeEvents(std::vector<zro::Event>* out) override {
    zro::Event event;
    while (corrector_->PopEvent(&event)) out->push_back(event);
  }
  int Reboot(bool orderly) override {
    if (orderly) corrector_->Commit();
    zro::Corrector reborn(config_, &storage_);
    reborn.Boot();
    reborn.SetDate(date_);
    const int lost = Lost(corrector_->table(), reborn.table());
    corrector_.emplace(reborn);
    return lost;
  }
  std::uint32_t ReadingSamples() const override {
    return config_.limits.min_samples +
           static_cast<std::uint32_t>(zro::Reading::kGuardS * config_.sample_hz);
  }

 private:
  zro::Config config_;
  RamStorage storage_;
  std::optional<zro::Corrector> corrector_;
  std::uint16_t date_ = 0;
};

}  // namespace

std::unique_ptr<Learner> MakeLearner(LearnerKind kind, double sample_hz) {
  if (kind == LearnerKind::kOurs) return std::make_unique<Ours>(sample_hz);
  if (kind == LearnerKind::kConstant) return std::make_unique<ConstantLearner>(sample_hz);
  return std::make_unique<BinsLearner>(sample_hz);
}

}  // namespace zrobench::bench
