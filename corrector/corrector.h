#pragma once
// The gyro zero-rate-offset corrector: learns (temperature, ZRO) pairs while the board is
// motionless, checks each before it may enter the table, subtracts the interpolated offset.
// Implements the method of US 8,577,633 B2 (figures 4 and 5, claims 1-13); docs/patent-map.md.
#include "corrector/age.h"
#include "corrector/arithmetic.h"
#include "corrector/config.h"
#include "corrector/event_queue.h"
#include "corrector/noise_floor.h"
#include "corrector/quality.h"
#include "corrector/quarantine.h"
#include "corrector/reading.h"
#include "corrector/residual.h"
#include "corrector/sanity.h"
#include "corrector/stillness.h"
#include "corrector/storage.h"
#include "corrector/store.h"
#include "corrector/table.h"
#include "corrector/thermometer.h"
#include "corrector/types.h"

namespace zro {

/// One gyro's corrector. Not thread-safe; no global state, so one program may hold several.
/// Deterministic: outputs depend on the calls and their order alone.
class Corrector {
 public:
  /// `storage` is borrowed and may be null (table in RAM only).
  Corrector(const Config& config, Storage* storage);

  /// Loads the newest valid slot. Call once after construction (a reboot is a new object).
  /// A store that holds something, but nothing valid, gives kStoreInvalid and an empty table.
  void Boot();

  /// Date for new entries, days since 1984-01-01; 0 = unknown.
  void SetDate(std::uint16_t days);

  /// One sample in, one corrected rate out. Bounded time; no I/O except a table commit.
  Output Step(const Sample& sample);

  /// Takes the oldest event not yet taken; false when there is none. At most
  /// EventQueue::kCapacity are kept (the oldest give way); lost_events() counts the others.
  bool PopEvent(Event* out) { return events_.Pop(out); }
  std::uint32_t lost_events() const { return events_.lost(); }

  /// Adds an entry measured at the factory (claim 7). Not stored until Commit(). Replaces the
  /// factory entry of the same bin. False when the values are unfit or the table is full.
  bool AddFactoryEntry(float temp_degc, const float zro_dps[kAxes], float sigma_dps);
  /// Writes the table to the store now (object 0x1010), unless nothing changed since the last
  /// time. False when the storage failed; it is tried again a minute later.
  bool Commit();
  /// Drops what was learned, keeps the factory's entries, commits (object 0x1011).
  bool RestoreFactory();
  void SetLimits(const Limits& limits) { config_.limits = limits; }
  const Limits& limits() const { return config_.limits; }
  /// A reading with a sample taken while this is set is refused with kTestMode (object 0x2101).
  void SetTestMode(bool on) { test_mode_ = on; }

  const Table& table() const { return table_; }
  std::uint32_t generation() const { return generation_; }
  bool dirty() const { return dirty_; }                  ///< changed since the last commit
  bool store_failing() const { return store_failing_; }  ///< the last commit failed
  bool complete() const { return complete_; }

 private:
  /// The still period under way.
  struct Period {
    Finding pending;           ///< mismatch being re-read; kNone: none
    std::uint32_t resume_at;   ///< no reading before this sample, while waiting
    std::uint32_t written_at;  ///< last write, to written_bin, while wrote
    std::uint32_t said_at;     ///< last kRecentNothingToDo, of said_bin, while said
    std::int16_t written_bin;
    std::int16_t said_bin;
    std::uint8_t refusals;  ///< since the last accepted reading
    bool waiting;
    bool wrote;
    bool said;
    bool judged;  ///< a reading of it was learned or refused
    bool voted;   ///< it had its say in the quarantine
    bool clean;   ///< the pending mismatch may be evidence
  };

  void Learn(const Sample& sample);
  void EndStill();
  void Judge();
  void Refuse(const Finding& finding, const Summary& reading);
  void Contradict(const Decision& decision, const Summary& reading);
  Quarantine::Vote VoteOf(const Decision& decision, const Summary& reading) const;
  bool IsClean(const Summary& reading) const;
  void Follow(const Decision& decision, const Summary& reading);
  void Vote();
  void Confirm();
  void ShiftTable(const float shift_dps[kAxes]);
  void Accept(const Decision& decision, const Summary& reading);
  void Write(const Decision& decision, const Summary& reading);
  void SayNothingToDo(const Finding& finding, const Summary& reading);
  void NoteWrite(float temp_degc, bool promptly);
  void UpdateCompletion();
  bool EveryBinIsFresh() const;
  Entry EntryOf(const Summary& reading) const;
  bool MayMerge(float temp_degc) const;

  void TakeTemperature(const Sample& sample);
  void CommitIfDue();
  Estimate EstimateNow();
  /// Adds to the table's offset what is known beyond it.
  void AddPresent(float temp_degc, Estimate* estimate) const;
  Output Correct(const Sample& sample);
  Source SourceOf(const Estimate& estimate) const;
  bool Vibrates() const;
  void Emit(const Finding& finding, float temp_degc, const float* measured_dps);
  std::uint8_t WireBin(float temp_degc) const;
  Age Ages() const { return Age(date_, config_); }
  std::uint32_t Samples(float seconds) const { return SamplesIn(seconds, config_.sample_hz); }
  bool Due(std::uint32_t at) const { return static_cast<std::int32_t>(sample_ - at) >= 0; }

  Config config_;
  Table table_;
  Store store_;
  EventQueue events_;
  Stillness stillness_;
  Reading reading_;
  NoiseFloor floor_;
  PresentNoise noise_;
  Quarantine quarantine_;
  Residual residual_;
  Thermometer thermometer_;
  Period period_{};
  Entry candidate_{};                     ///< the latest reading that the table contradicted ...
  Quarantine::Vote candidate_vote_{};     ///< ... and what it says
  Estimate estimate_{};                   ///< at estimate_degc_; holds while fresh_ ...
  float slope_dps_per_degc_[kAxes] = {};  ///< ... with this slope about it
  float estimate_degc_ = 0.0f;
  float temp_degc_ = 0.0f;  ///< last physical temperature, finer than a coarse sensor's step
  std::uint32_t generation_ = 0;
  std::uint32_t sample_ = 0;  ///< index of the present sample since boot
  std::uint32_t commit_at_ = 0;
  std::uint32_t last_commit_ = 0;
  std::uint16_t date_ = 0;
  std::int8_t nearest_ = -1;  ///< entry, of estimate_degc_
  bool started_ = false;
  bool has_temp_ = false;
  bool temp_valid_ = false;  ///< the present sample's own temperature is physical
  bool fresh_ = false;
  bool commit_due_ = false;
  bool dirty_ = false;
  bool complete_ = false;
  bool test_mode_ = false;
  bool tested_ = false;  ///< test_mode_ was set during the reading under way
  bool updated_ = false;
  bool store_invalid_ = false;
  bool store_failing_ = false;
};

}  // namespace zro
