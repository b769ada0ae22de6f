#pragma once
// The gyro zero-rate-offset corrector: learns (temperature, ZRO) pairs while the board is
// motionless, checks each before it may enter the table, subtracts the interpolated offset.
// Implements the method of US 8,577,633 B2 (figures 4 and 5, claims 1-13); docs/patent-map.md.
#include "corrector/config.h"
#include "corrector/storage.h"
#include "corrector/table.h"
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

  /// Takes the oldest event not yet taken; false when there is none. At most kEventQueue are kept
  /// (the oldest give way); lost_events() counts the others.
  bool PopEvent(Event* out);
  std::uint32_t lost_events() const { return lost_events_; }

  /// Adds an entry measured at the factory (claim 7). Not stored until Commit().
  bool AddFactoryEntry(float temp_degc, const float zro_dps[kAxes], float sigma_dps);
  /// Writes the table to the store now (object 0x1010). False when the storage failed.
  bool Commit();
  /// Drops what was learned, keeps the factory's entries, commits (object 0x1011).
  bool RestoreFactory();
  void SetLimits(const Limits& limits);
  const Limits& limits() const { return config_.limits; }
  /// While set, readings are refused with kTestMode (object 0x2101).
  void SetTestMode(bool on) { test_mode_ = on; }

  const Table& table() const { return table_; }
  std::uint32_t generation() const { return generation_; }
  bool dirty() const { return dirty_; }  ///< changed since the last commit
  bool complete() const { return complete_; }

 private:
  static constexpr int kEventQueue = 16;
  // private parts are the corrector room's own
  Config config_;
  Storage* storage_;
  Table table_;
  std::uint32_t generation_ = 0;
  std::uint32_t lost_events_ = 0;
  bool dirty_ = false;
  bool complete_ = false;
  bool test_mode_ = false;
};

}  // namespace zro
