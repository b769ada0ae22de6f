#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"
#include "corrector/node/node.h"
#include "rig/record/item.h"
#include "rig/record/ram_storage.h"
#include "rig/record/sample_counter.h"

namespace zrobench {

/// What the board sent and what the replica says it should have sent.
struct Lockstep {
  std::uint64_t equal = 0;  ///< frames that agree byte for byte
  std::uint64_t different = 0;
  std::optional<std::uint64_t> first_difference_us;
  std::uint32_t first_difference_id = 0;  ///< CAN id of that frame
};

/// The board's software again, on the host, fed from a record in bus order: whoever wants to know
/// what the corrector should have done asks here. Its inputs are those of design.md section 5:
/// start image, DUT_TIME, DUT_RAW and DUT_ACC, TIME_STAMP, NMT, rig heartbeat, SDO writes, boots.
/// An SDO request takes effect where the record shows the board's reply.
class Replica final : private zro::node::FrameSink {
 public:
  /// `start_image`: the board's store at the start of the record, as its first TableItem has it
  /// (StartImage()). kConfig when it is no canonical image. `time_divider` as the board's
  /// (DUT_TIME every n-th sample).
  static Result<std::unique_ptr<Replica>> Create(const zro::Config& config,
                                                 std::uint16_t time_divider,
                                                 std::span<const std::uint8_t> start_image);

  /// Items in the order of the record. Those that are no input of the board are ignored.
  void On(const ImuTime& item) {
    counter_.Take(item);
    temperature_ = item.temperature;
  }
  void On(const ImuSample& item);
  void On(const ImuCorrection& item);
  void On(const BusFrame& item);
  template <typename T>
  void On(const T&) {}

  /// Canonical image of the replica's table now; empty before the first boot.
  std::vector<std::uint8_t> TableImage() const;
  /// Every 24-byte log record so far, over all boots.
  const std::vector<std::array<std::uint8_t, 24>>& log() const { return log_; }

  const Lockstep& rates() const { return rates_; }              ///< DUT_RATE
  const Lockstep& corrections() const { return corrections_; }  ///< DUT_CORR
  const Lockstep& replies() const { return replies_; }          ///< SDO, objects 0x2000 and up
  const Lockstep& emergencies() const { return emergencies_; }
  /// Inputs that the record lacks: samples missing between others, samples in front of the first
  /// boot, requests without a reply. Not zero: nothing can be concluded from a difference.
  std::uint64_t lost_inputs() const { return lost_inputs_; }
  std::uint32_t boots() const { return boots_; }

 private:
  Replica(const zro::Config& config, std::uint16_t time_divider)
      : config_(config), time_divider_(time_divider) {}
  void Send(const zro::node::Frame& frame) override;
  void Reboot();
  void OnOwn(const BusFrame& item, const zro::node::Frame& frame);
  void OnReply(const BusFrame& item, const zro::node::Frame& frame);
  void OnEmergency(const BusFrame& item, const zro::node::Frame& frame);
  void CollectLog();

  zro::Config config_;
  std::uint16_t time_divider_;
  RamStorage storage_;
  std::optional<zro::node::Node> node_;
  SampleCounter counter_;
  std::int16_t temperature_ = 0;
  std::uint32_t boots_ = 0;

  // what the node sent last
  zro::node::Frame rate_{}, correction_{};
  std::deque<zro::node::Frame> sent_emergencies_, sent_replies_;
  std::optional<zro::node::Frame> request_;  ///< on its way, not yet answered
  std::uint16_t object_ = 0;                 ///< of the transfer under way

  std::vector<std::array<std::uint8_t, 24>> log_;
  std::uint32_t logged_ = 0;  ///< of this boot
  Lockstep rates_, corrections_, replies_, emergencies_;
  std::uint64_t lost_inputs_ = 0;
};

/// The board's store at the start of a record: the image of its first TableItem. kFile when the
/// record cannot be read, kConfig when it holds no table.
Result<std::vector<std::uint8_t>> StartImage(const std::filesystem::path& record);

}  // namespace zrobench
