#pragma once
// An IMU board that speaks the protocol of corrector/node/zrobench.dbc.
#include "drivers/imu/imu_board.h"
#include "drivers/imu/sdo_client.h"

namespace zrobench {

/// Over any CanBus. Thread-compatible.
class CanImuBoard final : public ImuBoard {
 public:
  /// All are borrowed; `listener` may be null.
  CanImuBoard(CanBus& bus, Clock& clock, FrameListener* listener);

  Status Pump() override;
  BoardStatus status() const override;
  CanHealth link() const override { return bus_.health(); }

  Status Reset() override;
  /// kConfig before 1984-01-01 and after 2163-06-06: CiA TIME cannot say it.
  Status SendDate(UtcNs utc) override;
  Status SendHeartbeat() override;

  /// Freezes, reads header, image and header again, releases (also after a failure). kProtocol when
  /// image, CRC-32 and generation do not fit together; a generation that moved is tried once more.
  Result<TableSnapshot> ReadTable(Instant deadline) override;
  Result<std::vector<std::array<std::uint8_t, 24>>> ReadNewLogRecords(Instant deadline) override;
  Status StoreTable(Instant deadline) override;
  Status RestoreFactory(Instant deadline) override;
  /// Unlocks the board, downloads, locks it again (which ends its test modes).
  Status DownloadFactoryEntry(double temp_degc, const std::array<double, 3>& zro_dps,
                              double sigma_dps, Instant deadline) override;

  Status SetLoad(double duty_pct, Instant deadline) override;

  /// Any other object.
  SdoClient& sdo() { return sdo_; }

 private:
  struct TableHeader {
    std::uint32_t generation = 0;
    std::uint32_t crc32 = 0;
    bool operator==(const TableHeader&) const = default;
  };

  Status WatchTime(Instant at);
  void Take(const zro::node::Frame& frame);
  void CountSample(std::uint8_t seq);
  Status WriteU32(std::uint16_t index, std::uint8_t sub, std::uint32_t value, Instant deadline);
  Result<std::uint32_t> ReadU32(std::uint16_t index, std::uint8_t sub, Instant deadline);
  Result<TableHeader> ReadTableHeader(Instant deadline);
  /// Nothing when the table changed meanwhile.
  Result<std::optional<TableSnapshot>> TryReadTable(Instant deadline);
  Result<std::optional<TableSnapshot>> ReadFrozenTable(Instant deadline);

  CanBus& bus_;
  Clock& clock_;
  FrameListener* listener_;
  SdoClient sdo_;
  BoardStatus status_;
  bool heard_ = false;
  Instant last_heard_{};
  Instant last_frame_{};
  bool have_seq_ = false;
  std::uint8_t last_seq_ = 0;
};

}  // namespace zrobench
